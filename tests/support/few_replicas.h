/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines and crossovers through means of few replicas, of known truth: how often intervals hold it,
 * and how often points that are on the line are said not to be. What docs/theory/estimators.md and
 * scaling-laws.md state. */
#ifndef FRACAS_TESTS_SUPPORT_FEW_REPLICAS_H
#define FRACAS_TESTS_SUPPORT_FEW_REPLICAS_H

#include "analysis/scaling/scaling.h"
#include "analysis/data/estimate.h"
#include "base/param.h"
#include "tests/support/test.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

enum { FEW_MOST = 32, FEW_POINTS = 8, FEW_MOST_POINTS = 30, FEW_RATES = 9, FEW_DRAWS = 199 };

/* One scatter of a replica for all points, 5 %; or falling to a tenth from the first point to the
 * last, from 10 %. */
static inline double few_scatter(bool falling, size_t i, size_t n)
{
    return falling ? 0.1 * pow(10, -(double)i / (double)(n - 1)) : 0.05;
}

static inline fracas_estimate few_mean(gsl_rng *random, double truth, double scatter, int replicas)
{
    double value[FEW_MOST];
    for (int r = 0; r < replicas; r++) value[r] = truth * (1 + gsl_ran_gaussian(random, scatter));
    return fracas_estimate_of(value, 1, (size_t)replicas);
}

typedef struct {
    int rounds;
    double slope,
        alarms; /* shares: of intervals that hold the slope, of lines that are said to be none */
} few_lines;

/* replicas[points]. own: weights of each point's own replicas, however few, as they must not be. */
static inline few_lines few_lines_through(size_t points, const int *replicas, bool falling,
                                          bool own, int rounds, unsigned long seed)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, seed);
    int held = 0, alarms = 0;
    for (int round = 0; round < rounds; round++) {
        double x[FEW_MOST_POINTS], y[FEW_MOST_POINTS];
        fracas_mean mean[FEW_MOST_POINTS];
        fracas_mean_error error[FEW_MOST_POINTS];
        for (size_t i = 0; i < points; i++) {
            x[i] = log(1e3) + log(1e3) * (double)i / (double)(points - 1);
            const fracas_estimate size = few_mean(random, exp(-0.7 * x[i]),
                                                  few_scatter(falling, i, points), replicas[i]);
            y[i] = log(size.mean);
            mean[i] = (fracas_mean){size.n, size.deviation / size.mean};
        }
        fracas_mean_errors(mean, points, error);
        for (size_t i = 0; own && i < points; i++)
            error[i].variance = mean[i].scatter * mean[i].scatter / replicas[i];
        const fracas_slope line = fracas_slope_of(x, y, error, points);
        held += fabs(line.slope + 0.7) <= line.half_width;
        alarms += line.misfit < FRACAS_MISFIT_LIMIT;
    }
    gsl_rng_free(random);
    print_message("%zu points, %2d to %2d replicas%s, scatter %s: %.4f hold the slope, %.4f are "
                  "said to be no line\n",
                  points, replicas[0], replicas[points - 1], own ? " that weigh by themselves" : "",
                  falling ? "falling" : "equal", (double)held / rounds, (double)alarms / rounds);
    return (few_lines){rounds, (double)held / rounds, (double)alarms / rounds};
}

static inline few_lines few_lines_of(size_t points, int replicas, bool falling, bool own,
                                     int rounds, unsigned long seed)
{
    int each[FEW_MOST_POINTS];
    for (size_t i = 0; i < points; i++) each[i] = replicas;
    return few_lines_through(points, each, falling, own, rounds, seed);
}

typedef struct {
    double held[3]; /* shares of intervals: s_q, edot_c, k */
    double alarms;
} few_bends;

static inline few_bends few_bends_of(int replicas, bool falling, int rounds, unsigned long seed)
{
    static const double size = 1e-3, rate = 3e4, k = 0.7;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, seed);
    few_bends found = {{0}, 0};
    for (int round = 0; round < rounds; round++) {
        fracas_size_point point[FEW_RATES];
        for (size_t i = 0; i < FEW_RATES; i++) {
            const double at = 1e2 * pow(10, 5.0 * (double)i / (FEW_RATES - 1));
            const fracas_estimate mean = few_mean(random, size / (1 + pow(at / rate, k)),
                                                  few_scatter(falling, i, FEW_RATES), replicas);
            point[i] = (fracas_size_point){.point = i,
                                           .replicas = replicas,
                                           .rate = at,
                                           .size = mean.mean,
                                           .error = mean.deviation / (sqrt(replicas) * mean.mean)};
        }
        const fracas_size_series series = {.name = "", .n = FEW_RATES, .point = point};
        fracas_size_crossover fit;
        OK(fracas_crossover_fit(&series, FEW_DRAWS, (uint64_t)round + 1, &fit));
        assert_string_equal(fit.reason, "");
        found.held[0] += (fit.size.low <= size && size <= fit.size.high) / (double)rounds;
        found.held[1] += (fit.rate.low <= rate && rate <= fit.rate.high) / (double)rounds;
        found.held[2] += (fit.exponent.low <= -k && -k <= fit.exponent.high) / (double)rounds;
        found.alarms += (fit.misfit < FRACAS_MISFIT_LIMIT) / (double)rounds;
    }
    gsl_rng_free(random);
    print_message("crossover, %2d replicas, scatter %s: %.3f hold s_q, %.3f the rate, %.3f the "
                  "exponent; %.4f are said to be off\n",
                  replicas, falling ? "falling" : "equal", found.held[0], found.held[1],
                  found.held[2], found.alarms);
    return found;
}

/* What the pages state, as shares. */
typedef struct {
    int replicas;
    bool falling;
    double slope, slope_alarms, held[3], alarms;
} few_stated;

static const few_stated few_claims[] = {
    {2, false, 0.985, 0.01, {0.99, 0.99, 0.99}, 0.01},
    {3, false, 0.986, 0.01, {0.99, 0.98, 0.98}, 0.01},
    {4, false, 0.987, 0.01, {0.98, 0.98, 0.98}, 0.01},
    {8, false, 0.969, 0.012, {0.96, 0.97, 0.97}, 0.01},
    {16, false, 0.981, 0.011, {0.95, 0.95, 0.96}, 0.01},
    {32, false, 0.986, 0.01, {0.96, 0.96, 0.96}, 0.01},
    {2, true, 0.962, 0.043, {0.97, 0.99, 0.998}, 0.05},
    {3, true, 0.967, 0.042, {0.97, 0.99, 0.998}, 0.05},
    {4, true, 0.970, 0.039, {0.97, 0.99, 0.998}, 0.05},
    {8, true, 0.969, 0.013, {0.95, 0.96, 0.97}, 0.01},
    {16, true, 0.982, 0.011, {0.96, 0.96, 0.96}, 0.01},
    {32, true, 0.986, 0.01, {0.96, 0.96, 0.96}, 0.01},
};
enum { FEW_CLAIMS = sizeof few_claims / sizeof *few_claims };

/* Points of unequal replicas; shares with equal and with falling scatter. */
typedef struct {
    int replicas[FEW_POINTS];
    double slope[2], alarms[2];
} few_mixture;

static const few_mixture few_mixed[] = {
    {{7, 32, 32, 32, 32, 32, 32, 32}, {0.983, 0.986}, {0.013, 0.015}},
    {{4, 4, 8, 8, 16, 16, 32, 32}, {0.974, 0.976}, {0.015, 0.015}},
    {{3, 3, 3, 3, 32, 32, 32, 32}, {0.982, 0.984}, {0.009, 0.014}},
    {{3, 9, 3, 9, 3, 9, 3, 9}, {0.975, 0.958}, {0.007, 0.023}},
    {{2, 8, 2, 8, 2, 8, 2, 8}, {0.970, 0.945}, {0.013, 0.028}},
    {{2, 32, 32, 32, 32, 32, 32, 32}, {0.986, 0.987}, {0.000, 0.018}},
    {{1, 32, 32, 32, 32, 32, 32, 32}, {0.987, 0.991}, {0.010, 0.172}},
};

/* A share of `rounds` is the stated one: five standard deviations of a binomial, and half a unit of
 * the digits that are stated. */
static inline void few_assert_share(double found, double stated, double digit, int rounds)
{
    const double limit = digit / 2 + 5 * sqrt(stated * (1 - stated) / rounds);
    if (!(fabs(found - stated) < limit))
        fail_msg("%.4f of %d, %.4f +- %.4f are stated", found, rounds, stated, limit);
}

static inline void few_assert_bends(const few_stated *claim, int rounds, unsigned long seed)
{
    const few_bends found = few_bends_of(claim->replicas, claim->falling, rounds, seed);
    for (int i = 0; i < 3; i++) few_assert_share(found.held[i], claim->held[i], 0.01, rounds);
    few_assert_share(found.alarms, claim->alarms, 0.01, rounds);
}

#endif
