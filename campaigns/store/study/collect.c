/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Needless files of a study: found, and removed. */
#include "base/file.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/index/index.h"
#include "campaigns/store/upkeep.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct {
    const char *study;
    fracas_index *index;
    const fracas_collect_options *options;
    fracas_known_segments known; /* by name */
    bool *needless;              /* each of them: it has no row */
    size_t nneedless;
    uint64_t freed;
} collection;

typedef enum { KEEP, REMOVE, LEAVE } fate;

static bool starts_with(const char *name, const char *start)
{
    return strncmp(name, start, strlen(start)) == 0;
}

/* Reports the fate of a file or an empty folder, and removes it. */
static fracas_err dispose(collection *c, const char *path, fate what, const char *why)
{
    struct stat info;
    if (what == KEEP) return FRACAS_OK;
    if (lstat(path, &info) < 0)
        return errno == ENOENT ? FRACAS_OK : fracas_disk_fail("look at", path);
    const uint64_t bytes = S_ISDIR(info.st_mode) ? 0 : (uint64_t)info.st_size;
    if (what == REMOVE && !c->options->dry && remove(path) < 0 && errno != ENOENT)
        return fracas_disk_fail("remove", path);
    if (what == REMOVE) c->freed += bytes;
    c->options->found(c->options->context, &(fracas_collected){path, bytes, why, what == REMOVE});
    return FRACAS_OK;
}

typedef struct {
    collection *c;
    fate (*judge)(const collection *c, const char *name, const char **why);
} judging;

static fracas_err judge_file(void *context, const char *path, const char *name)
{
    const judging *j = context;
    const char *why = "not of fracas, as far as it knows";
    const fate what = j->judge(j->c, name, &why);
    return dispose(j->c, path, what, why);
}

/* `folder`: in the study; "": itself. */
static fracas_err each(collection *c, const char *folder,
                       fate (*judge)(const collection *c, const char *name, const char **why))
{
    OWNED char *path = NULL;
    if (*folder) TRY(fracas_disk_join(c->study, folder, &path));
    if (path && !fracas_folder_is_own(path)) return fracas_disk_fail("remove files of", path);
    return fracas_disk_each(path ? path : c->study, judge_file, &(judging){c, judge});
}

/* ---- the study folder, and the leftovers of a reindex ---- */

static fate judge_nursery(const collection *c, const char *name, const char **why)
{
    (void)c;
    *why = "an index that was not finished";
    return starts_with(name, "index.sqlite") ? REMOVE : LEAVE;
}

/* "20260101T000000" and so many digits behind `mark`, then "", "-wal" and the like. */
static bool is_stamp(const char *text, const char *mark)
{
    static const char form[] = "########T######", *const tail[] = {"", "-wal", "-shm", "-journal"};
    for (const char *f = form; *f; f++, text++)
        if (*f == '#' ? *text < '0' || *text > '9' : *text != *f) return false;
    const size_t size = strlen(mark);
    if (strncmp(text, mark, size) != 0) return false;
    const size_t digits = strspn(text + size, "0123456789");
    for (size_t t = 0; digits > 0 && t < FRACAS_COUNT(tail); t++)
        if (strcmp(text + size + digits, tail[t]) == 0) return true;
    return false;
}

/* As a reindex names it, and, of an older version, fracas_file_set_aside. */
static bool is_replaced_index(const char *name)
{
    static const char start[] = "index.sqlite.before-";
    const char *stamp = name + sizeof start - 1;
    return starts_with(name, start) && (is_stamp(stamp, ".") || is_stamp(stamp, "Z-"));
}

static fate judge_study(const collection *c, const char *name, const char **why)
{
    static const char *const ours[] = {"campaign.yaml",
                                       "index.sqlite",
                                       "index.sqlite-wal",
                                       "index.sqlite-shm",
                                       "index.sqlite-journal",
                                       "lock",
                                       "study.h5",
                                       "segments",
                                       "attachments",
                                       "report",
                                       FRACAS_CHECKPOINTS,
                                       "fields",
                                       "fits.csv",
                                       "fits.csv.part",
                                       "export",
                                       "vtk",
                                       "pictures"};
    (void)c;
    for (size_t i = 0; i < sizeof ours / sizeof *ours; i++)
        if (strcmp(name, ours[i]) == 0) return KEEP;
    if (fracas_disk_is_temporary(name) || strcmp(name, "campaign.yaml.tmp") == 0)
        *why = "half written";
    else if (is_replaced_index(name)) *why = "an index that was replaced";
    else if (strcmp(name, FRACAS_REINDEX_FOLDER) == 0) *why = "of an interrupted reindex";
    else return LEAVE;
    return REMOVE;
}

/* ---- attachments ---- */

static fate judge_attachment(const collection *c, const char *name, const char **why)
{
    fracas_hash hash;
    for (size_t a = 0; a < c->options->nattachments; a++)
        if (strcmp(c->options->attachment[a], name) == 0) return KEEP;
    char digest[FRACAS_HASH_HEX];
    snprintf(digest, sizeof digest, "%.32s", name);
    if (!fracas_hash_parse(digest, &hash)) return LEAVE;
    const char *rest = name + strlen(digest);
    if (*rest && strcmp(rest, ".tmp") != 0) return LEAVE;
    *why = *rest ? "half written" : "campaign.yaml does not name it";
    return REMOVE;
}

/* ---- segments ---- */

static fate judge_segment(const collection *c, const char *name, const char **why)
{
    const fracas_known_segment *known = fracas_segment_of_name(&c->known, name);
    if (fracas_disk_is_temporary(name)) {
        *why = "half written";
        return REMOVE;
    }
    if (known) {
        *why = "another segment has each of its realizations";
        return c->needless[known - c->known.segment] ? REMOVE : KEEP;
    }
    if (fracas_disk_ends(name, ".damaged")) {
        *why = "a damaged segment that was set aside";
        return REMOVE;
    }
    if (fracas_disk_ends(name, ".h5"))
        *why = "not in the index; `fracas run` and `fracas merge` adopt it, if it is of this study";
    return LEAVE;
}

#define NEEDLESS "id NOT IN (SELECT segment FROM realization WHERE segment IS NOT NULL)"

static fracas_err list_needless(collection *c)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    c->needless = calloc(c->known.count + 1, sizeof *c->needless);
    if (!c->needless) return fracas_no_memory("the list of segments");
    TRY(fracas_sql_start(c->index, "SELECT name FROM segment WHERE " NEEDLESS, NULL, 0, &s));
    while (fracas_sql_next(c->index, s, &err)) {
        const char *name = (const char *)sqlite3_column_text(s, 0);
        const fracas_known_segment *known = name ? fracas_segment_of_name(&c->known, name) : NULL;
        if (known) c->needless[known - c->known.segment] = true;
        c->nneedless += known != NULL;
    }
    return err;
}

/* Before their files go: killed in between, they are found and known again; the other way round
 * they would be missed. */
static fracas_err forget_needless(collection *c)
{
    char text[96];
    if (!c->nneedless || c->options->dry) return FRACAS_OK;
    snprintf(text, sizeof text, "%zu segments that no realization needs are removed", c->nneedless);
    TRY(fracas_index_begin(c->index));
    fracas_err err = fracas_sql_script(c->index, "DELETE FROM segment WHERE " NEEDLESS);
    if (!err) err = fracas_index_event(c->index, "collected", text);
    return fracas_index_end(c->index, err);
}

static fracas_err collect_segments(collection *c)
{
    TRY(fracas_index_segments_by_name(c->index, &c->known));
    TRY(list_needless(c));
    TRY(forget_needless(c));
    return each(c, "segments", judge_segment);
}

/* ---- the index ---- */

/* Bytes of the database and of its log. */
static fracas_err index_bytes(const collection *c, uint64_t *bytes)
{
    static const char *const tail[] = {"", "-wal"};
    *bytes = 0;
    for (int t = 0; t < 2; t++) {
        OWNED char *path = NULL;
        struct stat info;
        TRY(fracas_path(&path, "%s%s", c->index->path, tail[t]));
        if (stat(path, &info) == 0) *bytes += (uint64_t)info.st_size;
    }
    return FRACAS_OK;
}

/* By which `before` exceeds the bytes of pages in use. */
static fracas_err free_pages(const collection *c, uint64_t before, uint64_t *bytes)
{
    int64_t used;
    TRY(fracas_sql_numbers(c->index,
                           "SELECT (page_count - freelist_count) * page_size FROM "
                           "pragma_page_count, pragma_freelist_count, pragma_page_size",
                           NULL, 0, &used, NULL));
    *bytes = before > (uint64_t)used ? before - (uint64_t)used : 0;
    return FRACAS_OK;
}

static fracas_err compact(collection *c)
{
    uint64_t before, after, freed;
    TRY(index_bytes(c, &before));
    if (c->options->dry) {
        TRY(free_pages(c, before, &freed));
    } else {
        TRY(fracas_sql_checkpoint(c->index));
        TRY(fracas_sql_script(c->index, "VACUUM"));
        TRY(fracas_sql_checkpoint(c->index));
        TRY(index_bytes(c, &after));
        freed = before > after ? before - after : 0;
    }
    c->freed += freed;
    if (freed)
        c->options->found(
            c->options->context,
            &(fracas_collected){c->index->path, freed, "free pages, and its log", true});
    return FRACAS_OK;
}

/* ---- all of it ---- */

static fracas_err collect(collection *c)
{
    TRY(each(c, FRACAS_REINDEX_FOLDER, judge_nursery));
    TRY(each(c, "", judge_study));
    TRY(collect_segments(c));
    TRY(each(c, "attachments", judge_attachment));
    return compact(c);
}

fracas_err fracas_study_collect(const char *study, fracas_index *index,
                                const fracas_collect_options *options, uint64_t *freed)
{
    collection c = {.study = study, .index = index, .options = options};
    fracas_err err = collect(&c);
    fracas_known_segments_clear(&c.known);
    free(c.needless);
    *freed = c.freed;
    return err;
}
