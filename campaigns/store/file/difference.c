/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/file/difference.h"

#include "campaigns/store/datafile.h"
#include "campaigns/store/file/schema.h"

#include <assert.h>
#include <inttypes.h>
#include <string.h>

enum { VALUES_MOST = 64 }; /* in a row of a column */

static void write_value(const fracas_store_column *column, const char *row, size_t k, char text[32])
{
    const char *at = row + column->offset + k * sizeof(double);
    if (column->type == FRACAS_FLOAT64) snprintf(text, 32, "%.17g", *(const double *)at);
    else snprintf(text, 32, "%" PRId64, *(const int64_t *)at);
}

/* Compares row `row` of a set. */
static void compare_row(const fracas_store_set *set, const char *a, const char *b, size_t row,
                        fracas_record_difference *difference)
{
    char stored[2][VALUES_MOST * sizeof(double)];
    for (size_t c = 0; c < set->ncolumns && !difference->column; c++) {
        const fracas_store_column *column = &set->column[c];
        const size_t size = fracas_stored_size(column) / column->width;
        assert(column->width <= VALUES_MOST);
        fracas_rows_store(column, a, set->row_size, 1, stored[0]);
        fracas_rows_store(column, b, set->row_size, 1, stored[1]);
        for (size_t k = 0; k < column->width && !difference->column; k++) {
            if (!memcmp(stored[0] + k * size, stored[1] + k * size, size)) continue;
            difference->column = column->path;
            difference->row = row;
            write_value(column, a, k, difference->value[0]);
            write_value(column, b, k, difference->value[1]);
        }
    }
}

void fracas_record_compare(const fracas_record *a, const fracas_record *b, bool interfaces,
                           fracas_record_difference *difference)
{
    const fracas_stored_realization x = {.record = *a}, y = {.record = *b};
    *difference = (fracas_record_difference){0};
    compare_row(&fracas_store_sets[FRACAS_SET_REALIZATION], (const char *)&x, (const char *)&y, 0,
                difference);
    for (int p = 0; p < FRACAS_NPARTS && !difference->column; p++) {
        const fracas_ragged *part = &fracas_record_parts[p];
        const fracas_store_set *set = &fracas_store_sets[part->offsets + 1];
        if (!interfaces && 1 << p == FRACAS_READ_INTERFACES) continue;
        size_t count[2];
        const char *rows[2] = {fracas_ragged_get(part, a, &count[0]),
                               fracas_ragged_get(part, b, &count[1])};
        if (count[0] != count[1]) {
            difference->column = fracas_store_sets[part->offsets].column->path;
            for (int i = 0; i < 2; i++)
                snprintf(difference->value[i], sizeof difference->value[i], "%zu rows", count[i]);
        }
        for (size_t i = 0; i < count[0] && !difference->column; i++)
            compare_row(set, rows[0] + i * set->row_size, rows[1] + i * set->row_size, i,
                        difference);
    }
}
