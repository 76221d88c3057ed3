/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/export/tables.h"

#include "analysis/data/format.h"
#include "analysis/summary/numbers.h"
#include "base/own.h"
#include "base/sheet.h"
#include "base/text.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char of_all[] =
    "n: realizations used (FRAGMENTED, INTACT, TIME_LIMIT); fail: all others. After the mean: half "
    "width of its 95 % interval over replicas (Student's t), - where one replica has none. Dust: "
    "pieces of one element, of surfaces those of one or two.";
static const char of_chains[] =
    "ZMR, Grady, GC (Glenn-Chudnovsky), Mott (of strengths with a Weibull modulus): scaling laws "
    "with the point's material and mean strength; size/ZMR: ratio to ZMR, to the digits that the "
    "interval of the size supports.";
static const char of_surfaces[] =
    "rotation: mean kinetic energy of the spins of fragments, as part of that of their centres of "
    "mass. Of a part (geometry.part) all this is the part's own: of an octant an eighth of the "
    "body.";
static const char of_ledger[] =
    "resid., created: largest over replicas of |ledger residual| and of created energy, as parts "
    "of the dissipated. resid./total, on the page: the residual by the largest total energy: "
    "kinetic, stored and lost.";

bool fracas_result_table_beside(const fracas_analysis *analysis, char *text, size_t size)
{
    char paths[640];
    fracas_columns_beside(analysis->table, &analysis->shown, paths, sizeof paths);
    snprintf(text, size,
             "The points of this table also differ in %s: their values are in points.csv.", paths);
    return *paths != '\0';
}

/* True for a number with a column in this table. */
static bool has_column(const fracas_number *number, const fracas_analysis *analysis)
{
    if (!number->column) return false;
    if (number->where == FRACAS_WITH_SURFACES) return fracas_analysis_any_surface(analysis);
    if (number->where == FRACAS_ALWAYS) return true;
    return fracas_number_above_0(number, analysis->point, analysis->table->npoints);
}

static bool any_chain(const fracas_analysis *analysis)
{
    return !fracas_analysis_all_surfaces(analysis);
}

static bool any_mott(const fracas_analysis *analysis)
{
    for (size_t p = 0; p < analysis->table->npoints && any_chain(analysis); p++)
        if (isfinite(analysis->point[p].law[FRACAS_LAW_MOTT])) return true;
    return false;
}

/* "32 FRAGMENTED, 1 FAILED, 7 not there": the outcomes, and the missing realizations of a partial
 * study. */
static void outcomes_text(const fracas_analysis *analysis, size_t p, const void *row, char *text)
{
    const fracas_point_statistics *statistics = row;
    const fracas_progress progress = fracas_analysis_progress_of(analysis, p);
    const int64_t to_come = progress.planned - progress.done - progress.failed;
    *text = '\0';
    for (int o = 0; o < FRACAS_NOUTCOMES; o++)
        if (statistics->outcome[o] > 0)
            fracas_append(text, FRACAS_CELL, ", ", "%" PRId64 " %s", statistics->outcome[o],
                          fracas_outcome_name(o));
    if (to_come > 0) fracas_append(text, FRACAS_CELL, ", ", "%" PRId64 " not there", to_come);
    if (!*text) snprintf(text, FRACAS_CELL, "-");
}

void fracas_result_table_legend(const fracas_analysis *analysis, fracas_legend *legend)
{
    const char **line = legend->line;
    *legend = (fracas_legend){.numbers = ""};
    for (size_t i = 0; i < FRACAS_NNUMBERS; i++)
        if (has_column(&fracas_realization_numbers[i], analysis))
            fracas_append(legend->numbers, sizeof legend->numbers, "; ", "%s: %s",
                          fracas_realization_numbers[i].column, fracas_realization_numbers[i].doc);
    fracas_append(legend->numbers, sizeof legend->numbers, "", ".");
    *line++ = legend->numbers;
    *line++ = of_all;
    if (any_chain(analysis)) *line++ = of_chains;
    if (fracas_analysis_any_surface(analysis)) *line++ = of_surfaces;
    *line++ = of_ledger;
}

#define PLACE(member) offsetof(fracas_point_statistics, member)

/* Columns beside the numbers, of which `leading` stand before these; `shown`: NULL, always;
 * `page`: not on a terminal, for want of room. */
static const struct {
    fracas_table_column column;
    bool (*shown)(const fracas_analysis *analysis);
    bool leading, law, page;
} columns[] = {
    {{"n", "", FRACAS_CELL_INTEGER, PLACE(usable)}, .leading = true},
    {{"fail", "", FRACAS_CELL_INTEGER, PLACE(unusable)}, .leading = true},
#define LAW(name, id)                                                                   \
    {                                                                                   \
        name, "m", FRACAS_CELL_NUMBER, PLACE(law[FRACAS_LAW_##id]), 4, .prefixed = true \
    }
    {LAW("ZMR", ZMR), any_chain, .law = true},
    {LAW("Grady", GRADY), any_chain, .law = true},
    {LAW("GC", GLENN_CHUDNOVSKY), any_chain, .law = true},
    {LAW("Mott", MOTT), any_mott, .law = true},
#undef LAW
    {{"size", "/ZMR", FRACAS_CELL_MEAN, PLACE(size), 0, PLACE(law[FRACAS_LAW_ZMR])},
     any_chain,
     .law = true},
    {{"resid.", "/diss.", FRACAS_CELL_NUMBER, PLACE(residual), 2}},
    {{"resid.", "/total", FRACAS_CELL_NUMBER, PLACE(residual_total), 2}, .page = true},
    {{"created", "/diss.", FRACAS_CELL_NUMBER, PLACE(created), 2}},
    {{"rotation", "/transl.", FRACAS_CELL_NUMBER, PLACE(rotation.mean), 2, PLACE(translation.mean)},
     fracas_analysis_any_surface},
    {{"outcomes", "", FRACAS_CELL_FORMAT, .format = outcomes_text}},
};
enum { NCOLUMNS = sizeof columns / sizeof *columns, MOST_KEYS = 3 };

/* The columns of this table, without its parameters. */
typedef struct {
    size_t count, laws, first_law;
    fracas_table_column column[NCOLUMNS + FRACAS_NNUMBERS];
} chosen_columns;

static void add_numbers(const fracas_analysis *analysis, chosen_columns *to)
{
    for (size_t i = 0; i < FRACAS_NNUMBERS; i++) {
        const fracas_number *number = &fracas_realization_numbers[i];
        const bool pure = !strcmp(number->unit, "1");
        if (has_column(number, analysis))
            to->column[to->count++] = (fracas_table_column){
                number->column, pure ? "" : number->unit, FRACAS_CELL_ESTIMATE, number->mean,
                .prefixed = !pure};
    }
}

static void choose_columns(const fracas_analysis *analysis, bool page, chosen_columns *to)
{
    for (size_t c = 0; c < NCOLUMNS; c++) {
        if (c > 0 && columns[c - 1].leading && !columns[c].leading) add_numbers(analysis, to);
        if (columns[c].shown && !columns[c].shown(analysis)) continue;
        if (columns[c].page && !page) continue;
        if (columns[c].law && to->laws++ == 0) to->first_law = to->count;
        to->column[to->count++] = columns[c].column;
    }
}

/* Lengths among the parameters have a prefix of their own, which avoids radii in exponents. */
static fracas_prefix parameter_prefix(const fracas_point_table *points, size_t column)
{
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

static void fill_parameters(const fracas_point_table *points, const fracas_columns *first,
                            bool unicode, const fracas_result_table *table)
{
    for (size_t i = 0; i < first->count; i++) {
        const fracas_column *column = &points->column[first->column[i]];
        const fracas_prefix prefix = parameter_prefix(points, first->column[i]);
        snprintf(fracas_result_table_cell(table, 0, i), FRACAS_CELL, "%s",
                 fracas_columns_name(points, first, i));
        if (!column->text && strcmp(column->unit, "1"))
            snprintf(fracas_result_table_cell(table, 1, i), FRACAS_CELL, "[%s%s]",
                     unicode ? prefix.sign : prefix.symbol, column->unit);
        for (size_t p = 0; p < points->npoints; p++)
            fracas_columns_value(points, first->column[i], p, prefix.factor,
                                 fracas_result_table_cell(table, FRACAS_RESULT_TABLE_HEAD + p, i),
                                 FRACAS_CELL);
    }
}

fracas_err fracas_result_table_create(const fracas_analysis *analysis, bool unicode,
                                      fracas_result_table *table)
{
    FRACAS_CLEARED(fracas_columns) first = {0};
    chosen_columns shown = {0};
    TRY(fracas_columns_with_rate(analysis->table, &analysis->shown, &first));
    choose_columns(analysis, unicode, &shown);
    const fracas_table_rows rows = {analysis->point, analysis->table->npoints,
                                    sizeof *analysis->point, analysis, NULL};
    TRY(fracas_table_empty(rows.count, first.count + shown.count, NULL, table));
    fill_parameters(analysis->table, &first, unicode, table);
    fracas_table_fill(table, first.count, shown.column, shown.count, &rows, unicode);
    table->keys = first.count <= MOST_KEYS ? first.count : 1;
    table->laws = shown.laws;
    table->first_law = first.count + shown.first_law;
    return FRACAS_OK;
}

static FRACAS_PRINTF(3, 4) void print_line(int width, FILE *out, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fracas_text_wrap(text, 0, width, out);
}

static void print_decisions(const fracas_analysis *analysis, int width, FILE *out)
{
    char text[512];
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (fracas_analysis_decided(analysis, p, text, sizeof text))
            print_line(width, out, "decided: %s", text);
}

static void print_warnings(const fracas_analysis *analysis, int width, FILE *out)
{
    OWNED fracas_warning_line *line = NULL;
    size_t count;
    if (fracas_analysis_warning_lines(analysis, &line, &count)) {
        fprintf(out, "%s\n", fracas_message());
        return;
    }
    for (size_t i = 0; i < count; i++) fracas_sheet_warning(line[i].text, width, out);
}

typedef struct {
    int width;
    FILE *out;
} sheet;

static void print_effect(void *context, const char *line)
{
    const sheet *on = context;
    print_line(on->width, on->out, "effect of %s", line);
}

void fracas_analysis_print_table(const fracas_analysis *analysis, int width, FILE *out)
{
    fracas_result_table table;
    if (fracas_result_table_create(analysis, false, &table)) {
        fprintf(out, "%s\n", fracas_message());
        return;
    }
    fracas_table_print(&table, "", 1U << (table.columns - 1), true, width, out);
    fracas_result_table_clear(&table);
    putc('\n', out);
    fracas_legend legend;
    fracas_result_table_legend(analysis, &legend);
    fracas_sheet_legend(legend.line, width ? width : 120, out);
    char beside[768];
    if (fracas_result_table_beside(analysis, beside, sizeof beside))
        print_line(width, out, "%s", beside);
    sheet on = {width, out};
    if (fracas_effects_say(analysis, print_effect, &on)) fprintf(out, "%s\n", fracas_message());
    print_decisions(analysis, width, out);
    print_warnings(analysis, width, out);
}
