/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plates at rising rates, made so that every power is known: slopes of size and count, the figures
 * of counts and of masses, and the residual by the total energy. */
#include "analysis/report/figures.h"
#include "analysis/scaling/scaling.h"
#include "tests/support/test.h"

enum { NPOINTS = 5, NREPLICAS = 2, NCOLUMNS = 3 };

/* Point p has the rate 1e3 4^p /s. Its replicas have n = 9 2^p and 11 2^p fragments of the size
 * sqrt(1e-4 m2/n) and the mass 1e-3 kg/n, the last of them dust of a tenth of it. So the mean count
 * goes with the rate to the power 1/2, the mean size to -1/4, and the relative scatter of either is
 * that of all points. */
static void make_plates(fracas_point_statistics point[NPOINTS], fracas_analysis *analysis)
{
    static const fracas_column column[NCOLUMNS] = {{"derived.strain_rate", "1/s", "", false},
                                                   {"derived.surface", "1", "", false},
                                                   {"loading.rate", "1/s", "", false}};
    static fracas_value value[NPOINTS][NCOLUMNS];
    static fracas_point_row row[NPOINTS];
    static fracas_point_table table;
    table = (fracas_point_table){NCOLUMNS, column, NPOINTS, row};
    for (size_t p = 0; p < NPOINTS; p++) {
        const double rate = 1e3 * (double)(1 << 2 * p), of[NCOLUMNS] = {rate, 1, rate};
        for (size_t c = 0; c < NCOLUMNS; c++) value[p][c] = (fracas_value){of[c], ""};
        row[p] = (fracas_point_row){.replicas = NREPLICAS, .value = value[p]};
    }
    *analysis = (fracas_analysis){.table = &table, .point = point, .header = {.complete = true}};
    for (size_t p = 0; p < NPOINTS; p++) {
        fracas_point_statistics_init(&table, p, &point[p]);
        for (size_t r = 0; r < NREPLICAS; r++) {
            const size_t n = (r ? 11U : 9U) << p;
            FRACAS_CLEARED(fracas_record) record;
            fracas_record_init(&record);
            record.outcome = FRACAS_FRAGMENTED;
            record.nfragment = n;
            record.fragments = (int64_t)n;
            record.fragments_dust = 1;
            record.fragment = calloc(n, sizeof *record.fragment);
            assert_non_null(record.fragment);
            for (size_t i = 0; i < n; i++)
                record.fragment[i] = (fracas_fragment){
                    .size = sqrt(1e-4 / (double)n),
                    .mass = (i + 1 < n ? 1e-3 : 1e-4) / (double)n,
                    .elements = i + 1 < n ? 50 : 2,
                    .dust = i + 1 == n};
            OK(fracas_point_statistics_add(&point[p], NREPLICAS * p + r, (int64_t)r, &record));
        }
        OK(fracas_point_statistics_finish(&point[p]));
    }
    OK(fracas_columns_create(&table, &analysis->shown));
}

static void clear_plates(fracas_point_statistics point[NPOINTS], fracas_analysis *analysis)
{
    for (size_t p = 0; p < NPOINTS; p++) fracas_point_statistics_clear(&point[p]);
    fracas_means_axes_clear(&analysis->axes);
    fracas_columns_clear(&analysis->shown);
}

/* The one slope of a study of one series: known to the rounding of means and logarithms. Those are
 * at most log(2.56e5) = 12.5 and good to 12.5 2^-53 = 1.4e-15 each; over a range of 4 log 4 = 5.5
 * five of them move a slope by less than 5 1.4e-15/5.5 = 1.3e-15, 1e-14 is eight times that. */
static void assert_power(fracas_err err, fracas_size_slope *list, size_t count, double power)
{
    OK(err);
    assert_int_equal(count, 1);
    assert_true(list->slope.n == NPOINTS && list->mixes == 1);
    assert_true(fabs(list->slope.slope - power) < 1e-14);
    assert_true(list->slope.misfit > 1 - 1e-9 && list->slope.pooled == NPOINTS);
    assert_true(isnan(list->mott) && isnan(list->grady)); /* these are of one dimension */
    assert_string_equal(list->name, "all points");
}

static void powers_of_plates(void **state)
{
    fracas_point_statistics point[NPOINTS];
    fracas_analysis analysis;
    OWNED fracas_size_slope *size = NULL, *all = NULL, *large = NULL;
    OWNED fracas_size_window *window = NULL;
    size_t count = 0;
    make_plates(point, &analysis);
    fracas_err err = fracas_size_slopes(&analysis, &size, &count);
    assert_power(err, size, count, -0.25);
    err = fracas_count_slopes(&analysis, true, &all, &count);
    assert_power(err, all, count, 0.5);
    for (size_t p = 0; p < NPOINTS; p++) /* the line passes through the means: e^12 to 1e-14 12 */
        assert_true(fabs(fracas_slope_at(&all->slope, point[p].rate) / point[p].count.mean - 1) <
                    1e-12);
    /* Each point has the relative error d/(sqrt(2) mean) = 0.1: deviation sqrt(2), mean 10. */
    const double error = 0.1 / (log(4) * sqrt(10)); /* sum of squares of -2 .. 2 */
    assert_true(fabs(all->slope.standard_error / error - 1) < 1e-12);
    /* Without dust one fragment less: not that power. */
    OK(fracas_count_slopes(&analysis, false, &large, &count));
    assert_true(count == 1 && large->slope.slope > 0.51 && large->slope.slope < 0.53);
    OK(fracas_size_windows(&analysis, &window, &count));
    assert_int_equal(count, NPOINTS - 1);
    for (size_t i = 0; i < count; i++) assert_true(fabs(window[i].window.slope + 0.25) < 1e-14);
    /* A point of nothing but dust has no logarithm, and takes the others' errors from them no more.
     */
    free(large);
    point[2].count_large = (fracas_estimate){.n = NREPLICAS, .mean = 0, .deviation = 0};
    OK(fracas_count_slopes(&analysis, false, &large, &count));
    assert_true(count == 1 && large->slope.n == NPOINTS - 1 && large->slope.pooled == NPOINTS - 1);
    /* Where little is dust, nothing is said of counts without it. */
    for (size_t p = 0; p < NPOINTS; p++) point[p].dust_share = 0.05;
    free(large);
    OK(fracas_count_slopes(&analysis, false, &large, &count));
    assert_true(count == 0 && !large);
    clear_plates(point, &analysis);
}

/* Open marks without dust, filled ones with it, then the fitted line; and nothing against a rate
 * that is not there. */
static void figure_of_counts(void **state)
{
    fracas_point_statistics point[NPOINTS];
    fracas_analysis analysis;
    FRACAS_CLEARED(fracas_charts) charts = {0};
    make_plates(point, &analysis);
    OK(fracas_analysis_axes(&analysis, NULL, NULL, NULL));
    OK(fracas_figure_means(&analysis, FRACAS_MEANS_COUNT, &charts));
    fracas_chart chart = charts.chart[0];
    assert_true(charts.count == 1 && chart.npanels == 1 && chart.panel[0].nseries == 3);
    const fracas_series *open = &chart.panel[0].series[0], *filled = open + 1, *line = open + 2;
    assert_true(open->open && !filled->open && open->n == NPOINTS && filled->n == NPOINTS &&
                open->look == filled->look && line->kind == FRACAS_CURVE);
    for (size_t p = 0; p < NPOINTS; p++) {
        const double n = (double)(10 << p);
        assert_true(filled->x[p] == 1e3 * (double)(1 << 2 * p) && filled->y[p] == n);
        assert_true(open->y[p] == n - 1);
        /* t_(0.975, 1) = 12.7062 times 2^p sqrt(2)/sqrt(2) */
        assert_true(fabs((filled->high[p] - n) / (12.7062 * (double)(1 << p)) - 1) < 1e-5);
    }
    assert_true(
        fabs(log(line->y[line->n - 1] / line->y[0]) / log(line->x[line->n - 1] / line->x[0]) -
             0.5) < 1e-13);
    fracas_charts_clear(&charts);
    for (size_t p = 0; p < NPOINTS; p++) point[p].dust_share = 0.05; /* not much */
    OK(fracas_figure_means(&analysis, FRACAS_MEANS_COUNT, &charts));
    chart = charts.chart[0];
    assert_true(chart.panel[0].nseries == 2 && !chart.panel[0].series[0].open);
    fracas_charts_clear(&charts);
    /* Without a rate against what varies; that is no strain rate, and has no powers. */
    for (size_t p = 0; p < NPOINTS; p++) point[p].rate = p ? NAN : 0;
    OK(fracas_analysis_axes(&analysis, NULL, NULL, NULL));
    OK(fracas_figure_means(&analysis, FRACAS_MEANS_COUNT, &charts));
    chart = charts.chart[0];
    assert_string_equal(chart.file, "count-against-loading-rate");
    assert_true(chart.panel[0].nseries == 2 && chart.panel[0].series[1].n == NPOINTS);
    clear_plates(point, &analysis);
}

/* N(>= m) of a point begins at its mean count, a number of whole fragments by two replicas, and
 * ends at those of the heavier kind: the dust of both replicas, then the fragments of both. */
static void figure_of_masses(void **state)
{
    fracas_point_statistics point[NPOINTS];
    fracas_analysis analysis;
    FRACAS_CLEARED(fracas_chart) chart;
    make_plates(point, &analysis);
    fracas_chart_init(&chart);
    OK(fracas_figure_masses(&analysis, 0, &chart));
    assert_true(chart.npanels == 1 && chart.panel[0].nseries == 2 * NPOINTS);
    for (size_t p = 0; p < NPOINTS; p++) {
        const fracas_series *steps = &chart.panel[0].series[2 * p], *mark = steps + 1;
        const double n = (double)(10 << p), least = (double)(9 << p), most = (double)(11 << p),
                     y[] = {n, n - 0.5, n - 1, (least - 1) / 2},
                     mass[] = {0.1 / most, 0.1 / least, 1 / most, 1 / least};
        assert_true(steps->kind == FRACAS_STEPS && steps->n == 4);
        assert_true(steps->y[0] == point[p].count.mean);
        for (size_t i = 0; i < 4; i++) { /* grams by the axis' prefix: milligrams */
            assert_true(steps->y[i] == y[i]);
            assert_true(fabs(steps->x[i] / (1e3 * mass[i]) - 1) < 1e-14);
        }
        assert_true(mark->open && mark->n == 1 && mark->x[0] == steps->x[2] &&
                    mark->y[0] == steps->y[2] && mark->look == steps->look);
    }
    assert_string_equal(chart.panel[0].x.label, "fragment mass m [mg]");
    clear_plates(point, &analysis);
}

/* kinetic 3, elastic 2, cohesive 1, dissipated 4, friction 0.5 J: 10.5 J; at the end 8 J. A part of
 * bending, created energy and work are in no total. */
static void residual_by_the_total_energy(void **state)
{
    fracas_history_row row[] = {{.time = 0, .kinetic = 1, .created = 100, .work = -100},
                                {.time = 1,
                                 .kinetic = 3,
                                 .elastic = 2,
                                 .cohesive = 1,
                                 .dissipated = 4,
                                 .dissipated_bending = 50,
                                 .friction = 0.5,
                                 .created = 100,
                                 .work = 200}};
    fracas_record record;
    fracas_record_init(&record);
    record.kinetic = 3;
    record.elastic = record.cohesive = record.friction = 0;
    record.dissipated = 5;
    record.dissipated_bending = record.created = record.work = 300;
    record.residual = 0.021;
    record.history = row;
    record.nhistory = 2;
    fracas_point_statistics point;
    fracas_analysis analysis;
    fracas_point_statistics all[NPOINTS];
    make_plates(all, &analysis);
    fracas_point_statistics_init(analysis.table, 0, &point);
    assert_true(isnan(point.residual_total));
    fracas_point_statistics_add_history(&point, &record);
    assert_true(fabs(point.residual_total / 0.002 - 1) < 1e-15); /* one division */
    record.nhistory = 0; /* no history is kept: 0.021 of 8 J */
    fracas_point_statistics_add_history(&point, &record);
    assert_true(fabs(point.residual_total / 0.002625 - 1) < 1e-15);
    record.residual = 0.001; /* the largest of all replicas stays */
    fracas_point_statistics_add_history(&point, &record);
    assert_true(fabs(point.residual_total / 0.002625 - 1) < 1e-15);
    record.kinetic = record.dissipated = 0; /* a body at rest has no total */
    record.residual = 1;
    fracas_point_statistics_add_history(&point, &record);
    assert_true(fabs(point.residual_total / 0.002625 - 1) < 1e-15);
    fracas_point_statistics_clear(&point);
    clear_plates(all, &analysis);
}

TESTS(powers_of_plates, figure_of_counts, figure_of_masses, residual_by_the_total_energy)
