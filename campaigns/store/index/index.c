/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The index: opening the database, its tables and its statements. */
#include "campaigns/store/index/index.h"

#include "base/file.h"
#include "base/param.h"
#include "campaigns/store/file/disk.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char remedy[] = "`fracas reindex` makes it anew from the segments";

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
    case SQLITE_TOOBIG:
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

static fracas_err check(const fracas_index *index, int code)
{
    return code == SQLITE_OK ? FRACAS_OK
                             : fracas_index_error(index, index->opened ? "read or write" : "open");
}

static int bind(sqlite3_stmt *statement, int n, const fracas_sql_value *value)
{
    switch (value->type) {
    case SQLITE_INTEGER: return sqlite3_bind_int64(statement, n, value->integer);
    case SQLITE_FLOAT: return sqlite3_bind_double(statement, n, value->real); /* NaN: NULL */
    case SQLITE_TEXT: return sqlite3_bind_text(statement, n, value->text, -1, SQLITE_TRANSIENT);
    case SQLITE_BLOB:
        if (!value->hash) return sqlite3_bind_null(statement, n);
        return sqlite3_bind_text(statement, n, fracas_hash_hex(value->hash).text, -1,
                                 SQLITE_TRANSIENT);
    default: return sqlite3_bind_null(statement, n);
    }
}

/* Finds the statement, or prepares it. */
static fracas_err prepare(fracas_index *index, const char *text, sqlite3_stmt **prepared)
{
    size_t s = 0;
    while (s < index->nstatements && index->statement[s].text != text) s++;
    if (s == index->nstatements) {
        TRY(fracas_grow(&index->statement, sizeof *index->statement, s, &index->room,
                        "the statements of the index"));
        fracas_statement *new = &index->statement[s];
        TRY(check(index, sqlite3_prepare_v3(index->db, text, -1, SQLITE_PREPARE_PERSISTENT,
                                            &new->prepared, NULL)));
        new->text = text;
        index->nstatements++;
    }
    *prepared = index->statement[s].prepared;
    return FRACAS_OK;
}

fracas_err fracas_sql_start(fracas_index *index, const char *text, const fracas_sql_value *value,
                            size_t count, sqlite3_stmt **statement)
{
    sqlite3_stmt *prepared;
    *statement = NULL;
    errno = 0; /* for fracas_index_error */
    TRY(prepare(index, text, &prepared));
    if (sqlite3_stmt_busy(prepared))
        return fracas_fail(FRACAS_BUG, "%s: started twice: %s", index->path, text);
    for (size_t n = 0; n < count; n++) TRY(check(index, bind(prepared, (int)n + 1, &value[n])));
    *statement = prepared;
    return FRACAS_OK;
}

bool fracas_sql_next(fracas_index *index, sqlite3_stmt *statement, fracas_err *err)
{
    errno = 0;
    const int code = sqlite3_step(statement);
    *err = code == SQLITE_ROW || code == SQLITE_DONE ? FRACAS_OK : check(index, code);
    if (code != SQLITE_ROW) fracas_sql_end(statement);
    return code == SQLITE_ROW;
}

fracas_err fracas_sql_whole(const fracas_index *index)
{
    return sqlite3_errcode(index->db) == SQLITE_NOMEM ? check(index, SQLITE_NOMEM) : FRACAS_OK;
}

void fracas_sql_end(sqlite3_stmt *statement)
{
    if (statement) sqlite3_reset(statement); /* repeats the error of its last step */
}

fracas_err fracas_sql_do(fracas_index *index, const char *text, const fracas_sql_value *value,
                         size_t count)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    TRY(fracas_sql_start(index, text, value, count, &s));
    (void)fracas_sql_next(index, s, &err);
    return err;
}

fracas_err fracas_sql_numbers(fracas_index *index, const char *text, const fracas_sql_value *value,
                              size_t count, int64_t *first, int64_t *second)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    TRY(fracas_sql_start(index, text, value, count, &s));
    const bool row = fracas_sql_next(index, s, &err);
    *first = row ? sqlite3_column_int64(s, 0) : 0;
    if (second) *second = row ? sqlite3_column_int64(s, 1) : 0;
    return err;
}

fracas_err fracas_sql_text(fracas_index *index, const char *text, const fracas_sql_value *value,
                           size_t count, char **found)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    *found = NULL;
    TRY(fracas_sql_start(index, text, value, count, &s));
    if (!fracas_sql_next(index, s, &err)) return err;
    const char *column = (const char *)sqlite3_column_text(s, 0);
    if (!column) return fracas_sql_whole(index);
    *found = strdup(column);
    return *found ? FRACAS_OK : fracas_no_memory("a text of the index");
}

fracas_err fracas_sql_script(fracas_index *index, const char *text)
{
    return check(index, sqlite3_exec(index->db, text, NULL, NULL, NULL));
}

fracas_err fracas_sql_checkpoint(fracas_index *index)
{
    return check(
        index, sqlite3_wal_checkpoint_v2(index->db, NULL, SQLITE_CHECKPOINT_TRUNCATE, NULL, NULL));
}

fracas_err fracas_index_begin(fracas_index *index)
{
    return fracas_sql_do(index, "BEGIN IMMEDIATE", NULL, 0);
}

fracas_err fracas_index_begin_reading(fracas_index *index)
{
    return fracas_sql_do(index, "BEGIN", NULL, 0);
}

fracas_err fracas_index_end(fracas_index *index, fracas_err err)
{
    if (!err) err = fracas_sql_do(index, "COMMIT", NULL, 0);
    /* SQLite may have rolled back by itself (disk full); the first error is the one to tell. */
    if (err && !sqlite3_get_autocommit(index->db))
        sqlite3_exec(index->db, "ROLLBACK", NULL, NULL, NULL);
    return err;
}

/* ---- opening ---- */

/* Runs a pragma and compares its first value. */
static fracas_err pragma(fracas_index *index, const char *text, const char *wanted)
{
    OWNED char *found = NULL;
    TRY(fracas_sql_text(index, text, NULL, 0, &found));
    if (!wanted || (found && !strcmp(found, wanted))) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "%s: '%s' gives '%s', not '%s': nothing would be durable here", index->path,
                       text, found ? found : "", wanted);
}

/* Limits on a stranger's database (docs/decisions/trust.md). A log that was
 * there stays as it is when a reader ends. The schema is trusted: SQLite does not count json_valid,
 * which ours calls, among the functions that any schema may call. */
static fracas_err set_limits(fracas_index *index, bool keep_log)
{
    enum { TEXT_MIB = 64, COLUMNS = 64, DEPTH = 100, NATTACHED = 1 };
    sqlite3 *db = index->db;
    sqlite3_limit(db, SQLITE_LIMIT_LENGTH, TEXT_MIB << 20);
    sqlite3_limit(db, SQLITE_LIMIT_COLUMN, COLUMNS);
    sqlite3_limit(db, SQLITE_LIMIT_EXPR_DEPTH, DEPTH);
    sqlite3_limit(db, SQLITE_LIMIT_ATTACHED, NATTACHED);
    int code = sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    if (!code) code = sqlite3_db_config(db, SQLITE_DBCONFIG_ENABLE_VIEW, 0, NULL);
    if (!code) code = sqlite3_db_config(db, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, keep_log, NULL);
    if (!code && index->reading)
        code = sqlite3_exec(db, "PRAGMA query_only = ON", NULL, NULL, NULL);
    return check(index, code);
}

/* Runs a query of one text, which must find none. */
static fracas_err check_none(fracas_index *index, const char *query)
{
    OWNED char *text = NULL;
    TRY(fracas_sql_text(index, query, NULL, 0, &text));
    if (!text) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "%s has a %.100s, as no index of fracas has; %s",
                       index->path, text, remedy);
}

/* Tables alone, whose columns are stored: nothing runs when they are read. */
static fracas_err check_objects(fracas_index *index)
{
    TRY(check_none(index, "SELECT CASE type WHEN 'table' THEN 'virtual table' ELSE type END || ' ' "
                          "|| name FROM sqlite_master WHERE type NOT IN ('table', 'index') OR "
                          "rootpage = 0 LIMIT 1"));
    return check_none(index, "SELECT 'computed column ' || m.name || '.' || c.name FROM "
                             "sqlite_master m, pragma_table_xinfo(m.name) c WHERE m.type = 'table' "
                             "AND c.hidden <> 0 LIMIT 1");
}

static fracas_err set_locking(fracas_index *index)
{
    const bool shared = index->local || sqlite3_db_readonly(index->db, "main");
    return shared ? FRACAS_OK : pragma(index, "PRAGMA locking_mode = EXCLUSIVE", "exclusive");
}

static fracas_err set_durability(fracas_index *index)
{
    TRY(set_locking(index));
    TRY(index->local ? pragma(index, "PRAGMA journal_mode = WAL", "wal")
                     : pragma(index, "PRAGMA journal_mode = TRUNCATE", "truncate"));
    TRY(pragma(index, "PRAGMA synchronous = FULL", NULL));
    return pragma(index, "PRAGMA synchronous", "2"); /* FULL */
}

/* Runs the printed statements. */
static fracas_err run_printed(fracas_index *index, void (*print)(FILE *out), const char *doing)
{
    OWNED char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return fracas_no_memory("the tables of the index");
    print(out);
    if (fclose(out) != 0) return fracas_no_memory("the tables of the index");
    if (sqlite3_exec(index->db, text, NULL, NULL, NULL) == SQLITE_OK) return FRACAS_OK;
    fracas_err err = fracas_index_error(index, doing);
    if (!sqlite3_get_autocommit(index->db)) sqlite3_exec(index->db, "ROLLBACK", NULL, NULL, NULL);
    return err;
}

static void print_creation(FILE *out)
{
    fputs("BEGIN IMMEDIATE;", out);
    fracas_index_print_schema(out);
    fprintf(out, "INSERT OR IGNORE INTO meta VALUES ('format_version', '%d'); COMMIT",
            FRACAS_FORMAT_VERSION);
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
    OWNED char *name = NULL;
    struct stat info;
    return fracas_path(&name, "%s-wal", path) || (stat(name, &info) == 0 && info.st_size > 0);
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

/* A rollback journal ending with the name of another file makes SQLite look there, and remove
 * it. fracas writes to one database at a time, whose journals name none. */
static fracas_err check_journal(const char *path)
{
    static const unsigned char mark[8] = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
    unsigned char end[sizeof mark];
    struct stat info;
    size_t got;
    OWN_FD fd = fracas_file_open(path);
    if (fd < 0) return errno == ENOENT ? FRACAS_OK : fracas_disk_fail("open", path);
    if (fstat(fd, &info) < 0) return fracas_disk_fail("read", path);
    if (info.st_size < (off_t)sizeof end) return FRACAS_OK;
    if (!fracas_disk_read(fd, (uint64_t)info.st_size - sizeof end, end, sizeof end, &got))
        return fracas_disk_fail("read", path);
    if (got < sizeof end || memcmp(end, mark, sizeof mark) != 0) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s names another file, as no journal of fracas does; move it away, and %s",
                       path, remedy);
}

/* The database, and SQLite's files beside it, are files and no links: SQLite would follow the one,
 * and wait for a pipe. */
static fracas_err check_names(const char *path)
{
    static const char *const tail[] = {"", "-wal", "-shm", "-journal"};
    for (size_t t = 0; t < FRACAS_COUNT(tail); t++) {
        OWNED char *name = NULL;
        TRY(fracas_path(&name, "%s%s", path, tail[t]));
        if (!fracas_file_is_own(name)) return fracas_disk_fail("open", name);
        if (t == FRACAS_COUNT(tail) - 1) TRY(check_journal(name));
    }
    return FRACAS_OK;
}

static fracas_err connect_to(fracas_index *index, const char *study, bool create)
{
    TRY(check_names(index->path));
    if (!create && access(index->path, F_OK) < 0 && errno == ENOENT)
        return fracas_fail(FRACAS_DAMAGED,
                           "%s is not there; `fracas reindex` makes it from the segments of a "
                           "study, `fracas run` a new study",
                           index->path);
    index->reading = !create;
    const bool keep_log = index->reading && has_log(index->path);
    if (create || (can_write(index->path) && can_write(study))) {
        /* A reader, too: only so does SQLite take its -wal and -shm away. */
        int flags = SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0);
        TRY(check(index, sqlite3_open_v2(index->path, &index->db, flags, NULL)));
    } else {
        TRY(connect_to_read(index));
    }
    return set_limits(index, keep_log);
}

/* Counts the tables, and the ones called `meta`. */
static fracas_err count_tables(fracas_index *index, int64_t *all, int64_t *meta)
{
    return fracas_sql_numbers(index,
                              "SELECT count(*), count(CASE name WHEN 'meta' THEN 1 END) FROM "
                              "sqlite_master WHERE type = 'table'",
                              NULL, 0, all, meta);
}

static fracas_err open_database(fracas_index *index, const char *study, bool create)
{
    int64_t all, meta;
    TRY(connect_to(index, study, create));
    sqlite3_busy_timeout(index->db, 5000);
    /* 8 MiB: as fast as 64, and less of rank 0's memory fills as realizations get done */
    TRY(pragma(index, "PRAGMA cache_size = -8192", NULL));
    TRY(index->reading ? set_locking(index) : set_durability(index));
    TRY(count_tables(index, &all, &meta));
    if (!all && !create)
        return fracas_fail(FRACAS_DAMAGED, "%s holds no index yet; `fracas run` makes one",
                           index->path);
    if (all && !meta)
        return fracas_fail(FRACAS_DAMAGED, "%s is no index of fracas; %s", index->path, remedy);
    if (create) {
        TRY(run_printed(index, print_creation, "create its tables"));
        TRY(fracas_disk_sync_folder(index->path));
    }
    TRY(check_objects(index));
    TRY(check_version(index));
    TRY(run_printed(index, fracas_index_print_check, "read its tables"));
    index->opened = true;
    return FRACAS_OK;
}

/* The tables of STUDY/index.sqlite; false if it cannot be read. */
static bool look_at_tables(const char *study, int64_t *all, int64_t *meta)
{
    OWN(fracas_index) index = calloc(1, sizeof *index);
    return index && !fracas_disk_join(study, "index.sqlite", &index->path) &&
           !connect_to(index, study, false) && !count_tables(index, all, meta);
}

bool fracas_index_exists(const char *study)
{
    int64_t all, meta;
    return look_at_tables(study, &all, &meta) && meta;
}

bool fracas_index_is_foreign(const char *study)
{
    int64_t all, meta;
    if (look_at_tables(study, &all, &meta)) return all && !meta;
    OWNED char *path = NULL;
    struct stat info;
    return !fracas_disk_join(study, "index.sqlite", &path) && !lstat(path, &info) &&
           info.st_size > 0;
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
    for (size_t s = 0; s < index->nstatements; s++) sqlite3_finalize(index->statement[s].prepared);
    free(index->statement);
    sqlite3_close(index->db);
    free(index->path);
    free(index);
}
