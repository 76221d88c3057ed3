/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/keep.h"

#include "base/file.h"
#include "base/param.h"
#include "base/text.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/index.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- folders and whole files ---- */

/* One that is there may be of a run that was killed before its sync; whose folder cannot be opened
 * is not ours, and not new. */
fracas_err fracas_folder_make(const char *path)
{
    OWNED char *part = NULL;
    TRY(fracas_path(&part, "%s", path));
    for (char *at = part + 1;; at++) {
        char here = *at;
        if (here != '/' && here != '\0') continue;
        *at = '\0';
        const bool made = mkdir(part, 0777) == 0;
        if (!made && errno != EEXIST)
            return fracas_fail_system(
                errno, "cannot create the folder %s (or choose another --study)", part);
        if (fracas_disk_sync_folder(part) && made) return FRACAS_ENVIRONMENT;
        if (here == '\0') return FRACAS_OK;
        *at = here;
    }
}

/* Writes FOLDER/NAME whole by `write`: under a temporary name, synced, renamed. */
static fracas_err write_whole(const char *folder, const char *name,
                              fracas_err (*write)(const void *content, FILE *out),
                              const void *content)
{
    OWNED char *path = NULL, *temporary = NULL;
    TRY(fracas_path(&path, "%s/%s", folder, name));
    TRY(fracas_path(&temporary, "%s.tmp", path));
    FILE *out = fracas_file_stream(fracas_file_create(temporary), "w");
    fracas_err err = FRACAS_OK;
    if (out) err = write(content, out);
    bool good = out && !err && !fflush(out) && !fsync(fileno(out));
    int reason = errno;
    if (out && fclose(out) && good) {
        good = false;
        reason = errno;
    }
    if (good && rename(temporary, path)) {
        good = false;
        reason = errno;
    }
    if (good) return fracas_disk_sync_folder(path);
    unlink(temporary);
    return err ? err : fracas_fail_system(reason, "cannot write %s", path);
}

static fracas_err campaign_to(const void *campaign, FILE *out)
{
    return fracas_campaign_write(campaign, out);
}

static fracas_err attachment_to(const void *content, FILE *out)
{
    const fracas_attachment *attachment = content;
    errno = 0;
    if (fwrite(attachment->text, 1, attachment->size, out) == attachment->size) return FRACAS_OK;
    return fracas_fail_system(errno, "cannot copy %s into the study", attachment->path);
}

/* True if the study has this content already. */
static bool is_copied(const char *folder, const fracas_attachment *attachment)
{
    OWNED char *path = NULL;
    char block[1 << 14];
    size_t at = 0, got;
    if (fracas_path(&path, "%s/%s", folder, attachment->digest)) return false;
    OWN(FILE) in = fracas_file_stream(fracas_file_open(path), "rb");
    if (!in) return false;
    while ((got = fread(block, 1, sizeof block, in)) > 0 && got <= attachment->size - at &&
           memcmp(block, attachment->text + at, got) == 0)
        at += got;
    return got == 0 && at == attachment->size && !ferror(in);
}

fracas_err fracas_folder_make_own(const char *folder, const char *name, char **path)
{
    TRY(fracas_path(path, "%s/%s", folder, name));
    return fracas_folder_create(*path) ? fracas_disk_sync_folder(*path)
                                       : fracas_fail_system(errno, "cannot create %s", *path);
}

/* Copies the files named in the campaign into the study, which then does not depend on the
 * originals. */
static fracas_err copy_attachments(const char *study, const fracas_campaign *campaign)
{
    OWNED char *folder = NULL;
    if (!campaign->attached) return FRACAS_OK;
    TRY(fracas_folder_make_own(study, FRACAS_ATTACHMENTS, &folder));
    for (const fracas_attached *a = campaign->attached; a; a = a->next)
        if (!is_copied(folder, &a->attachment))
            TRY(write_whole(folder, a->attachment.digest, attachment_to, &a->attachment));
    return FRACAS_OK;
}

/* ---- the campaign file of a folder ---- */

/* *text: the bytes of a file, a NUL behind them. */
static fracas_err bytes_of(const char *path, char **text)
{
    OWN(FILE) in = fracas_file_stream(fracas_file_open(path), "rb");
    size_t room = 0;
    *text = NULL;
    if (!in) return fracas_fail_system(errno, "cannot open %s", path);
    if (getdelim(text, &room, '\0', in) < 0 && !*text) return fracas_no_memory("a campaign file");
    return ferror(in) ? fracas_fail_system(errno, "cannot read %s", path) : FRACAS_OK;
}

/* The text names every file of the campaign by its copy. */
static bool names_copies(const char *text, const fracas_campaign *campaign)
{
    for (const fracas_attached *a = campaign->attached; a; a = a->next)
        if (!fracas_campaign_names(text, &a->attachment)) return false;
    return true;
}

typedef enum { ABSENT, SAME, OTHER, BY_HAND } kept_file;

/* Compares the file at `path` with a campaign: the same one; another as a run writes it; another
 * with changes by hand, or none. */
static fracas_err look_at(const char *path, const fracas_campaign *campaign, kept_file *what)
{
    OWN(fracas_campaign) before = NULL;
    OWNED char *text = NULL, *was = NULL, *is = NULL;
    size_t size;
    *what = ABSENT;
    if (access(path, F_OK) && errno == ENOENT && fracas_file_is_own(path)) return FRACAS_OK;
    TRY(bytes_of(path, &text));
    TRY(fracas_campaign_text(campaign, &is, &size));
    *what = SAME;
    if (strcmp(text, is) == 0) return FRACAS_OK;
    *what = BY_HAND;
    if (fracas_campaign_read(path, &before)) return FRACAS_OK;
    TRY(fracas_campaign_text(before, &was, &size));
    if (strcmp(was, is) == 0 && names_copies(text, campaign)) *what = SAME;
    else if (strcmp(was, text) == 0) *what = OTHER;
    return FRACAS_OK;
}

/* FRACAS_USAGE for a link or a file that may not be written. */
static fracas_err check_replaced(const char *path)
{
    struct stat info;
    if (!fracas_file_is_own(path))
        return fracas_fail(FRACAS_USAGE,
                           "%s is no file but a link, which is not replaced: put a file in its "
                           "place, or choose another --study",
                           path);
    if (lstat(path, &info) || (info.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH))) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is write-protected, and would be replaced: make it writable (chmod "
                       "u+w), or choose another --study",
                       path);
}

fracas_err fracas_campaign_keeps(const fracas_campaign *campaign, const char *folder,
                                 const char *name)
{
    OWNED char *path = NULL;
    kept_file what;
    TRY(fracas_path(&path, "%s/%s", folder, name));
    TRY(look_at(path, campaign, &what));
    if (what == ABSENT || what == SAME) return FRACAS_OK;
    TRY(check_replaced(path));
    if (what == OTHER) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is not as a run writes it, and would be replaced: move it away and run "
                       "again, or choose another --study",
                       path);
}

/* Gives a file with changes by hand another name, which *said tells. */
static fracas_err set_aside(const char *path, char **said)
{
    OWNED char *aside = NULL;
    TRY(fracas_file_set_aside(path, &aside));
    return aside ? fracas_path(said, "%s had changes by hand; it is %s now\n", path, aside)
                 : FRACAS_OK;
}

fracas_err fracas_campaign_keep(const fracas_campaign *campaign, const char *folder,
                                const char *name, char **said)
{
    OWNED char *path = NULL;
    kept_file what;
    if (said) *said = NULL;
    TRY(fracas_folder_make(folder));
    TRY(fracas_path(&path, "%s/%s", folder, name));
    TRY(look_at(path, campaign, &what));
    if (!said) TRY(fracas_campaign_keeps(campaign, folder, name));
    TRY(copy_attachments(folder, campaign));
    if (what == SAME) return FRACAS_OK;
    if (what != ABSENT) TRY(check_replaced(path));
    if (what == BY_HAND && said) TRY(set_aside(path, said));
    return write_whole(folder, name, campaign_to, campaign);
}

/* ---- whose the folder of a study is ---- */

static const char SIGNED[] = "host="; /* a lock that a run has */

/* STUDY/NAME is a regular file, not empty, that begins in this way; true without memory, too. */
static bool has(const char *study, const char *name, const char *begin)
{
    struct stat info;
    OWNED char *path = NULL;
    return fracas_path(&path, "%s/%s", study, name) ||
           (!lstat(path, &info) && S_ISREG(info.st_mode) && info.st_size > 0 &&
            fracas_file_begins(path, begin));
}

static fracas_err note_segment(void *found, const char *path, const char *name)
{
    uint64_t version;
    bool *any = found;
    *any = *any || (fracas_disk_ends(name, ".h5") && !fracas_file_version(path, &version));
    return FRACAS_OK;
}

/* It has an index or a segment. */
static bool has_results(const char *study)
{
    OWNED char *segments = NULL;
    bool any = false;
    if (fracas_index_exists(study) || fracas_path(&segments, "%s/segments", study)) return true;
    return fracas_disk_each(segments, note_segment, &any) || any;
}

/* A run has made it: it has an index, a resolved campaign or a segment. */
static bool is_study(const char *study)
{
    return has(study, "campaign.yaml", FRACAS_RESOLVED) || has_results(study);
}

/* Without an index and segments a study.h5 is not the run's: somebody has put it there, and a run
 * would begin anew and replace it. */
static fracas_err keep_file(const char *study)
{
    OWNED char *path = NULL;
    uint64_t version;
    TRY(fracas_path(&path, "%s/study.h5", study));
    if (has_results(study) || fracas_file_version(path, &version) || has_results(study))
        return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is there without the index and the segments of its run, which would "
                       "begin anew and replace it: `fracas export %s --study NEW` makes a study of "
                       "it, or move it away",
                       path, fracas_shell_path(study, "study.h5").text);
}

static fracas_err note_entry(void *any, const char *path, const char *name)
{
    (void)path, (void)name;
    *(bool *)any = true;
    return FRACAS_OK;
}

/* STUDY/NAME is nothing that a run leaves which was killed before its first segment: an empty
 * file or folder; a file that begins in this way. */
static bool is_foreign(const char *path, const char *begin)
{
    struct stat info;
    bool any = false;
    if (lstat(path, &info)) return false;
    if (S_ISDIR(info.st_mode)) return fracas_disk_each(path, note_entry, &any) || any;
    if (!S_ISREG(info.st_mode)) return !S_ISFIFO(info.st_mode);
    return info.st_size > 0 && !(begin && fracas_file_begins(path, begin));
}

/* It cannot be read while a run makes it, which has the lock. */
static bool is_foreign_index(const char *study)
{
    return fracas_index_is_foreign(study) && !has(study, "lock", SIGNED);
}

fracas_err fracas_study_place(const char *study)
{
    static const struct {
        const char *name, *begin;
    } ours[] = {{"campaign.yaml", NULL},    {"study.h5", NULL},
                {"index.sqlite", NULL},     {"segments", NULL},
                {"report", NULL},           {"fields", NULL},
                {FRACAS_CHECKPOINTS, NULL}, {"fits.csv", NULL},
                {"lock", SIGNED},           {"campaign.yaml.tmp", FRACAS_RESOLVED}};
    if (is_study(study)) return keep_file(study);
    for (size_t i = 0; i < FRACAS_COUNT(ours); i++) {
        OWNED char *path = NULL;
        TRY(fracas_path(&path, "%s/%s", study, ours[i].name));
        const bool index = strcmp(ours[i].name, "index.sqlite") == 0;
        const bool foreign = index ? is_foreign_index(study) : is_foreign(path, ours[i].begin);
        if (foreign && !is_study(study)) /* a run may have begun since the first look */
            return fracas_fail(FRACAS_USAGE,
                               "%s is there already, and no run of fracas wrote it: choose another "
                               "folder for the study (--study), or move it away",
                               path);
    }
    return FRACAS_OK;
}
