/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The index: planning, leasing, committing and counting realizations. */
#include "campaigns/store/index/index.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static sqlite3_stmt *at(fracas_index *index, fracas_sql sql)
{
    return index->statement[sql];
}

static const char *const status_text[] = {
    [FRACAS_PLANNED] = "planned",   [FRACAS_LEASED] = "leased",           [FRACAS_DONE] = "done",
    [FRACAS_FAILED_ROW] = "failed", [FRACAS_QUARANTINED] = "quarantined",
};

/* The tables' CHECK allows nothing else; a text with a flipped bit counts as planned.
 */
fracas_row_status fracas_index_status(const unsigned char *text)
{
    for (int s = FRACAS_PLANNED; text && s <= FRACAS_QUARANTINED; s++)
        if (!strcmp((const char *)text, status_text[s])) return (fracas_row_status)s;
    return FRACAS_PLANNED;
}

double fracas_index_real(sqlite3_stmt *row, int column)
{
    return sqlite3_column_type(row, column) == SQLITE_NULL ? NAN
                                                           : sqlite3_column_double(row, column);
}

fracas_place fracas_place_read(sqlite3_stmt *row, int first)
{
    fracas_place place = {.status = fracas_index_status(sqlite3_column_text(row, first)),
                          .segment = sqlite3_column_int64(row, first + 1),
                          .row = sqlite3_column_int64(row, first + 2)};
    first += 3;
#define READ_INTEGER sqlite3_column_int64
#define READ_REAL fracas_index_real
#define READ(key, type, value, meaning) place.summary.key = READ_##type(row, first++);
    FRACAS_EACH_SUMMARY(READ)
    return place;
}

bool fracas_place_fits(const fracas_place *place, const fracas_record *record, bool sized)
{
    fracas_summary found = fracas_summary_of(record);
    if (!sized) found.size = place->summary.size;
    return fracas_summary_same(&place->summary, &found) &&
           place->status == (record->outcome == FRACAS_FAILED ? FRACAS_FAILED_ROW : FRACAS_DONE);
}

fracas_err fracas_index_find_point(fracas_index *index, const fracas_hash *point, int64_t *id)
{
    char hex[FRACAS_HASH_HEX];
    bool found = false;
    fracas_hash_hex(point, hex);
    TRY(fracas_index_bind_text(index, FRACAS_SQL_POINT_FIND, 1, hex));
    TRY(fracas_index_step(index, FRACAS_SQL_POINT_FIND, &found));
    *id = found ? sqlite3_column_int64(at(index, FRACAS_SQL_POINT_FIND), 0) : 0;
    fracas_index_reset(index, FRACAS_SQL_POINT_FIND);
    return FRACAS_OK;
}

/* The same for a point that must be there. */
static fracas_err need_point(fracas_index *index, const fracas_hash *point, int64_t *id)
{
    TRY(fracas_index_find_point(index, point, id));
    if (*id) return FRACAS_OK;
    char hex[FRACAS_HASH_HEX];
    fracas_hash_hex(point, hex);
    return fracas_fail(
        FRACAS_DAMAGED,
        "%s has no point %s; remove it and run again: it is made anew from the segments",
        index->path, hex);
}

/* Steps a statement of one row of numbers. */
static fracas_err one_row(fracas_index *index, fracas_sql sql, int64_t *first, int64_t *second)
{
    bool row = false;
    TRY(fracas_index_step(index, sql, &row));
    *first = sqlite3_column_int64(at(index, sql), 0);
    if (second) *second = sqlite3_column_int64(at(index, sql), 1);
    fracas_index_reset(index, sql);
    return FRACAS_OK;
}

/* ---- planning ---- */

fracas_err fracas_index_plan_point(fracas_index *index, const fracas_point_row *point)
{
    char hex[FRACAS_HASH_HEX];
    int64_t id, there;
    fracas_hash_hex(&point->hash, hex);
    TRY(fracas_index_bind_text(index, FRACAS_SQL_POINT_ADD, 1, hex));
    TRY(fracas_index_bind(index, FRACAS_SQL_POINT_ADD, 2, point->replicas));
    TRY(fracas_index_do(index, FRACAS_SQL_POINT_ADD));
    TRY(need_point(index, &point->hash, &id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_COUNT, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_COUNT, 2, point->replicas));
    TRY(one_row(index, FRACAS_SQL_ROW_COUNT, &there, NULL));
    if (there == point->replicas) return FRACAS_OK; /* to resume a large study is quick */
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_ADD, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_ADD, 2, point->replicas));
    return fracas_index_do(index, FRACAS_SQL_ROW_ADD);
}

fracas_err fracas_index_plan(fracas_index *index, const fracas_point_table *table)
{
    TRY(fracas_index_do(index, FRACAS_SQL_BEGIN));
    fracas_err err = fracas_index_do(index, FRACAS_SQL_ROW_UNLEASE);
    for (size_t p = 0; !err && p < table->npoints; p++)
        err = fracas_index_plan_point(index, &table->point[p]);
    return fracas_index_end(index, err);
}

fracas_err fracas_index_rows_from(fracas_index *index, const fracas_point_row *point, size_t p,
                                  int64_t first, fracas_index_row *row)
{
    int64_t id, found = first;
    bool more = true;
    TRY(need_point(index, &point->hash, &id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_OF_POINT, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_OF_POINT, 2, point->replicas));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_OF_POINT, 3, first));
    sqlite3_stmt *s = at(index, FRACAS_SQL_ROW_OF_POINT);
    for (;; found++) {
        TRY(fracas_index_step(index, FRACAS_SQL_ROW_OF_POINT, &more));
        if (!more || sqlite3_column_int64(s, 0) != found)
            break; /* else first, first + 1 ... below point->replicas */
        row[found - first] = (fracas_index_row){
            p, found, fracas_index_status(sqlite3_column_text(s, 1)), sqlite3_column_int64(s, 2)};
    }
    fracas_index_reset(index, FRACAS_SQL_ROW_OF_POINT);
    if (found == point->replicas) return FRACAS_OK;
    return fracas_fail(
        FRACAS_DAMAGED,
        "%s: replica %" PRId64
        " of point %zu was never planned; `fracas reindex` makes it anew from the segments",
        index->path, found, p);
}

fracas_err fracas_index_rows(fracas_index *index, const fracas_point_table *table,
                             fracas_index_row **row, size_t *count)
{
    *count = 0;
    for (size_t p = 0; p < table->npoints; p++) *count += (size_t)table->point[p].replicas;
    *row = calloc(*count ? *count : 1, sizeof **row);
    if (!*row) return fracas_no_memory("the plan");
    fracas_err err = FRACAS_OK;
    size_t first = 0;
    for (size_t p = 0; !err && p < table->npoints; p++) {
        err = fracas_index_rows_from(index, &table->point[p], p, 0, *row + first);
        first += (size_t)table->point[p].replicas;
    }
    if (err) free(*row), *row = NULL;
    return err;
}

fracas_err fracas_index_failures(fracas_index *index, const fracas_point_table *table,
                                 void (*say)(void *context, const fracas_index_row *row,
                                             const char *reason),
                                 void *context)
{
    sqlite3_stmt *s = at(index, FRACAS_SQL_ROW_FAILED);
    for (size_t p = 0; p < table->npoints; p++) {
        int64_t id;
        bool more;
        TRY(need_point(index, &table->point[p].hash, &id));
        TRY(fracas_index_bind(index, FRACAS_SQL_ROW_FAILED, 1, id));
        for (;;) {
            TRY(fracas_index_step(index, FRACAS_SQL_ROW_FAILED, &more));
            if (!more) break;
            fracas_index_row row = {p, sqlite3_column_int64(s, 0),
                                    fracas_index_status(sqlite3_column_text(s, 1)),
                                    sqlite3_column_int64(s, 2)};
            say(context, &row, (const char *)sqlite3_column_text(s, 3));
        }
        fracas_index_reset(index, FRACAS_SQL_ROW_FAILED);
    }
    return FRACAS_OK;
}

fracas_err fracas_index_place(fracas_index *index, const fracas_hash *point, int64_t replica,
                              fracas_place *place)
{
    int64_t id;
    bool found = false;
    TRY(need_point(index, point, &id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_FIND, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_FIND, 2, replica));
    TRY(fracas_index_step(index, FRACAS_SQL_ROW_FIND, &found));
    sqlite3_stmt *s = at(index, FRACAS_SQL_ROW_FIND);
    if (found) *place = fracas_place_read(s, 0);
    fracas_index_reset(index, FRACAS_SQL_ROW_FIND);
    if (found) return FRACAS_OK;
    char hex[FRACAS_HASH_HEX];
    fracas_hash_hex(point, hex);
    return fracas_fail(FRACAS_DAMAGED,
                       "%s has no replica %" PRId64
                       " of point %s; `fracas reindex` makes it anew from the segments",
                       index->path, replica, hex);
}

fracas_err fracas_index_each_by_segment(fracas_index *index,
                                        fracas_err (*visit)(void *context, const fracas_hash *point,
                                                            int64_t replica,
                                                            const fracas_place *place),
                                        void *context)
{
    sqlite3_stmt *s = at(index, FRACAS_SQL_ROW_BY_SEGMENT);
    bool more = true;
    fracas_err err = FRACAS_OK;
    while (!err && !(err = fracas_index_step(index, FRACAS_SQL_ROW_BY_SEGMENT, &more)) && more) {
        fracas_hash point;
        const char *hex = (const char *)sqlite3_column_text(s, 0);
        const bool valid = hex && fracas_hash_parse(hex, &point);
        const fracas_place place = fracas_place_read(s, 2);
        err = visit(context, valid ? &point : NULL, sqlite3_column_int64(s, 1), &place);
    }
    fracas_index_reset(index, FRACAS_SQL_ROW_BY_SEGMENT);
    return err;
}

/* The last update changed this realization, or it is done already and stays; FRACAS_DAMAGED if it
 * was never planned. */
static fracas_err changed_or_done(fracas_index *index, const fracas_hash *point, int64_t replica)
{
    fracas_place place;
    return sqlite3_changes(index->db) == 1 ? FRACAS_OK
                                           : fracas_index_place(index, point, replica, &place);
}

/* ---- leases, failures, events ---- */

static fracas_err synchronous(fracas_index *index, const char *text)
{
    if (sqlite3_exec(index->db, text, NULL, NULL, NULL) == SQLITE_OK) return FRACAS_OK;
    return fracas_index_error(index, "change its syncing");
}

/* A lease need not survive: after any death its rows are planned again. So it waits for no disk
 * where the journal cannot suffer from that (WAL). */
fracas_err fracas_index_lease(fracas_index *index, const fracas_hash *point, int64_t replica,
                              int64_t count)
{
    int64_t id;
    TRY(need_point(index, point, &id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_LEASE, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_LEASE, 2, replica));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_LEASE, 3, count));
    if (index->local) TRY(synchronous(index, "PRAGMA synchronous = NORMAL"));
    fracas_err err = fracas_index_do(index, FRACAS_SQL_ROW_LEASE);
    if (index->local && !err) err = synchronous(index, "PRAGMA synchronous = FULL");
    return err;
}

fracas_err fracas_index_fail(fracas_index *index, const fracas_hash *point, int64_t replica,
                             const char *reason, bool final)
{
    int64_t id;
    TRY(need_point(index, point, &id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_FAIL, 1, id));
    TRY(fracas_index_bind(index, FRACAS_SQL_ROW_FAIL, 2, replica));
    TRY(fracas_index_bind_text(index, FRACAS_SQL_ROW_FAIL, 3, reason));
    TRY(fracas_index_bind_text(index, FRACAS_SQL_ROW_FAIL, 4,
                               status_text[final ? FRACAS_FAILED_ROW : FRACAS_PLANNED]));
    if (final) TRY(fracas_index_bind(index, FRACAS_SQL_ROW_FAIL, 5, FRACAS_FAILED));
    else sqlite3_bind_null(at(index, FRACAS_SQL_ROW_FAIL), 5);
    TRY(fracas_index_do(index, FRACAS_SQL_ROW_FAIL));
    return changed_or_done(index, point, replica);
}

fracas_err fracas_index_event(fracas_index *index, const char *kind, const char *text)
{
    TRY(fracas_index_bind_text(index, FRACAS_SQL_EVENT_ADD, 1, kind));
    TRY(fracas_index_bind_text(index, FRACAS_SQL_EVENT_ADD, 2, text));
    return fracas_index_do(index, FRACAS_SQL_EVENT_ADD);
}

fracas_err fracas_index_last_event(fracas_index *index, const char *kind, char **text)
{
    bool found = false;
    *text = NULL;
    TRY(fracas_index_bind_text(index, FRACAS_SQL_EVENT_LAST, 1, kind));
    TRY(fracas_index_step(index, FRACAS_SQL_EVENT_LAST, &found));
    if (found)
        *text = strdup((const char *)sqlite3_column_text(at(index, FRACAS_SQL_EVENT_LAST), 0));
    fracas_index_reset(index, FRACAS_SQL_EVENT_LAST);
    return found && !*text ? fracas_no_memory("an event") : FRACAS_OK;
}

/* ---- segments ---- */

static void checksum_text(uint64_t checksum, char text[17])
{
    snprintf(text, 17, "%016" PRIx64, checksum);
}

/* Id of the segment; added if the index does not know it. */
static fracas_err add_segment(fracas_index *index, const char *name, const fracas_file_seal *seal,
                              size_t rows, const char *provenance, int64_t *id)
{
    char checksum[17];
    bool known = false, same = false;
    checksum_text(seal->checksum, checksum);
    TRY(fracas_index_bind_text(index, FRACAS_SQL_SEGMENT_FIND, 1, name));
    TRY(fracas_index_step(index, FRACAS_SQL_SEGMENT_FIND, &known));
    if (known) {
        sqlite3_stmt *s = at(index, FRACAS_SQL_SEGMENT_FIND);
        *id = sqlite3_column_int64(s, 0);
        same = sqlite3_column_int64(s, 1) == (int64_t)seal->bytes &&
               !strcmp((const char *)sqlite3_column_text(s, 2), checksum);
    }
    fracas_index_reset(index, FRACAS_SQL_SEGMENT_FIND);
    if (known && !same)
        return fracas_fail(FRACAS_BUG, "%s knows another segment %s", index->path, name);
    if (known) return FRACAS_OK;
    TRY(fracas_index_bind_text(index, FRACAS_SQL_SEGMENT_ADD, 1, name));
    TRY(fracas_index_bind(index, FRACAS_SQL_SEGMENT_ADD, 2, (int64_t)seal->bytes));
    TRY(fracas_index_bind_text(index, FRACAS_SQL_SEGMENT_ADD, 3, checksum));
    TRY(fracas_index_bind(index, FRACAS_SQL_SEGMENT_ADD, 4, (int64_t)rows));
    TRY(fracas_index_bind_text(index, FRACAS_SQL_SEGMENT_ADD, 5, provenance));
    TRY(fracas_index_do(index, FRACAS_SQL_SEGMENT_ADD));
    *id = sqlite3_last_insert_rowid(index->db);
    return FRACAS_OK;
}

static fracas_err set_done(fracas_index *index, int64_t point, int64_t segment,
                           const fracas_segment_row *row)
{
    bool failed = row->summary.outcome == FRACAS_FAILED;
    const fracas_sql done = FRACAS_SQL_ROW_DONE;
    int n = 6;
    TRY(fracas_index_bind(index, done, 1, point));
    TRY(fracas_index_bind(index, done, 2, row->replica));
    TRY(fracas_index_bind_text(index, done, 3,
                               status_text[failed ? FRACAS_FAILED_ROW : FRACAS_DONE]));
    TRY(fracas_index_bind(index, done, 4, segment));
    TRY(fracas_index_bind(index, done, 5, row->row));
#define BIND_INTEGER fracas_index_bind
#define BIND_REAL fracas_index_bind_real
#define BIND(key, type, value, meaning) TRY(BIND_##type(index, done, n++, row->summary.key));
    FRACAS_EACH_SUMMARY(BIND)
    TRY(fracas_index_do(index, FRACAS_SQL_ROW_DONE));
    return changed_or_done(index, &row->point, row->replica);
}

fracas_err fracas_index_commit(fracas_index *index, const char *segment,
                               const fracas_file_seal *seal, const fracas_segment_row *row,
                               size_t count, const char *provenance)
{
    TRY(fracas_index_do(index, FRACAS_SQL_BEGIN));
    int64_t id = 0, point = 0;
    fracas_err err = add_segment(index, segment, seal, count, provenance, &id);
    for (size_t r = 0; !err && r < count; r++) {
        if (r == 0 || !fracas_hash_equal(&row[r].point, &row[r - 1].point))
            err = need_point(index, &row[r].point, &point);
        if (!err) err = set_done(index, point, id, &row[r]);
    }
    return fracas_index_end(index, err);
}

static fracas_err load_segments(fracas_index *index, fracas_known_segment **segment, size_t *count)
{
    sqlite3_stmt *s = at(index, FRACAS_SQL_SEGMENT_ALL);
    size_t room = 0;
    for (;;) {
        bool more = false;
        TRY(fracas_index_step(index, FRACAS_SQL_SEGMENT_ALL, &more));
        if (!more) return FRACAS_OK;
        if (*count == room) {
            room = room ? 2 * room : 64;
            fracas_known_segment *bigger = realloc(*segment, room * sizeof **segment);
            if (!bigger) return fracas_no_memory("the list of segments");
            *segment = bigger;
        }
        const char *name = (const char *)sqlite3_column_text(s, 1),
                   *hex = (const char *)sqlite3_column_text(s, 3);
        char *end;
        fracas_file_seal seal = {(uint64_t)sqlite3_column_int64(s, 2),
                                 hex ? strtoull(hex, &end, 16) : 0};
        int64_t rows = sqlite3_column_int64(s, 4);
        if (!name || strchr(name, '/') || !hex || strlen(hex) != 16 || *end || rows < 0)
            return fracas_fail(FRACAS_DAMAGED,
                               "%s: a row of its table `segment` is damaged; remove it and run "
                               "again: it is made anew from the segments",
                               index->path);
        (*segment)[*count] = (fracas_known_segment){sqlite3_column_int64(s, 0), strdup(name), seal,
                                                    rows};
        if (!(*segment)[(*count)++].name) return fracas_no_memory("the list of segments");
    }
}

fracas_err fracas_index_segments(fracas_index *index, fracas_known_segment **segment, size_t *count)
{
    *segment = NULL;
    *count = 0;
    fracas_err err = load_segments(index, segment, count);
    fracas_index_reset(index, FRACAS_SQL_SEGMENT_ALL);
    if (err) fracas_index_segments_free(*segment, *count), *segment = NULL, *count = 0;
    return err;
}

void fracas_index_segments_free(fracas_known_segment *segment, size_t count)
{
    for (size_t s = 0; s < count; s++) free(segment[s].name);
    free(segment);
}

fracas_err fracas_index_forget(fracas_index *index, const int64_t *segment, size_t count,
                               int64_t *rows)
{
    *rows = 0;
    if (!count) return FRACAS_OK;
    TRY(fracas_index_do(index, FRACAS_SQL_BEGIN));
    fracas_err err = FRACAS_OK;
    /* Marked by an impossible size, so that one scan of the realizations serves them all. */
    for (size_t s = 0; !err && s < count; s++) {
        err = fracas_index_bind(index, FRACAS_SQL_SEGMENT_LOSE, 1, segment[s]);
        if (!err) err = fracas_index_do(index, FRACAS_SQL_SEGMENT_LOSE);
    }
    if (!err) err = fracas_index_do(index, FRACAS_SQL_ROW_FORGET);
    if (!err) *rows = sqlite3_changes64(index->db);
    if (!err) err = fracas_index_do(index, FRACAS_SQL_SEGMENT_FORGET);
    return fracas_index_end(index, err);
}

/* ---- counting ---- */

static void add_to(fracas_index_counts *counts, fracas_row_status status, int64_t outcome)
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

/* Counts every row into *counts, and those of point id `i` into each[i - 1], for i to `most`. */
static fracas_err tally(fracas_index *index, fracas_sql sql, fracas_index_counts *counts,
                        fracas_index_counts **each, int64_t most)
{
    sqlite3_stmt *s = at(index, sql);
    for (;;) {
        bool more = false;
        TRY(fracas_index_step(index, sql, &more));
        if (!more) break;
        const fracas_row_status status = fracas_index_status(sqlite3_column_text(s, 0));
        const int64_t outcome = sqlite3_column_type(s, 1) == SQLITE_NULL
                                    ? -1
                                    : sqlite3_column_int64(s, 1);
        add_to(counts, status, outcome);
        const int64_t id = each ? sqlite3_column_int64(s, 2) : 0;
        if (id > 0 && id <= most && each[id - 1]) add_to(each[id - 1], status, outcome);
    }
    fracas_index_reset(index, sql);
    return FRACAS_OK;
}

fracas_err fracas_index_points(fracas_index *index, int64_t *points)
{
    return one_row(index, FRACAS_SQL_POINT_COUNT, points, NULL);
}

static fracas_err count_all(fracas_index *index, fracas_index_counts *counts,
                            fracas_index_counts **each, int64_t most)
{
    *counts = (fracas_index_counts){0};
    TRY(one_row(index, FRACAS_SQL_POINT_COUNT, &counts->points, NULL));
    TRY(one_row(index, FRACAS_SQL_SEGMENT_TOTAL, &counts->segments, &counts->bytes));
    return tally(index, FRACAS_SQL_TALLY, counts, each, most);
}

fracas_err fracas_index_count(fracas_index *index, fracas_index_counts *counts)
{
    return count_all(index, counts, NULL, 0);
}

fracas_err fracas_index_count_points(fracas_index *index, const fracas_point_table *table,
                                     fracas_index_counts *counts, fracas_index_counts *point)
{
    int64_t *id = malloc((table->npoints + 1) * sizeof *id), most = 0;
    fracas_err err = id ? FRACAS_OK : fracas_no_memory("the counts of the points");
    for (size_t p = 0; !err && p < table->npoints; p++) {
        point[p] = (fracas_index_counts){.points = 1};
        err = need_point(index, &table->point[p].hash, &id[p]);
        if (!err && id[p] > most) most = id[p];
    }
    fracas_index_counts **each = err ? NULL : calloc((size_t)most + 1, sizeof *each);
    if (!err && !each) err = fracas_no_memory("the counts of the points");
    for (size_t p = 0; !err && p < table->npoints; p++) each[id[p] - 1] = &point[p];
    if (!err) err = count_all(index, counts, each, most);
    free(each);
    free(id);
    return err;
}
