/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/export/table.h"

#include "analysis/data/format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Columns after those that tell the points apart. */
enum {
    USED,
    FAILED,
    COUNT,
    LARGE,
    SIZE,
    DISSIPATED,
    BENDING,
    ZMR,
    GRADY,
    GC,
    MOTT,
    RATIO,
    RESIDUAL,
    CREATED,
    ROTATION,
    OUTCOMES,
    NCOLUMNS
};

static const char *const legend_of_chains[] = {
    "n: realizations used (FRAGMENTED, INTACT, TIME_LIMIT); fail: all others. After the mean: half "
    "width of its 95 %",
    "interval over replicas (Student's t), - where one replica has none. count: fragments, dust "
    "included. size: mean over",
    "replicas of length/count. ZMR, Grady, GC (Glenn-Chudnovsky), Mott (of strengths with a "
    "Weibull modulus): size laws with the",
    "point's material and mean strength; size/ZMR: ratio to ZMR, to the digits that the interval "
    "of the size supports.",
    "resid., created: largest over replicas of |ledger residual| and of created energy, as parts "
    "of the dissipated.",
    NULL,
};
static const char *const legend_with_surfaces[] = {
    "n: realizations used (FRAGMENTED, INTACT, TIME_LIMIT); fail: all others. After the mean: half "
    "width of its 95 %",
    "interval over replicas (Student's t), - where one replica has none. count: fragments, dust "
    "included; no dust: without it",
    "(of a surface pieces of one or two elements). size: mean over replicas of the mean size, of a "
    "surface of the square root of a fragment's area, dust",
    "included; of a bar or a ring length/count, beside size laws (ZMR, Grady, Glenn-Chudnovsky, "
    "Mott), which are of one dimension.",
    "bending, where there is any: its part of dissipated. resid., created: largest over replicas "
    "of |ledger residual| and of",
    "created energy, as parts of the dissipated. rotation: mean kinetic energy of the spins of a "
    "surface's fragments, as part of",
    "that of their centres of mass. Of an octant (geometry.part) all this is the octant's own, an "
    "eighth of the sphere.",
    NULL,
};

const char *const *fracas_result_table_legend(const fracas_analysis *analysis)
{
    return fracas_analysis_any_surface(analysis) ? legend_with_surfaces : legend_of_chains;
}

bool fracas_result_table_beside(const fracas_analysis *analysis, char *text, size_t size)
{
    char paths[640];
    fracas_columns_beside(analysis->table, &analysis->shown, paths, sizeof paths);
    snprintf(text, size,
             "The points of this table also differ in %s: their values are in points.csv.", paths);
    return *paths != '\0';
}

typedef struct {
    const fracas_analysis *analysis;
    const fracas_result_table *table;
    const fracas_columns
        *first; /* those that tell the points apart, and the strain rate that they make */
    const char *plus_minus;
    bool unicode;
    fracas_prefix size, energy;
    size_t place[NCOLUMNS];    /* of each column in the table; HIDDEN */
    char nowhere[FRACAS_CELL]; /* what is hidden is painted here */
} painter;

static const size_t HIDDEN = SIZE_MAX;

static bool any_bending(const fracas_analysis *analysis)
{
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (analysis->point[p].dissipated_bending.mean > 0) return true;
    return false;
}

static bool any_mott(const fracas_analysis *analysis)
{
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (isfinite(analysis->point[p].law[FRACAS_LAW_MOTT])) return true;
    return false;
}

/* Counts without dust and rotation are for surfaces, size laws for what is none. Returns how many
 * columns there are. */
static size_t place_columns(painter *paint)
{
    const bool any = fracas_analysis_any_surface(paint->analysis),
               all = fracas_analysis_all_surfaces(paint->analysis);
    size_t next = paint->first->count;
    for (size_t c = 0; c < NCOLUMNS; c++) {
        const bool law = c >= ZMR && c <= RATIO, of_surfaces = c == LARGE || c == ROTATION;
        const bool shown = law           ? !all && (c != MOTT || any_mott(paint->analysis))
                           : of_surfaces ? any
                                         : c != BENDING || any_bending(paint->analysis);
        paint->place[c] = shown ? next++ : HIDDEN;
    }
    return next;
}

/* The cell of one of our columns. */
static char *cell_of(painter *paint, size_t row, size_t c)
{
    return paint->place[c] == HIDDEN ? paint->nowhere
                                     : fracas_result_table_cell(paint->table, row, paint->place[c]);
}

/* "32 FRAGMENTED, 1 FAILED, 7 not there": the outcomes that occurred, and what a partial study
 * lacks. */
static void outcomes_text(const fracas_analysis *analysis, size_t p, char *text, size_t size)
{
    const fracas_point_statistics *statistics = &analysis->point[p];
    const fracas_progress progress = fracas_analysis_progress_of(analysis, p);
    const long long to_come = (long long)(progress.planned - progress.done - progress.failed);
    size_t used = 0;
    snprintf(text, size, "-");
    for (int o = 0; o < FRACAS_NOUTCOMES && used < size; o++)
        if (statistics->outcome[o] > 0)
            used += (size_t)snprintf(text + used, size - used, "%s%lld %s", used ? ", " : "",
                                     (long long)statistics->outcome[o], fracas_outcome_name(o));
    if (to_come > 0 && used < size)
        snprintf(text + used, size - used, "%s%lld not there", used ? ", " : "", to_come);
}

/* One prefix for a column, from the values of `member` at all points. */
static fracas_prefix prefix_of(const fracas_analysis *analysis, size_t offset)
{
    double extreme[2] = {INFINITY, 0};
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        double mean = ((const fracas_estimate *)((const char *)&analysis->point[p] + offset))->mean;
        if (!(mean > 0)) continue;
        extreme[0] = fmin(extreme[0], mean);
        extreme[1] = fmax(extreme[1], mean);
    }
    return fracas_prefix_for(extreme, 2);
}

static void paint_unit(const painter *paint, char *cell, const fracas_prefix *prefix,
                       const char *unit)
{
    snprintf(cell, FRACAS_CELL, "[%s%s]", paint->unicode ? prefix->sign : prefix->symbol, unit);
}

/* Lengths among the first columns have a prefix of their own, so that radii are not read in
 * exponents. */
static fracas_prefix parameter_prefix(const painter *paint, size_t column)
{
    const fracas_point_table *points = paint->analysis->table;
    if (strcmp(points->column[column].unit, "m")) return (fracas_prefix){1, "", ""};
    double extreme[2] = {INFINITY, 0};
    for (size_t p = 0; p < points->npoints; p++) {
        double value = points->point[p].value[column].real;
        if (!(value > 0)) continue;
        extreme[0] = fmin(extreme[0], value);
        extreme[1] = fmax(extreme[1], value);
    }
    return fracas_prefix_for(extreme, 2);
}

static void paint_head(painter *paint)
{
    static const char *const name[NCOLUMNS] = {
        [USED] = "n",
        [FAILED] = "fail",
        [COUNT] = "count",
        [LARGE] = "no dust",
        [SIZE] = "size",
        [DISSIPATED] = "dissipated",
        [BENDING] = "bending",
        [ZMR] = "ZMR",
        [GRADY] = "Grady",
        [GC] = "GC",
        [MOTT] = "Mott",
        [RATIO] = "size",
        [RESIDUAL] = "resid.",
        [CREATED] = "created",
        [ROTATION] = "rotation",
        [OUTCOMES] = "outcomes",
    };
    const fracas_columns *shown = paint->first;
    const fracas_point_table *points = paint->analysis->table;
    for (size_t i = 0; i < shown->count; i++) {
        const fracas_column *column = &points->column[shown->column[i]];
        snprintf(fracas_result_table_cell(paint->table, 0, i), FRACAS_CELL, "%s",
                 fracas_columns_name(points, shown, i));
        fracas_prefix prefix = parameter_prefix(paint, shown->column[i]);
        if (!column->text && strcmp(column->unit, "1"))
            paint_unit(paint, fracas_result_table_cell(paint->table, 1, i), &prefix, column->unit);
    }
    for (size_t c = 0; c < NCOLUMNS; c++)
        snprintf(cell_of(paint, 0, c), FRACAS_CELL, "%s", name[c]);
    for (size_t c = SIZE; c <= MOTT; c++)
        paint_unit(paint, cell_of(paint, 1, c), &paint->size, "m");
    paint_unit(paint, cell_of(paint, 1, DISSIPATED), &paint->energy, "J");
    paint_unit(paint, cell_of(paint, 1, BENDING), &paint->energy, "J");
    snprintf(cell_of(paint, 1, RATIO), FRACAS_CELL, "/ZMR");
    snprintf(cell_of(paint, 1, RESIDUAL), FRACAS_CELL, "/diss.");
    snprintf(cell_of(paint, 1, CREATED), FRACAS_CELL, "/diss.");
    snprintf(cell_of(paint, 1, ROTATION), FRACAS_CELL, "/transl.");
}

static void paint_point(painter *paint, size_t p)
{
    const fracas_point_statistics *statistics = &paint->analysis->point[p];
    const fracas_columns *shown = paint->first;
    size_t row = FRACAS_RESULT_TABLE_HEAD + p;
    char *first = fracas_result_table_cell(paint->table, row, 0), *cell[NCOLUMNS];
    for (size_t i = 0; i < shown->count; i++)
        fracas_columns_value(paint->analysis->table, shown->column[i], p,
                             parameter_prefix(paint, shown->column[i]).factor,
                             first + i * FRACAS_CELL, FRACAS_CELL);
    for (size_t c = 0; c < NCOLUMNS; c++) cell[c] = cell_of(paint, row, c);
    snprintf(cell[USED], FRACAS_CELL, "%lld", (long long)statistics->usable);
    snprintf(cell[FAILED], FRACAS_CELL, "%lld", (long long)statistics->unusable);
    const char *sign = paint->plus_minus;
    fracas_format_estimate(&statistics->count, 1, sign, cell[COUNT], FRACAS_CELL);
    fracas_format_estimate(&statistics->count_large, 1, sign, cell[LARGE], FRACAS_CELL);
    fracas_format_estimate(&statistics->size, paint->size.factor, sign, cell[SIZE], FRACAS_CELL);
    fracas_format_estimate(&statistics->dissipated, paint->energy.factor, sign, cell[DISSIPATED],
                           FRACAS_CELL);
    fracas_format_estimate(&statistics->dissipated_bending, paint->energy.factor, sign,
                           cell[BENDING], FRACAS_CELL);
    const fracas_size_law_id law[] = {FRACAS_LAW_ZMR, FRACAS_LAW_GRADY, FRACAS_LAW_GLENN_CHUDNOVSKY,
                                      FRACAS_LAW_MOTT};
    for (size_t i = 0; i < sizeof law / sizeof *law; i++)
        fracas_format_digits(statistics->law[law[i]] * paint->size.factor, 4, cell[ZMR + i],
                             FRACAS_CELL);
    fracas_format_mean(&statistics->size, 1 / statistics->law[FRACAS_LAW_ZMR], cell[RATIO],
                       FRACAS_CELL);
    fracas_format_digits(statistics->residual, 2, cell[RESIDUAL], FRACAS_CELL);
    fracas_format_digits(statistics->created, 2, cell[CREATED], FRACAS_CELL);
    fracas_format_digits(statistics->rotation.mean / statistics->translation.mean, 2,
                         cell[ROTATION], FRACAS_CELL);
    outcomes_text(paint->analysis, p, cell[OUTCOMES], FRACAS_CELL);
}

fracas_err fracas_result_table_create(const fracas_analysis *analysis, bool unicode,
                                      fracas_result_table *table)
{
    fracas_columns first;
    TRY(fracas_columns_with_rate(analysis->table, &analysis->shown, &first));
    painter paint = {
        .analysis = analysis,
        .table = table,
        .first = &first,
        .unicode = unicode,
        .plus_minus = unicode ? "\u00b1" : "+-",
        .size = prefix_of(analysis, offsetof(fracas_point_statistics, size)),
        .energy = prefix_of(analysis, offsetof(fracas_point_statistics, dissipated)),
    };
    table->rows = FRACAS_RESULT_TABLE_HEAD + analysis->table->npoints;
    table->columns = place_columns(&paint);
    table->laws = paint.place[ZMR] == HIDDEN ? 0 : paint.place[RATIO] - paint.place[ZMR] + 1;
    table->first_law = paint.place[ZMR];
    table->cell = calloc(table->rows * table->columns, sizeof *table->cell);
    if (table->cell) {
        paint_head(&paint);
        for (size_t p = 0; p < analysis->table->npoints; p++) paint_point(&paint, p);
    }
    fracas_columns_clear(&first);
    return table->cell ? FRACAS_OK : fracas_no_memory("the result table");
}

void fracas_result_table_clear(fracas_result_table *table)
{
    free(table->cell);
    *table = (fracas_result_table){0};
}

static int column_width(const fracas_result_table *table, size_t column)
{
    size_t width = 0;
    for (size_t r = 0; r < table->rows; r++) {
        size_t length = strlen(fracas_result_table_cell(table, r, column));
        if (length > width) width = length;
    }
    return (int)width;
}

/* Two spaces; one between the size laws, which are one group, so that an everyday table fits 120
 * columns. */
static const char *gap_before(const fracas_result_table *table, size_t column)
{
    if (column == 0) return "";
    return table->laws && column > table->first_law && column < table->first_law + table->laws
               ? " "
               : "  ";
}

static void print_cells(const fracas_result_table *table, FILE *out)
{
    for (size_t r = 0; r < table->rows; r++) {
        for (size_t c = 0; c + 1 < table->columns; c++)
            fprintf(out, "%s%*s", gap_before(table, c), column_width(table, c),
                    fracas_result_table_cell(table, r, c));
        const char *last = fracas_result_table_cell(table, r, table->columns - 1);
        fprintf(out, "%s%s\n", *last ? "  " : "", last);
    }
}

/* How the replicas were decided, where they were not given. */
static void print_decisions(const fracas_analysis *analysis, FILE *out)
{
    char text[512];
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (fracas_analysis_decided(analysis, p, text, sizeof text))
            fprintf(out, "decided: %s\n", text);
}

static void print_warnings(const fracas_analysis *analysis, FILE *out)
{
    fracas_warning *warning;
    size_t count;
    if (fracas_analysis_warnings(analysis, &warning, &count)) {
        fprintf(out, "%s\n", fracas_message());
        return;
    }
    for (size_t i = 0; i < count; i++) {
        char label[256] = "";
        if (warning[i].point != SIZE_MAX)
            fracas_analysis_label(analysis, warning[i].point, label, sizeof label);
        fprintf(out, "warning: %s%s%s\n", label, *label ? ": " : "", warning[i].text);
    }
    free(warning);
}

void fracas_analysis_print_table(const fracas_analysis *analysis, FILE *out)
{
    fracas_result_table table;
    if (fracas_result_table_create(analysis, false, &table)) {
        fprintf(out, "%s\n", fracas_message());
        return;
    }
    print_cells(&table, out);
    fracas_result_table_clear(&table);
    putc('\n', out);
    const char *const *legend = fracas_result_table_legend(analysis);
    for (size_t i = 0; legend[i]; i++) fprintf(out, "%s\n", legend[i]);
    char beside[768];
    if (fracas_result_table_beside(analysis, beside, sizeof beside)) fprintf(out, "%s\n", beside);
    print_decisions(analysis, out);
    print_warnings(analysis, out);
}
