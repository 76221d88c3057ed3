/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The index: planning, leasing, committing, counting and deciding on realizations. */
#include "campaigns/store/index/index.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char remedy[] = "remove it and run again: it is made anew from the segments";

static const char *const status_text[] = {
    [FRACAS_PLANNED] = "planned",   [FRACAS_LEASED] = "leased",           [FRACAS_DONE] = "done",
    [FRACAS_FAILED_ROW] = "failed", [FRACAS_QUARANTINED] = "quarantined",
};

fracas_row_status fracas_status_read(sqlite3_stmt *row, int column)
{
    const unsigned char *text = sqlite3_column_text(row, column);
    for (int s = FRACAS_PLANNED; text && s <= FRACAS_QUARANTINED; s++)
        if (!strcmp((const char *)text, status_text[s])) return (fracas_row_status)s;
    return FRACAS_PLANNED;
}

double fracas_real_read(sqlite3_stmt *row, int column)
{
    return sqlite3_column_type(row, column) == SQLITE_NULL ? NAN
                                                           : sqlite3_column_double(row, column);
}

fracas_row_place fracas_place_read(sqlite3_stmt *row, int first)
{
    fracas_row_place place = {.status = fracas_status_read(row, first),
                              .segment = sqlite3_column_int64(row, first + 1),
                              .row = sqlite3_column_int64(row, first + 2)};
    first += 3;
#define READ_INTEGER sqlite3_column_int64
#define READ_REAL fracas_real_read
#define READ(key, type, value, meaning) place.summary.key = READ_##type(row, first++);
    FRACAS_EACH_SUMMARY(READ)
    return place;
}

bool fracas_place_fits(const fracas_row_place *place, const fracas_record *record, bool sized)
{
    fracas_summary found = fracas_summary_of(record);
    if (!sized) found.size = place->summary.size;
    return fracas_summary_same(&place->summary, &found) &&
           place->status == (record->outcome == FRACAS_FAILED ? FRACAS_FAILED_ROW : FRACAS_DONE);
}

fracas_err fracas_index_find_point(fracas_index *index, const fracas_hash *point, int64_t *id)
{
    return fracas_sql_numbers(index, "SELECT id FROM point WHERE hash = ?1",
                              SQL_VALUES(SQL_HASH(point)), id, NULL);
}

fracas_err fracas_index_need_point(fracas_index *index, const fracas_hash *point, int64_t *id)
{
    TRY(fracas_index_find_point(index, point, id));
    if (*id) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "%s has no point %s; %s", index->path,
                       fracas_hash_hex(point).text, remedy);
}

/* ---- planning ---- */

fracas_err fracas_index_plan_point(fracas_index *index, const fracas_point_row *point)
{
    int64_t id, there;
    TRY(fracas_sql_do(index,
                      "INSERT INTO point(hash, replicas) VALUES (?1, ?2) ON CONFLICT (hash) DO "
                      "UPDATE SET replicas = max(replicas, excluded.replicas)",
                      SQL_VALUES(SQL_HASH(&point->hash), SQL_INTEGER(point->replicas))));
    TRY(fracas_index_need_point(index, &point->hash, &id));
    TRY(fracas_sql_numbers(
        index, "SELECT count(*) FROM realization WHERE point = ?1 AND replica < ?2",
        SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(point->replicas)), &there, NULL));
    if (there == point->replicas) return FRACAS_OK; /* to resume a large study is quick */
    return fracas_sql_do(index,
                         "WITH RECURSIVE n(replica) AS (SELECT 0 UNION ALL SELECT replica + 1 FROM "
                         "n WHERE replica + 1 < ?2) INSERT OR IGNORE INTO realization(point, "
                         "replica, status) SELECT ?1, replica, 'planned' FROM n",
                         SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(point->replicas)));
}

fracas_err fracas_index_plan(fracas_index *index, const fracas_point_table *table)
{
    TRY(fracas_index_begin(index));
    fracas_err err = fracas_sql_do(
        index, "UPDATE realization SET status = 'planned' WHERE status = 'leased'", NULL, 0);
    for (size_t p = 0; !err && p < table->npoints; p++)
        err = fracas_index_plan_point(index, &table->point[p]);
    return fracas_index_end(index, err);
}

fracas_err fracas_index_rows_from(fracas_index *index, const fracas_point_row *point, size_t p,
                                  int64_t first, fracas_index_row *row)
{
    int64_t id, found = first;
    fracas_err err;
    OWN(sqlite3_stmt) s = NULL;
    TRY(fracas_index_need_point(index, &point->hash, &id));
    TRY(fracas_sql_start(
        index,
        "SELECT replica, status, attempts FROM realization WHERE point = ?1 AND replica >= ?3 AND "
        "replica < ?2 ORDER BY replica",
        SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(point->replicas), SQL_INTEGER(first)), &s));
    for (; fracas_sql_next(index, s, &err); found++) {
        if (sqlite3_column_int64(s, 0) != found) break; /* it must be first, first + 1 ... */
        row[found - first] = (fracas_index_row){p, found, fracas_status_read(s, 1),
                                                sqlite3_column_int64(s, 2)};
    }
    TRY(err);
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
    OWNED fracas_index_row *all = calloc(*count ? *count : 1, sizeof *all);
    *row = NULL;
    if (!all) return fracas_no_memory("the plan");
    for (size_t p = 0, first = 0; p < table->npoints; p++) {
        TRY(fracas_index_rows_from(index, &table->point[p], p, 0, all + first));
        first += (size_t)table->point[p].replicas;
    }
    *row = all;
    all = NULL;
    return FRACAS_OK;
}

fracas_err fracas_index_failures(fracas_index *index, const fracas_point_table *table,
                                 void (*say)(void *context, const fracas_index_row *row,
                                             const char *reason),
                                 void *context)
{
    for (size_t p = 0; p < table->npoints; p++) {
        int64_t id;
        fracas_err err;
        OWN(sqlite3_stmt) s = NULL;
        TRY(fracas_index_need_point(index, &table->point[p].hash, &id));
        TRY(fracas_sql_start(index,
                             "SELECT replica, status, attempts, coalesce(reason, '') FROM "
                             "realization WHERE point = ?1 AND status IN ('failed', 'quarantined') "
                             "ORDER BY replica",
                             SQL_VALUES(SQL_INTEGER(id)), &s));
        while (fracas_sql_next(index, s, &err)) {
            fracas_index_row row = {p, sqlite3_column_int64(s, 0), fracas_status_read(s, 1),
                                    sqlite3_column_int64(s, 2)};
            const char *reason = (const char *)sqlite3_column_text(s, 3);
            TRY(fracas_sql_whole(index));
            say(context, &row, reason);
        }
        TRY(err);
    }
    return FRACAS_OK;
}

fracas_err fracas_index_place(fracas_index *index, const fracas_hash *point, int64_t replica,
                              fracas_row_place *place)
{
    int64_t id;
    fracas_err err;
    OWN(sqlite3_stmt) s = NULL;
    TRY(fracas_index_need_point(index, point, &id));
    TRY(fracas_sql_start(
        index, "SELECT " FRACAS_PLACE_COLUMNS " FROM realization WHERE point = ?1 AND replica = ?2",
        SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(replica)), &s));
    if (fracas_sql_next(index, s, &err)) {
        *place = fracas_place_read(s, 0);
        return fracas_sql_whole(index);
    }
    TRY(err);
    return fracas_fail(FRACAS_DAMAGED,
                       "%s has no replica %" PRId64
                       " of point %s; `fracas reindex` makes it anew from the segments",
                       index->path, replica, fracas_hash_hex(point).text);
}

fracas_err fracas_index_each_by_segment(fracas_index *index, fracas_place_visit *visit,
                                        void *context)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    TRY(fracas_sql_start(index,
                         "SELECT hash, replica, " FRACAS_PLACE_COLUMNS
                         " FROM realization r JOIN point p ON p.id = r.point WHERE segment IS NOT "
                         "NULL OR status = 'done' ORDER BY segment, row",
                         NULL, 0, &s));
    while (fracas_sql_next(index, s, &err)) {
        fracas_hash point;
        const char *hex = (const char *)sqlite3_column_text(s, 0);
        const bool valid = hex && fracas_hash_parse(hex, &point);
        const fracas_row_place place = fracas_place_read(s, 2);
        TRY(fracas_sql_whole(index));
        TRY(visit(context, valid ? &point : NULL, sqlite3_column_int64(s, 1), &place));
    }
    return err;
}

/* The last update changed this realization, or it is done already and stays; FRACAS_DAMAGED if it
 * was never planned. */
static fracas_err changed_or_done(fracas_index *index, const fracas_hash *point, int64_t replica)
{
    fracas_row_place place;
    return sqlite3_changes(index->db) == 1 ? FRACAS_OK
                                           : fracas_index_place(index, point, replica, &place);
}

/* ---- leases, failures, events ---- */

/* A lease need not survive: after any death its rows are planned again. So it waits for no disk
 * where the journal cannot suffer from that (WAL). */
fracas_err fracas_index_lease(fracas_index *index, const fracas_hash *point, int64_t replica,
                              int64_t count)
{
    int64_t id;
    TRY(fracas_index_need_point(index, point, &id));
    if (index->local) TRY(fracas_sql_script(index, "PRAGMA synchronous = NORMAL"));
    fracas_err err = fracas_sql_do(
        index,
        "UPDATE realization SET status = 'leased' WHERE point = ?1 AND replica >= ?2 AND replica < "
        "?2 + ?3 AND status = 'planned'",
        SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(replica), SQL_INTEGER(count)));
    /* After a failure, too, whose message stays: later commits wait for the disk. */
    if (index->local &&
        sqlite3_exec(index->db, "PRAGMA synchronous = FULL", NULL, NULL, NULL) != SQLITE_OK && !err)
        err = fracas_index_error(index, "read or write");
    return err;
}

fracas_err fracas_index_fail(fracas_index *index, const fracas_hash *point, int64_t replica,
                             const char *reason, bool final)
{
    int64_t id;
    const char *status = status_text[final ? FRACAS_FAILED_ROW : FRACAS_PLANNED];
    TRY(fracas_index_need_point(index, point, &id));
    TRY(fracas_sql_do(
        index,
        "UPDATE realization SET attempts = attempts + 1, reason = ?3, status = ?4, outcome = ?5 "
        "WHERE point = ?1 AND replica = ?2 AND status <> 'done'",
        SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(replica), SQL_TEXT(reason), SQL_TEXT(status),
                   {.type = final ? SQLITE_INTEGER : SQLITE_NULL, .integer = FRACAS_FAILED})));
    return changed_or_done(index, point, replica);
}

fracas_err fracas_index_event(fracas_index *index, const char *kind, const char *text)
{
    return fracas_sql_do(index,
                         "INSERT INTO event(time, kind, text) VALUES "
                         "(strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), ?1, ?2)",
                         SQL_VALUES(SQL_TEXT(kind), SQL_TEXT(text)));
}

fracas_err fracas_index_last_event(fracas_index *index, const char *kind, char **text)
{
    return fracas_sql_text(index, "SELECT text FROM event WHERE kind = ?1 ORDER BY id DESC LIMIT 1",
                           SQL_VALUES(SQL_TEXT(kind)), text);
}

/* ---- segments ---- */

/* Id of the segment; added if the index does not know it. */
static fracas_err add_segment(fracas_index *index, const char *name, const fracas_file_seal *seal,
                              size_t rows, const char *provenance, int64_t *id)
{
    char checksum[17];
    int64_t same;
    snprintf(checksum, sizeof checksum, "%016" PRIx64, seal->checksum);
    TRY(fracas_sql_numbers(
        index, "SELECT id, bytes = ?2 AND checksum = ?3 FROM segment WHERE name = ?1",
        SQL_VALUES(SQL_TEXT(name), SQL_INTEGER((int64_t)seal->bytes), SQL_TEXT(checksum)), id,
        &same));
    if (*id && !same)
        return fracas_fail(FRACAS_BUG, "%s knows another segment %s", index->path, name);
    if (*id) return FRACAS_OK;
    TRY(fracas_sql_do(
        index,
        "INSERT INTO segment(name, bytes, checksum, rows, provenance) VALUES (?1, "
        "?2, ?3, ?4, ?5)",
        SQL_VALUES(SQL_TEXT(name), SQL_INTEGER((int64_t)seal->bytes), SQL_TEXT(checksum),
                   SQL_INTEGER((int64_t)rows), SQL_TEXT(provenance))));
    *id = sqlite3_last_insert_rowid(index->db);
    return FRACAS_OK;
}

static fracas_err set_done(fracas_index *index, int64_t point, int64_t segment,
                           const fracas_segment_row *row)
{
    const bool failed = row->summary.outcome == FRACAS_FAILED;
#define VALUE(key, type, value, meaning) SQL_##type(row->summary.key),
    TRY(fracas_sql_do(
        index,
        "UPDATE realization SET status = ?3, segment = ?4, row = ?5" FRACAS_EACH_SUMMARY(
            FRACAS_SQL_SET) " WHERE point = ?1 AND replica = ?2 AND status <> 'done'",
        SQL_VALUES(SQL_INTEGER(point), SQL_INTEGER(row->replica),
                   SQL_TEXT(status_text[failed ? FRACAS_FAILED_ROW : FRACAS_DONE]),
                   SQL_INTEGER(segment), SQL_INTEGER(row->row), FRACAS_EACH_SUMMARY(VALUE))));
    return changed_or_done(index, &row->point, row->replica);
}

fracas_err fracas_index_commit(fracas_index *index, const char *segment,
                               const fracas_file_seal *seal, const fracas_segment_row *row,
                               size_t count, const char *provenance)
{
    TRY(fracas_index_begin(index));
    int64_t id = 0, point = 0;
    fracas_err err = add_segment(index, segment, seal, count, provenance, &id);
    for (size_t r = 0; !err && r < count; r++) {
        if (r == 0 || !fracas_hash_equal(&row[r].point, &row[r - 1].point))
            err = fracas_index_need_point(index, &row[r].point, &point);
        if (!err) err = set_done(index, point, id, &row[r]);
    }
    return fracas_index_end(index, err);
}

fracas_err fracas_index_fold(fracas_index *index, const char *segment, const fracas_file_seal *seal,
                             const fracas_segment_row *row, size_t count)
{
    static const char move[] = "UPDATE realization SET segment = ?3, row = ?4 WHERE point = ?1 AND "
                               "replica = ?2 AND status = 'done'";
    static const char sum[] = "SELECT count(*) FROM realization WHERE segment = ?1";
    TRY(fracas_index_begin(index));
    int64_t id = 0, point = 0, rows = 0;
    fracas_err err = add_segment(index, segment, seal, count, "{\"merged\": true}", &id);
    for (size_t r = 0; !err && r < count; r++) {
        if (r == 0 || !fracas_hash_equal(&row[r].point, &row[r - 1].point))
            err = fracas_index_need_point(index, &row[r].point, &point);
        if (!err)
            err = fracas_sql_do(index, move,
                                SQL_VALUES(SQL_INTEGER(point), SQL_INTEGER(row[r].replica),
                                           SQL_INTEGER(id), SQL_INTEGER(row[r].row)));
    }
    if (!err) err = fracas_sql_numbers(index, sum, SQL_VALUES(SQL_INTEGER(id)), &rows, NULL);
    if (!err && (size_t)rows != count)
        err = fracas_fail(FRACAS_DAMAGED, "%s: %" PRId64 " of %zu rows of study.h5 are done; %s",
                          index->path, rows, count, remedy);
    return fracas_index_end(index, err);
}

static fracas_err load_segments(fracas_index *index, const char *select,
                                fracas_known_segments *known)
{
    OWN(sqlite3_stmt) s = NULL;
    size_t room = 0;
    fracas_err err;
    TRY(fracas_sql_start(index, select, NULL, 0, &s));
    while (fracas_sql_next(index, s, &err)) {
        TRY(fracas_grow(&known->segment, sizeof *known->segment, known->count, &room,
                        "the list of segments"));
        const char *name = (const char *)sqlite3_column_text(s, 1),
                   *hex = (const char *)sqlite3_column_text(s, 3);
        TRY(fracas_sql_whole(index));
        char *end;
        fracas_file_seal seal = {(uint64_t)sqlite3_column_int64(s, 2),
                                 hex ? strtoull(hex, &end, 16) : 0};
        int64_t rows = sqlite3_column_int64(s, 4);
        if (!name || strchr(name, '/') || *name == '.' || !hex || strlen(hex) != 16 || *end ||
            rows < 0)
            return fracas_fail(FRACAS_DAMAGED, "%s: a row of its table `segment` is damaged; %s",
                               index->path, remedy);
        fracas_known_segment *new = &known->segment[known->count++];
        *new = (fracas_known_segment){sqlite3_column_int64(s, 0), strdup(name), seal, rows};
        if (!new->name) return fracas_no_memory("the list of segments");
    }
    return err;
}

#define SELECT_SEGMENTS "SELECT id, name, bytes, checksum, rows FROM segment ORDER BY "
fracas_err fracas_index_segments_by_id(fracas_index *index, fracas_known_segments *known)
{
    return load_segments(index, SELECT_SEGMENTS "id", known);
}

fracas_err fracas_index_segments_by_name(fracas_index *index, fracas_known_segments *known)
{
    return load_segments(index, SELECT_SEGMENTS "name", known);
}

void fracas_known_segments_clear(fracas_known_segments *known)
{
    for (size_t s = 0; s < known->count; s++) free(known->segment[s].name);
    free(known->segment);
    *known = (fracas_known_segments){0};
}

static int compare_id(const void *id, const void *segment)
{
    const int64_t a = *(const int64_t *)id, b = ((const fracas_known_segment *)segment)->id;
    return (a > b) - (a < b);
}

static int compare_name(const void *name, const void *segment)
{
    return strcmp(name, ((const fracas_known_segment *)segment)->name);
}

static const fracas_known_segment *find(const fracas_known_segments *known, const void *key,
                                        int (*compare)(const void *key, const void *segment))
{
    return known->count
               ? bsearch(key, known->segment, known->count, sizeof *known->segment, compare)
               : NULL;
}

const fracas_known_segment *fracas_segment_of_id(const fracas_known_segments *known, int64_t id)
{
    return find(known, &id, compare_id);
}

const fracas_known_segment *fracas_segment_of_name(const fracas_known_segments *known,
                                                   const char *name)
{
    return find(known, name, compare_name);
}

fracas_err fracas_index_forget(fracas_index *index, const int64_t *segment, size_t count,
                               int64_t *rows)
{
    *rows = 0;
    if (!count) return FRACAS_OK;
    TRY(fracas_index_begin(index));
    fracas_err err = FRACAS_OK;
    /* Marked by an impossible size, so that one scan of the realizations serves them all. */
    for (size_t s = 0; !err && s < count; s++)
        err = fracas_sql_do(index, "UPDATE segment SET bytes = -1 WHERE id = ?1",
                            SQL_VALUES(SQL_INTEGER(segment[s])));
    if (!err)
        err = fracas_sql_do(index,
                            "UPDATE realization SET " FRACAS_UNSET_PLACE
                            " WHERE segment IN (SELECT id FROM segment WHERE bytes < 0)",
                            NULL, 0);
    if (!err) *rows = sqlite3_changes64(index->db);
    if (!err) err = fracas_sql_do(index, "DELETE FROM segment WHERE bytes < 0", NULL, 0);
    return fracas_index_end(index, err);
}

/* ---- decisions on the number of replicas, and the summaries they rest on ---- */

fracas_err fracas_index_summaries(fracas_index *index, const fracas_hash *point, size_t count,
                                  fracas_row_place *row)
{
    int64_t id;
    size_t found = 0;
    fracas_err err;
    OWN(sqlite3_stmt) s = NULL;
    TRY(fracas_index_need_point(index, point, &id));
    TRY(fracas_sql_start(index,
                         "SELECT " FRACAS_PLACE_COLUMNS
                         " FROM realization WHERE point = ?1 AND replica < ?2 ORDER BY replica",
                         SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER((int64_t)count)), &s));
    while (found < count && fracas_sql_next(index, s, &err)) row[found++] = fracas_place_read(s, 0);
    if (found < count) TRY(err);
    if (found == count) return fracas_sql_whole(index);
    return fracas_fail(FRACAS_DAMAGED, "%s: %zu of the first %zu replicas of a point are there; %s",
                       index->path, found, count, remedy);
}

fracas_err fracas_index_decisions(fracas_index *index, const fracas_hash *point,
                                  fracas_decision **decision, size_t *count)
{
    int64_t id;
    size_t room = 0;
    fracas_err err;
    OWN(sqlite3_stmt) s = NULL;
    OWNED fracas_decision *found = NULL;
    *decision = NULL;
    *count = 0;
    TRY(fracas_index_need_point(index, point, &id));
    TRY(fracas_sql_start(
        index,
        "SELECT 0, round, replicas, replicas - failed, mean, half_width, stop, quantity, minimum, "
        "maximum, relative_half_width, confidence FROM decision WHERE point = ?1 ORDER BY round",
        SQL_VALUES(SQL_INTEGER(id)), &s));
    for (; fracas_sql_next(index, s, &err); ++*count) {
        int c = 0;
        TRY(fracas_grow(&found, sizeof *found, *count, &room, "the decisions of a point"));
#define READ_NEXT(key, type, stored, meaning) found[*count].key = READ_##type(s, c++);
        FRACAS_EACH_DECISION(READ_NEXT)
        if (!fracas_decision_valid(&found[*count]))
            return fracas_fail(FRACAS_DAMAGED, "%s: a row of its table `decision` is damaged; %s",
                               index->path, remedy);
    }
    TRY(err);
    *decision = found;
    found = NULL;
    return FRACAS_OK;
}

fracas_err fracas_index_decide(fracas_index *index, const fracas_point_row *point,
                               const fracas_decision *d, const char *reason)
{
    int64_t id;
    TRY(fracas_index_need_point(index, &point->hash, &id));
    TRY(fracas_sql_do(index, "DELETE FROM decision WHERE point = ?1 AND round >= ?2",
                      SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(d->round))));
    TRY(fracas_sql_do(
        index,
        "INSERT INTO decision VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)",
        SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(d->round), SQL_INTEGER(d->replicas),
                   SQL_INTEGER(d->replicas - d->used), SQL_REAL(d->mean), SQL_REAL(d->half_width),
                   SQL_REAL(fracas_decision_relative(d)), SQL_INTEGER(d->stop), SQL_TEXT(reason),
                   SQL_INTEGER(d->quantity), SQL_INTEGER(d->minimum), SQL_INTEGER(d->maximum),
                   SQL_REAL(d->relative_half_width), SQL_REAL(d->confidence))));
    if (!d->stop) return fracas_index_plan_point(index, point);
    return fracas_sql_do(index, "DELETE FROM realization WHERE point = ?1 AND replica >= ?2",
                         SQL_VALUES(SQL_INTEGER(id), SQL_INTEGER(point->replicas)));
}
