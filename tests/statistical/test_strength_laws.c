/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strength fields against their exact laws, where the law is given by mean and standard deviation,
 * by measured strengths, or for a specimen of another size. */
#include "tests/support/strength_samples.h"

#include <gsl/gsl_cdf.h>

static const double specimen = 2e-9; /* m3 */

static const fracas_attachment measured = FILE_OF(
    "m.csv", "3.1e8\n2.2e8\n2.9e8\n3.5e8\n2.6e8\n4.4e8\n3.3e8\n");
static const fracas_attachment table = FILE_OF("t.csv",
                                               "1e8 0\n2e8 0.1\n3e8 0.4\n3.5e8 0.9\n5e8 1\n");

/* F of a specimen, of the law's own parameters by closed forms that the sampler does not use. */
static double cdf(const fracas_strength *law, double s)
{
    const char *name = law->distribution->name;
    const double mean = law->mean, deviation = law->deviation, ratio = deviation / mean;
    if (strcmp(name, "gamma") == 0)
        return gsl_cdf_gamma_P(s, 1 / (ratio * ratio), mean * ratio * ratio);
    if (strcmp(name, "uniform") == 0)
        return gsl_cdf_flat_P(s, mean - sqrt(3.0) * deviation, mean + sqrt(3.0) * deviation);
    if (strcmp(name, "lognormal") == 0) {
        const double square = log1p(ratio * ratio);
        return gsl_cdf_lognormal_P(s, log(mean) - 0.5 * square, sqrt(square));
    }
    const double x[2][7] = {{2.2e8, 2.6e8, 2.9e8, 3.1e8, 3.3e8, 3.5e8, 4.4e8},
                            {1e8, 2e8, 3e8, 3.5e8, 5e8}};
    const double f[2][7] = {{0, 1 / 6.0, 2 / 6.0, 3 / 6.0, 4 / 6.0, 5 / 6.0, 1},
                            {0, 0.1, 0.4, 0.9, 1}};
    const int which = law->file == &table;
    for (int k = 1;; k++)
        if (s <= x[which][k])
            return f[which][k - 1] + (f[which][k] - f[which][k - 1]) * (s - x[which][k - 1]) /
                                         (x[which][k] - x[which][k - 1]);
}

static void moments_are_those_that_are_given(void **state)
{
    static const struct {
        const char *law;
        double minimum, ratio;
    } given[] = {
        {"weibull", 0.0, 0.05},  {"weibull", 264e6, 0.07}, {"weibull", 0.0, 1.2},
        {"lognormal", 0.0, 0.2}, {"gamma", 0.0, 0.02},     {"gamma", 0.0, 1.5},
        {"uniform", 0.0, 0.3},   {"normal", 0.0, 0.1},     {"normal", 0.0, 0.6},
    };
    for (size_t k = 0; k < FRACAS_COUNT(given); k++) {
        const fracas_strength law = law_by_moments(given[k].law, given[k].minimum, 308e6,
                                                   given[k].ratio * 308e6);
        draw(&law, 700 + k, specimen);
        assert_moments(308e6, given[k].ratio * 308e6, NAN);
        if (strcmp(given[k].law, "weibull") && strcmp(given[k].law, "normal"))
            assert_follows(&law, cdf, 1.0, sample, N);
    }
}

static void interfaces_are_as_weak_as_the_weakest_specimen(void **state)
{
    fracas_strength laws[] = {
        law_by_moments("lognormal", 0.0, 308e6, 60e6),
        law_by_moments("gamma", 0.0, 308e6, 60e6),
        law_by_moments("uniform", 0.0, 308e6, 60e6),
        law_of_file(&measured, false),
        law_of_file(&table, false),
    };
    for (size_t k = 0; k < FRACAS_COUNT(laws); k++)
        for (int step = 0; step < 3; step++) {
            const double size = (double[]){0.2, 1.0, 12.0}[step];
            laws[k].reference_volume = specimen;
            draw(&laws[k], 740 + 10 * k + (uint64_t)step, size * specimen);
            assert_moments(
                fracas_strength_mean(&laws[k], (fracas_extent){size * specimen, 1.0}),
                fracas_strength_deviation(&laws[k], (fracas_extent){size * specimen, 1.0}), NAN);
            assert_follows(&laws[k], cdf, size, sample, N);
        }
}

/* Steps: each of n measured strengths as often as another, n p (1 - p) the variance of how often.
 */
static void steps_are_equally_frequent(void **state)
{
    const fracas_strength law = law_of_file(&measured, true);
    draw(&law, 800, specimen);
    qsort(sample, N, sizeof *sample, ascending);
    const double x[7] = {2.2e8, 2.6e8, 2.9e8, 3.1e8, 3.3e8, 3.5e8, 4.4e8}, expected = N / 7.0;
    size_t i = 0;
    for (int k = 0; k < 7; k++) {
        size_t count = 0;
        while (i < N && sample[i] == x[k]) i++, count++;
        assert_true(fabs((double)count - expected) <
                    5.2 * sqrt(expected * 6.0 / 7.0)); /* ALPHA/7 each */
    }
    assert_int_equal(i, N);
}

/* The weakest of n interfaces that share a body follows the law of the body, however many they are.
 */
static void the_weakest_of_a_body_does_not_see_the_mesh(void **state)
{
    fracas_strength laws[] = {law_by_moments("lognormal", 0.0, 308e6, 60e6),
                              law_of_file(&table, false)};
    for (size_t k = 0; k < FRACAS_COUNT(laws); k++)
        for (size_t n = 1; n <= LONGEST; n *= 4) {
            laws[k].reference_volume = specimen;
            draw_weakest(&laws[k], n, 3.0 * specimen, 820 + n);
            assert_follows(&laws[k], cdf, 3.0, sample, CHAINS);
        }
}

TESTS(moments_are_those_that_are_given, interfaces_are_as_weak_as_the_weakest_specimen,
      steps_are_equally_frequent, the_weakest_of_a_body_does_not_see_the_mesh)
