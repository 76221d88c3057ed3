/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Intervals of fitted parameters hold the truth as often as they say, and p-values are uniform,
 * whether the fragments of a realization depend on each other or not; a few repetitions of what
 * test_fits_storm.c has a thousand of.
 */
#include "tests/support/fit_checks.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>

enum { REPETITIONS = 80, RESAMPLES = 199 };

static const synthetic truth[] = {
    {.family = &fracas_family_exponential,
     .parameter = {20},
     .lattice = 1,
     .realizations = 50,
     .fragments = 40},
    {.family = &fracas_family_shifted_rayleigh,
     .parameter = {8, 9.6},
     .lattice = 1,
     .realizations = 50,
     .fragments = 40},
};

/* Coverage is between 93 and 97 %: fewer, or more, than a coverage of 93 %, or 97 %, gives once in
 * a million are too few, or too many. An error in the mean of five standard deviations (alpha 1e-6)
 * over sqrt(80), beside a bias of 0.1 of them, which moves the coverage of an interval by less than
 * 0.3 %. */
static void of(const synthetic *what, unsigned long seed)
{
    const fit_check found = fit_check_of(what, REPETITIONS, RESAMPLES, seed);
    fit_check_print(what, &found);
    assert_int_equal(found.failed, 0);
    assert_true(found.ks < FIT_KOLMOGOROV && found.ad < FIT_KOLMOGOROV);
    for (size_t i = 0; i < what->family->nparameters; i++) {
        const unsigned held = (unsigned)lround(found.held[i] * REPETITIONS);
        assert_true(gsl_cdf_binomial_P(held, 0.93, REPETITIONS) > 1e-6);
        assert_true(held == 0 || gsl_cdf_binomial_Q(held - 1, 0.97, REPETITIONS) > 1e-6);
        assert_true(fabs(found.bias[i]) < 0.1 + 5 / sqrt(REPETITIONS));
    }
}

static void intervals_and_p_values(void **state)
{
    for (size_t t = 0; t < sizeof truth / sizeof *truth; t++)
        for (int how = 0; how < NDEPENDENCES; how++) {
            synthetic what = truth[t];
            what.how = (dependence)how;
            of(&what, 100 * (unsigned long)t + (unsigned long)how);
        }
}

/* Sizes of half a wrong law: p-values go to the least that the resamples can show. */
static void a_wrong_law_is_found(void **state)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    const fracas_family *family = &fracas_family_exponential;
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    FRACAS_CLEARED(fracas_point_fits) fits;
    OK(synthetic_ensemble(&truth[1], random, &ensemble));
    OK(fracas_point_fits_of(&ensemble, &family, 1, RESAMPLES, 1, &fits));
    assert_true(fits.family[0].goodness.ks_p == 1.0 / (RESAMPLES + 1) &&
                fits.family[0].goodness.ad_p == 1.0 / (RESAMPLES + 1));
    gsl_rng_free(random);
}

/* p of the likelihood ratio of a Weibull to the exponential that holds: uniform, whatever the
 * dependence. */
static void nested_families(void **state)
{
    const fracas_family *const family[2] = {&fracas_family_exponential, &fracas_family_weibull};
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    for (int how = 0; how < NDEPENDENCES; how++) {
        double p[REPETITIONS];
        synthetic what = truth[0];
        what.how = (dependence)how;
        for (size_t r = 0; r < REPETITIONS; r++) {
            FRACAS_CLEARED(fracas_ensemble) ensemble;
            FRACAS_CLEARED(fracas_fit_sample) sample;
            fracas_fit fit[2];
            fracas_fit_comparison comparison;
            OK(synthetic_ensemble(&what, random, &ensemble));
            OK(fracas_fit_sample_create(&ensemble, &sample));
            for (int i = 0; i < 2; i++) fracas_fit_of(family[i], &sample, &fit[i]);
            OK(fracas_fit_compare(&sample, family, fit, RESAMPLES, r, &comparison));
            assert_true(comparison.nested && comparison.statistic > -1e-3);
            p[r] = comparison.p;
        }
        const double distance = fit_distance(p, REPETITIONS);
        print_message("likelihood ratio, dependence %d: distance from uniform * sqrt(n) %.2f\n",
                      how, distance);
        assert_true(distance < FIT_KOLMOGOROV);
    }
    gsl_rng_free(random);
}

/* Vuong's z grows with the root of the realizations where one of two families is the truth: with
 * 200 it is far beyond chance. Turned round it changes its sign, to rounding. */
static void not_nested_families(void **state)
{
    const fracas_family *const family[2] = {&fracas_family_lognormal, &fracas_family_weibull};
    synthetic what = {.family = &fracas_family_weibull,
                      .parameter = {20, 1.5},
                      .lattice = 1,
                      .realizations = 200,
                      .fragments = 40};
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    FRACAS_CLEARED(fracas_fit_sample) sample;
    fracas_fit fit[2], swapped[2];
    fracas_fit_comparison comparison, other;
    OK(synthetic_ensemble(&what, random, &ensemble));
    OK(fracas_fit_sample_create(&ensemble, &sample));
    for (int i = 0; i < 2; i++) fracas_fit_of(family[i], &sample, &fit[i]);
    OK(fracas_fit_compare(&sample, family, fit, RESAMPLES, 1, &comparison));
    const fracas_family *const turned[2] = {family[1], family[0]};
    swapped[0] = fit[1];
    swapped[1] = fit[0];
    OK(fracas_fit_compare(&sample, turned, swapped, RESAMPLES, 1, &other));
    print_message("lognormal against Weibull: z %.2f, p %.2g\n", comparison.statistic,
                  comparison.p);
    assert_true(!comparison.nested && comparison.statistic < -5 && comparison.p < 1e-6);
    assert_true(fabs(other.statistic + comparison.statistic) < 1e-9 * fabs(other.statistic) &&
                other.p > 0);
    gsl_rng_free(random);
}

int fracas_test(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_and_p_values),
        cmocka_unit_test(a_wrong_law_is_found),
        cmocka_unit_test(nested_families),
        cmocka_unit_test(not_nested_families),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
