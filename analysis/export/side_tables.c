/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/export/side_tables.h"

#include "analysis/data/format.h"
#include "analysis/scaling/crossover.h"
#include "analysis/scaling/slope.h"
#include "analysis/scaling/windows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *const fracas_slope_table_legend[] = {
    "slope: of log(mean size) against log(strain rate), weighted least squares, each point by the "
    "standard error of its mean over replicas, from one relative variance pooled over the points "
    "that have less than eight; points where no body came apart are left out; after it the half "
    "width of its 95 % interval (Student's t with points - 2 degrees of freedom).",
    "chi2/dof: scatter of the points about the line over what their errors explain; where it is "
    "above 1 the interval is wider by its square root. Mott, Grady: exponents of the theories.",
    NULL,
};
const char *const fracas_window_table_legend[] = {
    "slope: of log(mean size) against log(strain rate) between two neighbouring rates; after it "
    "the half width of its 95 % interval, from the standard errors of the two means (Student's t, "
    "degrees of freedom by Welch and Satterthwaite).",
    "from, to: the rates, and as parts of the characteristic rate edot0 of the material.",
    NULL,
};
const char *const fracas_crossover_table_legend[] = {
    "s = s_q/(1 + (rate/crossover)^k), by least squares of log(mean size), weighted as slopes are: "
    "s_q is the size at low rates (exponent 0), -k the exponent at high rates. In brackets 95 % "
    "intervals by the parametric bootstrap: means drawn again by their standard errors, Student's. "
    "/s0, /edot0: as parts of the characteristic size and rate of the material.",
    "chi2/dof: scatter of the points about the curve over what their errors explain; where it is "
    "above 1 the intervals are wider by its square root. At least five rates with the bend among "
    "them are needed; else the last column says what is missing.",
    NULL,
};
const char *const fracas_motion_table_legend[] = {
    "Velocities of the fragments' centres of mass at the end, each fragment weighed by its mass; "
    "means over replicas with their 95 % intervals, n: replicas with two fragments or more. "
    "outward: mean velocity along the direction from the centre of the ring. scatter: its standard "
    "deviation over fragments.",
    "along: root mean square of the velocity along the ring. spin: mean |angular velocity| about "
    "the centre of mass, with the moment of inertia of an arc.",
    NULL,
};

fracas_err fracas_side_table_make(size_t rows, size_t columns, const char *const *name,
                                  fracas_result_table *table)
{
    table->rows = FRACAS_RESULT_TABLE_HEAD + rows;
    table->columns = columns;
    table->cell = calloc(table->rows * table->columns, sizeof *table->cell);
    if (!table->cell) return fracas_no_memory("a table");
    for (size_t c = 0; c < columns; c++)
        snprintf(fracas_result_table_cell(table, 0, c), FRACAS_CELL, "%s", name[c]);
    return FRACAS_OK;
}

fracas_err fracas_slope_table_create(const fracas_analysis *analysis, bool unicode,
                                     fracas_result_table *table)
{
    enum { SLOPE, MOTT, GRADY, POINTS, CHI2, SERIES, NCOLUMNS };
    static const char *const name[NCOLUMNS] = {"slope",  "Mott",     "Grady",
                                               "points", "chi2/dof", "series"};
    fracas_size_slope *list;
    size_t count;
    TRY(fracas_size_slopes(analysis, &list, &count));
    fracas_err err = fracas_side_table_make(count, NCOLUMNS, name, table);
    for (size_t i = 0; i < count && !err; i++) {
        const fracas_slope *slope = &list[i].slope;
        char *cell[NCOLUMNS];
        for (size_t c = 0; c < NCOLUMNS; c++)
            cell[c] = fracas_result_table_cell(table, FRACAS_RESULT_TABLE_HEAD + i, c);
        const fracas_estimate estimate = {
            .n = slope->n, .mean = slope->slope, .half_width = slope->half_width};
        fracas_format_estimate(&estimate, 1, unicode ? "\u00b1" : "+-", cell[SLOPE], FRACAS_CELL);
        fracas_format_short(FRACAS_SLOPE_MOTT, cell[MOTT], FRACAS_CELL);
        fracas_format_digits(FRACAS_SLOPE_GRADY, 3, cell[GRADY], FRACAS_CELL);
        snprintf(cell[POINTS], FRACAS_CELL, "%lld", (long long)slope->n);
        fracas_format_digits(slope->chi2 / (double)(slope->n - 2), 2, cell[CHI2], FRACAS_CELL);
        snprintf(cell[SERIES], FRACAS_CELL, "%s", list[i].name);
    }
    free(list);
    return err;
}

fracas_err fracas_window_table_create(const fracas_analysis *analysis, bool unicode,
                                      fracas_result_table *table)
{
    enum { SLOPE, FROM, TO, FROM_PART, TO_PART, SERIES, NCOLUMNS };
    static const char *const name[NCOLUMNS] = {"slope", "from", "to", "from", "to", "series"};
    fracas_size_window *list;
    size_t count;
    TRY(fracas_size_windows(analysis, &list, &count));
    fracas_err err = fracas_side_table_make(count, NCOLUMNS, name, table);
    for (size_t c = FROM; c <= TO_PART && !err; c++)
        snprintf(fracas_result_table_cell(table, 1, c), FRACAS_CELL, "%s",
                 c <= TO   ? "[1/s]"
                 : unicode ? "/\u03b5\u0307\u2080"
                           : "/edot0");
    for (size_t i = 0; i < count && !err; i++) {
        const fracas_window *window = &list[i].window;
        char *cell[NCOLUMNS];
        for (size_t c = 0; c < NCOLUMNS; c++)
            cell[c] = fracas_result_table_cell(table, FRACAS_RESULT_TABLE_HEAD + i, c);
        const fracas_estimate estimate = {
            .n = 2, .mean = window->slope, .half_width = window->half_width};
        fracas_format_estimate(&estimate, 1, unicode ? "\u00b1" : "+-", cell[SLOPE], FRACAS_CELL);
        for (size_t end = 0; end < 2; end++) {
            fracas_format_short(list[i].rate[end], cell[FROM + end], FRACAS_CELL);
            fracas_format_digits(list[i].normalised[end], 3, cell[FROM_PART + end], FRACAS_CELL);
        }
        snprintf(cell[SERIES], FRACAS_CELL, "%s", list[i].name);
    }
    free(list);
    return err;
}

/* "3.51e4 [3.20e4, 3.94e4]" */
static void format_interval(const fracas_interval *interval, double factor, char *text)
{
    fracas_format_interval(interval->value * factor, interval->low * factor,
                           interval->high * factor, text, FRACAS_CELL);
}

/* A series of one rate has nothing to go over from. */
static void keep_series_of_rates(fracas_size_crossover *list, size_t *count)
{
    size_t kept = 0;
    for (size_t i = 0; i < *count; i++)
        if (list[i].n > 1) list[kept++] = list[i];
    *count = kept;
}

fracas_err fracas_crossover_table_create(const fracas_analysis *analysis, bool unicode,
                                         fracas_result_table *table)
{
    enum { RATE, RATE_PART, SIZE, SIZE_PART, EXPONENT, POINTS, CHI2, SERIES, NCOLUMNS };
    static const char *const name[NCOLUMNS] = {"crossover", "crossover", "s_q",      "s_q",
                                               "exponent",  "points",    "chi2/dof", "series"};
    fracas_size_crossover *list;
    size_t count;
    TRY(fracas_size_crossovers(analysis, true, &list, &count));
    keep_series_of_rates(list, &count);
    double size[2] = {INFINITY, 0};
    for (size_t i = 0; i < count; i++)
        if (list[i].size.value > 0)
            size[0] = fmin(size[0], list[i].size.value),
            size[1] = fmax(size[1], list[i].size.value);
    const fracas_prefix prefix = fracas_prefix_for(size, 2);
    fracas_err err = fracas_side_table_make(count, NCOLUMNS, name, table);
    if (!err) {
        snprintf(fracas_result_table_cell(table, 1, RATE), FRACAS_CELL, "[1/s]");
        snprintf(fracas_result_table_cell(table, 1, RATE_PART), FRACAS_CELL,
                 unicode ? "/\u03b5\u0307\u2080" : "/edot0");
        snprintf(fracas_result_table_cell(table, 1, SIZE), FRACAS_CELL, "[%sm]",
                 unicode ? prefix.sign : prefix.symbol);
        snprintf(fracas_result_table_cell(table, 1, SIZE_PART), FRACAS_CELL,
                 unicode ? "/s\u2080" : "/s0");
    }
    for (size_t i = 0; i < count && !err; i++) {
        const fracas_size_crossover *of = &list[i];
        char *cell[NCOLUMNS];
        for (size_t c = 0; c < NCOLUMNS; c++)
            cell[c] = fracas_result_table_cell(table, FRACAS_RESULT_TABLE_HEAD + i, c);
        format_interval(&of->rate, 1, cell[RATE]);
        format_interval(&of->rate_normalised, 1, cell[RATE_PART]);
        format_interval(&of->size, prefix.factor, cell[SIZE]);
        format_interval(&of->size_normalised, 1, cell[SIZE_PART]);
        format_interval(&of->exponent, 1, cell[EXPONENT]);
        snprintf(cell[POINTS], FRACAS_CELL, "%lld", (long long)of->n);
        fracas_format_digits(of->chi2 / of->freedom, 2, cell[CHI2], FRACAS_CELL);
        snprintf(cell[SERIES], FRACAS_CELL, "%.60s%s%.60s", of->name, *of->reason ? ": " : "",
                 of->reason);
    }
    free(list);
    return err;
}

/* One prefix for the spins of all points. */
static fracas_prefix spin_prefix(const fracas_analysis *analysis)
{
    double extreme[2] = {INFINITY, 0};
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        double mean = analysis->point[p].angular_velocity.mean;
        if (!(mean > 0)) continue;
        extreme[0] = fmin(extreme[0], mean);
        extreme[1] = fmax(extreme[1], mean);
    }
    return fracas_prefix_for(extreme, 2);
}

fracas_err fracas_motion_table_create(const fracas_analysis *analysis, bool unicode,
                                      fracas_result_table *table)
{
    enum { USED, OUTWARD, SCATTER, ALONG, SPIN, POINT, NCOLUMNS };
    static const char *const name[NCOLUMNS] = {"n", "outward", "scatter", "along", "spin", "point"};
    size_t rings = 0, row = FRACAS_RESULT_TABLE_HEAD;
    for (size_t p = 0; p < analysis->table->npoints; p++) rings += analysis->point[p].radius > 0;
    TRY(fracas_side_table_make(rings, NCOLUMNS, name, table));
    fracas_prefix spin = spin_prefix(analysis);
    for (size_t c = OUTWARD; c <= ALONG; c++)
        snprintf(fracas_result_table_cell(table, 1, c), FRACAS_CELL, "[m/s]");
    snprintf(fracas_result_table_cell(table, 1, SPIN), FRACAS_CELL, "[%srad/s]",
             unicode ? spin.sign : spin.symbol);
    const char *sign = unicode ? "\u00b1" : "+-";
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_point_statistics *statistics = &analysis->point[p];
        if (!(statistics->radius > 0)) continue;
        char *cell[NCOLUMNS];
        for (size_t c = 0; c < NCOLUMNS; c++) cell[c] = fracas_result_table_cell(table, row, c);
        snprintf(cell[USED], FRACAS_CELL, "%lld", (long long)statistics->radial_velocity.n);
        fracas_format_estimate(&statistics->radial_velocity, 1, sign, cell[OUTWARD], FRACAS_CELL);
        fracas_format_estimate(&statistics->radial_scatter, 1, sign, cell[SCATTER], FRACAS_CELL);
        fracas_format_estimate(&statistics->circumferential_velocity, 1, sign, cell[ALONG],
                               FRACAS_CELL);
        fracas_format_estimate(&statistics->angular_velocity, spin.factor, sign, cell[SPIN],
                               FRACAS_CELL);
        fracas_analysis_label(analysis, p, cell[POINT], FRACAS_CELL);
        row++;
    }
    return FRACAS_OK;
}
