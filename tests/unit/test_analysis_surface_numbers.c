/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the analysis says of surfaces in numbers: sizes of areas, no laws of one dimension. */
#include "tests/support/store_sample.h"
#include "tests/support/stored_mesh.h"
#include "analysis/report/figures.h"
#include "analysis/scaling/scaling.h"
#include "analysis/export/tables.h"

enum { NPOINTS = 4 };

/* `bars` bars of 10 mm, then plates, the first `bent` points with a part of bending of 2 J and 4 J
 * in 8 J; rates 1e3, 2e3, ... Each point has two realizations of fragments of 1, 2 and 3 mm and of
 * 1 (dust) and 4 mm: mean sizes of a plate 2 and 2.5 mm. Cleared by fracas_point_statistics_clear
 * and fracas_columns_clear. */
static void make_analysis(size_t bars, size_t bent, fracas_point_statistics point[NPOINTS],
                          fracas_analysis *analysis)
{
    static const fracas_column columns[] = {{"derived.fracture_energy", "J/m2", "", false},
                                            {"derived.strain_rate", "1/s", "", false},
                                            {"derived.strength_mean", "Pa", "", false},
                                            {"derived.length", "m", "", false},
                                            {"derived.surface", "1", "", false},
                                            {"loading.rate", "1/s", "", false},
                                            {"material.density", "kg/m3", "", false},
                                            {"material.young", "Pa", "", false},
                                            {"model", "", "", true}};
    enum { NCOLUMNS = sizeof columns / sizeof *columns };
    static fracas_value value[NPOINTS][NCOLUMNS];
    static fracas_point_row row[NPOINTS];
    static fracas_point_table points;
    static const double size[2][3] = {{1e-3, 2e-3, 3e-3}, {1e-3, 4e-3}};
    for (size_t p = 0; p < NPOINTS; p++) {
        const double rate = 1e3 * (double)(p + 1),
                     of[NCOLUMNS] = {
                         100,  rate,  3e8, p < bars ? 1e-2 : NAN, p < bars ? 0 : 1, rate,
                         2750, 275e9, NAN};
        for (size_t c = 0; c < NCOLUMNS; c++) value[p][c] = (fracas_value){of[c], ""};
        value[p][NCOLUMNS - 1].text = p < bars ? "bar" : "membrane";
        row[p] = (fracas_point_row){.replicas = 2, .value = value[p]};
    }
    points = (fracas_point_table){NCOLUMNS, columns, NPOINTS, row};
    *analysis = (fracas_analysis){.table = &points, .point = point, .header = {.complete = true}};
    for (size_t p = 0; p < NPOINTS; p++) {
        fracas_point_statistics_init(&points, p, &point[p]);
        for (size_t r = 0; r < 2; r++) {
            fracas_fragment fragment[3] = {0};
            fracas_record record;
            fracas_record_init(&record);
            record.outcome = FRACAS_FRAGMENTED;
            record.nfragment = 3 - r;
            record.fragments = (int64_t)record.nfragment;
            record.fragments_dust = fragment[0].dust = r == 1;
            record.fragment = fragment;
            record.dissipated = 8;
            record.dissipated_bending = p < bent ? 2 + 2 * (double)r : 0;
            for (size_t i = 0; i < record.nfragment;
                 i++) /* 2 (9 + 16 + 144)/2 = 169 J and (2 + 2 + 2)/2 = 3 J each */
                fragment[i] = (fracas_fragment){.size = size[r][i],
                                                .elements = 20,
                                                .dust = fragment[i].dust,
                                                .mass = 2,
                                                .velocity = {3, -4, 12},
                                                .angular_momentum = {1, 2, -1},
                                                .spin = {2, 1, -2}};
            OK(fracas_point_statistics_add(&point[p], 2 * p + r, (int64_t)r, &record));
        }
        OK(fracas_point_statistics_finish(&point[p]));
    }
    OK(fracas_columns_create(&points, &analysis->shown));
}

/* The names of the table's columns in a row, as "rate n fail ...". */
static void names_of(const fracas_analysis *analysis, char names[512])
{
    FRACAS_CLEARED(fracas_result_table) table;
    OK(fracas_result_table_create(analysis, false, &table));
    names[0] = '\0';
    for (size_t c = 0; c < table.columns; c++)
        strcat(strcat(names, fracas_result_table_cell(&table, 0, c)), " ");
}

static size_t curves_of(fracas_analysis *analysis, bool normalised, size_t *marks)
{
    FRACAS_CLEARED(fracas_charts) charts = {0};
    size_t curves = 0;
    *marks = 0;
    OK(fracas_analysis_axes(analysis, NULL, NULL, NULL));
    OK(fracas_figure_means(analysis, normalised ? FRACAS_MEANS_NORMALISED : FRACAS_MEANS_SIZE,
                           &charts));
    fracas_means_axes_clear(&analysis->axes);
    const fracas_chart chart = charts.count ? charts.chart[0] : (fracas_chart){.npanels = 0};
    for (size_t s = 0; chart.npanels > 0 && s < chart.panel[0].nseries; s++) {
        const bool curve = chart.panel[0].series[s].kind == FRACAS_CURVE;
        curves += curve;
        *marks += curve ? 0 : chart.panel[0].series[s].n;
    }
    return curves;
}

/* Sizes of plates are means of their fragments' sizes, of bars 10 mm over their number. Laws, and
 * the theories' slopes, are those of bars alone, and a study without a bar does not speak of them.
 * Bars and plates are two series, though the rate alone tells their points apart; plates alone have
 * a fitted line in place of laws. */
static void surfaces_have_no_laws_of_one_dimension(void **state)
{
    static const struct {
        size_t bars, curves, slopes, normalised_curves, normalised;
        const char *names;
    } expected[] = {
        {0, 1, 1, 0, 0,
         "rate n fail count no dust size dissipated resid. created rotation outcomes "},
        {3, 4, 2, 4, 3,
         "rate n fail count no dust size dissipated ZMR Grady GC size resid. created rotation "
         "outcomes "},
        {4, 4, 1, 4, 4,
         "rate n fail count size dissipated ZMR Grady GC size resid. created outcomes "}};
    for (size_t k = 0; k < 3; k++) {
        fracas_point_statistics point[NPOINTS];
        fracas_analysis analysis;
        OWNED fracas_size_slope *slope;
        size_t count, marks;
        char names[512];
        make_analysis(expected[k].bars, 0, point, &analysis);
        for (size_t p = 0; p < NPOINTS; p++) {
            const bool bar = p < expected[k].bars;
            assert_int_equal(point[p].surface, !bar);
            assert_true(fabs(point[p].size.mean - (bar ? (1e-2 / 3 + 1e-2 / 2) / 2 : 2.25e-3)) <
                        1e-15); /* a few roundings */
            assert_true(point[p].count.mean == 2.5 && point[p].count_large.mean == 2);
            for (int law = 0; law < FRACAS_SCALING_LAWS; law++)
                assert_int_equal(isfinite(point[p].law[law]) != 0,
                                 bar &&
                                     law != FRACAS_LAW_MOTT); /* their strengths have no modulus */
            assert_non_null(point[p].without_mott);
        }
        assert_int_equal(curves_of(&analysis, false, &marks), expected[k].curves);
        assert_int_equal(marks, NPOINTS);
        assert_int_equal(curves_of(&analysis, true, &marks), expected[k].normalised_curves);
        assert_int_equal(marks, expected[k].normalised);
        OK(fracas_size_slopes(&analysis, &slope, &count));
        assert_int_equal(count, expected[k].slopes);
        assert_true(slope[0].slope.n == (k == 1 ? 3 : NPOINTS) && slope[0].mixes == 1);
        assert_true(isfinite(slope[0].mott) == (k > 0) && isfinite(slope[0].grady) == (k > 0));
        assert_true(slope[count - 1].slope.n == NPOINTS && slope[count - 1].mixes == 1 + (k == 1));
        assert_true(isfinite(slope[count - 1].mott) == (k == 2));
        if (k == 1) assert_string_equal(slope[0].name, "model bar");
        names_of(&analysis, names);
        assert_string_equal(names, expected[k].names);
        for (size_t p = 0; p < NPOINTS; p++) fracas_point_statistics_clear(&point[p]);
        fracas_columns_clear(&analysis.shown);
    }
}

static void cell_says(const fracas_analysis *analysis, size_t row, const char *name,
                      const char *wanted)
{
    FRACAS_CLEARED(fracas_result_table) table;
    size_t c = 0;
    OK(fracas_result_table_create(analysis, false, &table));
    while (strcmp(fracas_result_table_cell(&table, 0, c), name)) assert_true(++c < table.columns);
    assert_string_equal(fracas_result_table_cell(&table, row, c), wanted);
}

/* Of three and of two fragments with 169 J and 3 J each: means 422.5 J and 7.5 J, a ratio of
 * 0.01775. A bar has none, nor has a body in one piece. */
static void fragments_of_surfaces_fly_and_turn(void **state)
{
    fracas_point_statistics point[NPOINTS];
    fracas_analysis analysis;
    make_analysis(1, 0, point, &analysis);
    assert_int_equal(point[0].translation.n, 0);
    assert_int_equal(point[0].rotation.n, 0);
    for (size_t p = 1; p < NPOINTS; p++) {
        assert_int_equal(point[p].translation.n, 2);
        assert_true(point[p].translation.mean == 422.5 &&
                    point[p].rotation.mean == 7.5); /* whole numbers */
    }
    cell_says(&analysis, FRACAS_RESULT_TABLE_HEAD, "rotation", "-");
    cell_says(&analysis, FRACAS_RESULT_TABLE_HEAD + 1, "rotation", "0.018");
    cell_says(&analysis, 1, "rotation", "/transl.");
    fracas_fragment whole = {.mass = 1, .velocity = {1}, .angular_momentum = {1}, .spin = {1}};
    fracas_record record;
    fracas_record_init(&record);
    record.outcome = FRACAS_INTACT;
    record.fragments = (int64_t)(record.nfragment = 1);
    record.fragment = &whole;
    FRACAS_CLEARED(fracas_point_statistics) one;
    fracas_point_statistics_init(analysis.table, 1, &one);
    OK(fracas_point_statistics_add(&one, 0, 0, &record));
    OK(fracas_point_statistics_finish(&one));
    assert_true(one.usable == 1 && one.translation.n == 0 && one.rotation.n == 0);
    for (size_t p = 0; p < NPOINTS; p++) fracas_point_statistics_clear(&point[p]);
    fracas_columns_clear(&analysis.shown);
}

/* Where bending dissipated anything there are a column and a curve of it, and nowhere else. */
static void bending_is_shown_where_it_is(void **state)
{
    for (size_t bent = 0; bent < 2; bent++) {
        fracas_point_statistics point[NPOINTS];
        fracas_analysis analysis;
        char names[512];
        make_analysis(0, bent, point, &analysis);
        assert_true(point[0].dissipated_bending.mean == (bent ? 3 : 0) &&
                    point[1].dissipated_bending.mean == 0 && point[0].dissipated_bending.n == 2);
        names_of(&analysis, names);
        assert_int_equal(strstr(names, " dissipated bending resid. ") != NULL, bent);
        if (bent) {
            cell_says(&analysis, 1, "bending", "[J]");
            /* t_(0.975, 1) = 12.706 times sqrt(2)/sqrt(2) J */
            cell_says(&analysis, FRACAS_RESULT_TABLE_HEAD, "bending", "3 +- 13");
        }
        point[0].nhistory = 2;
        point[0].history = calloc(2, sizeof *point[0].history);
        assert_non_null(point[0].history);
        point[0].history[1] = (fracas_history_row){
            .time = 1, .dissipated = 8, .dissipated_bending = bent ? 2 : 0};
        fracas_chart chart;
        size_t curves = 0;
        fracas_chart_init(&chart);
        OK(fracas_figure_energies(&analysis, 0, &chart));
        for (size_t s = 0; s < chart.panel[0].nseries; s++) {
            const fracas_series *series = &chart.panel[0].series[s];
            if (strcmp(series->name, "dissipated, bending")) continue;
            curves++;
            assert_true(series->n == 2 && series->y[0] == 0 && series->y[1] == 2);
        }
        assert_int_equal(curves, bent);
        assert_int_equal(chart.panel[1].nseries, 1); /* the residual */
        fracas_chart_clear(&chart);
        for (size_t p = 0; p < NPOINTS; p++) fracas_point_statistics_clear(&point[p]);
        fracas_columns_clear(&analysis.shown);
    }
}

TESTS(surfaces_have_no_laws_of_one_dimension, fragments_of_surfaces_fly_and_turn,
      bending_is_shown_where_it_is)
