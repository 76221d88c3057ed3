/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/file/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Bytes that one column of `count` rows takes in the file, at least one for malloc. */
static void *column_memory(const fracas_store_column *column, size_t count)
{
    return calloc(count ? count : 1, fracas_stored_size(column));
}

/* ---- writing ---- */

static fracas_err write_column(const fracas_h5 *h5, const fracas_store_column *column, size_t count,
                               const void *stored)
{
    OWN_ID dataset = H5I_INVALID_HID;
    TRY(fracas_h5_create_column(h5, column, FRACAS_POINT_CHUNK, &dataset));
    return count ? fracas_h5_append_rows(h5, column, dataset, 0, count, stored) : FRACAS_OK;
}

static fracas_err write_points(const fracas_h5 *h5, const fracas_point_table *table)
{
    const size_t width = fracas_store_point_hash.width;
    OWNED char *hashes = column_memory(&fracas_store_point_hash, table->npoints);
    OWNED int64_t *replicas = column_memory(&fracas_store_point_replicas, table->npoints);
    if (!hashes || !replicas) return fracas_no_memory("the point table");
    for (size_t p = 0; p < table->npoints; p++) {
        memcpy(hashes + p * width, fracas_hash_hex(&table->point[p].hash).text, width);
        replicas[p] = table->point[p].replicas;
    }
    TRY(write_column(h5, &fracas_store_point_hash, table->npoints, hashes));
    return write_column(h5, &fracas_store_point_replicas, table->npoints, replicas);
}

size_t fracas_table_text_width(const fracas_point_table *table, size_t c)
{
    size_t longest = 1; /* HDF5 has no empty type */
    for (size_t p = 0; p < table->npoints; p++) {
        size_t length = strlen(table->point[p].value[c].text);
        if (length > longest) longest = length;
    }
    return longest;
}

static fracas_err write_values(const fracas_h5 *h5, const fracas_point_table *table, size_t c)
{
    const fracas_column *from = &table->column[c];
    char path[256];
    if ((size_t)snprintf(path, sizeof path, "/point/%s", from->path) >= sizeof path ||
        strchr(from->path, '/') || !strcmp(path, fracas_store_point_hash.path) ||
        !strcmp(path, fracas_store_point_replicas.path))
        return fracas_fail(FRACAS_BUG, "a column of the point table cannot be named '%s'",
                           from->path);
    fracas_store_column column = {path,       FRACAS_FLOAT64, 1,
                                  from->unit, from->doc,      offsetof(fracas_value, real)};
    if (from->text) column.type = FRACAS_TEXT, column.width = fracas_table_text_width(table, c);
    OWNED char *stored = column_memory(&column, table->npoints);
    if (!stored) return fracas_no_memory("the point table");
    for (size_t p = 0; p < table->npoints; p++) {
        const fracas_value *value = &table->point[p].value[c];
        char *at = stored + p * fracas_stored_size(&column);
        if (from->text) memcpy(at, value->text, strlen(value->text));
        else (void)fracas_rows_store(&column, value, sizeof *value, 1, at);
    }
    return write_column(h5, &column, table->npoints, stored);
}

fracas_err fracas_table_write(const fracas_h5 *h5, const fracas_point_table *table)
{
    TRY(fracas_h5_create_group(h5, "/point"));
    TRY(fracas_h5_put_integer(h5, "/point", "columns", H5T_STD_I64LE, table->ncolumns));
    TRY(write_points(h5, table));
    for (size_t c = 0; c < table->ncolumns; c++) TRY(write_values(h5, table, c));
    return FRACAS_OK;
}

/* ---- reading ---- */

/* A whole column; `rows`: its number of rows, SIZE_MAX for any. *stored freed by the caller, after
 * an error too. */
static fracas_err read_column(const fracas_h5 *h5, const fracas_store_column *column, size_t *rows,
                              void **stored)
{
    OWN_ID dataset = H5I_INVALID_HID;
    uint64_t found;
    TRY(fracas_h5_open_column(h5, column, FRACAS_POINT_CHUNK, &dataset, &found));
    if (*rows == SIZE_MAX) *rows = found;
    if (*rows != found)
        return fracas_fail(FRACAS_DAMAGED, "%s: %s: damaged: %llu rows for %zu points", h5->path,
                           column->path, (unsigned long long)found, *rows);
    *stored = column_memory(column, *rows);
    if (!*stored) return fracas_no_memory("the point table");
    return *rows ? fracas_h5_read_rows(h5, column, dataset, 0, *rows, *stored) : FRACAS_OK;
}

fracas_err fracas_table_read_points(const fracas_h5 *h5, fracas_stored_table *stored)
{
    size_t count = SIZE_MAX, width = fracas_store_point_hash.width;
    OWNED void *hashes = NULL;
    OWNED void *replicas = NULL;
    TRY(read_column(h5, &fracas_store_point_hash, &count, &hashes));
    TRY(read_column(h5, &fracas_store_point_replicas, &count, &replicas));
    stored->point = calloc(count ? count : 1, sizeof *stored->point);
    if (!stored->point) return fracas_no_memory("the point table");
    for (size_t p = 0; p < count; p++) {
        char hex[FRACAS_HASH_HEX] = "";
        memcpy(hex, (char *)hashes + p * width, width);
        stored->point[p].replicas = ((int64_t *)replicas)[p];
        if (!fracas_hash_parse(hex, &stored->point[p].hash) || stored->point[p].replicas < 0)
            return fracas_fail(FRACAS_DAMAGED,
                               "%s: /point: damaged: row %zu has no valid hash and replicas",
                               h5->path, p);
    }
    stored->table.npoints = count;
    stored->table.point = stored->point;
    return FRACAS_OK;
}

/* Spreads a column as read over the rows' values. */
static fracas_err spread_values(fracas_stored_table *stored, size_t c,
                                const fracas_store_column *column, const char *from)
{
    size_t npoints = stored->table.npoints, ncolumns = stored->table.ncolumns,
           step = column->width + 1;
    bool text = column->type == FRACAS_TEXT;
    if (text && !(stored->text[c] = calloc(npoints ? npoints : 1, step)))
        return fracas_no_memory("the point table");
    for (size_t p = 0; p < npoints; p++) {
        fracas_value *value = &stored->value[p * ncolumns + c];
        *value = (fracas_value){NAN, ""};
        if (text)
            value->text = memcpy(stored->text[c] + p * step, from + p * column->width,
                                 column->width);
        else
            fracas_rows_load(column, from + p * fracas_stored_size(column), 1, value,
                             sizeof *value);
    }
    return FRACAS_OK;
}

static fracas_err read_values(const fracas_h5 *h5, const char *name, fracas_stored_table *stored,
                              size_t c)
{
    char path[256], *unit = NULL, *doc = NULL;
    snprintf(path, sizeof path, "/point/%s", name);
    fracas_store_column column = {path, FRACAS_FLOAT64, 1, "", "", offsetof(fracas_value, real)};
    OWNED void *values = NULL;
    size_t width, rows = stored->table.npoints;
    TRY(fracas_h5_text_width(h5, path, &width));
    if (width) column.type = FRACAS_TEXT, column.width = width;
    fracas_err err = read_column(h5, &column, &rows, &values);
    if (!err) err = fracas_h5_get_text(h5, path, "unit", &unit);
    if (!err) err = fracas_h5_get_text(h5, path, "description", &doc);
    if (!err) err = spread_values(stored, c, &column, values);
    stored->column[c] = (fracas_column){strdup(name), unit, doc, width > 0};
    if (!err && !stored->column[c].path) err = fracas_no_memory("the point table");
    return err;
}

static bool is_column(const char *link)
{
    return strcmp(link, strrchr(fracas_store_point_hash.path, '/') + 1) != 0 &&
           strcmp(link, strrchr(fracas_store_point_replicas.path, '/') + 1) != 0;
}

static fracas_err read_columns(const fracas_h5 *h5, fracas_stored_table *stored, char **link,
                               size_t nlinks)
{
    size_t c = 0;
    for (size_t n = 0; n < nlinks; n++) {
        if (!is_column(link[n])) continue;
        if (c == stored->table.ncolumns) return fracas_h5_fail(h5, "/point");
        TRY(read_values(h5, link[n], stored, c));
        c++;
    }
    return FRACAS_OK;
}

fracas_err fracas_table_read(const fracas_h5 *h5, fracas_stored_table *stored)
{
    TRY(fracas_table_read_points(h5, stored));
    uint64_t columns;
    TRY(fracas_h5_get_integer(h5, "/point", "columns", H5T_STD_I64LE, &columns));
    const size_t ncolumns = columns, npoints = stored->table.npoints;
    /* each link takes a byte at least, and each value */
    if (columns > h5->bytes || (ncolumns && npoints > h5->bytes / ncolumns))
        return fracas_fail(FRACAS_DAMAGED, "%s: /point: damaged: it has more values than bytes",
                           h5->path);
    stored->column = calloc(ncolumns + 1, sizeof *stored->column);
    stored->text = calloc(ncolumns + 1, sizeof *stored->text);
    stored->value = calloc(npoints * ncolumns + 1, sizeof *stored->value);
    OWNED char **link = calloc(ncolumns + 2, sizeof *link);
    if (!stored->column || !stored->text || !stored->value || !link)
        return fracas_no_memory("the point table");
    stored->table.column = stored->column;
    stored->table.ncolumns = ncolumns;
    size_t nlinks = 0;
    fracas_err err = fracas_h5_link_names(h5, "/point", ncolumns + 2, link, &nlinks);
    /* After a bad checksum in a part of a group's header HDF5 1.10 may go on without its links. */
    if (!err && nlinks != ncolumns + 2)
        err = fracas_fail(FRACAS_DAMAGED,
                          "%s: /point: damaged: it has not the columns that it says", h5->path);
    if (!err) err = read_columns(h5, stored, link, nlinks);
    for (size_t n = 0; n < nlinks; n++) free(link[n]);
    for (size_t p = 0; !err && p < npoints; p++)
        stored->point[p].value = stored->value + p * ncolumns;
    return err;
}

void fracas_table_clear(fracas_stored_table *stored)
{
    for (size_t c = 0; stored->column && c < stored->table.ncolumns; c++) {
        free((void *)(uintptr_t)stored->column[c].path);
        free((void *)(uintptr_t)stored->column[c].unit);
        free((void *)(uintptr_t)stored->column[c].doc);
        free(stored->text[c]);
    }
    free(stored->column);
    free(stored->point);
    free(stored->value);
    free(stored->text);
    *stored = (fracas_stored_table){0};
}
