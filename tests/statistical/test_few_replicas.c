/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Slopes and crossovers from few replicas: intervals hold the truth, and lines are taken for lines,
 * as often as the pages of theory state. Crossovers of a few hundred repetitions;
 * test_few_replicas_storm.c has thousands.
 */
#include "tests/support/few_replicas.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>

/* Where scatter is equal and pooled, weights are no random numbers, and the interval t max(r, S) of
 * variances r^2 (f degrees of freedom) and S^2 (q, of the residuals), all independent, holds a
 * normal deviate of variance 1 with the probability that two midpoint rules give. */
static double exact_share(double q, double f)
{
    enum { PARTS = 300 };
    const double t = gsl_cdf_tdist_Pinv(0.975, q);
    double sum = 0, residual[PARTS], own[PARTS];
    for (int i = 0; i < PARTS; i++) {
        residual[i] = gsl_cdf_chisq_Pinv((i + 0.5) / PARTS, q) / q;
        own[i] = gsl_cdf_chisq_Pinv((i + 0.5) / PARTS, f) / f;
    }
    for (int i = 0; i < PARTS; i++)
        for (int j = 0; j < PARTS; j++)
            sum += 1 - 2 * gsl_cdf_ugaussian_Q(t * sqrt(fmax(residual[i], own[j])));
    return sum / PARTS / PARTS;
}

static void lines(void **state)
{
    enum { ROUNDS = 20000 };
    for (size_t c = 0; c < FEW_CLAIMS; c++) {
        const few_stated *claim = &few_claims[c];
        const few_lines found = few_lines_of(FEW_POINTS, claim->replicas, claim->falling, false,
                                             ROUNDS, 1000 + c);
        few_assert_share(found.slope, claim->slope, 0.001, ROUNDS);
        few_assert_share(found.alarms, claim->slope_alarms, 0.001, ROUNDS);
        if (claim->falling || claim->replicas >= FRACAS_REPLICAS_OWN) continue;
        few_assert_share(found.slope,
                         exact_share(FEW_POINTS - 2, FEW_POINTS * (claim->replicas - 1)), 0.001,
                         ROUNDS);
    }
}

/* Why errors are pooled. */
static void own_weights(void **state)
{
    enum { ROUNDS = 20000 };
    static const double stated[] = {0.71, 0.87, 0.92};
    for (int i = 0; i < 3; i++)
        few_assert_share(
            few_lines_of(FEW_POINTS, 2 + i, false, true, ROUNDS, 500 + (unsigned long)i).slope,
            stated[i], 0.01, ROUNDS);
}

/* Points of few replicas beside such as have their own: neither hides how the others scatter. Their
 * numbers, and what the page states for equal and for falling scatter. */
static void mixed(void **state)
{
    enum { ROUNDS = 20000 };
    for (size_t k = 0; k < FRACAS_COUNT(few_mixed); k++)
        for (int falling = 0; falling < 2; falling++) {
            const few_mixture *claim = &few_mixed[k];
            const few_lines found = few_lines_through(FEW_POINTS, claim->replicas, falling, false,
                                                      ROUNDS, 900 + k);
            few_assert_share(found.slope, claim->slope[falling], 0.001, ROUNDS);
            few_assert_share(found.alarms, claim->alarms[falling], 0.001, ROUNDS);
        }
}

/* Of many points, each of its own weight from eight replicas, intervals are short. */
static void many_points(void **state)
{
    enum { ROUNDS = 5000 };
    static const struct {
        size_t points;
        double slope, alarms;
    } stated[] = {{20, 0.923, 0.020}, {30, 0.909, 0.025}};
    for (int i = 0; i < 2; i++)
        for (int falling = 0; falling < 2; falling++) {
            const few_lines found = few_lines_of(stated[i].points, FRACAS_REPLICAS_OWN, falling,
                                                 false, ROUNDS, 800 + (unsigned long)i);
            few_assert_share(found.slope, stated[i].slope, 0.01, ROUNDS);
            few_assert_share(found.alarms, stated[i].alarms, 0.01, ROUNDS);
        }
}

/* Of more points pooling holds less where scatter falls. */
static void twelve_points(void **state)
{
    enum { ROUNDS = 20000 };
    static const double stated[] = {0.95, 0.95, 0.95};
    for (int i = 0; i < 3; i++)
        few_assert_share(few_lines_of(12, 2 + i, true, false, ROUNDS, 700 + (unsigned long)i).slope,
                         stated[i], 0.01, ROUNDS);
}

static void crossovers(void **state)
{
    for (size_t c = 0; c < FEW_CLAIMS; c += 2) few_assert_bends(&few_claims[c], 200, 2000 + c);
}

/* Draws about a curve without noise are as wide as Student's law of the freedom behind the errors,
 * beside those of errors known from 100000 replicas: the fit is linear in errors of 0.1 %. Of 19999
 * draws the quantile 0.025 is known to 1.4 % at worst; 5 % are allowed. */
static double width_of(int64_t replicas, int64_t of_last, double zigzag)
{
    fracas_size_point point[FEW_RATES];
    for (size_t i = 0; i < FEW_RATES; i++) {
        const double at = 1e2 * pow(10, 5.0 * (double)i / (FEW_RATES - 1)),
                     off = exp(zigzag * 1e-3 * (i % 2 ? 1 : -1));
        const int64_t n = i + 1 < FEW_RATES ? replicas : of_last;
        point[i] = (fracas_size_point){.replicas = n,
                                       .rate = at,
                                       .size = 1e-3 * off / (1 + pow(at / 3e4, 0.7)),
                                       .error = n > 1 ? 1e-3 : NAN};
    }
    const fracas_size_series series = {.name = "", .n = FEW_RATES, .point = point};
    fracas_size_crossover fit;
    OK(fracas_crossover_fit(&series, 19999, 1, &fit));
    print_message("%lld replicas, the last mean %lld: pooled %g, inflation %.3f, width %.5f\n",
                  (long long)replicas, (long long)of_last, fit.pooled, fit.inflation,
                  log(fit.rate.high / fit.rate.low));
    const double few = replicas < FRACAS_REPLICAS_OWN ? 8.0 * (double)(replicas - 1) : 0,
                 last = of_last < FRACAS_REPLICAS_OWN ? (double)(of_last - 1) : 0;
    assert_true(few + last > 0 ? fit.pooled == few + last : isnan(fit.pooled));
    return log(fit.rate.high / fit.rate.low) / fit.inflation;
}

static void draws_are_students(void **state)
{
    const double known = width_of(100000, 100000, 0), normal = gsl_cdf_ugaussian_Pinv(0.975);
    assert_true(fabs(width_of(2, 2, 0) / known / (gsl_cdf_tdist_Pinv(0.975, 9) / normal) - 1) <
                0.05);
    assert_true(fabs(width_of(3, 3, 0) / known / (gsl_cdf_tdist_Pinv(0.975, 18) / normal) - 1) <
                0.05);
    /* Each its own, of 7 degrees of freedom: independent, of variance 7/5 each, a sum of which is
     * nearly normal. */
    assert_true(fabs(width_of(8, 8, 0) / known / sqrt(7.0 / 5) - 1) < 0.05);
    /* Off the curve: the residuals' own 6 degrees of freedom, whatever the replicas. */
    assert_true(
        fabs(width_of(100000, 100000, 30) / known / (gsl_cdf_tdist_Pinv(0.975, 6) / normal) - 1) <
        0.05);
    /* The last mean alone of five degrees of freedom: only its own draws are wider, not all by t_5
     * = 2.57 over 1.96. */
    const double mixed = width_of(100000, 6, 0) / known;
    assert_true(mixed > 1.005 && mixed < 1.15);
    /* A last mean of one replica has an error too, and takes part: the eight others have 8 degrees
     * of freedom. */
    assert_true(width_of(2, 1, 0) > width_of(2, 2, 0));
}

/* The same pooled variance, all of it from the scatter at the lowest rate: means there are drawn
 * three times as far off, and s_q, which they tell, is known less well. Were they drawn by the
 * pooled error, both widths would be equal. */
static void draws_know_who_scatters(void **state)
{
    double width[2];
    for (int one = 0; one < 2; one++) {
        fracas_size_point point[FEW_RATES];
        for (size_t i = 0; i < FEW_RATES; i++) {
            const double at = 1e2 * pow(10, 5.0 * (double)i / (FEW_RATES - 1));
            point[i] = (fracas_size_point){.replicas = 3,
                                           .rate = at,
                                           .size = 1e-3 / (1 + pow(at / 3e4, 0.7)),
                                           .error = one ? i ? 0 : 3e-3 : 1e-3};
        }
        const fracas_size_series series = {.name = "", .n = FEW_RATES, .point = point};
        fracas_size_crossover fit;
        OK(fracas_crossover_fit(&series, 999, 1, &fit));
        assert_true(fit.pooled == 18);
        width[one] = fit.size.high - fit.size.low;
    }
    assert_true(width[1] > 1.2 * width[0]);
}

TESTS(lines, own_weights, twelve_points, mixed, many_points, crossovers, draws_are_students,
      draws_know_who_scatters)
