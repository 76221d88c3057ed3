/* The slope of a line and its interval: exact lines, GSL, the interval's coverage, and which points of a study count. */
#include "analysis/laws/slope.h"
#include "analysis/study/study.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* s = 3 rate^(-2/3) at rates 1e3 to 1e6: logarithms of about 10 are good to 2e-15, slopes over a range of 7 to 1e-15. */
static void exact_power_law(void **state)
{
    (void)state;
    double x[5], y[5], variance[5];
    for (size_t i = 0; i < 5; i++) {
        x[i] = log(1e3 * pow(10, 0.75 * (double)i));
        y[i] = log(3) - 2.0 / 3 * x[i];
        variance[i] = 1e-4 * (double)(1 + i);
    }
    fracas_slope line = fracas_slope_of(x, y, variance, 5);
    assert_int_equal(line.n, 5);
    assert_true(fabs(line.slope - FRACAS_SLOPE_GRADY) < 1e-14);
    assert_true(fabs(line.intercept - log(3)) < 1e-13);
    assert_true(line.chi2 < 1e-20);
    /* The points' own errors, not the residuals that are not there: t = 3.18, 0.01 to 0.022 over sqrt(sum of squares 30). */
    assert_true(line.half_width > 3.18 * 0.01 / sqrt(30));
}

/* GSL sums in another order: 1e-12 is ten times what nine values of size 10 round to. */
static void as_gsl_has_it(void **state)
{
    (void)state;
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int round = 0; round < 50; round++) {
        enum { N = 9 };
        double x[N], y[N], variance[N], weight[N], c0, c1, v00, v01, v11, chi2;
        double noise = round % 2 ? 3 : 0.3; /* of the stated error: chi2/dof above 1, or below */
        for (size_t i = 0; i < N; i++) {
            variance[i] = 1e-4 * (1 + 20 * gsl_rng_uniform(rng));
            weight[i] = 1 / variance[i];
            x[i] = 10 * gsl_rng_uniform(rng);
            y[i] = 2 - 0.8 * x[i] + noise * gsl_ran_gaussian(rng, sqrt(variance[i]));
        }
        gsl_fit_wlinear(x, 1, weight, 1, y, 1, N, &c0, &c1, &v00, &v01, &v11, &chi2);
        fracas_slope line = fracas_slope_of(x, y, variance, N);
        assert_true(fabs(line.slope - c1) < 1e-12 && fabs(line.intercept - c0) < 1e-11);
        assert_true(fabs(line.chi2 - chi2) < 1e-9 * chi2);
        double error = sqrt(v11 * fmax(1, chi2 / (N - 2)));
        assert_true(fabs(line.standard_error - error) < 1e-11 * error);
        assert_true(fabs(line.half_width - 2.364624 * error) < 1e-6 * error); /* tabulated t_(0.975, 7) */
        assert_true(round % 2 ? chi2 / (N - 2) > 1 : chi2 / (N - 2) < 1);
    }
    gsl_rng_free(rng);
}

enum { REPETITIONS = 2000, RATES = 8 };

/* Share of repetitions whose interval holds the true slope. Noise has `factor` times the stated deviation, which differs
 * from point to point; without `stated` no variance is given, and all are equal. */
static double coverage(double factor, bool stated, unsigned long seed)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, seed);
    int held = 0;
    for (int round = 0; round < REPETITIONS; round++) {
        double x[RATES], y[RATES], variance[RATES];
        for (size_t i = 0; i < RATES; i++) {
            double deviation = stated ? 0.01 * (1 + (double)(i % 3)) : 0.01;
            x[i] = log(1e3) + (double)i * log(1e3) / (RATES - 1);
            y[i] = 1 - 0.7 * x[i] + gsl_ran_gaussian(rng, factor * deviation);
            variance[i] = stated ? deviation * deviation : NAN;
        }
        fracas_slope line = fracas_slope_of(x, y, variance, RATES);
        held += fabs(line.slope + 0.7) <= line.half_width;
    }
    gsl_rng_free(rng);
    return (double)held / REPETITIONS;
}

/* P(|Z| <= t max(1, S)), Z normal, S^2 = chi2/dof independent of it: the midpoint rule over the distribution of S^2. */
static double expected_coverage(double dof)
{
    enum { PARTS = 20000 };
    double t = gsl_cdf_tdist_Pinv(0.975, dof), sum = 0;
    for (int i = 0; i < PARTS; i++) {
        double s2 = gsl_cdf_chisq_Pinv((i + 0.5) / PARTS, dof) / dof;
        sum += 1 - 2 * gsl_cdf_ugaussian_Q(t * sqrt(fmax(1, s2)));
    }
    return sum / PARTS;
}

/* Noise above the stated errors (chi2/dof is below 1 with a probability of 1e-3 then), or of no stated size: the
 * interval is Student's, 95 %, and 2000 repetitions show that to 2 % (four standard deviations). Noise of exactly the
 * stated size: chi2/dof is not let below 1, and the interval holds more than 95 %, as much as the integral says. */
static void interval_covers(void **state)
{
    (void)state;
    double above = coverage(4, true, 1), unstated = coverage(1, false, 2), exact = coverage(1, true, 3);
    double expected = expected_coverage(RATES - 2);
    print_message("coverage: noise of 4 times the stated errors %.4f, no stated errors %.4f, of just the stated errors %.4f "
                  "(%.4f expected)\n", above, unstated, exact, expected);
    assert_true(above > 0.93 && above < 0.97);
    assert_true(unstated > 0.93 && unstated < 0.97);
    assert_true(expected > 0.97 && fabs(exact - expected) < 4 * sqrt(expected * (1 - expected) / REPETITIONS));
}

static void assert_no_slope(fracas_slope line, int64_t n)
{
    assert_int_equal(line.n, n);
    assert_true(isnan(line.slope) && isnan(line.intercept) && isnan(line.chi2));
    assert_true(isnan(line.standard_error) && isnan(line.half_width));
}

static void values_left_out(void **state)
{
    (void)state;
    const double x[] = {1, 2, 3, 4, NAN, 5}, y[] = {2, 4, 6, 100, 3, -INFINITY};
    const double variance[] = {1, 4, 1, NAN, 1, 1}, none[] = {0, NAN, 0, NAN, 0, NAN};
    fracas_slope line = fracas_slope_of(x, y, variance, 6);
    assert_int_equal(line.n, 3);
    assert_true(fabs(line.slope - 2) < 1e-15);
    assert_no_slope(fracas_slope_of(x, y, variance, 2), 2);
    line = fracas_slope_of(x, y, none, 3); /* no variance known: all weigh the same; no residual, no width */
    assert_int_equal(line.n, 3);
    assert_true(fabs(line.slope - 2) < 1e-15 && isnan(line.chi2) && line.half_width < 1e-14);
    const double one[] = {log(80 / 0.008), log(160 / 0.016), nextafter(log(1e4), 10)}; /* one rate, but for rounding */
    assert_no_slope(fracas_slope_of(one, y, variance, 3), 3);
}

/* ---- of a study ---- */

enum { NPOINTS = 8, NCOLUMNS = 3 };

/* Two radii, 8 and 16 mm, each at four velocities; sizes go with v/R to the power -1 for the one and -2/3 for the
 * other. Velocities and rates coincide between radii. */
static void slopes_of_series(void **state)
{
    (void)state;
    static const fracas_column column[NCOLUMNS] = {
        {"derived.strain_rate", "1/s", "", false}, {"geometry.radius", "m", "", false}, {"loading.radial", "m/s", "", false}};
    fracas_value value[NPOINTS][NCOLUMNS];
    fracas_point_row row[NPOINTS];
    fracas_point_statistics point[NPOINTS];
    for (size_t p = 0; p < NPOINTS; p++) {
        double radius = p % 2 ? 16e-3 : 8e-3, velocity = 10 * pow(2, (double)(p / 2)), rate = velocity / radius;
        double real[NCOLUMNS] = {rate, radius, velocity};
        for (size_t c = 0; c < NCOLUMNS; c++) value[p][c] = (fracas_value){.real = real[c], .text = ""};
        row[p] = (fracas_point_row){.value = value[p]};
        double mean = pow(rate, p % 2 ? -2.0 / 3 : -1);
        point[p] = (fracas_point_statistics){.rate = rate, .size = {.n = 16, .mean = mean, .deviation = 0.04 * mean}};
    }
    fracas_point_table table = {.ncolumns = NCOLUMNS, .column = column, .npoints = NPOINTS, .point = row};
    fracas_analysis analysis = {.table = &table, .point = point};
    assert_int_equal(fracas_columns_create(&table, &analysis.shown), FRACAS_OK);
    fracas_size_slope *list;
    size_t count;
    assert_int_equal(fracas_size_slopes(&analysis, &list, &count), FRACAS_OK);
    assert_int_equal(count, 3);
    assert_string_equal(list[0].name, "all points");
    assert_int_equal(list[0].slope.n, NPOINTS);
    assert_string_equal(list[1].name, "radius 8 mm");
    assert_string_equal(list[2].name, "radius 16 mm");
    assert_int_equal(list[1].slope.n, 4);
    assert_true(fabs(list[1].slope.slope - FRACAS_SLOPE_MOTT) < 1e-13);
    assert_true(fabs(list[2].slope.slope - FRACAS_SLOPE_GRADY) < 1e-13);
    /* Each point has the standard error 0.04/sqrt(16) of its logarithm, at x = 0, 1, 2, 3 times log 2: sum of squares 5. */
    double error = 0.01 / (log(2) * sqrt(5));
    assert_true(fabs(list[1].slope.standard_error - error) < 1e-12);
    assert_true(fabs(list[1].slope.half_width - 4.302653 * error) < 1e-6 * error); /* tabulated t_(0.975, 2) */
    free(list);
    point[6].size = (fracas_estimate){.n = 0, .mean = NAN, .deviation = NAN}; /* three points of 8 mm, then two */
    assert_int_equal(fracas_size_slopes(&analysis, &list, &count), FRACAS_OK);
    assert_int_equal(count, 3);
    free(list);
    point[4].rate = NAN;
    assert_int_equal(fracas_size_slopes(&analysis, &list, &count), FRACAS_OK);
    assert_int_equal(count, 2);
    assert_string_equal(list[1].name, "radius 16 mm");
    free(list);
    table.npoints = 2;
    assert_int_equal(fracas_size_slopes(&analysis, &list, &count), FRACAS_OK);
    assert_int_equal(count, 0);
    free(list);
    fracas_columns_clear(&analysis.shown);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_power_law), cmocka_unit_test(as_gsl_has_it), cmocka_unit_test(interval_covers),
        cmocka_unit_test(values_left_out), cmocka_unit_test(slopes_of_series),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
