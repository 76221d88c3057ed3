/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How often the two halves of replicas that are alike are said to differ, and how often halves that
 * differ are found to: fixed seeds. */
#include "analysis/estimate/convergence.h"
#include "analysis/estimate/pooled.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

enum { MOST = 64 };

static bool differ(const double *value, size_t n)
{
    const fracas_part a = fracas_part_of(value, 1, n / 2),
                      b = fracas_part_of(value + n / 2, 1, n - n / 2);
    return fracas_parts_alike(&a, &b) < FRACAS_CONVERGED_ALARM;
}

/* Share of `repetitions` samples of n normal values, the second half of which is higher by `shift`
 * deviations. */
static double share_found(size_t n, double shift, int repetitions)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, 1 + n);
    int found = 0;
    for (int r = 0; r < repetitions; r++) {
        double value[MOST];
        for (size_t i = 0; i < n; i++)
            value[i] = 100 + gsl_ran_ugaussian(random) + (i >= n / 2 ? shift : 0);
        found += differ(value, n);
    }
    gsl_rng_free(random);
    return (double)found / repetitions;
}

/* Share p of R repetitions is known to sqrt(p (1 - p)/R): 4.9 of these (alpha 1e-6). */
static double room(double p, int repetitions)
{
    return 4.9 * sqrt(fmax(p * (1 - p), 0) / repetitions);
}

/* Of 200 000, 125 +- 11 false alarms: 1/1600 +- 0.00027, so that one in 900 or in 2800 would be
 * seen. */
static void false_alarms(void **state)
{
    enum { REPETITIONS = 200000 };
    const size_t n[] = {4, 5, 8, 16, 50};
    for (size_t k = 0; k < sizeof n / sizeof *n; k++) {
        const double found = share_found(n[k], 0, REPETITIONS);
        print_message("n %2zu: false alarms 1 in %.0f\n", n[k], 1 / found);
        assert_true(fabs(found - FRACAS_CONVERGED_ALARM) <=
                    room(FRACAS_CONVERGED_ALARM, REPETITIONS));
    }
}

typedef struct {
    double freedom, beyond, shift;
} noncentral;

/* Given the variance u/freedom, u of chi^2, normal numbers about `shift` are beyond so many
 * estimated deviations. */
static double found_at(double u, void *context)
{
    const noncentral *of = context;
    const double far = of->beyond * sqrt(u / of->freedom);
    return gsl_ran_chisq_pdf(u, of->freedom) *
           (gsl_cdf_ugaussian_Q(far - of->shift) + gsl_cdf_ugaussian_P(-far - of->shift));
}

/* P(|t| > its quantile), t noncentral: what the test finds of normal values, of halves of n/2 each.
 */
static double power_of(size_t n, double shift)
{
    noncentral of = {(double)n - 2, gsl_cdf_tdist_Qinv(FRACAS_CONVERGED_ALARM / 2, (double)n - 2),
                     shift * sqrt((double)n) / 2};
    double value, error;
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(200);
    gsl_integration_qagiu(&(gsl_function){found_at, &of}, 0, 1e-10, 1e-8, 200, work, &value,
                          &error);
    gsl_integration_workspace_free(work);
    return value;
}

/* What the theory page states, of shifts of 1, 2, 4 and 6 standard deviations between the halves.
 */
static void power(void **state)
{
    enum { REPETITIONS = 20000 };
    static const struct {
        size_t n;
        double found[4];
    } stated[] = {{4, {0.00, 0.00, 0.01, 0.02}},  {6, {0.00, 0.01, 0.10, 0.32}},
                  {8, {0.01, 0.04, 0.40, 0.86}},  {12, {0.02, 0.19, 0.93, 1.00}},
                  {16, {0.04, 0.41, 1.00, 1.00}}, {32, {0.19, 0.95, 1.00, 1.00}},
                  {50, {0.46, 1.00, 1.00, 1.00}}};
    const double shift[] = {1, 2, 4, 6};
    for (size_t k = 0; k < sizeof stated / sizeof *stated; k++) {
        for (int s = 0; s < 4; s++) {
            const double expected = power_of(stated[k].n, shift[s]),
                         found = share_found(stated[k].n, shift[s], REPETITIONS);
            print_message("n %2zu, shift %g: found %.4f, expected %.4f\n", stated[k].n, shift[s],
                          found, expected);
            assert_true(fabs(expected - stated[k].found[s]) <= 0.0051);
            assert_true(fabs(found - expected) <= room(expected, REPETITIONS) + 1e-6);
        }
    }
}

/* Counts of few fragments repeat themselves: halves without any scatter, {3, 3} and {4, 4}, are no
 * proof. Of Poisson counts of mean 1 no more than twice as many alarms as of normal values: 4.9
 * deviations above 2/1600 are allowed. */
static void counts_that_repeat(void **state)
{
    enum { REPETITIONS = 50000 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, 1);
    for (size_t n = 4; n <= 12; n++) {
        int found = 0;
        for (int r = 0; r < REPETITIONS; r++) {
            double value[MOST];
            for (size_t i = 0; i < n; i++) value[i] = gsl_ran_poisson(random, 1);
            found += differ(value, n);
        }
        assert_true((double)found / REPETITIONS <=
                    2 * FRACAS_CONVERGED_ALARM + room(2 * FRACAS_CONVERGED_ALARM, REPETITIONS));
    }
    gsl_rng_free(random);
    const double few[] = {3, 3, 4, 4}, many[] = {3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4},
                 rounded[] = {0.1, 0.1, 0.1, 0.3 - 0.2};
    assert_false(differ(few, 4));
    assert_true(differ(many, 14)); /* 2 of 3432 deals */
    assert_false(differ(rounded, 4));
}

/* Ratios of sums over realizations: their variances are from leaving realizations out in turn,
 * which is rough with few, and their halves are compared alike. Realizations of 20 + Poisson(10)
 * fragments, sizes exponential times a scale of the realization's, lognormal of deviation 0.2;
 * those of the second half three times as large are found in most samples. */
static void halves_of_ratios(void **state)
{
    enum { REPETITIONS = 10000, N = 16, FRAGMENTS = 80 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, 1);
    int alarms[FRACAS_NPOOLED] = {0}, found = 0;
    fracas_ensemble ensemble;
    fracas_ensemble_init(&ensemble, 0);
    for (int r = 0; r < 2 * REPETITIONS; r++) {
        const bool shifted = r >= REPETITIONS;
        fracas_ensemble_clear(&ensemble);
        for (size_t i = 0; i < N; i++) {
            fracas_fragment fragment[FRAGMENTS];
            fracas_record record;
            const fracas_replica_values value = {0};
            const double scale = gsl_ran_lognormal(random, 0, 0.2) *
                                 (shifted && i >= N / 2 ? 3 : 1);
            fracas_record_init(&record);
            record.fragment = fragment;
            record.nfragment = 20 + gsl_ran_poisson(random, 10);
            if (record.nfragment > FRAGMENTS) record.nfragment = FRAGMENTS;
            for (size_t f = 0; f < record.nfragment; f++) {
                const double size = scale * gsl_ran_exponential(random, 1);
                fragment[f] = (fracas_fragment){.size = size, .mass = size, .elements = 100};
            }
            OK(fracas_ensemble_add(&ensemble, i, (int64_t)i, &value, &record));
        }
        fracas_part first[FRACAS_NPOOLED], second[FRACAS_NPOOLED];
        OK(fracas_pooled_part(&ensemble, 0, N / 2, first));
        OK(fracas_pooled_part(&ensemble, N / 2, N, second));
        for (int v = 0; v < FRACAS_NPOOLED && !shifted; v++)
            alarms[v] += fracas_parts_alike(&first[v], &second[v]) < FRACAS_CONVERGED_ALARM;
        found += shifted &&
                 fracas_parts_alike(&first[FRACAS_POOLED_MEAN], &second[FRACAS_POOLED_MEAN]) <
                     FRACAS_CONVERGED_ALARM;
    }
    print_message("of %d: alarms %d %d %d, found %d\n", REPETITIONS, alarms[0], alarms[1],
                  alarms[2], found);
    for (int v = 0; v < FRACAS_NPOOLED; v++)
        assert_true(alarms[v] <= REPETITIONS * (2 * FRACAS_CONVERGED_ALARM +
                                                room(2 * FRACAS_CONVERGED_ALARM, REPETITIONS)));
    assert_true(found > 0.8 * REPETITIONS);
    fracas_ensemble_clear(&ensemble);
    gsl_rng_free(random);
}

int fracas_test(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {cmocka_unit_test(false_alarms), cmocka_unit_test(power),
                                       cmocka_unit_test(counts_that_repeat),
                                       cmocka_unit_test(halves_of_ratios)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
