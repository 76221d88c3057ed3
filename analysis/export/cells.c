/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/export/tables.h"

#include "analysis/data/format.h"
#include "base/sheet.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

void fracas_result_table_clear(fracas_result_table *table)
{
    free(table->cell);
    *table = (fracas_result_table){0};
}

static double double_at(const void *row, size_t offset)
{
    return *(const double *)(const void *)((const char *)row + offset);
}

static const void *row_at(const fracas_table_rows *rows, size_t i)
{
    return (const char *)rows->first + i * rows->size;
}

static bool kept(const fracas_table_rows *rows, size_t i)
{
    return !rows->keep || rows->keep(row_at(rows, i));
}

/* One prefix for a column: from its least and its greatest value above 0. */
static fracas_prefix prefix_of(const fracas_table_column *column, const fracas_table_rows *rows)
{
    const size_t place = column->kind == FRACAS_CELL_INTERVAL
                             ? column->offset + offsetof(fracas_interval, value)
                             : column->offset + offsetof(fracas_estimate, mean);
    return fracas_prefix_over((const void *)((const char *)rows->first + place), rows->size,
                              rows->count);
}

void fracas_cell_label(const fracas_analysis *analysis, size_t point, const void *row, char *text)
{
    (void)row;
    snprintf(text, FRACAS_CELL, "%.127s", fracas_analysis_label(analysis, point).text);
}

static void format_cell(const fracas_table_column *column, const fracas_table_rows *rows, size_t i,
                        double prefix, const char *sign, char *text)
{
    const void *row = row_at(rows, i), *at = (const char *)row + column->offset;
    const double divisor = column->other ? double_at(row, column->other) : 1;
    const fracas_interval *interval = at;
    fracas_estimate estimate = {.n = 2};
    switch (column->kind) {
    case FRACAS_CELL_INTEGER: snprintf(text, FRACAS_CELL, "%" PRId64, *(const int64_t *)at); break;
    case FRACAS_CELL_NUMBER:
        if (column->digits)
            fracas_format_digits(*(const double *)at * prefix / divisor, column->digits, text,
                                 FRACAS_CELL);
        else fracas_format_short(*(const double *)at, text, FRACAS_CELL);
        break;
    case FRACAS_CELL_ESTIMATE:
        fracas_format_estimate(at, prefix / divisor, sign, text, FRACAS_CELL);
        break;
    case FRACAS_CELL_MEAN: fracas_format_mean(at, prefix / divisor, text, FRACAS_CELL); break;
    case FRACAS_CELL_INTERVAL:
        fracas_format_interval(interval->value * prefix, interval->low * prefix,
                               interval->high * prefix, text, FRACAS_CELL);
        break;
    case FRACAS_CELL_PLUS_MINUS:
        estimate.mean = *(const double *)at;
        estimate.half_width = divisor;
        fracas_format_estimate(&estimate, 1, sign, text, FRACAS_CELL);
        break;
    case FRACAS_CELL_TEXT: snprintf(text, FRACAS_CELL, "%s", (const char *)at); break;
    case FRACAS_CELL_FORMAT: column->format(rows->analysis, i, row, text); break;
    }
}

void fracas_table_fill(const fracas_result_table *table, size_t at,
                       const fracas_table_column *column, size_t columns,
                       const fracas_table_rows *rows, bool unicode)
{
    for (size_t c = 0; c < columns; c++) {
        const fracas_table_column *of = &column[c], *like = of;
        fracas_prefix prefix = {1, "", ""};
        if (of->prefixed) {
            for (like = column; !like->prefixed || strcmp(like->unit, of->unit) != 0;) like++;
            prefix = prefix_of(like, rows);
        }
        snprintf(fracas_result_table_cell(table, 0, at + c), FRACAS_CELL, "%s", of->name);
        snprintf(fracas_result_table_cell(table, 1, at + c), FRACAS_CELL,
                 of->prefixed ? "[%s%s]" : "%s%s", unicode ? prefix.sign : prefix.symbol, of->unit);
        for (size_t i = 0, line = FRACAS_RESULT_TABLE_HEAD; i < rows->count; i++)
            if (kept(rows, i))
                format_cell(of, rows, i, prefix.factor, unicode ? "\u00b1" : "+-",
                            fracas_result_table_cell(table, line++, at + c));
    }
}

fracas_err fracas_table_empty(size_t count, size_t columns, const char *const *name,
                              fracas_result_table *table)
{
    *table = (fracas_result_table){
        .rows = FRACAS_RESULT_TABLE_HEAD + count, .columns = columns, .keys = 1};
    table->cell = calloc(table->rows * table->columns, sizeof *table->cell);
    if (!table->cell) return fracas_no_memory("a table");
    for (size_t c = 0; c < columns && name; c++)
        snprintf(fracas_result_table_cell(table, 0, c), FRACAS_CELL, "%s", name[c]);
    return FRACAS_OK;
}

fracas_err fracas_table_make(const fracas_table_column *column, size_t columns,
                             const fracas_table_rows *rows, bool unicode,
                             fracas_result_table *table)
{
    size_t count = 0;
    for (size_t i = 0; i < rows->count; i++) count += kept(rows, i);
    TRY(fracas_table_empty(count, columns, NULL, table));
    fracas_table_fill(table, 0, column, columns, rows, unicode);
    return FRACAS_OK;
}

/* Two spaces; one between scaling laws, to fit an everyday table into 120 columns. */
static const char *gap_before(const void *of, size_t column)
{
    const fracas_result_table *table = of;
    if (column == 0) return "";
    return table->laws && column > table->first_law && column < table->first_law + table->laws
               ? " "
               : "  ";
}

static const char *cell_of(const void *of, size_t row, size_t column)
{
    return fracas_result_table_cell(of, row, column);
}

/* Without the line of units. */
static const char *cell_without_unit(const void *of, size_t row, size_t column)
{
    return cell_of(of, row ? row + 1 : 0, column);
}

void fracas_table_print(const fracas_result_table *table, const char *indent, unsigned left,
                        bool units, int columns, FILE *out)
{
    const fracas_sheet sheet = {.rows = table->rows - (units ? 0 : 1),
                                .columns = table->columns,
                                .keys = table->keys,
                                .left = left,
                                .indent = indent,
                                .cell = units ? cell_of : cell_without_unit,
                                .gap = gap_before,
                                .of = table};
    fracas_sheet_print(&sheet, columns, out);
}
