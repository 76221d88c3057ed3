/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of a convergence: for a terminal and for its page. */
#include "analysis/converge/rows.h"

#include "analysis/data/format.h"
#include "analysis/export/side_tables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* One prefix for all values of a number. */
static fracas_prefix prefix_of(const fracas_convergence *convergence,
                               const fracas_compared_quantity *number)
{
    double ends[2] = {INFINITY, 0};
    if (!strcmp(number->unit, "1")) return (fracas_prefix){1, "", ""};
    for (size_t i = 0; i < convergence->nrows; i++) {
        const fracas_convergence_row *row = &convergence->row[i];
        if (row->number != number || !(row->value.a.mean > 0)) continue;
        ends[0] = fmin(ends[0], row->value.a.mean);
        ends[1] = fmax(ends[1], row->value.a.mean);
    }
    return fracas_prefix_for(ends, 2);
}

/* "+0.8 +- 2.0": in per cent of the number as it is. Round-off has no digits worth a reader's time.
 */
static void format_change(const fracas_compared_value *value, const char *sign, char *text,
                          size_t size)
{
    const fracas_estimate change = {
        .n = value->a.n,
        .mean = 100 * value->relative,
        .half_width = 50 * (value->relative_high - value->relative_low)};
    char plain[FRACAS_CELL - 1];
    if (fabs(change.mean) + change.half_width < 1e-3) {
        snprintf(text, size, change.mean == 0 && change.half_width == 0 ? "0" : "below 0.001");
        return;
    }
    fracas_format_estimate(&change, 1, sign, plain, sizeof plain);
    snprintf(text, size, "%s%s", change.mean > 0 ? "+" : "", plain);
}

static void fill_row(const fracas_convergence *convergence, size_t i, bool unicode,
                     const fracas_result_table *table)
{
    const fracas_convergence_row *row = &convergence->row[i];
    const fracas_compared_value *value = &row->value;
    const fracas_prefix prefix = prefix_of(convergence, row->number);
    const bool pure = !strcmp(row->number->unit, "1");
    const char *sign = unicode ? "\u00b1" : "+-";
    char *cell[FRACAS_CONVERGENCE_COLUMNS];
    for (size_t c = 0; c < FRACAS_CONVERGENCE_COLUMNS; c++)
        cell[c] = fracas_result_table_cell(table, FRACAS_RESULT_TABLE_HEAD + i, c);
    snprintf(cell[0], FRACAS_CELL, "%s", row->refinement);
    fracas_cell_label(convergence->study, row->point, NULL, cell[1]);
    if (pure) snprintf(cell[2], FRACAS_CELL, "%s", row->number->key);
    else
        snprintf(cell[2], FRACAS_CELL, "%s [%s%s]", row->number->key,
                 unicode ? prefix.sign : prefix.symbol, row->number->unit);
    fracas_format_estimate(&value->a, prefix.factor, sign, cell[3], FRACAS_CELL);
    fracas_format_estimate(&value->b, prefix.factor, sign, cell[4], FRACAS_CELL);
    format_change(value, sign, cell[5], FRACAS_CELL);
    fracas_format_digits(value->difference / value->a.half_width, 2, cell[6], FRACAS_CELL);
    snprintf(cell[7], FRACAS_CELL, "%s", fracas_number_verdict_name[row->verdict]);
}

fracas_err fracas_convergence_table_create(const fracas_convergence *convergence, bool unicode,
                                           fracas_result_table *table)
{
    static const char *const head[FRACAS_CONVERGENCE_COLUMNS] = {
        "", "point", "number", "as it is", "refined", "change [%]", "half widths", ""};
    TRY(fracas_table_empty(convergence->nrows, FRACAS_CONVERGENCE_COLUMNS, head, table));
    for (size_t i = 0; i < convergence->nrows; i++) fill_row(convergence, i, unicode, table);
    return FRACAS_OK;
}
