/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci */
/* Slopes between rates and the crossover of mean size: known exponents are found, 95 % intervals
 * hold them as often as they should, and what cannot be fitted says why. */
#include "analysis/scaling/scaling.h"
#include "analysis/data/estimate.h"
#include "tests/support/test.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

enum { RATES = 9, REPLICAS = 16 };
static const double TRUE_SIZE = 1e-3, TRUE_RATE = 3e4, TRUE_K = 0.7;

static double rate_of(size_t i)
{
    return 1e2 * pow(10, 5.0 * (double)i / (RATES - 1)); /* 1e2 to 1e7 */
}

static double size_at(double rate)
{
    return TRUE_SIZE / (1 + pow(rate / TRUE_RATE, TRUE_K));
}

/* Means with a known relative standard error; exact where random is NULL. */
static void make(fracas_size_point point[RATES], double error, gsl_rng *random)
{
    for (size_t i = 0; i < RATES; i++) {
        const double noise = random ? exp(gsl_ran_gaussian(random, error)) : 1;
        point[i] = (fracas_size_point){.point = i,
                                       .replicas = 64,
                                       .rate = rate_of(i),
                                       .size = size_at(rate_of(i)) * noise,
                                       .error = error};
    }
}

static void exact_windows(void **state)
{
    fracas_size_point low = {.replicas = 8, .rate = 1e3, .size = 2e-4, .error = 0.03},
                      high = {.replicas = 8, .rate = 1e4, .size = 2e-5, .error = 0.04};
    fracas_window window = fracas_window_of(&low, &high);
    assert_true(fabs(window.slope + 1) < 1e-14);
    assert_true(fabs(window.standard_error - 0.05 / log(10)) < 1e-15);
    /* Welch and Satterthwaite: 7 (9 + 16)^2/(81 + 256) = 12.98; tabulated t_(0.975, 13) = 2.160. */
    assert_true(fabs(window.freedom - 7 * 625.0 / 337) < 1e-10);
    assert_true(fabs(window.half_width / window.standard_error - 2.160) < 2e-3);
    high.error = NAN; /* one replica */
    assert_true(isfinite(fracas_window_of(&low, &high).slope) &&
                isnan(fracas_window_of(&low, &high).half_width));
    low.error = high.error = 0;
    assert_true(fracas_window_of(&low, &high).half_width == 0);
    high.replicas = 7; /* alike by chance */
    assert_true(fracas_window_of(&low, &high).standard_error == 0 &&
                isnan(fracas_window_of(&low, &high).half_width));
    assert_true(isnan(fracas_window_of(&high, &low).half_width));
    low.error = 0.03; /* one scatters */
    assert_true(fracas_window_of(&low, &high).half_width > 0);
    high.rate = 1e3 * (1 + 1e-12);
    assert_true(isnan(fracas_window_of(&low, &high).slope));
}

/* Sizes of 16 replicas, of unequal spread: 2000 repetitions know the coverage to 0.5 %. */
static void windows_cover(void **state)
{
    enum { REPETITIONS = 2000 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    int held = 0;
    for (int round = 0; round < REPETITIONS; round++) {
        fracas_size_point point[2];
        for (size_t i = 0; i < 2; i++) {
            double value[REPLICAS];
            for (size_t r = 0; r < REPLICAS; r++)
                value[r] = (i ? 0.2 : 1) * (1 + gsl_ran_gaussian(random, i ? 0.1 : 0.03));
            const fracas_estimate size = fracas_estimate_of(value, 1, REPLICAS);
            point[i] = (fracas_size_point){.replicas = size.n,
                                           .rate = i ? 1e4 : 1e3,
                                           .size = size.mean,
                                           .error = size.deviation / (4 * size.mean)};
        }
        const fracas_window window = fracas_window_of(&point[0], &point[1]);
        held += fabs(window.slope - log10(0.2)) <= window.half_width;
    }
    gsl_rng_free(random);
    print_message("windows: %.4f of %d intervals hold the slope\n", (double)held / REPETITIONS,
                  (int)REPETITIONS);
    assert_true(held > 0.93 * REPETITIONS && held < 0.97 * REPETITIONS);
}

/* Without noise the constants are those of the truth; the fit stops at steps of 1e-9. */
static void exact_crossover(void **state)
{
    fracas_size_point point[RATES];
    make(point, 0.01, NULL);
    const fracas_size_series series = {.name = "all points", .n = RATES, .point = point};
    fracas_size_crossover found;
    OK(fracas_crossover_fit(&series, 0, 1, &found));
    assert_string_equal(found.reason, "");
    assert_true(fabs(found.size.value / TRUE_SIZE - 1) < 1e-6);
    assert_true(fabs(found.rate.value / TRUE_RATE - 1) < 1e-6);
    assert_true(fabs(found.exponent.value + TRUE_K) < 1e-6);
    assert_true(found.chi2 < 1e-6 && found.inflation == 1 && isnan(found.rate.low));
    assert_true(fabs(fracas_crossover_at(&found, TRUE_RATE) / (TRUE_SIZE / 2) - 1) < 1e-6);
}

/* Shares of intervals that hold the truth, of 1 % of noise and errors that are stated `factor`
 * times too small. */
typedef struct {
    double held[3], inflated, off;
} shares;

static shares covers(double factor, int repetitions, unsigned long seed)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, seed);
    shares of = {{0}, 0, 0};
    for (int round = 0; round < repetitions; round++) {
        fracas_size_point point[RATES];
        make(point, 0.01, random);
        for (size_t i = 0; i < RATES; i++) point[i].error /= factor;
        const fracas_size_series series = {.name = "", .n = RATES, .point = point};
        fracas_size_crossover found;
        OK(fracas_crossover_fit(&series, 399, (uint64_t)round + 1, &found));
        assert_string_equal(found.reason, "");
        of.held[0] += (found.size.low <= TRUE_SIZE && TRUE_SIZE <= found.size.high) /
                      (double)repetitions;
        of.held[1] += (found.rate.low <= TRUE_RATE && TRUE_RATE <= found.rate.high) /
                      (double)repetitions;
        of.held[2] += (found.exponent.low <= -TRUE_K && -TRUE_K <= found.exponent.high) /
                      (double)repetitions;
        of.inflated += (found.inflation > 1) / (double)repetitions;
        of.off += (found.misfit < FRACAS_MISFIT_LIMIT) / (double)repetitions;
    }
    gsl_rng_free(random);
    print_message("crossover, errors %g times too small: %.3f hold s_q, %.3f the rate, %.3f the "
                  "exponent; %.3f are inflated, %.3f said to be off\n",
                  factor, of.held[0], of.held[1], of.held[2], of.inflated, of.off);
    return of;
}

/* Errors that are right: P(|Z| < 1.96 max(1, S)) = 97 %, S^2 = chi2/6 independent of Z, of which
 * half is not above 1: 42 % are (the chi2 distribution). 1000 repetitions know the one to 0.5 %,
 * the other to 1.6 %. */
static void crossover_covers(void **state)
{
    const shares of = covers(1, 1000, 2);
    for (int i = 0; i < 3; i++) assert_true(of.held[i] > 0.945 && of.held[i] < 0.99);
    assert_true(fabs(of.inflated - 0.423) < 0.08);
    assert_true(of.off < 0.03); /* 1 % expected; 6 standard deviations */
}

/* Errors that are too small: the intervals are inflated and hold the truth about as often; 300
 * repetitions know it to 1.5 %. Inflated only where the test says that the means are off, they
 * would hold it in 0.84 of those with 1.5 and 2; not at all, in 0.30 of those with 5. */
static void understated_errors(void **state)
{
    static const double factor[] = {1.5, 2, 5};
    for (int f = 0; f < 3; f++) {
        const shares of = covers(factor[f], 300, 3);
        for (int i = 0; i < 3; i++) assert_true(of.held[i] > 0.89);
    }
}

/* Errors of 60 %: some draws have next to no crossover, and the standard error is of what the
 * others say. */
static void draws_that_run_away(void **state)
{
    fracas_size_point point[RATES];
    make(point, 0.6, NULL);
    const fracas_size_series series = {.name = "", .n = RATES, .point = point};
    fracas_size_crossover found;
    OK(fracas_crossover_fit(&series, 999, 1, &found));
    print_message("s_q %g m, %g to %g, +- %g\n", found.size.value, found.size.low, found.size.high,
                  found.size.standard_error);
    assert_true(found.size.standard_error > 0 &&
                found.size.standard_error < (found.size.high - found.size.low) / 2);
}

static void without_a_fit(void **state)
{
    fracas_size_point point[RATES];
    fracas_size_series series = {.name = "steel", .n = RATES, .point = point};
    fracas_size_crossover found;
    struct {
        const char *what, *reason;
    } const row[] = {{"few", "4 rates with a known standard error, 5 are needed"},
                     {"one", "1 rate with a known standard error, 5 are needed"},
                     {"equal", "1 rate with a known standard error, 5 are needed"},
                     {"unknown", "0 rates with a known"},
                     {"powers", "no bend: the fitted crossover is below all rates"},
                     {"level", "no bend: the fitted crossover is above all rates"}};
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        make(point, 0.01, NULL);
        series.n = !strcmp(row[k].what, "few") ? 4 : !strcmp(row[k].what, "one") ? 1 : RATES;
        for (size_t i = 0; i < RATES; i++) {
            if (!strcmp(row[k].what, "equal")) point[i].rate = 1e4;
            if (!strcmp(row[k].what, "unknown")) point[i].error = i % 2 ? NAN : 0;
            if (!strcmp(row[k].what, "powers"))
                point[i].size = pow(point[i].rate, -0.7) * (i % 2 ? 1.002 : 0.998);
            if (!strcmp(row[k].what, "level")) point[i].size = 1e-3 / (1 + point[i].rate / 1e8);
        }
        OK(fracas_crossover_fit(&series, 99, 1, &found));
        print_message("%s: %s\n", row[k].what, found.reason);
        assert_non_null(strstr(found.reason, row[k].reason));
        assert_true(isnan(found.rate.value) && isnan(found.size.value) &&
                    isnan(found.exponent.low) && isnan(found.chi2));
        assert_string_equal(found.name, "steel");
    }
}

TESTS(exact_windows, windows_cover, exact_crossover, crossover_covers, understated_errors,
      draws_that_run_away, without_a_fit)
