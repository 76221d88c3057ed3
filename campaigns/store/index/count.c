/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The index: its realizations counted and visited, its latest run, its events. */
#include "campaigns/store/index/index.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

void fracas_index_counts_add(fracas_index_counts *counts, fracas_row_status status, int64_t outcome)
{
    counts->realizations++;
    switch (status) {
    case FRACAS_PLANNED: counts->planned++; break;
    case FRACAS_LEASED: counts->leased++; break;
    case FRACAS_DONE: counts->done++; break;
    case FRACAS_FAILED_ROW:
    case FRACAS_QUARANTINED: counts->failed++; break;
    }
    if (outcome >= 0 && outcome < FRACAS_NOUTCOMES) counts->outcome[outcome]++;
}

fracas_err fracas_index_count_segments(fracas_index *index, int64_t *segments, int64_t *bytes)
{
    return fracas_sql_numbers(index, "SELECT count(*), coalesce(sum(bytes), 0) FROM segment", NULL,
                              0, segments, bytes);
}

fracas_err fracas_index_points(fracas_index *index, int64_t *points)
{
    return fracas_sql_numbers(index, "SELECT count(*) FROM point", NULL, 0, points, NULL);
}

fracas_err fracas_index_check_points(fracas_index *index, const fracas_point_table *table)
{
    int64_t points, id, known = 0;
    TRY(fracas_index_points(index, &points));
    for (size_t p = 0; p < table->npoints; p++) {
        TRY(fracas_index_find_point(index, &table->point[p].hash, &id));
        known += id != 0;
    }
    if (points <= known) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s: %" PRId64 " of its %" PRId64
                       " points are not in the campaign; if campaign.yaml of the study was edited "
                       "put it back, else `fracas reindex` makes the index anew from the segments",
                       index->path, points - known, points);
}

/* Counts every row into *counts, and those of point id `i` into each[i - 1], for i to `most`. */
static fracas_err count_all(fracas_index *index, fracas_index_counts *counts,
                            fracas_index_counts **each, int64_t most)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    *counts = (fracas_index_counts){0};
    TRY(fracas_index_points(index, &counts->points));
    TRY(fracas_index_count_segments(index, &counts->segments, &counts->bytes));
    TRY(fracas_sql_start(index, "SELECT status, coalesce(outcome, -1), point FROM realization",
                         NULL, 0, &s));
    while (fracas_sql_next(index, s, &err)) {
        const fracas_row_status status = fracas_status_read(s, 0);
        const int64_t outcome = sqlite3_column_int64(s, 1);
        fracas_index_counts_add(counts, status, outcome);
        const int64_t id = each ? sqlite3_column_int64(s, 2) : 0;
        if (id > 0 && id <= most && each[id - 1])
            fracas_index_counts_add(each[id - 1], status, outcome);
    }
    return err;
}

fracas_err fracas_index_count(fracas_index *index, fracas_index_counts *counts)
{
    return count_all(index, counts, NULL, 0);
}

/* number[id]: of the point with this id in the table, npoints for others; *most: the largest id. */
static fracas_err number_points(fracas_index *index, const fracas_point_table *table,
                                size_t **number, int64_t *most)
{
    OWNED int64_t *id = malloc((table->npoints + 1) * sizeof *id);
    *most = 0;
    *number = NULL;
    if (!id) return fracas_no_memory("the points of the index");
    for (size_t p = 0; p < table->npoints; p++) {
        TRY(fracas_index_need_point(index, &table->point[p].hash, &id[p]));
        if (id[p] > *most) *most = id[p];
    }
    *number = malloc(((size_t)*most + 1) * sizeof **number);
    if (!*number) return fracas_no_memory("the points of the index");
    for (int64_t i = 0; i <= *most; i++) (*number)[i] = table->npoints;
    for (size_t p = 0; p < table->npoints; p++) (*number)[id[p]] = p;
    return FRACAS_OK;
}

fracas_err fracas_index_count_points(fracas_index *index, const fracas_point_table *table,
                                     fracas_index_counts *counts, fracas_index_counts *point)
{
    OWNED size_t *number = NULL;
    int64_t most;
    TRY(number_points(index, table, &number, &most));
    for (size_t p = 0; p < table->npoints; p++) point[p] = (fracas_index_counts){.points = 1};
    OWNED fracas_index_counts **each = calloc((size_t)most + 1, sizeof *each);
    if (!each) return fracas_no_memory("the counts of the points");
    for (int64_t id = 1; id <= most; id++)
        if (number[id] < table->npoints) each[id - 1] = &point[number[id]];
    return count_all(index, counts, each, most);
}

fracas_err fracas_index_each(fracas_index *index, const fracas_point_table *table,
                             fracas_index_visit *visit, void *context)
{
    OWNED size_t *number = NULL;
    OWN(sqlite3_stmt) s = NULL;
    int64_t most;
    fracas_err err;
    TRY(number_points(index, table, &number, &most));
    TRY(fracas_sql_start(index,
                         "SELECT point, replica, " FRACAS_PLACE_COLUMNS
                         " FROM realization ORDER BY point, replica",
                         NULL, 0, &s));
    while (fracas_sql_next(index, s, &err)) {
        const int64_t id = sqlite3_column_int64(s, 0);
        if (id <= 0 || id > most || number[id] == table->npoints) continue;
        const fracas_row_place place = fracas_place_read(s, 2);
        TRY(fracas_sql_whole(index));
        TRY(visit(context, number[id], sqlite3_column_int64(s, 1), &place));
    }
    return err;
}

fracas_err fracas_index_latest_run(fracas_index *index, fracas_latest_run *run)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    TRY(fracas_sql_start(
        index,
        "WITH began(at) AS (SELECT 86400.0 * (julianday(time) - 2440587.5) FROM event WHERE kind "
        "IN ('started', 'resumed') ORDER BY id DESC LIMIT 1) SELECT (SELECT at FROM began), "
        "max(json_extract(provenance, '$.began') + json_extract(provenance, '$.wall_seconds')), "
        "min(id) FROM segment "
        "WHERE json_extract(provenance, '$.began') >= (SELECT at FROM began)",
        NULL, 0, &s));
    *run = (fracas_latest_run){NAN, NAN, INT64_MAX};
    if (!fracas_sql_next(index, s, &err)) return err;
    run->began = fracas_real_read(s, 0);
    run->latest = fracas_real_read(s, 1);
    if (sqlite3_column_type(s, 2) != SQLITE_NULL) run->segment = sqlite3_column_int64(s, 2);
    return FRACAS_OK;
}

fracas_err fracas_index_events(fracas_index *index,
                               void (*say)(void *context, const char *time, const char *kind,
                                           const char *text),
                               void *context)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    TRY(fracas_sql_start(index, "SELECT time, kind, text FROM event ORDER BY id", NULL, 0, &s));
    while (fracas_sql_next(index, s, &err)) {
        const char *part[3];
        for (int c = 0; c < 3; c++) part[c] = (const char *)sqlite3_column_text(s, c);
        TRY(fracas_sql_whole(index));
        if (part[0] && part[1] && part[2]) say(context, part[0], part[1], part[2]);
    }
    return err;
}
