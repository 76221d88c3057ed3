/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: storm */
/* ctest-timeout: 7200 */
/* Coverage of the intervals of fitted parameters and uniformity of p-values, of 1000 samples each:
 * the table of docs/results/fits.md.
 */
#include "tests/support/fit_checks.h"
#include "tests/support/test.h"

enum { REPETITIONS = 1000, RESAMPLES = 299 };

#define TRUTH(of, realizations_, how_, ...)                                                   \
    {                                                                                         \
        .family = &fracas_family_##of, .parameter = {__VA_ARGS__}, .from = 1.5, .lattice = 1, \
        .realizations = realizations_, .fragments = 40, .how = how_                           \
    }

static const synthetic truth[] =
    {
        TRUTH(exponential, 50, INDEPENDENT, 20),
        TRUTH(exponential, 50, RING_SCORES, 20),
        TRUTH(exponential, 50, SHARED, 20),
        TRUTH(shifted_rayleigh, 50, INDEPENDENT, 8, 9.6),
        TRUTH(shifted_rayleigh, 50, RING_SCORES, 8, 9.6),
        TRUTH(shifted_rayleigh, 50, SHARED, 8, 9.6),
        TRUTH(weibull, 50, RING_SCORES, 20, 1.5),
        TRUTH(weibull3, 50, RING_SCORES, 6, 16, 1.6),
        TRUTH(lognormal, 50, RING_SCORES, 18, 0.5),
        TRUTH(gamma, 50, RING_SCORES, 5, 4),
        TRUTH(generalised_gamma, 50, RING_SCORES, 20, 0.4, 0.6),
        TRUTH(power_law, 50, RING_SCORES, 0.8, 30),
},
                       few[] = {
                           TRUTH(exponential, 16, INDEPENDENT, 20),
                           TRUTH(exponential, 16, RING_SCORES, 20),
                           TRUTH(exponential, 16, SHARED, 20),
                           TRUTH(shifted_rayleigh, 16, RING_SCORES, 8, 9.6),
                           TRUTH(shifted_rayleigh, 16, SHARED, 8, 9.6),
};

/* 93 to 97 % with 50 realizations, as stated; up to 98.5 for the Weibull law of shape 1.6, whose
 * shift is not regular (below 2 it is known better than errors of 1/sqrt(n) say). A bias of a fifth
 * of the standard deviation takes one percent off a coverage; five standard errors of the mean of
 * 1000 beside it. */
static void fifty_realizations(void **state)
{
    for (size_t t = 0; t < sizeof truth / sizeof *truth; t++) {
        const fit_check found = fit_check_of(&truth[t], REPETITIONS, RESAMPLES, 1000 + 7919 * t);
        fit_check_print(&truth[t], &found);
        assert_true(found.failed <=
                    REPETITIONS / 100); /* a shift at the smallest size, which has no interval */
        assert_true(found.ks < FIT_KOLMOGOROV && found.ad < FIT_KOLMOGOROV);
        const double most = truth[t].family == &fracas_family_weibull3 ? 0.985 : 0.97;
        for (size_t i = 0; i < truth[t].family->nparameters; i++) {
            assert_true(found.held[i] >= 0.93 && found.held[i] <= most);
            assert_true(fabs(found.bias[i]) < 0.2 + 5 / sqrt(REPETITIONS));
        }
    }
}

/* What it is with 16 is printed; below 85 % nobody would call it an interval of 95 %. */
static void sixteen_realizations(void **state)
{
    for (size_t t = 0; t < sizeof few / sizeof *few; t++) {
        const fit_check found = fit_check_of(&few[t], REPETITIONS, RESAMPLES, 2000 + 7919 * t);
        fit_check_print(&few[t], &found);
        for (size_t i = 0; i < few[t].family->nparameters; i++)
            assert_true(found.held[i] >= 0.85 && found.held[i] <= 0.99);
    }
}

int fracas_test(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {cmocka_unit_test(fifty_realizations),
                                       cmocka_unit_test(sixteen_realizations)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
