/* How often the final intervals of a sequential campaign hold the true mean. To stop where an interval happens to be narrow makes
 * it hold the mean less often than its confidence says; docs/theory/sequential.md states the table below. */
#include "sampler/sequential/sequential.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { REPETITIONS = 4000, MOST = 512, LAWS = 4, MINIMA = 3, WIDTHS = 4 };

/* Laws of one value: of a known mean and deviation. */
static double normal(gsl_rng *stream) { return 1 + gsl_ran_gaussian(stream, 0.2); }
static double counts(gsl_rng *stream) { return gsl_ran_poisson(stream, 20); }
static double skewed(gsl_rng *stream) { return gsl_ran_lognormal(stream, 0, 0.5); }
static double very_skewed(gsl_rng *stream) { return gsl_ran_exponential(stream, 1); }

static const struct {
    const char *name;
    double (*draw)(gsl_rng *stream);
    double mean, variation; /* deviation / mean */
    double stated[MINIMA];  /* least coverage over the widths at 95 %, for minima of 8, 16, 32: docs/theory/sequential.md */
} law[LAWS] = {
    {"normal, variation 0.2", normal, 1, 0.2, {0.935, 0.938, 0.942}},
    {"Poisson of mean 20", counts, 20, 0.22360679774997896, {0.932, 0.937, 0.943}},
    {"lognormal, sigma 0.5", skewed, 1.1331484530668263, 0.53294033909540544, {0.908, 0.918, 0.931}},
    {"exponential", very_skewed, 1, 1, {0.901, 0.915, 0.928}},
};
static const int64_t minimum[MINIMA] = {8, 16, 32};
static const double wanted[WIDTHS] = {1.5, 2.5, 4, 8}; /* replicas that the width asks for, in minima */

/* Coverage over the repetitions, and the mean number of replicas. Student's quantiles are what takes the time: they are kept. */
static double coverage(size_t l, const fracas_sequential_rule *rule, gsl_rng *stream, double *replicas)
{
    static double value[MOST];
    int64_t held = 0, all = 0;
    for (int r = 0; r < REPETITIONS; r++) {
        fracas_sequential_decision made = {.stop = FRACAS_GO_ON};
        int64_t n = 0;
        while (made.stop == FRACAS_GO_ON) {
            const int64_t next = fracas_sequential_next(rule, n);
            for (; n < next; n++) value[n] = law[l].draw(stream);
            made = fracas_sequential_decide(rule, value, n);
        }
        held += fabs(made.mean - law[l].mean) <= made.half_width;
        all += n;
    }
    *replicas = (double)all / REPETITIONS;
    return (double)held / REPETITIONS;
}

/* 4000 repetitions scatter by sqrt(0.93 0.07/4000) = 0.004: the stated coverage, measured with 20000, is exceeded downward by five of
 * that (alpha 1e-6 for one of 48) only by another program. Upward it is what a fixed number would give, 0.95, for the normal law. */
static void intervals_hold_the_mean_as_often_as_stated(void **state)
{
    (void)state;
    const double five = 5 * 0.004;
    gsl_rng *stream = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(stream, 20261121);
    for (size_t l = 0; l < LAWS; l++)
        for (size_t m = 0; m < MINIMA; m++) {
            double least = 1, at = 0;
            for (size_t w = 0; w < WIDTHS; w++) {
                const double replicas = wanted[w] * (double)minimum[m];
                const fracas_sequential_rule rule = {.minimum = minimum[m], .maximum = MOST, .confidence = 0.95,
                                                     .relative_half_width = 1.96 * law[l].variation / sqrt(replicas)};
                double used;
                const double held = coverage(l, &rule, stream, &used);
                if (held < least) least = held, at = used;
                assert_true(held < 0.95 + five); /* no more than asked for: stopping early helps nobody */
            }
            print_message("%-22s minimum %2d: %.3f at worst, with %.0f replicas on average\n", law[l].name, (int)minimum[m], least, at);
            assert_true(least > law[l].stated[m] - five);
        }
    gsl_rng_free(stream);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(intervals_hold_the_mean_as_often_as_stated)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
