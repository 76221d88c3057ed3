/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/compare/methods.h"

#include "analysis/data/format.h"
#include "analysis/data/room.h"
#include "base/own.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fracas_value value_of(const fracas_point_table *table, size_t point, const char *path)
{
    const size_t column = fracas_point_table_find(table, path);
    return column == SIZE_MAX ? (fracas_value){NAN, ""} : table->point[point].value[column];
}

static bool alike(const fracas_point_table *a, size_t p, const fracas_point_table *b, size_t q,
                  const char *const *path, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const fracas_value x = value_of(a, p, path[i]), y = value_of(b, q, path[i]);
        if (!fracas_value_same(&x, &y)) return false;
    }
    return true;
}

static bool varies(const fracas_point_table *table, const char *path)
{
    const size_t column = fracas_point_table_find(table, path);
    return column != SIZE_MAX && fracas_point_table_varies(table, column);
}

static size_t columns_that_vary(const fracas_point_table *a, const fracas_point_table *b,
                                const char **path)
{
    size_t count = 0;
    for (size_t c = 0; c < a->ncolumns; c++) {
        const char *name = a->column[c].path;
        const bool here = varies(a, name), there = varies(b, name),
                   both = fracas_point_table_find(b, name) != SIZE_MAX;
        if (both && (here || a->npoints == 1) && (there || b->npoints == 1) && (here || there))
            path[count++] = name;
    }
    return count;
}

static fracas_err columns_named(const fracas_point_table *a, const fracas_point_table *b, char *by,
                                const char **path, size_t *count)
{
    char *rest = by;
    for (char *name = strtok_r(rest, ", ", &rest); name; name = strtok_r(NULL, ", ", &rest)) {
        for (int which = 0; which < 2; which++)
            if (fracas_point_table_find(which ? b : a, name) == SIZE_MAX)
                return fracas_fail(FRACAS_USAGE,
                                   "--by %s: the %s study has no such column; they are in "
                                   "points.csv of its report",
                                   name, which ? "second" : "first");
        path[(*count)++] = name;
    }
    return *count > 0
               ? FRACAS_OK
               : fracas_fail(FRACAS_USAGE,
                             "--by: no column is named; give some, as loading.rate,strength.shape");
}

static void match_hashes(const fracas_point_table *a, const fracas_point_table *b, size_t *partner,
                         bool *taken)
{
    for (size_t p = 0; p < a->npoints; p++)
        for (size_t q = 0; q < b->npoints && partner[p] == SIZE_MAX; q++) {
            if (taken[q] || memcmp(&a->point[p].hash, &b->point[q].hash, sizeof a->point[p].hash))
                continue;
            partner[p] = q;
            taken[q] = true;
        }
}

static fracas_err ambiguous(const char *which, size_t first, size_t second, const char *how)
{
    return fracas_fail(FRACAS_USAGE,
                       "points %zu and %zu of the %s study are alike in %s: name by --by more "
                       "columns, in which they differ",
                       first, second, which, *how ? how : "all that varies");
}

static fracas_err match_values(const fracas_point_table *a, const fracas_point_table *b,
                               const char *const *path, size_t count, const char *how,
                               size_t *partner, const bool *taken)
{
    OWNED size_t *owner = malloc((b->npoints + 1) * sizeof *owner);
    if (!owner) return fracas_no_memory("the points");
    for (size_t q = 0; q < b->npoints; q++) owner[q] = SIZE_MAX;
    for (size_t p = 0; p < a->npoints; p++) {
        if (partner[p] != SIZE_MAX) continue;
        for (size_t q = 0; q < b->npoints; q++) {
            if (taken[q] || !alike(a, p, b, q, path, count)) continue;
            if (partner[p] != SIZE_MAX) return ambiguous("second", partner[p], q, how);
            if (owner[q] != SIZE_MAX) return ambiguous("first", owner[q], p, how);
            partner[p] = q;
            owner[q] = p;
        }
    }
    return FRACAS_OK;
}

fracas_err fracas_match_points(const fracas_point_table *a, const fracas_point_table *b,
                               const char *by, size_t *partner, char *how, size_t size)
{
    FRACAS_CLEARED(fracas_room) room = {0};
    char *names = NULL;
    const char **path;
    bool *taken;
    size_t count = 0, left = 0;
    FRACAS_TAKE(&room, path, a->ncolumns + (by ? strlen(by) : 0));
    FRACAS_TAKE(&room, taken, b->npoints);
    if (by && FRACAS_TAKE(&room, names, strlen(by))) memcpy(names, by, strlen(by));
    TRY(fracas_room_check(&room, "the points"));
    if (by) TRY(columns_named(a, b, names, path, &count));
    for (size_t p = 0; p < a->npoints; p++) partner[p] = SIZE_MAX;
    match_hashes(a, b, partner, taken);
    for (size_t p = 0; p < a->npoints; p++) left += partner[p] == SIZE_MAX;
    how[0] = '\0';
    if (left == 0) return FRACAS_OK;
    if (!by) count = columns_that_vary(a, b, path);
    for (size_t i = 0; i < count; i++) fracas_append(how, size, ", ", "%s", path[i]);
    if (count > 0) return match_values(a, b, path, count, how, partner, taken);
    if (a->npoints != 1 || b->npoints != 1) return FRACAS_OK;
    partner[0] = 0;
    snprintf(how, size, "being the only ones");
    return FRACAS_OK;
}

static void show(const fracas_value *value, char text[64])
{
    if (*value->text) snprintf(text, 64, "%.60s", value->text);
    else fracas_format_short(value->real, text, 64);
}

/* Columns of `from` with a difference, or only those missing in `to`. */
static void add_differences(const fracas_point_table *a, size_t p, const fracas_point_table *b,
                            size_t q, bool second, char *text, size_t size)
{
    const fracas_point_table *from = second ? b : a;
    for (size_t c = 0; c < from->ncolumns; c++) {
        const char *path = from->column[c].path;
        if (!strncmp(path, "derived.", 8) ||
            (second && fracas_point_table_find(a, path) != SIZE_MAX))
            continue;
        const fracas_value x = value_of(a, p, path), y = value_of(b, q, path);
        if (fracas_value_same(&x, &y)) continue;
        char here[64], there[64];
        show(&x, here);
        show(&y, there);
        fracas_append(text, size, ", ", "%s %s | %s", path, here, there);
    }
}

void fracas_match_differs(const fracas_point_table *a, size_t p, const fracas_point_table *b,
                          size_t q, char *text, size_t size)
{
    text[0] = '\0';
    add_differences(a, p, b, q, false, text, size);
    add_differences(a, p, b, q, true, text, size);
}
