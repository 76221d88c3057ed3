/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates, numbers as text, the columns that tell points apart, warnings, and what a figure
 * shows. */
#include "analysis/data/columns.h"
#include "analysis/data/estimate.h"
#include "analysis/data/format.h"
#include "analysis/report/figures.h"
#include "analysis/draw/scale.h"
#include "analysis/summary/study.h"
#include "base/param.h"
#include "tests/support/test.h"

/* 2, 4, 4, 4, 5, 5, 7, 9: mean 5, squares 32, deviation sqrt(32/7); tabulated t_(0.975, 7)
 * = 2.364624 to 1e-6. */
static void estimate_of_eight(void **state)
{
    const double value[] = {2, NAN, 4, 4, 4, INFINITY, 5, 5, 7, 9};
    fracas_estimate estimate = fracas_estimate_of(value, 1, 10);
    assert_int_equal(estimate.n, 8);
    assert_true(estimate.mean == 5);
    assert_true(fabs(estimate.deviation - sqrt(32.0 / 7)) < 1e-15);
    assert_true(fabs(estimate.half_width - 2.364624 * sqrt(32.0 / 7 / 8)) < 1e-6);
}

static void estimate_of_few(void **state)
{
    const double value[] = {3, 8};
    assert_true(isnan(fracas_estimate_of(value, 1, 0).mean));
    assert_true(fracas_estimate_of(value, 1, 1).mean == 3);
    assert_true(isnan(fracas_estimate_of(value, 1, 1).half_width));
    assert_true(fracas_estimate_of(value + 1, 7, 1).mean == 8);
    const double equal[] = {0.1, 0.1, 0.1}; /* their plain sum is not three times 0.1 */
    assert_true(fracas_estimate_of(equal, 1, 3).mean == 0.1 &&
                fracas_estimate_of(equal, 1, 3).half_width == 0);
}

static void assert_estimate(double mean, double half_width, double factor, const char *expected)
{
    char text[64];
    fracas_estimate estimate = {.n = 3, .mean = mean, .half_width = half_width};
    fracas_format_estimate(&estimate, factor, "+-", text, sizeof text);
    assert_string_equal(text, expected);
}

static void estimates_as_text(void **state)
{
    assert_estimate(57.8123, 1.2345, 1, "57.8 +- 1.2");
    assert_estimate(442.31e-6, 5.55e-6, 1e6, "442.3 +- 5.5"); /* 5.55 is below the tie in binary */
    assert_estimate(1641.4, 12.3, 1, "1641 +- 12");
    assert_estimate(1641.4, 0.996, 1, "1641.4 +- 1.0");
    assert_estimate(1641.4, 123.4, 1, "1641 +- 123");
    assert_estimate(1641.4, NAN, 1, "1641 +- -");
    assert_estimate(116, 0, 1, "116.0 +- 0");
    assert_estimate(116, 2e-14, 1, "116.0 +- 0"); /* round-off of equal values */
    assert_estimate(NAN, NAN, 1, "-");
}

static void assert_mean(double mean, double half_width, double factor, const char *expected)
{
    char text[64];
    fracas_estimate estimate = {.n = 3, .mean = mean, .half_width = half_width};
    fracas_format_mean(&estimate, factor, text, sizeof text);
    assert_string_equal(text, expected);
}

static void assert_interval(double value, double low, double high, const char *expected)
{
    char text[64];
    fracas_format_interval(value, low, high, text, sizeof text);
    assert_string_equal(text, expected);
}

/* As many digits as the interval has two of. */
static void digits_as_the_interval_supports(void **state)
{
    assert_mean(1.01387, 0.0142, 1, "1.014");
    assert_mean(1.01387, 0.142, 1, "1.01");
    assert_mean(1.01387e-4, 0.0000142e-4, 1e4, "1.013870");
    assert_mean(1.01387, 3.2, 1, "1.0");
    assert_mean(1.01387, NAN, 1, "1.01");
    assert_mean(1.01387, 0, 1, "1.01");
    assert_mean(1.01387, 1e-14, 1, "1.01"); /* round-off */
    assert_mean(NAN, NAN, 1, "-");
    assert_interval(0.0851, 0.066, 0.109, "0.085 [0.066, 0.109]");
    assert_interval(0.0851, 0.0802, 0.0899, "0.0851 [0.0802, 0.0899]");
    assert_interval(-0.667, -0.7, -0.6, "-0.667 [-0.700, -0.600]");
    assert_interval(123456, 118000, 129000, "1.235e5 [1.180e5, 1.290e5]");
    assert_interval(123456, 93000, 1290000, "1.2e5 [0.9e5, 12.9e5]");
    assert_interval(123.4, 120, 127, "123.4 [120.0, 127.0]");
    assert_interval(123.4, 80, 170, "123 [80, 170]");
    assert_interval(0.20, 0.0014, 0.71, "0.20 [0.001, 0.71]"); /* above 0, and shown so */
    assert_interval(7000, 51.2, 24000, "7e3 [0.05e3, 24e3]");
    assert_interval(12, -300, 900, "1e1 [-30e1, 90e1]"); /* tens */
    assert_interval(2.34e-4, 2.1e-4, 2.5e-4, "2.34e-4 [2.10e-4, 2.50e-4]");
    assert_interval(3.14159, NAN, NAN, "3.14 [-]");
    assert_interval(3.14159, 3.14159, 3.14159, "3.14");
    assert_interval(NAN, NAN, NAN, "-");
}

static void assert_short(double value, const char *expected)
{
    char text[64];
    fracas_format_short(value, text, sizeof text);
    assert_string_equal(text, expected);
}

static void numbers_as_text(void **state)
{
    assert_short(1e3, "1e3");
    assert_short(2500, "2500");
    assert_short(100, "100");
    assert_short(0.33, "0.33");
    assert_short(275e9, "2.75e11");
    assert_short(3e-7, "3e-7");
    assert_short(-2e10, "-2e10");
    assert_short(0, "0");
    assert_short(NAN, "-");
    char text[64];
    fracas_format_digits(0.9996, 3, text, sizeof text);
    assert_string_equal(text, "1.00");
    fracas_format_digits(2e-3, 2, text, sizeof text);
    assert_string_equal(text, "2.0e-3");
    fracas_format_digits(2058.7, 4, text, sizeof text);
    assert_string_equal(text, "2059");
    assert_string_equal(fracas_beside(0.893, 1).text, "0.89");
    assert_string_equal(fracas_beside(1.002, 1).text, "1.002");
    assert_string_equal(fracas_beside(1, 1).text, "1.0");
    assert_string_equal(fracas_beside(NAN, 1).text, "-");
}

static void prefixes(void **state)
{
    assert_string_equal(fracas_prefix_for((double[]){31e-6, 865e-6}, 2).symbol, "u");
    assert_string_equal(fracas_prefix_for((double[]){NAN, 1e-3, -5}, 3).symbol, "m");
    assert_string_equal(fracas_prefix_for((double[]){999}, 1).symbol, "");
    assert_string_equal(fracas_prefix_for((double[]){1e-14}, 1).symbol, "n");
    assert_string_equal(fracas_prefix_for(NULL, 0).symbol, "");
    static const struct {
        const char *unit, *prefix;
    } of[] = {{"J", "u"},    {"m/s", "u"}, {"rad/s", "u"}, {"J/m2", "u"}, {"kg", ""},
              {"kg m2", ""}, {"m2", ""},   {"1/s", ""},    {"1", ""},     {"m/s2", ""}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++)
        assert_string_equal(fracas_prefix_in(of[i].unit, &(double){31e-6}, 1).symbol, of[i].prefix);
}

/* rate x young, with mesh.elements zipped to the rate and density to young; derived.* never tells
 * points apart. */
static void columns_that_tell_points_apart(void **state)
{
    static const fracas_column column[] = {
        {"derived.strength_mean", "Pa", "", false},
        {"loading.rate", "1/s", "", false},
        {"loading.type", "", "", true},
        {"material.density", "kg/m3", "", false},
        {"material.young", "Pa", "", false},
        {"mesh.elements", "1", "", false},
    };
    enum { N = 6, P = 4 };
    fracas_value value[P][N];
    fracas_point_row point[P];
    for (size_t p = 0; p < P; p++) {
        double real[N] = {(double)p,           p % 2 ? 1e4 : 1e3,    NAN,
                          p < 2 ? 2700 : 7800, p < 2 ? 70e9 : 210e9, p % 2 ? 20 : 10};
        for (size_t c = 0; c < N; c++) value[p][c] = (fracas_value){.real = real[c], .text = ""};
        value[p][2].text = "imposed-rate";
        point[p] = (fracas_point_row){.value = value[p]};
    }
    fracas_point_table table = {.ncolumns = N, .column = column, .npoints = P, .point = point};
    fracas_columns columns, others;
    OK(fracas_columns_create(&table, &columns));
    assert_int_equal(columns.count, 2);
    assert_int_equal(columns.column[0], 1);
    assert_int_equal(columns.column[1], 3);
    char label[128];
    fracas_columns_label(&table, &columns, 3, label, sizeof label);
    assert_string_equal(label, "rate 1e4 1/s, density 7800 kg/m3");
    char beside[64];
    fracas_columns_beside(&table, &columns, beside, sizeof beside);
    assert_string_equal(beside, "material.young");        /* not the mesh */
    fracas_columns_label(&table, &columns, 3, label, 12); /* cut, not overrun */
    assert_string_equal(label, "rate 1e4 1/");
    OK(fracas_columns_without_rate(&table, &columns, &others));
    assert_int_equal(others.count, 1);
    assert_true(fracas_columns_same(&table, &others, 0, 1));
    assert_false(fracas_columns_same(&table, &others, 1, 2));
    fracas_columns_clear(&others);
    fracas_columns_clear(&columns);
    table.npoints = 1; /* nothing differs: the rate */
    OK(fracas_columns_create(&table, &columns));
    assert_int_equal(columns.count, 1);
    assert_int_equal(columns.column[0], 1);
    fracas_columns_clear(&columns);
}

/* What only a list of records shows: unusable outcomes are counted and left out; NaN onset; the
 * typical replica. */

/* Two laws of which one has a beta: the law names the points. */
static void names_come_before_their_numbers(void **state)
{
    static const fracas_column column[] = {{"cohesive.beta", "1", "", false},
                                           {"cohesive.law", "", "", true}};
    fracas_value value[2][2] = {{{.real = 4, .text = ""}, {.real = NAN, .text = "nitsche"}},
                                {{.real = NAN, .text = ""}, {.real = NAN, .text = "rigid-link"}}};
    fracas_point_row point[] = {{.value = value[0]}, {.value = value[1]}};
    fracas_point_table table = {.ncolumns = 2, .column = column, .npoints = 2, .point = point};
    FRACAS_CLEARED(fracas_columns) columns;
    char label[64];
    OK(fracas_columns_create(&table, &columns));
    assert_int_equal(columns.count, 1);
    fracas_columns_label(&table, &columns, 1, label, sizeof label);
    assert_string_equal(label, "law rigid-link");
}

/* A point is called by what it has: what only other loads have is left out, with its unit and its
 * comma. */
static void labels_leave_out_what_a_point_lacks(void **state)
{
    static const fracas_column column[] = {{"loading.acceleration", "m/s2", "", false},
                                           {"loading.force", "N/m", "", false},
                                           {"loading.direction", "", "", true}};
    fracas_value value[3][3] = {
        {{.real = NAN, .text = ""}, {.real = 1e6, .text = ""}, {.real = NAN, .text = "radial"}},
        {{.real = 3, .text = ""}, {.real = NAN, .text = ""}, {.real = NAN, .text = ""}},
        {{.real = NAN, .text = ""}, {.real = NAN, .text = ""}, {.real = NAN, .text = ""}}};
    fracas_point_row point[] = {{.value = value[0]}, {.value = value[1]}, {.value = value[2]}};
    fracas_point_table table = {.ncolumns = 3, .column = column, .npoints = 3, .point = point};
    fracas_columns columns = {.count = 3, .column = (size_t[]){0, 1, 2}};
    static const char *const expected[] = {"force 1e6 N/m, direction radial", "acceleration 3 m/s2",
                                           "acceleration -, force -, direction -"};
    for (size_t p = 0; p < 3; p++) {
        char label[64];
        fracas_columns_label(&table, &columns, p, label, sizeof label);
        assert_string_equal(label, expected[p]);
    }
}

/* s0 = E G_c/sigma_c^2 = 275e9 150/9e16 m. No law at rate 0. */
static void laws_of_a_point(void **state)
{
    static const fracas_column column[] = {{"derived.fracture_energy", "J/m2", "", false},
                                           {"derived.strain_rate", "1/s", "", false},
                                           {"derived.strength_mean", "Pa", "", false},
                                           {"material.density", "kg/m3", "", false},
                                           {"material.young", "Pa", "", false}};
    fracas_value value[2][5];
    fracas_point_row point[2];
    for (size_t p = 0; p < 2; p++) {
        const double real[] = {150, p == 1 ? 0 : 1e4, 300e6, 2750, 275e9};
        for (size_t c = 0; c < 5; c++) value[p][c] = (fracas_value){.real = real[c], .text = ""};
        point[p] = (fracas_point_row){.value = value[p]};
    }
    fracas_point_table table = {.ncolumns = 5, .column = column, .npoints = 2, .point = point};
    fracas_point_statistics given, still;
    fracas_point_statistics_init(&table, 0, &given);
    fracas_point_statistics_init(&table, 1, &still);
    assert_true(fabs(given.scales.size / (275e9 * 150 / 9e16) - 1) < 1e-14);
    for (int law = 0; law < FRACAS_SCALING_LAWS; law++) {
        assert_true(isnan(still.law[law]));
        if (law == FRACAS_LAW_MOTT)
            continue; /* the table does not say how strengths are distributed */
        assert_true(given.law[law] > 0);
    }
}

static void statistics_of_records(void **state)
{
    static const fracas_column column[] = {{"derived.length", "m", "", false}};
    fracas_value length = {.real = 0.06, .text = ""};
    fracas_point_row point = {.value = &length};
    fracas_point_table table = {.ncolumns = 1, .column = column, .npoints = 1, .point = &point};
    FRACAS_CLEARED(fracas_point_statistics) statistics;
    fracas_point_statistics_init(&table, 0, &statistics);
    assert_true(isnan(statistics.law[FRACAS_LAW_ZMR])); /* no material in the table */
    const int64_t outcome[] = {FRACAS_FRAGMENTED, FRACAS_NONFINITE, FRACAS_INTACT,
                               FRACAS_TIME_LIMIT};
    const double dissipated[] = {5, 100, 0, 4};
    fracas_fragment fragment[4] = {{.size = 0.03, .elements = 3},
                                   {.size = 0.01, .elements = 1, .dust = 1},
                                   {.size = 0.02, .elements = 2},
                                   {.size = 0.06, .elements = 6}};
    const size_t first[] = {0, 0, 3, 0}, count[] = {3, 3, 1, 3};
    for (size_t i = 0; i < 4; i++) {
        fracas_record record;
        fracas_record_init(&record);
        record.outcome = outcome[i];
        record.dissipated = dissipated[i];
        record.residual = 0.5;
        record.created = 0.1;
        record.kinetic =
            4; /* largest energies: 5 dissipated, work 60, and kinetic, stored and dissipated 40 */
        record.elastic = i == 3 ? 36 : 0;
        record.cohesive = record.friction = 0;
        record.work = i == 2 ? -60 : 0;
        record.fragments = (int64_t)count[i];
        record.fragments_dust = outcome[i] == FRACAS_INTACT ? 0 : 1;
        record.onset_time = outcome[i] == FRACAS_INTACT ? NAN : 1e-7;
        record.fragment = fragment + first[i];
        record.nfragment = count[i];
        OK(fracas_point_statistics_add(&statistics, 10 + i, (int64_t)i, &record));
    }
    OK(fracas_point_statistics_finish(&statistics));
    assert_int_equal(statistics.realizations, 4);
    assert_int_equal(statistics.usable, 3);
    assert_int_equal(statistics.outcome[FRACAS_NONFINITE], 1);
    assert_true(fabs(statistics.count.mean - 7.0 / 3) < 1e-15);
    assert_true(fabs(statistics.count_large.mean - 5.0 / 3) < 1e-15);
    assert_true(fabs(statistics.size.mean - (0.02 + 0.06 + 0.02) / 3) < 1e-16);
    assert_true(statistics.dissipated.mean == 3);
    assert_int_equal(statistics.onset_time.n, 2);
    assert_true(statistics.residual == 0.5 / 4 && statistics.created == 0.1 / 4);
    assert_true(statistics.drift == 0.5 / 5);
    assert_int_equal(statistics.drifted, 2); /* 0.1, 0.5/60 is not, 0.5/40 is */
    assert_int_equal(statistics.nfragments, 7);
    assert_true(statistics.fragment_size[0] == 0.01 && statistics.fragment_size[6] == 0.06);
    assert_true(statistics.elements == 18.0 / 7 && statistics.dust_share == 2.0 / 7);
    assert_int_equal(statistics.typical_replica, 3); /* |4 - 3| < |5 - 3| */
    assert_int_equal(statistics.typical_row, 13);
}

/* Just within every limit: no warning; just beyond every limit, and with every unusable outcome:
 * one each. */
static void warnings_at_their_limits(void **state)
{
    static const fracas_column column[] = {{"cohesive.zone", "m", "", false}};
    fracas_value zone[] = {{.real = 24e-6, .text = ""}, {.real = 26e-6, .text = ""}};
    fracas_point_row row[] = {{.value = &zone[0]}, {.value = &zone[1]}};
    fracas_point_table table = {.ncolumns = 1, .column = column, .npoints = 2, .point = row};
    fracas_point_statistics point[] = {
        {.size.mean = 1e-4,
         .realizations = 9,
         .usable = 9,
         .outcome = {9},
         .residual = 0.99e-3,
         .created = 0.99e-2,
         .elements = 10,
         .dust_share = 0.05,
         .drift = 0.01},
        {.size.mean = 1e-4,
         .realizations = 9,
         .usable = 5,
         .outcome = {2, 1, 2, 2, 1, 1},
         .kept = 1,
         .kept_at = {1.5e-6, 2e-6},
         .residual = 1.01e-3,
         .created = 1.01e-2,
         .elements = 9.9,
         .dust_share = 0.051,
         .drift = 0.0213,
         .drifted = 2},
    };
    fracas_analysis analysis = {.table = &table, .point = point, .header.complete = true};
    fracas_warning *warning;
    size_t count;
    OK(fracas_analysis_warnings(&analysis, &warning, &count));
    const char *const expected[] = {
        "2 of 9 realizations ended NONFINITE",
        "1 of 9 realizations ended ENERGY_DRIFT",
        "1 of 9 realizations ended FAILED",
        "1 of 9 realizations ended INTACT",
        "1 of 9 realizations lost their energy balance and count as they were before, at 1.50 us "
        "to "
        "2.00 us",
        "1 of 9 realizations were stopped",
        "ledger residual up to 1.0e-3",
        "energy drift above 1 %: 2 of 5 usable realizations, their |residual| up to 2.1 %",
        "energy created at breaks up to 0.010",
        "a mean fragment has 9.9 elements",
        "5.1 % of the fragments are dust",
        "cohesive.zone is 0.26 of a mean fragment"};
    assert_int_equal(count, FRACAS_COUNT(expected));
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(warning[i].point, 1);
        assert_ptr_equal(strstr(warning[i].text, expected[i]), warning[i].text);
    }
    free(warning);
    analysis.header.complete = false;
    OK(fracas_analysis_warnings(&analysis, &warning, &count));
    assert_int_equal(count, FRACAS_COUNT(expected) + 1);
    assert_true(warning[0].point == SIZE_MAX);
    free(warning);
}

/* In place of those of residual and drift: a shorter step is no remedy. */
static void a_warning_of_an_open_ledger(void **state)
{
    static const fracas_column column[] = {{"derived.open_ledger", "1", "", false}};
    for (int open = 0; open < 2; open++) {
        fracas_value value = {.real = open ? 1 : NAN, .text = ""};
        fracas_point_row row = {.value = &value};
        fracas_point_table table = {.ncolumns = 1, .column = column, .npoints = 1, .point = &row};
        fracas_point_statistics point = {.realizations = 9,
                                         .usable = 9,
                                         .outcome = {9},
                                         .residual = 0.21,
                                         .elements = 10,
                                         .drift = 0.02,
                                         .drifted = 2};
        fracas_analysis analysis = {.table = &table, .point = &point, .header.complete = true};
        fracas_warning *warning;
        size_t count;
        OK(fracas_analysis_warnings(&analysis, &warning, &count));
        assert_int_equal(count, open ? 1 : 2);
        assert_string_equal(warning[0].kind, open ? "open" : "residual");
        assert_true(!open || strstr(warning[0].text, "up to 0.21 of the dissipated"));
        free(warning);
    }
}

/* Of one point, and of many points that lose more and more energy and have ever smaller fragments:
 * a line a kind, of its worst point, and a line for the study. */
static void a_line_a_kind_of_warning(void **state)
{
    static const fracas_column column[] = {{"cohesive.zone", "m", "", false}};
    static const size_t many[] = {1, 18, 1000};
    for (size_t i = 0; i < FRACAS_COUNT(many); i++) {
        const size_t n = many[i];
        fracas_value zone = {.real = 0, .text = ""};
        OWNED fracas_point_row *row = calloc(n, sizeof *row);
        OWNED fracas_point_statistics *point = calloc(n, sizeof *point);
        assert_true(row && point);
        for (size_t p = 0; p < n; p++) {
            row[p].value = &zone;
            point[p] = (fracas_point_statistics){.size.mean = 1,
                                                 .realizations = 9,
                                                 .usable = 9,
                                                 .outcome = {9},
                                                 .residual = p % 2 ? 0 : 0.5 / (double)(1 + p),
                                                 .elements = 9.5 / (double)(1 + p)};
        }
        fracas_point_table table = {.ncolumns = 1, .column = column, .npoints = n, .point = row};
        fracas_analysis analysis = {.table = &table, .point = point};
        OWNED fracas_warning *warning = NULL;
        OWNED fracas_warning_line *line = NULL;
        size_t warnings, lines, residuals = 0;
        OK(fracas_analysis_warnings(&analysis, &warning, &warnings));
        OK(fracas_analysis_warning_lines(&analysis, &line, &lines));
        for (size_t p = 0; p < n; p++) residuals += point[p].residual > 1e-3;
        assert_int_equal(warnings, 1 + n + residuals);
        assert_int_equal(lines, 3);
        assert_string_equal(line[0].text, warning[0].text);
        char expected[2][120] = {"ledger residual up to 0.50 of",
                                 "a mean fragment has 9.5 elements"};
        if (n > 1) {
            snprintf(expected[0], sizeof *expected,
                     "%zu of %zu points, worst 0 (): ledger residual up to 0.50 of", residuals, n);
            snprintf(expected[1], sizeof *expected,
                     "%zu of %zu points, worst %zu (): a mean fragment has %.1f elements", n, n,
                     n - 1, 9.5 / (double)n);
        }
        for (int kind = 0; kind < 2; kind++)
            assert_ptr_equal(strstr(line[1 + kind].text, expected[kind]), line[1 + kind].text);
    }
}

/* Sizes 1, 1, 2, 4 mm, of which the ones differ by rounding: all are >= 1 mm, half >= 2 mm, a
 * quarter >= 4 mm. */
static void figure_of_sizes(void **state)
{
    fracas_point_table table = {.npoints = 1};
    double size[] = {1e-3, 1e-3 * (1 + 1e-15), 2e-3, 4e-3};
    fracas_point_statistics point = {.nfragments = 4, .fragment_size = size, .usable = 1};
    fracas_analysis analysis = {.table = &table, .point = &point};
    fracas_chart chart;
    fracas_chart_init(&chart);
    OK(fracas_figure_sizes(&analysis, 0, &chart));
    assert_int_equal(chart.panel[0].nseries, 1);
    const fracas_series *series = chart.panel[0].series;
    assert_int_equal(series->n, 3);
    const double x[] = {1, 2, 4}, y[] = {1, 0.5, 0.25};
    for (size_t i = 0; i < 3; i++) {
        assert_true(fabs(series->x[i] - x[i]) < 1e-14);
        assert_true(series->y[i] == y[i]);
    }
    fracas_chart_clear(&chart);
    OK(fracas_figure_sizes_together(&analysis, 0, &chart));
    assert_true(fabs(chart.panel[0].series->x[2] - 2) < 1e-14); /* over the mean, 2 mm */
    fracas_chart_clear(&chart);
}

static void assert_labels(bool log, double least, double greatest, const char *expected)
{
    fracas_scale scale = {.from = 0, .to = 400};
    fracas_scale_fit(&scale, log, least, greatest);
    assert_true(scale.low <= least * (1 + 1e-12) && scale.high >= greatest * (1 - 1e-12));
    assert_true(fabs(fracas_scale_place(&scale, scale.high) - 400) < 1e-9);
    fracas_tick tick[FRACAS_MAX_TICKS];
    size_t count = fracas_scale_ticks(&scale, tick);
    char text[512] = "";
    assert_true(log || (fabs(tick->value - scale.low) < 1e-9 &&
                        fabs(tick[count - 1].value - scale.high) < 1e-9));
    for (size_t i = 0; i < count; i++)
        if (*tick[i].label) strcat(strcat(text, tick[i].label), " ");
    assert_string_equal(text, expected);
}

static void ticks(void **state)
{
    assert_labels(false, 0, 9.3, "0 2 4 6 8 10 ");
    assert_labels(false, -0.02, 0.31, "-0.1 0.0 0.1 0.2 0.3 0.4 ");
    assert_labels(false, 5, 5, "2 3 4 5 6 7 8 ");
    assert_labels(false, -7.2, 6.8, "-10 -5 0 5 10 "); /* not of -8 to 8 */
    assert_labels(false, 0, 5e5, "0 100000 200000 300000 400000 500000 ");
    assert_labels(false, 0, 5e7,
                  "0 10\u2077 2\u00b710\u2077 3\u00b710\u2077 4\u00b710\u2077 5\u00b710\u2077 ");
    assert_labels(
        false, -0.3e7, 2e7,
        "-0.5\u00b710\u2077 0 0.5\u00b710\u2077 10\u2077 1.5\u00b710\u2077 2\u00b710\u2077 ");
    assert_labels(true, 0.013, 60, "0.01 0.1 1 10 100 ");
    assert_labels(true, 30, 180, "20 50 100 200 ");
    assert_labels(true, 1e4, 1e5, "10\u2074 2\u00b710\u2074 5\u00b710\u2074 10\u2075 ");
    assert_labels(true, 1e-12, 1,
                  "10\u207b\u00b9\u00b2 10\u207b\u00b9\u2070 10\u207b\u2078 10\u207b\u2076 "
                  "10\u207b\u2074 10\u207b\u00b2 10\u2070 ");
    assert_labels(true, 3, 3, "2 5 ");
    assert_labels(true, 2, 2, "1 10 ");
}

TESTS(estimate_of_eight, estimate_of_few, estimates_as_text, digits_as_the_interval_supports,
      numbers_as_text, prefixes, columns_that_tell_points_apart, names_come_before_their_numbers,
      labels_leave_out_what_a_point_lacks, laws_of_a_point, statistics_of_records,
      warnings_at_their_limits, a_warning_of_an_open_ledger, a_line_a_kind_of_warning,
      figure_of_sizes, ticks)
