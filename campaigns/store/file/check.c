/* SPDX-License-Identifier: GPL-3.0-or-later */
/* /point of a file against the campaign, whose values the hashes of points are of. */
#include "base/version.h"
#include "campaigns/store/datafile.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* A file and a campaign, and for each row or column of one its partner in the other. */
typedef struct {
    const fracas_point_table *found, *wanted;
    bool same_program; /* its descriptions and derived values are comparable, too */
    size_t *row;       /* in `wanted` of each point of the file, SIZE_MAX: none */
} comparison;

static size_t row_of(const fracas_point_table *table, const fracas_hash *hash, size_t near)
{
    if (near < table->npoints && fracas_hash_equal(&table->point[near].hash, hash)) return near;
    for (size_t p = 0; p < table->npoints; p++)
        if (fracas_hash_equal(&table->point[p].hash, hash)) return p;
    return SIZE_MAX;
}

static fracas_err check_column(const fracas_column *found, const fracas_column *wanted, bool doc)
{
    if (found->text == wanted->text && !strcmp(found->unit, wanted->unit) &&
        (!doc || !strcmp(found->doc, wanted->doc)))
        return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "/point/%s: its type, unit or description is not the campaign's",
                       found->path);
}

static fracas_err check_values(const comparison *of, size_t c, size_t wanted)
{
    static const fracas_value none = {.real = NAN, .text = ""};
    for (size_t p = 0; p < of->found->npoints; p++) {
        if (of->row[p] == SIZE_MAX) continue;
        const fracas_value *has = c == SIZE_MAX ? &none : &of->found->point[p].value[c],
                           *is = wanted == SIZE_MAX ? &none
                                                    : &of->wanted->point[of->row[p]].value[wanted];
        if (fracas_value_same(has, is)) continue;
        return fracas_fail(
            FRACAS_DAMAGED,
            "/point/%s: the value of point %zu is not the campaign's, of which its "
            "hash is",
            c == SIZE_MAX ? of->wanted->column[wanted].path : of->found->column[c].path, p);
    }
    return FRACAS_OK;
}

static bool is_derived(const fracas_column *column)
{
    return !strncmp(column->path, "derived.", 8);
}

/* A file of another version may have other columns, for what was derived. */
static fracas_err check_columns(const comparison *of)
{
    for (size_t c = 0; c < of->found->ncolumns; c++) {
        const fracas_column *column = &of->found->column[c];
        const size_t wanted = fracas_point_table_find(of->wanted, column->path);
        if (!of->same_program && (wanted == SIZE_MAX || is_derived(column))) continue;
        if (wanted != SIZE_MAX)
            TRY(check_column(column, &of->wanted->column[wanted], of->same_program));
        TRY(check_values(of, c, wanted));
    }
    for (size_t w = 0; of->same_program && w < of->wanted->ncolumns; w++)
        if (fracas_point_table_find(of->found, of->wanted->column[w].path) == SIZE_MAX)
            TRY(check_values(of, SIZE_MAX, w));
    return FRACAS_OK;
}

fracas_err fracas_reader_check_points(fracas_reader *reader, const fracas_point_table *table)
{
    const fracas_point_table *found = fracas_reader_points(reader);
    OWNED size_t *row = calloc(found->npoints + 1, sizeof *row);
    if (!row) return fracas_no_memory("the points of a file");
    for (size_t p = 0; p < found->npoints; p++) row[p] = row_of(table, &found->point[p].hash, p);
    return check_columns(&(comparison){
        .found = found,
        .wanted = table,
        .same_program = !strcmp(fracas_reader_header(reader)->version, FRACAS_VERSION),
        .row = row});
}
