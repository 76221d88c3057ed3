/* What is wrong with a study: segments against the index, study.h5 against the segments. */
#include "campaigns/store/disk.h"
#include "campaigns/store/pool.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    const char *study;
    fracas_index *index;
    fracas_pool *pool;
    fracas_reader *merged; /* study.h5, NULL if it is not there or not readable */
    void (*say)(void *context, const char *problem);
    void *context;
    int64_t problems;
} verification;

/* A problem is damage; anything else stops the verification. */
static fracas_err problem(verification *v, fracas_err err)
{
    if (err != FRACAS_DAMAGED) return err;
    v->say(v->context, fracas_message());
    v->problems++;
    return FRACAS_OK;
}

static fracas_err found(verification *v, const char *format, ...) FRACAS_PRINTF(2, 3);
static fracas_err found(verification *v, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return problem(v, fracas_fail(FRACAS_DAMAGED, "%s", text));
}

/* ---- the database itself ---- */

/* Each row of a pragma that checks the database is a problem, but "ok". */
static fracas_err check_database(verification *v, const char *pragma)
{
    sqlite3_stmt *statement;
    if (sqlite3_prepare_v2(v->index->db, pragma, -1, &statement, NULL) != SQLITE_OK)
        return problem(v, fracas_index_error(v->index, "check"));
    fracas_err err = FRACAS_OK;
    int code;
    while (!err && (code = sqlite3_step(statement)) == SQLITE_ROW) {
        const char *text = (const char *)sqlite3_column_text(statement, 0);
        if (text && strcmp(text, "ok") != 0)
            err = found(v, "%s: %s: %s; remove it and run again: it is made anew from the segments", v->index->path,
                        pragma, text);
    }
    if (!err && code != SQLITE_DONE) err = problem(v, fracas_index_error(v->index, "check"));
    sqlite3_finalize(statement);
    return err;
}

/* ---- segments against the index ---- */

static fracas_err check_segments(verification *v)
{
    fracas_known_segment *segment;
    size_t count;
    fracas_err err = fracas_index_segments(v->index, &segment, &count);
    if (err) return problem(v, err);
    for (size_t s = 0; !err && s < count; s++) {
        fracas_reader *reader;
        err = problem(v, fracas_pool_segment(v->pool, segment[s].id, &reader));
    }
    fracas_index_segments_free(segment, count);
    return err;
}

/* Equal, or both nothing: SQLite keeps NaN as NULL. */
static bool same_real(sqlite3_stmt *row, int column, double value)
{
    if (sqlite3_column_type(row, column) == SQLITE_NULL) return value != value;
    return sqlite3_column_double(row, column) == value;
}

/* One row of FRACAS_SQL_ROW_BY_SEGMENT against its record. */
static fracas_err check_row(verification *v, sqlite3_stmt *row, fracas_record *record)
{
    fracas_hash point;
    const char *hex = (const char *)sqlite3_column_text(row, 2);
    int64_t replica = sqlite3_column_int64(row, 3);
    fracas_place place = {fracas_index_status(sqlite3_column_text(row, 10)), sqlite3_column_int64(row, 0),
                          sqlite3_column_int64(row, 1)};
    if (!hex || !fracas_hash_parse(hex, &point)) return found(v, "%s: a point has no valid hash", v->index->path);
    if (fracas_pool_is_bad(v->pool, place.segment)) return FRACAS_OK; /* said already */
    fracas_err err = fracas_pool_record(v->pool, &place, &point, replica, record);
    if (err) return problem(v, err);
    bool same = sqlite3_column_int64(row, 4) == record->outcome && sqlite3_column_int64(row, 5) == record->fragments &&
                sqlite3_column_int64(row, 6) == record->fragments_dust &&
                sqlite3_column_int64(row, 7) == record->steps && same_real(row, 8, record->dissipated) &&
                same_real(row, 9, record->residual) &&
                place.status == (record->outcome == FRACAS_FAILED ? FRACAS_FAILED_ROW : FRACAS_DONE);
    if (same) return FRACAS_OK;
    return found(v, "%s: replica %" PRId64 " of point %s: its row differs from its record; remove the index and run "
                 "again: it is made anew from the segments", v->index->path, replica, hex);
}

static fracas_err check_rows(verification *v, fracas_record *record)
{
    fracas_err err = FRACAS_OK;
    while (!err) {
        bool more = false;
        err = fracas_index_step(v->index, FRACAS_SQL_ROW_BY_SEGMENT, &more);
        if (err) return problem(v, err);
        if (!more) break;
        err = check_row(v, v->index->statement[FRACAS_SQL_ROW_BY_SEGMENT], record);
    }
    fracas_index_reset(v->index, FRACAS_SQL_ROW_BY_SEGMENT);
    return err;
}

/* ---- study.h5 against the segments ---- */

static bool same_record(const fracas_record *a, const fracas_record *b, bool *same)
{
    size_t size = fracas_record_packed_size(a);
    *same = size == fracas_record_packed_size(b);
    if (!*same) return true;
    void *bytes_a = malloc(size), *bytes_b = malloc(size);
    if (bytes_a && bytes_b) {
        fracas_record_pack(a, bytes_a);
        fracas_record_pack(b, bytes_b);
        *same = memcmp(bytes_a, bytes_b, size) == 0;
    }
    bool compared = bytes_a && bytes_b;
    free(bytes_a);
    free(bytes_b);
    return compared;
}

/* A realization as merge would write it: *record, empty if it failed. *known is false if there are no bytes of it
 * (and this was said). */
static fracas_err expected(verification *v, const fracas_hash *point, int64_t replica, fracas_record *record,
                           bool *known)
{
    fracas_place place;
    *known = false;
    fracas_record_clear(record);
    fracas_err err = fracas_index_place(v->index, point, replica, &place);
    if (err) return problem(v, err);
    if (place.status == FRACAS_DONE && fracas_pool_is_bad(v->pool, place.segment)) return FRACAS_OK;
    if (place.status == FRACAS_DONE) err = fracas_pool_record(v->pool, &place, point, replica, record);
    if (place.status == FRACAS_PLANNED || place.status == FRACAS_LEASED)
        return found(v, "%s/study.h5 has replica %" PRId64 " of a point, but no segment has it any more; run again",
                     v->study, replica);
    *known = !err;
    return problem(v, err);
}

/* Row `row` of study.h5, which must be this realization. */
static fracas_err check_merged_row(verification *v, size_t row, size_t point, int64_t replica, fracas_record *merged,
                                   fracas_record *record)
{
    size_t found_point;
    int64_t found_replica;
    bool known, same;
    fracas_err err = fracas_reader_record(v->merged, row, FRACAS_READ_ALL, &found_point, &found_replica, merged);
    if (err) return problem(v, err);
    if (found_point != point || found_replica != replica)
        return found(v, "%s/study.h5: row %zu is not in plan order; run `fracas merge`", v->study, row);
    TRY(expected(v, &fracas_reader_points(v->merged)->point[point].hash, replica, record, &known));
    if (!known) return FRACAS_OK;
    if (!fracas_reader_has_interfaces(v->merged)) {
        free(record->interface);
        record->interface = NULL;
        record->ninterface = 0;
    }
    if (!same_record(merged, record, &same)) return fracas_no_memory("a record");
    if (same) return FRACAS_OK;
    return found(v, "%s/study.h5: row %zu differs from its segment; remove it and run again", v->study, row);
}

static fracas_err check_merged_rows(verification *v, fracas_record *merged, fracas_record *record)
{
    const fracas_point_table *table = fracas_reader_points(v->merged);
    size_t row = 0, rows = fracas_reader_realizations(v->merged);
    for (size_t p = 0; p < table->npoints; p++)
        for (int64_t replica = 0; replica < table->point[p].replicas; replica++, row++) {
            if (row >= rows) return found(v, "%s/study.h5 ends before its last realization; run again", v->study);
            TRY(check_merged_row(v, row, p, replica, merged, record));
        }
    return row == rows ? FRACAS_OK : found(v, "%s/study.h5 has more realizations than planned; run again", v->study);
}

/* When everything is computed, study.h5 must be there with all of it. */
static fracas_err check_merged_whole(verification *v)
{
    fracas_index_counts counts;
    fracas_err err = fracas_index_count(v->index, &counts);
    if (err) return problem(v, err);
    if (counts.planned || counts.leased || !counts.realizations) return FRACAS_OK;
    if (!v->merged || (int64_t)fracas_reader_realizations(v->merged) != counts.realizations)
        return found(v, "%s: every realization is computed, but study.h5 is not there or older; run again", v->study);
    bool complete = fracas_reader_header(v->merged)->complete;
    if (complete == (counts.failed == 0)) return FRACAS_OK;
    return found(v, "%s/study.h5: its attribute `complete` is wrong; remove it and run again", v->study);
}

/* ---- all of it ---- */

static fracas_err open_merged(verification *v)
{
    char *path;
    TRY(fracas_disk_join(v->study, "study.h5", &path));
    fracas_err err = FRACAS_OK;
    if (access(path, F_OK) == 0) err = problem(v, fracas_reader_open(path, &v->merged));
    else if (errno != ENOENT) err = fracas_disk_fail("open", path);
    free(path);
    return err;
}

static fracas_err verify(verification *v)
{
    fracas_record merged, record;
    fracas_err err = fracas_index_open(v->study, false, &v->index);
    if (err) return problem(v, err);
    TRY(check_database(v, "PRAGMA integrity_check"));
    TRY(check_database(v, "PRAGMA foreign_key_check"));
    TRY(open_merged(v));
    err = fracas_pool_create(v->study, v->index, v->merged ? fracas_reader_header(v->merged) : NULL, &v->pool);
    if (err) return problem(v, err);
    fracas_record_init(&merged);
    fracas_record_init(&record);
    err = check_segments(v);
    if (!err) err = check_rows(v, &record);
    if (!err && v->merged) err = check_merged_rows(v, &merged, &record);
    if (!err) err = check_merged_whole(v);
    fracas_record_clear(&merged);
    fracas_record_clear(&record);
    return err;
}

fracas_err fracas_study_verify(const char *study, void (*say)(void *context, const char *problem), void *context,
                               int64_t *problems)
{
    verification v = {.study = study, .say = say, .context = context};
    fracas_err err = verify(&v);
    fracas_pool_destroy(v.pool);
    fracas_reader_close(v.merged);
    fracas_index_close(v.index);
    *problems = v.problems;
    return err;
}
