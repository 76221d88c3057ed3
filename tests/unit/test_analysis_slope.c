/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The slope of a line and its interval: exact lines, GSL, the interval's coverage, errors that
 * points share, and which points of a study count. */
#include "analysis/scaling/scaling.h"
#include "analysis/summary/study.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

/* A variance that is given, not estimated. */
static fracas_mean_error given(double variance)
{
    return (fracas_mean_error){.variance = variance, .most = variance, .freedom = INFINITY};
}

/* s = 3 rate^(-2/3) at rates 1e3 to 1e6: logarithms of about 10 are good to 2e-15, slopes over a
 * range of 7 to 1e-15. */
static void exact_power_law(void **state)
{
    double x[5], y[5];
    fracas_mean_error error[5];
    for (size_t i = 0; i < 5; i++) {
        x[i] = log(1e3 * pow(10, 0.75 * (double)i));
        y[i] = log(3) - 2.0 / 3 * x[i];
        error[i] = given(1e-4 * (double)(1 + i));
    }
    fracas_slope line = fracas_slope_of(x, y, error, 5);
    assert_int_equal(line.n, 5);
    assert_true(fabs(line.slope - FRACAS_SLOPE_GRADY) < 1e-14);
    assert_true(fabs(line.intercept - log(3)) < 1e-13);
    assert_true(line.chi2 < 1e-20 && line.misfit > 1 - 1e-12 && isnan(line.pooled));
    /* The points' own errors, not the residuals that are not there: t = 3.18, 0.01 to 0.022 over
     * sqrt(sum of squares 30). */
    assert_true(line.half_width > 3.18 * 0.01 / sqrt(30));
}

/* GSL sums in another order: 1e-12 is ten times what nine values of size 10 round to. */
static void as_gsl_has_it(void **state)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int round = 0; round < 50; round++) {
        enum { N = 9 };
        double x[N], y[N], variance[N], weight[N], c0, c1, v00, v01, v11, chi2;
        fracas_mean_error stated[N];
        double noise = round % 2 ? 3 : 0.3; /* of the stated error: chi2/dof above 1, or below */
        for (size_t i = 0; i < N; i++) {
            variance[i] = 1e-4 * (1 + 20 * gsl_rng_uniform(rng));
            weight[i] = 1 / variance[i];
            stated[i] = given(variance[i]);
            x[i] = 10 * gsl_rng_uniform(rng);
            y[i] = 2 - 0.8 * x[i] + noise * gsl_ran_gaussian(rng, sqrt(variance[i]));
        }
        gsl_fit_wlinear(x, 1, weight, 1, y, 1, N, &c0, &c1, &v00, &v01, &v11, &chi2);
        fracas_slope line = fracas_slope_of(x, y, stated, N);
        assert_true(fabs(line.slope - c1) < 1e-12 && fabs(line.intercept - c0) < 1e-11);
        assert_true(fabs(line.chi2 - chi2) < 1e-9 * chi2);
        assert_true(fabs(line.misfit - gsl_cdf_chisq_Q(chi2, N - 2)) <
                    1e-8 * line.misfit); /* variances that are known, not estimated */
        double error = sqrt(v11 * fmax(1, chi2 / (N - 2)));
        assert_true(fabs(line.standard_error - error) < 1e-11 * error);
        assert_true(fabs(line.half_width - 2.364624 * error) <
                    1e-6 * error); /* tabulated t_(0.975, 7) */
        assert_true(round % 2 ? chi2 / (N - 2) > 1 : chi2 / (N - 2) < 1);
    }
    gsl_rng_free(rng);
}

enum { REPETITIONS = 2000, RATES = 8 };

/* Share of repetitions whose interval holds the true slope. Noise has `factor` times the stated
 * deviation, which differs from point to point; without `stated` no variance is given, and all are
 * equal. */
static double coverage(double factor, bool stated, unsigned long seed)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, seed);
    int held = 0;
    for (int round = 0; round < REPETITIONS; round++) {
        double x[RATES], y[RATES];
        fracas_mean_error error[RATES];
        for (size_t i = 0; i < RATES; i++) {
            double deviation = stated ? 0.01 * (1 + (double)(i % 3)) : 0.01;
            x[i] = log(1e3) + (double)i * log(1e3) / (RATES - 1);
            y[i] = 1 - 0.7 * x[i] + gsl_ran_gaussian(rng, factor * deviation);
            error[i] = given(stated ? deviation * deviation : NAN);
        }
        fracas_slope line = fracas_slope_of(x, y, error, RATES);
        held += fabs(line.slope + 0.7) <= line.half_width;
    }
    gsl_rng_free(rng);
    return (double)held / REPETITIONS;
}

/* P(|Z| <= t max(1, S)), Z normal, S^2 = chi2/dof independent of it: the midpoint rule over the
 * distribution of S^2. */
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

/* Noise above the stated errors (chi2/dof is below 1 with a probability of 1e-3 then), or of no
 * stated size: the interval is Student's, 95 %, and 2000 repetitions show that to 2 % (four
 * standard deviations). Noise of exactly the stated size: chi2/dof is not let below 1, and the
 * interval holds more than 95 %, as much as the integral says. */
static void interval_covers(void **state)
{
    double above = coverage(4, true, 1), unstated = coverage(1, false, 2),
           exact = coverage(1, true, 3);
    double expected = expected_coverage(RATES - 2);
    print_message("coverage: noise of 4 times the stated errors %.4f, no stated errors %.4f, of "
                  "just the stated errors %.4f (%.4f expected)\n",
                  above, unstated, exact, expected);
    assert_true(above > 0.93 && above < 0.97);
    assert_true(unstated > 0.93 && unstated < 0.97);
    assert_true(expected > 0.97 &&
                fabs(exact - expected) < 4 * sqrt(expected * (1 - expected) / REPETITIONS));
}

static void assert_no_slope(fracas_slope line, int64_t n)
{
    assert_int_equal(line.n, n);
    assert_true(isnan(line.slope) && isnan(line.intercept) && isnan(line.chi2) &&
                isnan(line.misfit) && isnan(line.pooled));
    assert_true(isnan(line.standard_error) && isnan(line.half_width));
}

static void values_left_out(void **state)
{
    const double x[] = {1, 2, 3, 4, NAN, 5}, y[] = {2, 4, 6, 100, 3, -INFINITY};
    const fracas_mean_error error[] = {given(1),   given(4), given(1),
                                       given(NAN), given(1), given(1)};
    const fracas_mean_error none[] = {given(0), given(NAN), given(0)};
    fracas_slope line = fracas_slope_of(x, y, error, 6);
    assert_int_equal(line.n, 3);
    assert_true(fabs(line.slope - 2) < 1e-15);
    assert_no_slope(fracas_slope_of(x, y, error, 2), 2);
    line = fracas_slope_of(x, y, none,
                           3); /* no variance known: all weigh the same; no residual, no width */
    assert_int_equal(line.n, 3);
    assert_true(fabs(line.slope - 2) < 1e-15 && isnan(line.chi2) && isnan(line.misfit) &&
                line.half_width < 1e-14);
    const double one[] = {log(80 / 0.008), log(160 / 0.016),
                          nextafter(log(1e4), 10)}; /* one rate, but for rounding */
    assert_no_slope(fracas_slope_of(one, y, error, 3), 3);
}

static void assert_variance(const fracas_mean_error *error, double variance, bool pooled,
                            double freedom)
{
    assert_true(fabs(error->variance - variance) < 1e-14 * variance &&
                error->most >= error->variance && error->pooled == pooled &&
                error->freedom == freedom);
}

/* Replicas 3, 1, 4, 2 with scatter 0.02, unknown, 0.04, 0, beside 9 with 0.1, which has its own:
 * r^2 = (2 0.0004 + 3 0.0016 + 1 0)/(2 + 3 + 1). */
static void shared_errors(void **state)
{
    fracas_mean mean[] = {{3, 0.02}, {1, NAN}, {4, 0.04}, {2, 0}, {9, 0.1}};
    fracas_mean_error error[5];
    for (size_t n = 4; n <= 5; n++) { /* with the last or without, the few are as they are */
        fracas_mean_errors(mean, n, error);
        for (size_t i = 0; i < 4; i++)
            assert_variance(&error[i], 0.0056 / 6 / (double)mean[i].replicas, true, 6);
    }
    assert_variance(&error[4], 0.01 / 9, false, 8);
    assert_true(error[0].most == error[0].variance && error[1].most == error[1].variance &&
                error[3].most == error[3].variance);
    assert_true(fabs(error[2].most - 0.0016 / 4) < 1e-18); /* its own is the greater */
    /* Less than four degrees of freedom, or no scatter: not less than that of all, 8 0.01/f. */
    mean[2].replicas = 1;
    fracas_mean_errors(mean, 5, error);
    for (size_t i = 0; i < 4; i++)
        assert_variance(&error[i], (0.0008 + 0.08) / 11 / (double)mean[i].replicas, true, 3);
    mean[4].scatter = 0.001;
    fracas_mean_errors(mean, 5, error);
    assert_variance(&error[0], 0.0008 / 3 / 3, true, 3);
    mean[4].scatter = 0.1;
    for (size_t i = 0; i < 4; i++) mean[i] = (fracas_mean){3, 0};
    fracas_mean_errors(mean, 5, error);
    assert_variance(&error[0], 0.08 / 16 / 3, true, 8);
    for (size_t i = 0; i < 4; i++) mean[i] = (fracas_mean){1, NAN};
    fracas_mean_errors(mean, 5, error);
    assert_variance(&error[0], 0.01, true, 8);
    fracas_mean_errors(mean, 4, error);
    assert_true(isnan(error[0].variance) && isnan(error[3].variance)); /* none is known */
    for (size_t i = 0; i < 4; i++) mean[i] = (fracas_mean){3, 0};
    fracas_mean_errors(mean, 4, error);
    assert_true(error[0].variance == 0 && error[3].variance == 0);
    /* Eight and more: each its own, unknown where all are alike. */
    mean[0] = mean[1] = (fracas_mean){8, 0.02};
    mean[1].scatter = 0;
    fracas_mean_errors(mean, 2, error);
    assert_variance(&error[0], 0.0004 / 8, false, 7);
    assert_true(error[0].most == error[0].variance && !error[1].pooled && error[1].variance == 0);
}

/* With two degrees of freedom above, P(F > x) = (1 + 2 x/f)^(-f/2). Of Johansen, sum (1 - h)^2/f =
 * 2 (0.75^2/4.5 + 0.25^2/0.5) = 0.5 makes chi2/(2 + 1 - 3/4) an F with 2 and 2 4/1.5 = 16/3 degrees
 * of freedom; and so do two that share 5, beside one of its own with 0.75^2/f = 0.5 - (1 + 1/2)/10.
 */
static void misfits(void **state)
{
    fracas_misfit shared = {0}, own = {0}, mixed = {0}, known = {0};
    for (int i = 0; i < 4; i++) {
        fracas_misfit_add(&shared, 0.5,
                          &(fracas_mean_error){.variance = 1, .freedom = 5, .pooled = true});
        fracas_misfit_add(&own, i % 2 ? 0.75 : 0.25,
                          &(fracas_mean_error){.variance = 1, .freedom = i % 2 ? 0.5 : 4.5});
    }
    fracas_misfit_add(&mixed, 0.5,
                      &(fracas_mean_error){.variance = 1, .freedom = 5, .pooled = true});
    fracas_misfit_add(&mixed, 0.25, &(fracas_mean_error){.variance = 1, .freedom = 0.5625 / 0.35});
    fracas_misfit_add(&mixed, 0.5,
                      &(fracas_mean_error){.variance = 1, .freedom = 5, .pooled = true});
    assert_true(fabs(fracas_misfit_probability(&mixed, 7, 2) -
                     pow(1 + 2 * 7 / 2.25 / (16.0 / 3), -8.0 / 3)) < 1e-13);
    fracas_misfit_add(&known, 0.5, &(fracas_mean_error){.variance = 1, .freedom = INFINITY});
    assert_true(fabs(own.doubt - 0.5) < 1e-15);
    assert_true(fabs(fracas_misfit_probability(&shared, 7, 2) - pow(1 + 7.0 / 5, -2.5)) < 1e-13);
    assert_true(fabs(fracas_misfit_probability(&own, 7, 2) -
                     pow(1 + 2 * 7 / 2.25 / (16.0 / 3), -8.0 / 3)) < 1e-13);
    assert_true(fabs(fracas_misfit_probability(&known, 7, 2) - exp(-3.5)) < 1e-13);
    assert_true(isnan(fracas_misfit_probability(&shared, NAN, 2)) &&
                isnan(fracas_misfit_probability(&shared, 7, 0)));
}

/* ---- of a study ---- */

enum { NPOINTS = 8, NCOLUMNS = 3 };

/* Two radii, 8 and 16 mm, each at four velocities; sizes go with v/R to the power -1 for the one
 * and -2/3 for the other. Velocities and rates coincide between radii. */
static void slopes_of_series(void **state)
{
    static const fracas_column column[NCOLUMNS] = {{"derived.strain_rate", "1/s", "", false},
                                                   {"geometry.radius", "m", "", false},
                                                   {"loading.radial", "m/s", "", false}};
    fracas_value value[NPOINTS][NCOLUMNS];
    fracas_point_row row[NPOINTS];
    fracas_point_statistics point[NPOINTS];
    for (size_t p = 0; p < NPOINTS; p++) {
        double radius = p % 2 ? 16e-3 : 8e-3, velocity = 10 * pow(2, (double)(p / 2)),
               rate = velocity / radius;
        double real[NCOLUMNS] = {rate, radius, velocity};
        for (size_t c = 0; c < NCOLUMNS; c++)
            value[p][c] = (fracas_value){.real = real[c], .text = ""};
        row[p] = (fracas_point_row){.value = value[p]};
        double mean = pow(rate, p % 2 ? -2.0 / 3 : -1);
        point[p] = (fracas_point_statistics){
            .rate = rate, .size = {.n = 16, .mean = mean, .deviation = 0.04 * mean}};
    }
    fracas_point_table table = {
        .ncolumns = NCOLUMNS, .column = column, .npoints = NPOINTS, .point = row};
    fracas_analysis analysis = {.table = &table, .point = point};
    OK(fracas_columns_create(&table, &analysis.shown));
    fracas_size_slope *list;
    size_t count;
    OK(fracas_size_slopes(&analysis, &list, &count));
    assert_int_equal(count, 3);
    assert_string_equal(list[0].name, "radius 8 mm");
    assert_string_equal(list[1].name, "radius 16 mm");
    assert_int_equal(list[0].slope.n, 4);
    assert_true(fabs(list[0].slope.slope - FRACAS_SLOPE_MOTT) < 1e-13);
    assert_true(fabs(list[1].slope.slope - FRACAS_SLOPE_GRADY) < 1e-13);
    assert_true(list[0].mixes == 1 && list[1].mixes == 1 && list[2].mixes == 2);
    assert_string_equal(list[2].name, "all points, 2 series mixed");
    assert_int_equal(list[2].slope.n, NPOINTS);
    /* Each point has the standard error 0.04/sqrt(16) of its logarithm, at x = 0, 1, 2, 3 times log
     * 2: sum of squares 5. */
    double error = 0.01 / (log(2) * sqrt(5));
    assert_true(fabs(list[0].slope.standard_error - error) < 1e-12);
    assert_true(fabs(list[0].slope.half_width - 4.302653 * error) <
                1e-6 * error); /* tabulated t_(0.975, 2) */
    free(list);
    /* A mean of two replicas, of one degree of freedom, and as the others scatter: they weigh as
     * their replicas, 16, 16, 16, 2. */
    point[6].size.n = 2;
    OK(fracas_size_slopes(&analysis, &list, &count));
    assert_true(list[0].slope.pooled == 1 && isnan(list[1].slope.pooled) &&
                list[2].slope.pooled == 1);
    error = 0.04 / (log(2) * sqrt(16 * (0 + 1 + 4) + 2 * 9 - pow(16 * 3 + 2 * 3, 2) / 50));
    assert_true(fabs(list[0].slope.standard_error - error) < 1e-12 &&
                list[0].slope.misfit > 1 - 1e-12);
    free(list);
    /* One replica counts as soon as another mean has two; where no body came apart, nothing. */
    point[6].size = (fracas_estimate){.n = 1, .mean = point[6].size.mean, .deviation = NAN};
    point[0].count.mean = 1;
    OK(fracas_size_slopes(&analysis, &list, &count));
    assert_true(list[0].slope.pooled == 30 && list[0].slope.n == 3 && list[2].slope.n == 7);
    free(list);
    point[0].count.mean = 0;
    point[6].size = (fracas_estimate){
        .n = 0, .mean = NAN, .deviation = NAN}; /* three points of 8 mm, then two */
    OK(fracas_size_slopes(&analysis, &list, &count));
    assert_int_equal(count, 3);
    free(list);
    point[4].rate = NAN;
    OK(fracas_size_slopes(&analysis, &list, &count));
    assert_int_equal(count, 2);
    assert_string_equal(list[0].name, "radius 16 mm");
    free(list);
    table.npoints = 2;
    OK(fracas_size_slopes(&analysis, &list, &count));
    assert_int_equal(count, 0);
    free(list);
    fracas_columns_clear(&analysis.shown);
}

TESTS(exact_power_law, as_gsl_has_it, interval_covers, values_left_out, shared_errors, misfits,
      slopes_of_series)
