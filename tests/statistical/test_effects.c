/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The interval of an effect holds the true one as often as it says. */
#include "analysis/summary/effects.h"
#include "tests/support/test.h"

#include <gsl/gsl_randist.h>

enum { SETTINGS = 4, POINTS = 2 * SETTINGS, REPLICAS = 6, TRIALS = 20000, NCOLUMNS = 2 };

/* Four settings, whose effects differ, with six replicas that scatter by 10 %: 95.0 % are expected
 * but for the curvature of the logarithm and the freedom by Welch and Satterthwaite, some 0.3 %
 * together; counting adds 4.9 standard deviations of 0.0015 (significance 1e-6). */
static void interval_holds_the_effect(void **state)
{
    static const fracas_column column[NCOLUMNS] = {{"loading.rate", "1/s", "", false},
                                                   {"strength.shape", "1", "", false}};
    static const double truth[SETTINGS] = {1.05, 1.1, 1.2, 1.4};
    static fracas_point_statistics point[POINTS];
    fracas_value value[POINTS][NCOLUMNS];
    fracas_point_row row[POINTS];
    fracas_point_table table = {NCOLUMNS, column, POINTS, row};
    fracas_analysis analysis = {.table = &table, .point = point};
    gsl_rng *generator = gsl_rng_alloc(gsl_rng_mt19937);
    double effect = 1;
    int held = 0;
    gsl_rng_set(generator, 20261127);
    for (size_t p = 0; p < POINTS; p++) {
        value[p][0] = (fracas_value){p % 2 ? 2 : 1, ""};
        value[p][1] = (fracas_value){(double)(p / 2), ""};
        row[p] = (fracas_point_row){.value = value[p]};
    }
    for (int s = 0; s < SETTINGS; s++) effect *= pow(truth[s], 1.0 / SETTINGS);
    OK(fracas_columns_create(&table, &analysis.shown));
    for (int trial = 0; trial < TRIALS; trial++) {
        OWNED fracas_effect *found = NULL;
        size_t count;
        for (size_t p = 0; p < POINTS; p++) {
            double sample[REPLICAS];
            const double mean = (50 + 10 * (double)(p / 2)) * (p % 2 ? truth[p / 2] : 1);
            for (int r = 0; r < REPLICAS; r++)
                sample[r] = mean + gsl_ran_gaussian(generator, 0.1 * mean);
            point[p].count = point[p].size = fracas_estimate_of(sample, 1, REPLICAS);
        }
        OK(fracas_effects(&analysis, &found, &count));
        assert_true(count > 0 && found->settings == SETTINGS);
        held += found->count.low <= effect - 1 && effect - 1 <= found->count.high;
    }
    printf("held in %.2f %%\n", 100.0 * held / TRIALS);
    assert_true(fabs((double)held / TRIALS - 0.95) < 0.003 + 4.9 * 0.00154);
    fracas_columns_clear(&analysis.shown);
    gsl_rng_free(generator);
}

TESTS(interval_holds_the_effect)
