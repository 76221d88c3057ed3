/* SPDX-License-Identifier: GPL-3.0-or-later */
/* STUDY/index.sqlite made anew from the segments. */
#include "base/file.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/index/index.h"
#include "campaigns/store/study.h"
#include "campaigns/store/upkeep.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* The files of a database: itself, and SQLite's beside it. */
static const char *const tail[] = {"", "-wal", "-shm", "-journal"};
enum { NTAILS = sizeof tail / sizeof *tail };

typedef struct {
    const char *study;
    const fracas_point_table *table;
    fracas_identity identity;
    const fracas_said *said;
    const char *nursery, *fresh, *old; /* STUDY/.reindex, its index.sqlite, STUDY/index.sqlite */
    fracas_index *index;               /* the new one */
    bool readable;                     /* the old one is there, sound and of this study */
} reindexing;

FRACAS_PRINTF(2, 3) static void say_line(const fracas_said *said, const char *format, ...)
{
    char text[1200];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    said->line(said->context, text);
}

void fracas_say_lines(const fracas_said *said, const char *text)
{
    for (size_t length; *text; text += length + (text[length] == '\n')) {
        length = strcspn(text, "\n");
        say_line(said, "%.*s", (int)length, text);
    }
}

/* ---- before ---- */

typedef struct {
    bool ours;        /* a segment of this format version is there */
    char *other;      /* path of the first one of another, */
    uint64_t version; /* which is this */
} versions;

static fracas_err note_version(void *context, const char *path, const char *name)
{
    versions *found = context;
    uint64_t version;
    if (found->ours || !fracas_disk_ends(name, ".h5")) return FRACAS_OK;
    fracas_err err = fracas_file_version(path, &version);
    if (err) return err == FRACAS_DAMAGED ? FRACAS_OK : err; /* a damaged one is removed later */
    found->ours = version == FRACAS_FORMAT_VERSION;
    if (found->ours || found->other) return FRACAS_OK;
    found->version = version;
    found->other = strdup(path);
    return found->other ? FRACAS_OK : fracas_no_memory("a file name");
}

/* A study of another format version is refused as such, not as one without any segment of ours. */
static fracas_err check_versions(const char *study)
{
    OWNED char *folder = NULL;
    versions found = {0};
    TRY(fracas_disk_join(study, "segments", &folder));
    fracas_err err = fracas_disk_each(folder, note_version, &found);
    OWNED char *other = found.other;
    if (err || found.ours || !other) return err;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s has format version %" PRIu64
                       "; this program reads %d: use the program version that wrote it, or compute "
                       "the study again in another folder",
                       other, found.version, FRACAS_FORMAT_VERSION);
}

/* Every page of the old index, before anything is taken from it. */
static fracas_err check_old(reindexing *r, fracas_index *old)
{
    fracas_identity found;
    char difference[FRACAS_DIFFERENCE_TEXT];
    OWNED char *text = NULL;
    TRY(fracas_sql_text(old, "PRAGMA integrity_check(1)", NULL, 0, &text));
    if (!text || strcmp(text, "ok") != 0)
        return fracas_fail(FRACAS_DAMAGED, "%s: damaged: %s", r->old, text ? text : "");
    TRY(fracas_index_identity(old, &found));
    if (fracas_identity_differs(&found, &r->identity, difference))
        return fracas_fail(FRACAS_DAMAGED, "%s: not of this study: %s", r->old, difference);
    return fracas_sql_checkpoint(old); /* so that its file alone is all of it */
}

static fracas_err look_at_old(reindexing *r)
{
    OWN(fracas_index) old = NULL;
    if (access(r->old, F_OK) < 0 && errno == ENOENT) return FRACAS_OK;
    fracas_err err = fracas_index_open(r->study, false, &old);
    if (!err) err = check_old(r, old);
    r->readable = !err;
    if (err != FRACAS_DAMAGED && err != FRACAS_BUG) return err; /* a bug: tables unlike ours */
    say_line(r->said, "the index before cannot be used: %s", fracas_message());
    say_line(r->said,
             "realizations that FAILED are computed again, for that index alone knew of them");
    return FRACAS_OK;
}

/* ---- the new index ---- */

static void drop_nursery(const reindexing *r)
{
    for (int t = 0; t < NTAILS; t++) {
        OWNED char *path = NULL;
        if (!fracas_path(&path, "%s%s", r->fresh, tail[t])) unlink(path);
    }
    rmdir(r->nursery);
}

static fracas_err clear_nursery(const reindexing *r)
{
    if (!fracas_folder_is_own(r->nursery)) return fracas_disk_fail("remove folder", r->nursery);
    drop_nursery(r);
    if (rmdir(r->nursery) == 0 || errno == ENOENT) return FRACAS_OK;
    return fracas_disk_fail("remove folder", r->nursery);
}

/* Plans as many replicas as in the old index where a rule decides their number. */
static fracas_err plan_as_before(reindexing *r)
{
    for (size_t p = 0; p < r->table->npoints; p++) {
        fracas_point_row point = r->table->point[p];
        int64_t replicas;
        if (!point.most) continue;
        TRY(fracas_sql_numbers(r->index,
                               "SELECT coalesce(max(r.replica) + 1, 0) FROM old.realization r JOIN "
                               "old.point q ON q.id = r.point WHERE q.hash = ?1 AND r.replica < ?2",
                               SQL_VALUES(SQL_HASH(&point.hash), SQL_INTEGER(point.most)),
                               &replicas, NULL));
        if (replicas > point.replicas) point.replicas = replicas;
        TRY(fracas_index_plan_point(r->index, &point));
    }
    return FRACAS_OK;
}

/* A failure holds unless a segment has the realization. */
static const char carried[] =
    "INSERT INTO main.event(time, kind, text) SELECT time, kind, text FROM old.event ORDER BY "
    "id;INSERT INTO main.meta SELECT key, value FROM old.meta WHERE key = 'part';UPDATE "
    "main.segment SET provenance = o.provenance FROM old.segment o WHERE o.name = "
    "main.segment.name AND o.bytes = main.segment.bytes AND o.checksum = "
    "main.segment.checksum;UPDATE main.realization SET attempts = o.attempts, reason = o.reason, "
    "outcome = CASE WHEN main.realization.status = 'planned' AND o.failed THEN o.outcome ELSE "
    "main.realization.outcome END, status = CASE WHEN main.realization.status = 'planned' AND "
    "o.failed THEN o.status ELSE main.realization.status END FROM (SELECT p.id AS point, "
    "r.replica, r.attempts, r.reason, r.outcome, r.status,  r.status IN ('failed', 'quarantined') "
    "AND r.segment IS NULL AS failed  FROM old.realization r JOIN old.point q ON q.id = r.point "
    "JOIN main.point p ON p.hash = q.hash  WHERE r.attempts > 0 OR r.status IN ('failed', "
    "'quarantined')) AS o WHERE main.realization.point = o.point AND main.realization.replica = "
    "o.replica;";

static fracas_err carry(reindexing *r)
{
    TRY(fracas_index_begin(r->index));
    fracas_err err = plan_as_before(r);
    if (!err) err = fracas_sql_script(r->index, carried);
    return fracas_index_end(r->index, err);
}

/* Takes over facts of the old index that no segment has. */
static fracas_err take_over(reindexing *r)
{
    if (!r->readable) return FRACAS_OK;
    TRY(fracas_sql_do(r->index, "ATTACH ?1 AS old", SQL_VALUES(SQL_TEXT(r->old))));
    TRY(carry(r)); /* its error may be the reason that the index stays attached */
    return fracas_sql_script(r->index, "DETACH old");
}

/* Prints the lines of the sweep, one for all adopted segments. */
static void tell(const reindexing *r, char *report)
{
    int64_t adopted = 0;
    for (char *line = strtok(report, "\n"); line; line = strtok(NULL, "\n")) {
        if (strncmp(line, "adopted ", 8) == 0) adopted++;
        else say_line(r->said, "%s", line);
    }
    say_line(r->said, "%" PRId64 " segments read", adopted);
}

static fracas_err fill(reindexing *r, const fracas_file_header *header)
{
    OWNED char *report = NULL;
    TRY(fracas_index_claim(r->index, header));
    TRY(fracas_study_recover(r->study, r->index, header, r->table, &report));
    tell(r, report);
    TRY(take_over(r));
    TRY(fracas_index_event(r->index, "reindexed", "index.sqlite is made anew from the segments"));
    return fracas_sql_checkpoint(r->index);
}

static fracas_err sync_file(const char *path)
{
    OWN_FD fd = fracas_file_open(path);
    return fd >= 0 && fsync(fd) == 0 ? FRACAS_OK : fracas_disk_fail("sync", path);
}

static fracas_err make(reindexing *r, const fracas_file_header *header)
{
    if (!fracas_folder_create(r->nursery)) return fracas_disk_fail("create", r->nursery);
    TRY(fracas_index_open(r->nursery, true, &r->index));
    fracas_err err = fill(r, header);
    fracas_index_close(r->index); /* removes its log, which is empty */
    r->index = NULL;
    return err ? err : sync_file(r->fresh);
}

/* ---- the exchange ---- */

/* Moves the old index away with all that SQLite has beside it, itself first: a log without its
 * database is nothing, but it must not be found beside another one. */
static fracas_err move_old(const reindexing *r)
{
    char day[32], stamp[64];
    struct tm utc;
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &utc);
    strftime(day, sizeof day, "%Y%m%dT%H%M%S", &utc);
    snprintf(stamp, sizeof stamp, ".before-%s.%09ld", day, now.tv_nsec);
    for (int t = 0; t < NTAILS; t++) {
        OWNED char *from = NULL;
        OWNED char *to = NULL;
        TRY(fracas_path(&from, "%s%s", r->old, tail[t]));
        TRY(fracas_path(&to, "%s%s%s", r->old, stamp, tail[t]));
        if (rename(from, to) < 0 && errno != ENOENT) return fracas_disk_fail("move away", from);
        if (t == 0 && access(to, F_OK) == 0) say_line(r->said, "the index before is %s", to);
    }
    return FRACAS_OK;
}

static fracas_err exchange(const reindexing *r)
{
    bool whole = r->readable; /* nothing of it is in a log */
    for (int t = 1; whole && t < NTAILS; t++) {
        OWNED char *path = NULL;
        struct stat info;
        TRY(fracas_path(&path, "%s%s", r->old, tail[t]));
        whole = stat(path, &info) < 0 || info.st_size == 0 || strcmp(tail[t], "-shm") == 0;
    }
    if (!whole) TRY(move_old(r));
    TRY(fracas_disk_sync_folder(r->old)); /* no log of the old one may come back beside the new */
    if (rename(r->fresh, r->old) < 0) return fracas_disk_fail("rename to", r->old);
    TRY(fracas_disk_sync_folder(r->old));
    return clear_nursery(r);
}

static fracas_err reindex(reindexing *r, const fracas_file_header *header)
{
    TRY(check_versions(r->study));
    TRY(clear_nursery(r)); /* an interrupted one's */
    TRY(look_at_old(r));
    fracas_err err = make(r, header);
    if (!err) err = exchange(r);
    if (err) drop_nursery(r); /* a full disk needs the room */
    return err;
}

fracas_err fracas_study_reindex(const char *study, const fracas_file_header *header,
                                const fracas_point_table *table, const fracas_said *said)
{
    OWNED char *nursery = NULL;
    OWNED char *fresh = NULL;
    OWNED char *old = NULL;
    TRY(fracas_disk_join(study, FRACAS_REINDEX_FOLDER, &nursery));
    TRY(fracas_disk_join(nursery, "index.sqlite", &fresh));
    TRY(fracas_disk_join(study, "index.sqlite", &old));
    reindexing r = {.study = study,
                    .table = table,
                    .said = said,
                    .nursery = nursery,
                    .fresh = fresh,
                    .old = old};
    fracas_identity_of(header, &r.identity);
    return reindex(&r, header);
}
