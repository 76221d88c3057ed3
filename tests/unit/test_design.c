/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Designs: which numbers they are, what stays as it is when they grow, strata, correlation;
 * distributions of uncertain parameters against GSL. */
#include "sampler/design/correlation.h"
#include "sampler/design/design.h"
#include "sampler/design/uncertain.h"
#include "sampler/special/normal.h"
#include "sampler/stream.h"

#include "base/hash.h"
#include "tests/support/kinds.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_qrng.h>
#include <inttypes.h>

enum { LATIN_HYPERCUBE, SOBOL, RANDOM, TYPES };

static const uint64_t names[5] = {11, 7, 5000000000, 3, 2};
static const uint64_t SEED = 20261121;

/* The first `d` of the parameters above. */
static fracas_probability *fill(int type, size_t n, size_t d, const double *correlation)
{
    const fracas_design design = {fracas_design_types[type], SEED, n, d, names, correlation};
    fracas_probability *p = zeroed(n * d, sizeof *p);
    OK(fracas_design_fill(&design, p));
    return p;
}

static bool same(const fracas_probability *a, const fracas_probability *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

static const double three_tied[9] = {1.0, 0.6, -0.3, 0.6, 1.0, 0.2, -0.3, 0.2, 1.0};

/* ---- which numbers ---- */

static void test_names(void **state)
{
    assert_string_equal(fracas_design_types[LATIN_HYPERCUBE]->name, "latin-hypercube");
    assert_string_equal(fracas_design_types[SOBOL]->name, "sobol");
    assert_string_equal(fracas_design_types[RANDOM]->name, "random");
    assert_true(fracas_design_most_parameters(fracas_design_types[RANDOM]) == SIZE_MAX);
    assert_true(fracas_design_most_parameters(fracas_design_types[LATIN_HYPERCUBE]) == SIZE_MAX);
    assert_int_equal(fracas_design_most_parameters(fracas_design_types[SOBOL]), 40);
}

/* Philox's u with purpose 3, use 0, the parameter's name as replica and the point as site. */
static void test_random_is_the_stream(void **state)
{
    OWNED fracas_probability *p = fill(RANDOM, 50, 4, NULL);
    for (size_t i = 0; i < 50; i++)
        for (size_t j = 0; j < 4; j++) {
            const fracas_stream stream = {.seed = SEED, .purpose = 3, .replica = names[j]};
            assert_true(p[i * 4 + j].below == fracas_stream_uniform(&stream, i));
            assert_true(p[i * 4 + j].above == 1.0 - p[i * 4 + j].below);
        }
}

/* GSL's sequence after the origin, plus the shift, modulo 1; the largest number of parameters too.
 */
static void test_sobol_is_gsl_shifted(void **state)
{
    enum { N = 1000, D = 40 };
    uint64_t many[D];
    for (size_t j = 0; j < D; j++) many[j] = 100 + j;
    const fracas_design design = {fracas_design_types[SOBOL], SEED, N, D, many, NULL};
    OWNED fracas_probability *p = zeroed(N * D, sizeof *p);
    OK(fracas_design_fill(&design, p));
    gsl_qrng *qrng = gsl_qrng_alloc(gsl_qrng_sobol, D);
    double x[D] = {0.0};
    for (size_t i = 0; i < N; i++) {
        if (i > 0) gsl_qrng_get(qrng, x);
        for (size_t j = 0; j < D; j++) {
            const fracas_stream stream = {
                .seed = SEED, .purpose = 3, .point = {2}, .replica = many[j]};
            const long double sum = (long double)x[j] +
                                    fracas_stream_uniform(&stream, 0); /* exact in 64 bits */
            assert_true(p[i * D + j].below == (double)(sum - floorl(sum)));
            assert_true(p[i * D + j].above == 1.0 - p[i * D + j].below &&
                        p[i * D + j].below > 0.0 && p[i * D + j].above > 0.0);
        }
    }
    gsl_qrng_free(qrng);
}

/* Bits that gcc and clang gave on CPUs with and without FMA. */
static void test_golden_bits(void **state)
{
    static const uint64_t golden[TYPES][2] = {{0xc82047bbd9dbd2f1, 0xd804efcea83840c3},
                                              {0x3c63ccbee4cfc541, 0xdef7fd98d374afe5},
                                              {0x475c24d0617679c7, 0x457fc82db5f4f573}};
    for (int type = 0; type < TYPES; type++)
        for (int tied = 0; tied < 2; tied++) {
            OWNED fracas_probability *p = fill(type, 300, 3, tied ? three_tied : NULL);
            const uint64_t sum = fracas_checksum_of(p, 900 * sizeof *p);
            if (sum != golden[type][tied])
                fail_msg("type %d, tied %d: 0x%016" PRIx64, type, tied, sum);
        }
}

/* ---- what stays ---- */

static void test_prefix(void **state)
{
    for (int type = 0; type < TYPES; type++)
        for (int tied = 0; tied < 2; tied++) {
            OWNED fracas_probability *few = fill(type, 16, 3, tied ? three_tied : NULL),
                                     *many = fill(type, 100, 3, tied ? three_tied : NULL);
            assert_true((memcmp(few, many, 48 * sizeof *few) == 0) == (type != LATIN_HYPERCUBE));
        }
}

/* A parameter does not depend on those after it; without correlation, but for Sobol, not on its
 * place either. */
static void test_other_parameters(void **state)
{
    const double two_tied[4] = {1.0, 0.6, 0.6, 1.0};
    const uint64_t turned[3] = {names[2], names[0], names[1]};
    for (int type = 0; type < TYPES; type++) {
        OWNED fracas_probability *three = fill(type, 30, 3, three_tied),
                                 *two = fill(type, 30, 2, two_tied);
        OWNED fracas_probability *free_of_ties = fill(type, 30, 3, NULL),
                                 *other = zeroed(90, sizeof *other);
        const fracas_design design = {fracas_design_types[type], SEED, 30, 3, turned, NULL};
        int kept = 0;
        OK(fracas_design_fill(&design, other));
        for (size_t i = 0; i < 30; i++) {
            assert_true(same(&three[3 * i], &two[2 * i]) &&
                        same(&three[3 * i + 1], &two[2 * i + 1]));
            assert_true(same(&three[3 * i],
                             &free_of_ties[3 * i])); /* the first is tied to none before it */
            kept += same(&free_of_ties[3 * i], &other[3 * i + 1]) &&
                    same(&free_of_ties[3 * i + 2], &other[3 * i]);
        }
        assert_true(type == SOBOL
                        ? kept < 5
                        : kept ==
                              30); /* the first points of a Sobol sequence are on the diagonal */
    }
}

/* Of three parameters of which the second is tied to the first, the third is as if there were no
 * ties, to the bit. */
static void test_untied_stays(void **state)
{
    const double tied[9] = {1.0, 0.6, 0.0, 0.6, 1.0, 0.0, 0.0, 0.0, 1.0};
    for (int type = 0; type < TYPES; type++) {
        OWNED fracas_probability *p = fill(type, 30, 3, tied), *q = fill(type, 30, 3, NULL);
        int moved = 0;
        for (size_t i = 0; i < 30; i++) {
            assert_true(same(&p[3 * i], &q[3 * i]) && same(&p[3 * i + 2], &q[3 * i + 2]));
            moved += !same(&p[3 * i + 1], &q[3 * i + 1]);
        }
        assert_true(moved > 20); /* a few keep their rank */
    }
}

/* ---- strata ---- */

static int by_below(const void *a, const void *b)
{
    const fracas_probability *x = a, *y = b;
    return (x->below > y->below) - (x->below < y->below);
}

/* Sorted, value k lies in stratum k, ends included: (k + v)/n is rounded twice, by at most 2^-52 of
 * itself. Its place inside is v. */
static void test_strata(void **state)
{
    static const size_t counts[] = {1, 2, 37, 1000};
    for (size_t c = 0; c < FRACAS_COUNT(counts); c++)
        for (int tied = 0; tied < 2; tied++) {
            const size_t n = counts[c];
            OWNED fracas_probability *p = fill(LATIN_HYPERCUBE, n, 3, tied ? three_tied : NULL),
                                     *column = zeroed(n, sizeof *column);
            for (size_t j = 0; j < 3; j++) {
                double inside = 0.0;
                for (size_t i = 0; i < n; i++) column[i] = p[3 * i + j];
                qsort(column, n, sizeof *column, by_below);
                for (size_t k = 0; k < n; k++) {
                    const double at = column[k].below * (double)n;
                    assert_true(at >= (double)k * (1.0 - 0x1p-52) &&
                                at <= (double)(k + 1) * (1.0 + 0x1p-52));
                    assert_true(fabs(column[k].below + column[k].above - 1.0) <= 0x1p-51);
                    assert_true(column[k].below > 0.0 && column[k].above > 0.0);
                    inside += at - (double)k;
                }
                /* mean of n uniform numbers: +- 4.9/sqrt(12 n) at alpha 1e-6 */
                if (n == 1000) assert_true(fabs(inside / 1000.0 - 0.5) < 4.9 / sqrt(12000.0));
            }
        }
}

/* The order of a Latin hypercube is that of the random design of the same names; the jitter is a
 * number of its own. */
static void test_order_of_latin_hypercube(void **state)
{
    OWNED fracas_probability *p = fill(LATIN_HYPERCUBE, 64, 3, three_tied),
                             *q = fill(RANDOM, 64, 3, three_tied);
    for (size_t a = 0; a < 64; a++)
        for (size_t b = 0; b < 64; b++)
            for (size_t j = 0; j < 3; j++)
                assert_true((p[3 * a + j].below < p[3 * b + j].below) ==
                            (q[3 * a + j].below < q[3 * b + j].below));
    for (size_t i = 0; i < 64; i++) {
        const fracas_stream jitter = {
            .seed = SEED, .purpose = 3, .point = {1}, .replica = names[1]};
        const double at = p[3 * i + 1].below *
                          64.0; /* 64: the division is exact, and k + v loses at most 2^-47 */
        assert_true(fabs(at - floor(at) - fracas_stream_uniform(&jitter, i)) <= 0x1p-47);
    }
}

/* ---- correlation ---- */

/* L L^T = C: of each sum at most 3 products, each rounded by 2^-53 of at most 1, and the divisions
 * by pivots above 0.5. */
static void test_factor(void **state)
{
    double factor[9], rest;
    size_t at;
    assert_true(fracas_correlation_factor(3, three_tied, factor, &at, &rest));
    for (size_t j = 0; j < 3; j++)
        for (size_t k = 0; k < 3; k++) {
            double sum = 0.0;
            for (size_t i = 0; i < 3; i++) sum += factor[3 * j + i] * factor[3 * k + i];
            assert_true(fabs(sum - three_tied[3 * j + k]) <= 16 * 0x1p-53);
            assert_true(k <= j || factor[3 * j + k] == 0.0);
        }
}

/* 0.9, 0.9 and -0.9 among three: of the third is left 1 - (0.81 + (-0.9 - 0.81)^2/0.19) = -15.2. */
static void test_contradiction(void **state)
{
    const double wrong[9] = {1.0, 0.9, 0.9, 0.9, 1.0, -0.9, 0.9, -0.9, 1.0},
                 equal[4] = {1.0, 1.0, 1.0, 1.0};
    double factor[9], rest = 0.0;
    size_t at = 0;
    assert_false(fracas_correlation_factor(3, wrong, factor, &at, &rest));
    assert_int_equal(at, 2);
    assert_true(fabs(rest - (1.0 - (0.81 + 1.71 * 1.71 / 0.19))) < 1e-12);
    assert_false(fracas_correlation_factor(2, equal, factor, &at, &rest));
    assert_int_equal(at, 1);
    assert_true(rest == 0.0);
    fracas_probability p[6];
    const fracas_design design = {fracas_design_types[RANDOM], SEED, 2, 3, names, wrong};
    assert_int_equal(fracas_design_fill(&design, p), FRACAS_BUG);
}

/* Correlation of the normal scores of two columns. */
static double score_correlation(const fracas_probability *p, size_t n, size_t a, size_t b)
{
    double sa = 0.0, sb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double x = fracas_normal_quantile(p[3 * i + a]),
                     y = fracas_normal_quantile(p[3 * i + b]);
        sa += x;
        sb += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    const double count = (double)n;
    return (ab - sa * sb / count) / sqrt((aa - sa * sa / count) * (bb - sb * sb / count));
}

/* atanh r is normal about atanh rho with variance 1/(n - 3) for normal scores (Fisher), and
 * asymptotically also for scores of ranks (Klaassen & Wellner, Bernoulli 3, 55-77, 1997); 4.9
 * deviations at alpha 1e-6, and rho/(2n) of bias. Sobol is no worse. */
static void test_correlation(void **state)
{
    enum { N = 16384 };
    for (int type = 0; type < TYPES; type++)
        for (int tied = 0; tied < 2; tied++) {
            OWNED fracas_probability *p = fill(type, N, 3, tied ? three_tied : NULL);
            for (size_t a = 0; a < 3; a++)
                for (size_t b = 0; b < a; b++) {
                    const double rho = tied ? three_tied[3 * a + b] : 0.0,
                                 r = score_correlation(p, N, a, b);
                    if (!(fabs(atanh(r) - atanh(rho)) < 4.9 / sqrt(N - 3.0) + 0.5 / N))
                        fail_msg("type %d: correlation of %zu and %zu is %g, expected %g", type, a,
                                 b, r, rho);
                }
        }
}

/* Kolmogorov's D of each margin of a correlated random design: P(sqrt(n) D > 2.70) < 2
 * exp(-2 2.70^2) = 1e-6. */
static void test_margins(void **state)
{
    enum { N = 16384 };
    OWNED fracas_probability *p = fill(RANDOM, N, 3, three_tied),
                             *column = zeroed(N, sizeof *column);
    for (size_t j = 0; j < 3; j++) {
        double distance = 0.0;
        for (size_t i = 0; i < N; i++) column[i] = p[3 * i + j];
        qsort(column, N, sizeof *column, by_below);
        for (size_t k = 0; k < N; k++) {
            distance = fmax(distance, fmax(column[k].below - (double)k / N,
                                           (double)(k + 1) / N - column[k].below));
            assert_true(fabs(column[k].below + column[k].above - 1.0) <=
                        0x1p-50); /* 2e-15 relative each */
        }
        assert_true(sqrt(N) * distance < 2.70);
    }
}

/* ---- distributions ---- */

static void assert_quantile(const fracas_uncertain *uncertain, fracas_probability p,
                            double expected, double tolerance)
{
    const double got = fracas_uncertain_quantile(uncertain, p);
    if (!(fabs(got - expected) <= tolerance))
        fail_msg("%s at %g: %.17g is not %.17g", uncertain->kind->name, p.below, got, expected);
}

/* Against GSL's inverses, to 1e-12 relative as those of strengths
 * (docs/decisions/own-inverse-transforms.md). */
static void test_distributions(void **state)
{
    static const double probes[] = {1e-9, 1e-4, 0.03, 0.3, 0.5, 0.77, 0.99, 0.99999};
    const fracas_uncertain uniform = UNCERTAIN("uniform", .minimum = -3.0, .maximum = 5.0);
    const fracas_uncertain log_uniform = UNCERTAIN("log-uniform", .minimum = 1e3, .maximum = 1e5);
    const fracas_uncertain normal = UNCERTAIN("normal", .mean = 370.0, .deviation = 200.0,
                                              .minimum = NAN, .maximum = NAN);
    const fracas_uncertain lognormal = UNCERTAIN("lognormal", .median = 4.0, .sigma = 0.5);
    const fracas_uncertain weibull = UNCERTAIN("weibull", .minimum = -20.0, .scale = 50.0,
                                               .shape = 10.0);
    const fracas_uncertain gamma_law = UNCERTAIN("gamma", .scale = 3.0, .shape = 2.5);
    for (size_t i = 0; i < FRACAS_COUNT(probes); i++) {
        const fracas_probability p = fracas_probability_of(probes[i]);
        const double z = gsl_cdf_ugaussian_Pinv(p.below);
        assert_quantile(&uniform, p, -3.0 + 8.0 * p.below, 8e-15);
        assert_quantile(&log_uniform, p, pow(10.0, 3.0 + 2.0 * p.below), 1e-12 * 1e5);
        assert_quantile(&normal, p, 370.0 + 200.0 * z, 1e-12 * (370.0 + 200.0 * fabs(z)));
        assert_quantile(&lognormal, p, 4.0 * exp(0.5 * z), 1e-12 * 4.0 * exp(0.5 * z));
        assert_quantile(&weibull, p, -20.0 + gsl_cdf_weibull_Pinv(p.below, 50.0, 10.0),
                        1e-12 * 100.0);
        assert_quantile(&gamma_law, p, gsl_cdf_gamma_Pinv(p.below, 2.5, 3.0), 1e-12 * 50.0);
    }
    assert_true(fracas_uncertain_quantile(&normal, fracas_probability_of(0.01)) <
                0.0); /* not cut at 0, as a strength would be */
}

/* F of the cut normal distribution at its quantile is p again: dF = f dx, with f dx at most 1e-12
 * relative of z about 10, and of kept. */
static void test_cut_normal(void **state)
{
    static const double bounds[][2] = {{-1.0, 2.0}, {NAN, -0.5},  {1.5, NAN},
                                       {3.0, 4.0},  {-5.0, -4.0}, {-0.1, 0.1}};
    const double mean = 10.0, deviation = 4.0;
    for (size_t b = 0; b < FRACAS_COUNT(bounds); b++) {
        const double low = bounds[b][0], high = bounds[b][1];
        const fracas_uncertain normal = UNCERTAIN("normal", .mean = mean, .deviation = deviation,
                                                  .minimum = mean + deviation * low,
                                                  .maximum = mean + deviation * high);
        OK(fracas_uncertain_check(&normal));
        for (double u = 0.0625; u < 1.0; u += 0.0625) {
            const double z = (fracas_uncertain_quantile(&normal, fracas_probability_of(u)) - mean) /
                             deviation;
            /* differences of the smaller tails, which do not cancel */
            const bool upper = low > 0.0;
            const double at_low = isnan(low) ? 0.0
                                  : upper    ? -gsl_cdf_ugaussian_Q(low)
                                             : gsl_cdf_ugaussian_P(low);
            const double at_high = upper         ? (isnan(high) ? 0.0 : -gsl_cdf_ugaussian_Q(high))
                                   : isnan(high) ? 1.0
                                                 : gsl_cdf_ugaussian_P(high);
            const double at_z = upper ? -gsl_cdf_ugaussian_Q(z) : gsl_cdf_ugaussian_P(z);
            if (!(fabs((at_z - at_low) / (at_high - at_low) - u) < 1e-11))
                fail_msg("cut %zu at %g", b, u);
            assert_true(!(z < low) && !(z > high));
        }
    }
}

static void test_distribution_checks(void **state)
{
    const fracas_uncertain turned = UNCERTAIN("uniform", .minimum = 5.0, .maximum = 3.0);
    const fracas_uncertain equal = UNCERTAIN("log-uniform", .minimum = 5.0, .maximum = 5.0);
    const fracas_uncertain crossed = UNCERTAIN("normal", .mean = 0.0, .deviation = 1.0,
                                               .minimum = 1.0, .maximum = -1.0);
    const fracas_uncertain far = UNCERTAIN("normal", .mean = 0.0, .deviation = 1.0, .minimum = 7.0,
                                           .maximum = NAN);
    const fracas_uncertain open = UNCERTAIN("normal", .mean = 0.0, .deviation = 1.0, .minimum = 1.0,
                                            .maximum = NAN);
    const fracas_uncertain *const wrong[] = {&turned, &equal, &crossed};
    for (size_t i = 0; i < FRACAS_COUNT(wrong); i++) {
        FAILS(fracas_uncertain_check(wrong[i]), FRACAS_USAGE, "the maximum must be the larger");
    }
    FAILS(fracas_uncertain_check(&far), FRACAS_USAGE,
          "its bounds leave 1.28e-12 of the normal distribution");
    OK(fracas_uncertain_check(&open));
}

TESTS(test_names, test_random_is_the_stream, test_sobol_is_gsl_shifted, test_golden_bits,
      test_prefix, test_other_parameters, test_untied_stays, test_strata,
      test_order_of_latin_hypercube, test_factor, test_contradiction, test_correlation,
      test_margins, test_distributions, test_cut_normal, test_distribution_checks)
