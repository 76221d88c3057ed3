/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The index: opening the database, its tables and its statements. */
#include "campaigns/store/index/index.h"

#include "campaigns/store/file/disk.h"
#include "campaigns/store/index/tables.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char remedy[] = "`fracas reindex` makes it anew from the segments";

static const char *const sql_text[FRACAS_NSQL] = {
    [FRACAS_SQL_BEGIN] = "BEGIN IMMEDIATE",
    [FRACAS_SQL_BEGIN_READING] = "BEGIN",
    [FRACAS_SQL_COMMIT] = "COMMIT",
    [FRACAS_SQL_POINT_ADD] = "INSERT INTO point(hash, replicas) VALUES (?1, ?2) ON CONFLICT (hash) "
                             "DO UPDATE SET replicas = max(replicas, excluded.replicas)",
    [FRACAS_SQL_POINT_FIND] = "SELECT id FROM point WHERE hash = ?1",
    [FRACAS_SQL_POINT_COUNT] = "SELECT count(*) FROM point",
    [FRACAS_SQL_POINT_ALL] = "SELECT hash, replicas FROM point ORDER BY id",
    [FRACAS_SQL_ROW_COUNT] = "SELECT count(*) FROM realization WHERE point = ?1 AND replica < ?2",
    [FRACAS_SQL_ROW_ADD] =
        "WITH RECURSIVE n(replica) AS (SELECT 0 UNION ALL SELECT replica + 1 FROM n WHERE replica "
        "+ 1 < ?2) INSERT OR IGNORE INTO realization(point, replica, status) SELECT ?1, replica, "
        "'planned' FROM n",
    [FRACAS_SQL_ROW_FIND] = "SELECT " FRACAS_PLACE_COLUMNS
                            " FROM realization WHERE point = ?1 AND replica = ?2",
    [FRACAS_SQL_ROW_OF_POINT] = "SELECT replica, status, attempts FROM realization WHERE point = "
                                "?1 AND replica >= ?3 AND replica < ?2 ORDER BY replica",
    [FRACAS_SQL_ROW_FAILED] =
        "SELECT replica, status, attempts, coalesce(reason, '') FROM realization WHERE point = ?1 "
        "AND status IN ('failed', 'quarantined') ORDER BY replica",
    [FRACAS_SQL_ROW_BY_SEGMENT] =
        "SELECT hash, replica, " FRACAS_PLACE_COLUMNS " FROM realization r JOIN point p ON p.id = "
        "r.point WHERE segment IS NOT NULL OR status = 'done' ORDER BY segment, row",
    [FRACAS_SQL_ROW_UNLEASE] = "UPDATE realization SET status = 'planned' WHERE status = 'leased'",
    [FRACAS_SQL_ROW_LEASE] = "UPDATE realization SET status = 'leased' WHERE point = ?1 AND "
                             "replica >= ?2 AND replica < ?2 + ?3 AND status = 'planned'",
    [FRACAS_SQL_ROW_FAIL] =
        "UPDATE realization SET attempts = attempts + 1, reason = ?3, status = ?4, outcome = ?5 "
        "WHERE point = ?1 AND replica = ?2 AND status <> 'done'",
    [FRACAS_SQL_ROW_DONE] =
        "UPDATE realization SET status = ?3, segment = ?4, row = ?5" FRACAS_EACH_SUMMARY(
            FRACAS_SQL_SET) " WHERE point = ?1 AND replica = ?2 AND status <> 'done'",
    [FRACAS_SQL_ROW_FORGET] = "UPDATE realization SET " FRACAS_UNSET_PLACE
                              " WHERE segment IN (SELECT id FROM segment WHERE bytes < 0)",
    [FRACAS_SQL_TALLY] = "SELECT status, outcome, point FROM realization",
    [FRACAS_SQL_SEGMENT_ADD] =
        "INSERT INTO segment(name, bytes, checksum, rows, provenance) VALUES (?1, ?2, ?3, ?4, ?5)",
    [FRACAS_SQL_SEGMENT_FIND] = "SELECT id, bytes, checksum FROM segment WHERE name = ?1",
    [FRACAS_SQL_SEGMENT_ALL] = "SELECT id, name, bytes, checksum, rows FROM segment ORDER BY id",
    [FRACAS_SQL_SEGMENT_LOSE] = "UPDATE segment SET bytes = -1 WHERE id = ?1",
    [FRACAS_SQL_SEGMENT_FORGET] = "DELETE FROM segment WHERE bytes < 0",
    [FRACAS_SQL_SEGMENT_TOTAL] = "SELECT count(*), coalesce(sum(bytes), 0) FROM segment",
    [FRACAS_SQL_EVENT_ADD] = "INSERT INTO event(time, kind, text) VALUES "
                             "(strftime('%Y-%m-%dT%H:%M:%fZ', 'now'), ?1, ?2)",
    [FRACAS_SQL_EVENT_LAST] = "SELECT text FROM event WHERE kind = ?1 ORDER BY id DESC LIMIT 1",
    [FRACAS_SQL_ROW_OF_POINT_PLACE] = "SELECT replica, " FRACAS_PLACE_COLUMNS
                                      " FROM realization WHERE point = ?1 AND replica < "
                                      "?2 ORDER BY replica",
    [FRACAS_SQL_ROW_TRIM] = "DELETE FROM realization WHERE point = ?1 AND replica >= ?2",
    [FRACAS_SQL_DECISION_ADD] =
        "INSERT INTO decision VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)",
    [FRACAS_SQL_DECISION_DROP] = "DELETE FROM decision WHERE point = ?1 AND round >= ?2",
    [FRACAS_SQL_DECISION_OF_POINT] =
        "SELECT round, replicas, failed, mean, half_width, stop, quantity, minimum, maximum, "
        "relative_half_width, confidence FROM decision WHERE point = ?1 ORDER BY round",
};

/* ---- errors and statements ---- */

/* Error of the system behind SQLite's. SQLite has none for a failed COMMIT; errno is still set
 * then. */
static int system_reason(const fracas_index *index, int last)
{
    const int told = index->db ? sqlite3_system_errno(index->db) : 0;
    const bool is_of_disk = last == ENOSPC || last == EDQUOT || last == EFBIG || last == EIO ||
                            last == EROFS;
    return told ? told : is_of_disk ? last : 0;
}

fracas_err fracas_index_error(const fracas_index *index, const char *doing)
{
    const int system = system_reason(index, errno);
    int code = index->db ? sqlite3_errcode(index->db) : SQLITE_NOMEM;
    const char *text = index->db ? sqlite3_errmsg(index->db) : "no memory";
    switch (code) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return fracas_fail(FRACAS_IN_USE,
                           "%s: cannot %s: another process is using it; try again later",
                           index->path, doing);
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
    case SQLITE_FORMAT:
        return fracas_fail(FRACAS_DAMAGED, "%s: cannot %s: damaged: %s; %s", index->path, doing,
                           text, remedy);
    case SQLITE_ERROR:
    case SQLITE_CONSTRAINT:
    case SQLITE_MISUSE:
    case SQLITE_RANGE:
    case SQLITE_MISMATCH:
        return fracas_fail(FRACAS_BUG, "%s: cannot %s: %s", index->path, doing, text);
    case SQLITE_FULL:
        return fracas_fail_system(system ? system : ENOSPC, "%s: cannot %s", index->path, doing);
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
        if (system && *fracas_remedy(system))
            return fracas_fail_system(system, "%s: cannot %s", index->path, doing);
        return fracas_fail(
            FRACAS_ENVIRONMENT,
            "%s: cannot %s: %s; make the study writable, or copy it to where you may write",
            index->path, doing, text);
    default:
        if (system)
            return fracas_fail_system(system, "%s: cannot %s: %s", index->path, doing, text);
        return fracas_fail(FRACAS_ENVIRONMENT, "%s: cannot %s: %s", index->path, doing, text);
    }
}

fracas_err fracas_index_step(fracas_index *index, fracas_sql sql, bool *row)
{
    errno = 0;
    int code = sqlite3_step(index->statement[sql]);
    *row = code == SQLITE_ROW;
    if (code == SQLITE_ROW || code == SQLITE_DONE) return FRACAS_OK;
    fracas_err err = fracas_index_error(index, "read or write");
    fracas_index_reset(index, sql);
    return err;
}

void fracas_index_reset(fracas_index *index, fracas_sql sql)
{
    sqlite3_reset(
        index->statement[sql]); /* repeats the error of the last step, which was reported */
}

fracas_err fracas_index_do(fracas_index *index, fracas_sql sql)
{
    bool row = false;
    fracas_err err = fracas_index_step(index, sql, &row);
    fracas_index_reset(index, sql);
    return err;
}

static fracas_err bound(fracas_index *index, int code)
{
    return code == SQLITE_OK ? FRACAS_OK : fracas_index_error(index, "bind a value");
}

fracas_err fracas_index_bind(fracas_index *index, fracas_sql sql, int n, int64_t value)
{
    return bound(index, sqlite3_bind_int64(index->statement[sql], n, value));
}

fracas_err fracas_index_bind_real(fracas_index *index, fracas_sql sql, int n, double value)
{
    return bound(index,
                 sqlite3_bind_double(index->statement[sql], n, value)); /* NaN becomes NULL */
}

fracas_err fracas_index_bind_text(fracas_index *index, fracas_sql sql, int n, const char *text)
{
    return bound(index, sqlite3_bind_text(index->statement[sql], n, text, -1, SQLITE_TRANSIENT));
}

fracas_err fracas_index_begin(fracas_index *index)
{
    return fracas_index_do(index, FRACAS_SQL_BEGIN);
}

fracas_err fracas_index_end(fracas_index *index, fracas_err err)
{
    if (!err) err = fracas_index_do(index, FRACAS_SQL_COMMIT);
    /* SQLite may have rolled back by itself (disk full); the first error is the one to tell. */
    if (err && !sqlite3_get_autocommit(index->db))
        sqlite3_exec(index->db, "ROLLBACK", NULL, NULL, NULL);
    return err;
}

/* ---- opening ---- */

/* Runs a pragma and compares its first value. */
static fracas_err pragma(fracas_index *index, const char *text, const char *wanted)
{
    sqlite3_stmt *statement;
    if (sqlite3_prepare_v2(index->db, text, -1, &statement, NULL) != SQLITE_OK)
        return fracas_index_error(index, "open");
    int code = sqlite3_step(statement);
    const char *found = code == SQLITE_ROW ? (const char *)sqlite3_column_text(statement, 0) : NULL;
    fracas_err err = FRACAS_OK;
    if (code != SQLITE_ROW && code != SQLITE_DONE) err = fracas_index_error(index, "open");
    else if (wanted && (!found || strcmp(found, wanted) != 0))
        err = fracas_fail(FRACAS_ENVIRONMENT,
                          "%s: '%s' gives '%s', not '%s': nothing would be durable here",
                          index->path, text, found ? found : "", wanted);
    sqlite3_finalize(statement);
    return err;
}

static fracas_err set_memory(fracas_index *index)
{
    sqlite3_busy_timeout(index->db, 5000);
    return pragma(index, "PRAGMA cache_size = -65536",
                  NULL); /* 64 MiB: a commit may touch pages all over the table */
}

static fracas_err set_durability(fracas_index *index)
{
    if (!index->local) TRY(pragma(index, "PRAGMA locking_mode = EXCLUSIVE", "exclusive"));
    TRY(index->local ? pragma(index, "PRAGMA journal_mode = WAL", "wal")
                     : pragma(index, "PRAGMA journal_mode = TRUNCATE", "truncate"));
    TRY(pragma(index, "PRAGMA synchronous = FULL", NULL));
    return pragma(index, "PRAGMA synchronous", "2"); /* FULL */
}

static fracas_err create_tables(fracas_index *index)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return fracas_no_memory("the tables of the index");
    fputs("BEGIN IMMEDIATE;", out);
    fracas_index_print_schema(out);
    fprintf(out, "INSERT OR IGNORE INTO meta VALUES ('format_version', '%d'); COMMIT",
            FRACAS_FORMAT_VERSION);
    fracas_err err = fclose(out) == 0 ? FRACAS_OK : fracas_no_memory("the tables of the index");
    if (!err && sqlite3_exec(index->db, text, NULL, NULL, NULL) != SQLITE_OK) {
        err = fracas_index_error(index, "create its tables");
        sqlite3_exec(index->db, "ROLLBACK", NULL, NULL, NULL);
    }
    free(text);
    return err ? err : fracas_disk_sync_folder(index->path);
}

static fracas_err check_version(fracas_index *index)
{
    char found[32], wanted[16];
    TRY(fracas_index_read_meta(index, "format_version", found, sizeof found));
    snprintf(wanted, sizeof wanted, "%d", FRACAS_FORMAT_VERSION);
    if (strcmp(found, wanted) == 0) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s has format version %s; this program reads %s: use the program version "
                       "that wrote it, or compute the study again in another folder",
                       index->path, *found ? found : "none", wanted);
}

/* ---- the file ---- */

/* True if the write-ahead log holds anything, which a reader must not pass over. */
static bool has_log(const char *path)
{
    char *name;
    struct stat info;
    if (asprintf(&name, "%s-wal", path) < 0) return true;
    bool has = stat(name, &info) == 0 && info.st_size > 0;
    free(name);
    return has;
}

/* "file:" and the path with all but plain characters as %XX; freed by the caller, NULL without
 * memory. */
static char *immutable_uri(const char *path)
{
    static const char hex[] = "0123456789ABCDEF", head[] = "file://", tail[] = "?immutable=1";
    char *uri = malloc(sizeof head + 3 * strlen(path) + sizeof tail), *to = uri;
    if (!uri) return NULL;
    to = stpcpy(to, *path == '/' ? head : "file:");
    for (const unsigned char *c = (const unsigned char *)path; *c; c++) {
        if (isalnum(*c) || strchr("/._-", *c)) {
            *to++ = (char)*c;
        } else {
            *to++ = '%';
            *to++ = hex[*c >> 4];
            *to++ = hex[*c & 15];
        }
    }
    strcpy(to, tail);
    return uri;
}

/* A file that cannot be written. In WAL mode reading needs files beside it; where those cannot be
 * made and the log is empty nobody writes, and SQLite may read it as it is. */
static fracas_err connect_to_read(fracas_index *index)
{
    int code = sqlite3_open_v2(index->path, &index->db, SQLITE_OPEN_READONLY, NULL);
    if (code == SQLITE_OK)
        code = sqlite3_exec(index->db, "SELECT 1 FROM sqlite_master", NULL, NULL, NULL);
    if ((code == SQLITE_CANTOPEN || code == SQLITE_READONLY) && !has_log(index->path)) {
        char *uri = immutable_uri(index->path);
        if (!uri) return fracas_no_memory("a file name");
        sqlite3_close(index->db);
        code = sqlite3_open_v2(uri, &index->db, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, NULL);
        free(uri);
    }
    return code == SQLITE_OK ? FRACAS_OK : fracas_index_error(index, "open");
}

static bool can_write(const char *path)
{
    return faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) == 0;
}

static fracas_err connect_to(fracas_index *index, const char *study, bool create)
{
    if (!create && access(index->path, F_OK) < 0 && errno == ENOENT)
        return fracas_fail(FRACAS_DAMAGED,
                           "%s is not there; `fracas reindex` makes it from the segments of a "
                           "study, `fracas run` a new study",
                           index->path);
    index->reading = !create && !(can_write(index->path) && can_write(study));
    if (index->reading) return connect_to_read(index);
    int flags = SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0);
    return sqlite3_open_v2(index->path, &index->db, flags, NULL) == SQLITE_OK
               ? FRACAS_OK
               : fracas_index_error(index, "open");
}

/* Counts the tables, and the ones called `meta`. */
static fracas_err count_tables(fracas_index *index, int *all, int *meta)
{
    static const char query[] = "SELECT count(*), count(CASE name WHEN 'meta' THEN 1 END) FROM "
                                "sqlite_master WHERE type = 'table'";
    sqlite3_stmt *statement;
    if (sqlite3_prepare_v2(index->db, query, -1, &statement, NULL) != SQLITE_OK)
        return fracas_index_error(index, "open");
    bool row = sqlite3_step(statement) == SQLITE_ROW;
    fracas_err err = row ? FRACAS_OK
                         : fracas_index_error(
                               index,
                               "open"); /* first: a column that is not there is another error */
    *all = row ? sqlite3_column_int(statement, 0) : 0;
    *meta = row ? sqlite3_column_int(statement, 1) : 0;
    sqlite3_finalize(statement);
    return err;
}

static fracas_err open_database(fracas_index *index, const char *study, bool create)
{
    int all, meta;
    TRY(connect_to(index, study, create));
    TRY(set_memory(index));
    if (!index->reading) TRY(set_durability(index));
    TRY(count_tables(index, &all, &meta));
    if (!all && !create)
        return fracas_fail(FRACAS_DAMAGED, "%s holds no index yet; `fracas run` makes one",
                           index->path);
    if (all && !meta)
        return fracas_fail(FRACAS_DAMAGED, "%s is no index of fracas; %s", index->path, remedy);
    if (create) TRY(create_tables(index));
    TRY(check_version(index));
    for (int s = 0; s < FRACAS_NSQL; s++)
        if (sqlite3_prepare_v3(index->db, sql_text[s], -1, SQLITE_PREPARE_PERSISTENT,
                               &index->statement[s], NULL))
            return fracas_index_error(index, "prepare a statement");
    return FRACAS_OK;
}

bool fracas_index_exists(const char *study)
{
    fracas_index index = {0};
    int all, meta = 0;
    bool exists = !fracas_disk_join(study, "index.sqlite", &index.path) &&
                  !connect_to(&index, study, false) && !count_tables(&index, &all, &meta) && meta;
    sqlite3_close(index.db);
    free(index.path);
    return exists;
}

fracas_err fracas_index_open_as(const char *study, bool create, bool local, fracas_index **index)
{
    *index = calloc(1, sizeof **index);
    if (!*index) return fracas_no_memory("the index");
    (*index)->local = local;
    fracas_err err = fracas_disk_join(study, "index.sqlite", &(*index)->path);
    if (!err) err = open_database(*index, study, create);
    if (!err) return FRACAS_OK;
    if (err == FRACAS_BUG)
        err = fracas_fail_within(FRACAS_DAMAGED, "damaged, or no index of fracas; %s", remedy);
    fracas_index_close(*index);
    *index = NULL;
    return err;
}

fracas_err fracas_index_open(const char *study, bool create, fracas_index **index)
{
    bool local;
    *index = NULL;
    TRY(fracas_disk_is_local(study, &local));
    return fracas_index_open_as(study, create, local, index);
}

void fracas_index_close(fracas_index *index)
{
    if (!index) return;
    for (int s = 0; s < FRACAS_NSQL; s++) sqlite3_finalize(index->statement[s]);
    sqlite3_close(index->db);
    free(index->path);
    free(index);
}
