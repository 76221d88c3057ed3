/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws of strengths by mean and standard deviation, and from measured strengths. */
#include "base/hash.h"
#include "sampler/special/weibull_shape.h"
#include "tests/support/strengths.h"

#include <gsl/gsl_cdf.h>
#include <inttypes.h>

static const fracas_extent one = {1.0, 1.0};

/* ---- Weibull shape ---- */

/* The oracle cancels: 4 2^-64 over the variation, 1.6e-6 at least. */
static long double exact_variation(long double x)
{
    return expm1l(lgammal(1.0L + 2.0L * x) - 2.0L * lgammal(1.0L + x));
}

static void weibull_variation_is_exact(void **state)
{
    double largest = 0.0, inverse = 0.0;
    for (double x = 0.001; x <= 10.0; x *= 1.003) {
        const double exact = (double)exact_variation(x);
        largest = fmax(largest, fabs(fracas_weibull_variation(x) / exact - 1.0));
        inverse = fmax(inverse, fabs(fracas_weibull_shape_inverse(exact, 0.001, 10.0) / x - 1.0));
    }
    print_message("variation: largest error %.2g, of the shape %.2g\n", largest, inverse);
    assert_true(largest < 5e-14 && inverse < 1e-13);
    assert_true(fracas_weibull_shape_inverse(0.0, 0.001, 10.0) < 0.0011 &&
                fracas_weibull_shape_inverse(1e9, 0.001, 10.0) > 9.999);
}

/* docs/theory/sampling.md: 308.31 +- 23.16 MPa above 264 MPa is of shape 2 and scale 50 MPa; five
 * digits are published. */
static void published_moments_are_the_published_shapes(void **state)
{
    static const struct {
        double minimum, mean, deviation, scale, shape;
    } published[] = {
        {264e6, 308.31e6, 23.16e6, 50e6, 2.0},
        {0.0, 413.18e6, 94.64e6, 450e6, 5.0},
        {0.0, 443.78e6, 13.98e6, 450e6, 40.0},
    };
    for (size_t k = 0; k < FRACAS_COUNT(published); k++) {
        const fracas_strength given = law_by_moments("weibull", published[k].minimum,
                                                     published[k].mean, published[k].deviation);
        FRACAS_CLEARED(fracas_strength) ready;
        OK(fracas_strength_init(&given, &ready));
        assert_close(ready.shape, published[k].shape, 5e-4);
        assert_close(ready.scale, published[k].scale, 5e-4);
    }
}

/* ---- moments ---- */

/* 1e-12: the shape is right to 1e-13, and near an end of the range, where a law is widest, its
 * deviation follows it several times over. */
static void moments_come_back(void **state)
{
    static const struct {
        const char *law;
        double minimum, mean, ratio;
    } given[] = {
        {"weibull", 0.0, 300e6, 0.0013}, {"weibull", 0.0, 300e6, 0.03},
        {"weibull", 0.0, 300e6, 0.14},   {"weibull", 0.0, 300e6, 1.0},
        {"weibull", 0.0, 300e6, 400.0},  {"weibull", 264e6, 308e6, 0.07},
        {"weibull", 299e6, 300e6, 1e-3}, {"lognormal", 0.0, 300e6, 1e-6},
        {"lognormal", 0.0, 300e6, 0.1},  {"lognormal", 0.0, 300e6, 5.0},
        {"lognormal", 0.0, 300e6, 1e8},  {"gamma", 0.0, 300e6, 0.0011},
        {"gamma", 0.0, 300e6, 0.3},      {"gamma", 0.0, 300e6, 3.1},
        {"uniform", 0.0, 300e6, 1e-4},   {"uniform", 0.0, 300e6, 0.57},
        {"normal", 0.0, 300e6, 1e-6},    {"normal", 0.0, 300e6, 0.1},
        {"normal", 0.0, 300e6, 0.4},     {"normal", 0.0, 300e6, 0.75},
    };
    for (size_t k = 0; k < FRACAS_COUNT(given); k++) {
        const double mean = given[k].mean, deviation = given[k].ratio * mean;
        const fracas_strength law = law_by_moments(given[k].law, given[k].minimum, mean, deviation);
        FRACAS_CLEARED(fracas_strength) ready;
        OK(fracas_strength_check(&law));
        OK(fracas_strength_init(&law, &ready));
        assert_close(fracas_strength_mean(&ready, one), mean, 1e-12);
        assert_close(fracas_strength_deviation(&ready, one), deviation, 1e-12);
        /* one that is not ready has the same bits */
        const fracas_probability p = fracas_probability_of(0.3);
        assert_true(fracas_strength_quantile(&law, one, p) ==
                    fracas_strength_quantile(&ready, one, p));
        assert_true(fracas_strength_deviation(&law, one) == fracas_strength_deviation(&ready, one));
    }
}

/* By its own parameters, so that the deviation is not that which was put in. Long double, or three
 * multiplications. */
static void deviations_are_exact(void **state)
{
    for (double shape = 0.1; shape <= 1000.0; shape *= 1.31) {
        fracas_strength law = STRENGTH("weibull", .minimum = 100e6, .scale = 50e6, .shape = shape);
        const long double x = 1.0L / shape;
        assert_close(fracas_strength_deviation(&law, one),
                     (double)(50e6L * expl(lgammal(1.0L + x)) * sqrtl(exact_variation(x))), 1e-13);
    }
    for (double sigma = 1e-4; sigma < 5.0; sigma *= 2.0) {
        fracas_strength law = STRENGTH("lognormal", .median = 300e6, .sigma = sigma);
        const long double s = (long double)sigma * sigma;
        assert_close(fracas_strength_deviation(&law, one),
                     (double)(300e6L * expl(0.5L * s) * sqrtl(expm1l(s))), 1e-14);
    }
    fracas_strength uniform = STRENGTH("uniform", .minimum = 100e6, .maximum = 340e6);
    assert_close(fracas_strength_deviation(&uniform, one), 240e6 / sqrt(12.0), 1e-15);
    fracas_strength gamma = STRENGTH("gamma", .shape = 16.0, .scale = 10e6);
    assert_close(fracas_strength_deviation(&gamma, one), 40e6, 1e-15);
    fracas_strength constant = STRENGTH("constant", .value = 1e8);
    assert_true(fracas_strength_deviation(&constant, one) == 0.0);
    for (double mu = 0.5; mu < 100.0;
         mu *= 3.0) { /* exponents 1/2 and 1: integrals over e^-z by parts, in long double */
        const long double m = mu, e = expl(-m), r1 = (1 - e) / m,
                          r2 = 2 * (1 - e * (1 + m)) / (m * m);
        const long double r4 = 4 * (6 - e * (((m + 3) * m + 6) * m + 6)) / (m * m * m * m);
        fracas_strength flaws = STRENGTH("flaws", .own[0] = mu, .minimum = 100e6, .maximum = 400e6,
                                         .own[1] = 1.0);
        assert_close(fracas_strength_deviation(&flaws, one), (double)(300e6L * sqrtl(r2 - r1 * r1)),
                     1e-12);
        flaws.own[1] = 0.5;
        assert_close(fracas_strength_deviation(&flaws, one), (double)(300e6L * sqrtl(r4 - r2 * r2)),
                     1e-12);
    }
    const fracas_attachment numbers = FILE_OF("s.csv", "1e8\n2e8\n4e8\n5e8\n");
    fracas_strength file = STRENGTH("file", .file = &numbers);
    assert_close(fracas_strength_deviation(&file, one), sqrt(2.5) * 1e8,
                 1e-15); /* of 1, 2, 4, 5 about 3 */
}

/* The bits of the shapes hang on every term. */
static void bits_are_golden(void **state)
{
    static double value[3000];
    for (int i = 0; i < 1000; i++) {
        const double x = 0.001 * (i < 500 ? 1.0 + 0.5 * i : 0.5 * i * i / 25.0);
        value[i] = fracas_weibull_variation(fmin(x, 10.0));
        value[1000 + i] = fracas_weibull_shape_inverse(value[i], 0.001, 10.0);
        const fracas_strength law = law_by_moments("normal", 0.0, 300e6,
                                                   300e6 * (0.0005 + 0.00075 * i));
        value[2000 + i] = fracas_strength_quantile(&law, one, fracas_probability_of(0.25));
    }
    const uint64_t got = fracas_checksum_of(value, sizeof value);
    print_message("0x%016" PRIx64 "\n", got);
    assert_true(got == 0x1042b69bfd225376);
}

static void refused(const fracas_strength *law, const char *words)
{
    FAILS(fracas_strength_check(law), FRACAS_USAGE, words);
    assert_true(isnan(fracas_strength_mean(law, one)));
}

static void one_pair_is_given_whole(void **state)
{
    static const char *const keys[] = {"scale", "shape", "mean", "deviation"};
    static const double values[] = {300e6, 5.0, 280e6, 60e6};
    static const char *const words[16] = {
        [0] = "needs `scale` and `shape`, or `mean` and `deviation`; none of them is given: add "
              "one of the two pairs",
        [1] = "; add `shape`",
        [2] = "; add `scale`",
        [4] = "; add `deviation`",
        [8] = "; add `mean`",
        [5] = "parts of both are given: take out `mean` and add `shape`",
        [9] = "take out `deviation` and add `shape`",
        [10] = "take out `deviation` and add `scale`",
        [7] = "`scale` and `shape` say all: take out `mean`",
        [11] = "`scale` and `shape` say all: take out `deviation`",
        [13] = "`mean` and `deviation` say all: take out `scale`",
        [14] = "`mean` and `deviation` say all: take out `shape`",
        [15] = "`scale` and `shape` say all: take out `mean` and `deviation`",
    }; /* none for 3, 6 and 12: a Weibull distribution takes shape and mean as well */
    for (unsigned given = 0; given < 16; given++) {
        fracas_strength law = law_blank("weibull");
        for (int k = 0; k < 4; k++)
            if (given >> k & 1u)
                fracas_param_set(param_of(law.distribution, keys[k]), &law, values[k]);
        if (words[given]) refused(&law, words[given]);
        else OK(fracas_strength_check(&law));
    }
}

static void moments_beyond_a_law_are_refused(void **state)
{
    fracas_strength law = law_by_moments("weibull", 0.0, 300e6, 300e3);
    refused(&law,
            "deviation/(mean - minimum) is 0.001; a weibull distribution has it from 0.00128");
    law.deviation = 430 * 300e6;
    refused(&law, "deviation/(mean - minimum) is 430; a weibull distribution has it from 0.00128");
    law = law_by_moments("weibull", 300e6, 300e6, 30e6);
    refused(&law, "strength.mean is 300000000 Pa and strength.minimum 300000000 Pa; the mean is "
                  "above the minimum");
    law = law_by_moments("gamma", 0.0, 300e6, 4 * 300e6);
    refused(&law, "deviation/mean is 4; a gamma distribution has it from 0.001 to 3.16228");
    law = law_by_moments("uniform", 0.0, 300e6, 0.578 * 300e6);
    refused(&law, "deviation/mean is 0.578; a uniform distribution has it from 1e-09 to 0.5773");
    law = law_by_moments("normal", 0.0, 300e6, 0.756 * 300e6);
    refused(&law,
            "kept_deviation/kept_mean is 0.756; a normal distribution has it from 1e-09 to 0.7555");
    law = law_by_moments("lognormal", 0.0, 300e6, 300e16);
    refused(&law, "deviation/mean is 1e+10; a lognormal distribution");
}

/* ---- empirical ---- */

static const fracas_attachment measured = FILE_OF(
    "m.csv", "strength\n3e8\n# weakest last\n5e8,\n4e8\n 2e8\n");
static const fracas_attachment table = FILE_OF("t.csv",
                                               "s F\n1e8, 0\n2e8 0.25\n3e8\t0.25\n5e8,1\n");

static double at(const fracas_strength *law, double below, double above)
{
    return fracas_strength_quantile(law, one, (fracas_probability){below, above});
}

static void empirical_is_what_the_file_says(void **state)
{
    fracas_strength law = law_of_file(&measured, false), ready;
    OK(fracas_strength_init(&law, &ready));
    assert_close(at(&ready, 0.5, 0.5), 3.5e8, 1e-15); /* 2, 3, 4, 5 at 0, 1/3, 2/3, 1 */
    assert_close(at(&ready, 0.25, 0.75), 2.75e8, 1e-15);
    assert_close(at(&ready, 0.75, 0.25), 4.25e8, 1e-15);
    assert_close(at(&ready, 1.0, 0x1p-70), 5e8, 1e-15);
    assert_close(at(&ready, 1e-3, 0.999) - 2e8, 3e5, 1e-9); /* 2e8 is rounded by 3e-8 */
    assert_close(5e8 - at(&ready, 0.999, 1e-3), 3e5, 1e-9);
    fracas_strength_clear(&ready);
    law = law_of_file(&measured, true);
    OK(fracas_strength_init(&law, &ready));
    for (int k = 0; k < 4; k++) { /* a quarter each, the upper end included */
        assert_true(at(&ready, 0.25 * k + 1e-9, 1.0 - (0.25 * k + 1e-9)) == (k + 2) * 1e8);
        assert_true(at(&ready, 0.25 * (k + 1), 0.75 - 0.25 * k) == (k + 2) * 1e8);
    }
    assert_close(fracas_strength_mean(&ready, one), 3.5e8, 1e-15);
    assert_close(fracas_strength_deviation(&ready, one), sqrt(1.25) * 1e8, 1e-15);
    fracas_strength_clear(&ready);
    law = law_of_file(&table, false);
    assert_close(at(&law, 0.125, 0.875), 1.5e8, 1e-15);
    assert_close(at(&law, 0.25, 0.75), 2e8, 1e-15);
    assert_close(at(&law, 0.25 + 1e-12, 0.75 - 1e-12), 3e8, 1e-11);
    assert_close(at(&law, 0.625, 0.375), 4e8, 1e-15);
    /* a quarter of a uniform law about 1.5 and three quarters of one about 4: 27/8, with (1/12
     * + 2.25)/4 + 3/4 (4/12 + 16) */
    assert_close(fracas_strength_mean(&law, one), 3.375e8, 1e-15);
    assert_close(fracas_strength_deviation(&law, one),
                 sqrt((1.0 / 12 + 2.25) / 4 + 0.75 * (4.0 / 12 + 16) - 3.375 * 3.375) * 1e8, 1e-14);
    law = law_of_file(&table, true);
    assert_true(at(&law, 0.1, 0.9) == 2e8 && at(&law, 0.3, 0.7) == 5e8);
    assert_close(fracas_strength_mean(&law, one), 0.25 * 2e8 + 0.75 * 5e8, 1e-15);
}

static void wrong_files_are_refused(void **state)
{
    static const struct {
        const char *text, *words;
        bool steps;
    } wrong[] = {
        {"", "m.csv has no strength; expected one in Pa on each line", false},
        {"3e8\n4e8 Pa\n", "m.csv:2: found `Pa`; expected a probability from 0 to 1", false},
        {"3e8\n-1\n", "m.csv:2: found `-1`; expected a strength in Pa, a number greater than 0",
         false},
        {"3e8\nx\n", "m.csv:2: found `x`; expected a strength in Pa", false},
        {"3e8\n0\n", "m.csv:2: found `0`; expected a strength", false},
        {"3e8\n", "m.csv has one strength; a linear distribution function needs two", false},
        {"3e8 0\n4e8 1.5\n", "m.csv:2: found `1.5`; expected a probability from 0 to 1", false},
        {"3e8 0\n4e8 1 7\n", "m.csv:2: found `7`; expected the end of the line", false},
        {"3e8 0.1\n4e8 1\n", "m.csv:1: found `0.1`; expected the probability 0: the table begins",
         false},
        {"3e8 0\n4e8 0.9\n", "m.csv ends with the probability 0.9; expected 1 on the last line",
         false},
        {"3e8 0\n3e8 1\n",
         "m.csv:2: found `300000000`; expected a strength above that of the line before", true},
        {"3e8 0\n\n4e8 0.5\n5e8 0.4\n6e8 1\n",
         "m.csv:4: found `0.4`; expected a probability not below that", false},
        {"3e8 0\n4e8\n", "m.csv:2: found `one number`; expected as many as on the lines before",
         false},
        {"3e8\n4e8 1\n", "m.csv:2: found `two numbers`; expected as many", true},
    };
    for (size_t k = 0; k < FRACAS_COUNT(wrong); k++) {
        const fracas_attachment file = attached("m.csv", wrong[k].text);
        fracas_strength law = law_of_file(&file, wrong[k].steps);
        refused(&law, wrong[k].words);
    }
    const fracas_attachment single = FILE_OF("m.csv", "3e8\n"),
                            late = FILE_OF("m.csv", "3e8 0.1\n4e8 1\n");
    fracas_strength law = law_of_file(&single, true);
    assert_true(at(&law, 0.3, 0.7) == 3e8 && fracas_strength_deviation(&law, one) == 0.0);
    law = law_of_file(&late, true); /* a tenth at the first strength */
    assert_true(at(&law, 0.1, 0.9) == 3e8 && at(&law, 0.11, 0.89) == 4e8);
}

TESTS(weibull_variation_is_exact, published_moments_are_the_published_shapes, moments_come_back,
      deviations_are_exact, bits_are_golden, one_pair_is_given_whole,
      moments_beyond_a_law_are_refused, empirical_is_what_the_file_says, wrong_files_are_refused)
