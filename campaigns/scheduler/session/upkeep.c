/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/upkeep.h"

#include "base/own.h"
#include "base/text.h"
#include "campaigns/scheduler/session/keep.h"
#include "campaigns/scheduler/session/meshes.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/session/rounds.h"
#include "campaigns/scheduler/session/failures.h"
#include "campaigns/scheduler/types/header.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/study.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- a locked study ---- */

typedef struct {
    const char *study;
    int lock;
    fracas_index *index;
    fracas_rounds rounds;
} holding;

static void holding_clear(holding *h)
{
    fracas_rounds_clear(&h->rounds);
    fracas_index_close(h->index);
    fracas_study_unlock(h->lock);
}

/* With the lock: recovers, plans, and decides complete rounds. */
static fracas_err resume(holding *h, const fracas_campaign *campaign, const fracas_said *said)
{
    OWNED char *report = NULL;
    TRY(fracas_study_plan(h->study, campaign, &h->index, &report));
    fracas_say_lines(said, report);
    return fracas_rounds_init(&h->rounds, campaign, h->index);
}

/* Opens an existing index, with its tables brought up to this version. */
static fracas_err open_index(const char *study, fracas_index **index)
{
    TRY(fracas_index_open(study, false, index)); /* fails if there is none */
    fracas_index_close(*index);
    return fracas_index_open(study, true, index);
}

/* ---- reindex ---- */

fracas_err fracas_upkeep_reindex(const char *study, const fracas_campaign *campaign,
                                 const fracas_said *said, fracas_index_counts *end)
{
    FRACAS_CLEARED(holding) h = {.study = study, .lock = -1};
    const fracas_file_header header = fracas_campaign_header(campaign);
    TRY(fracas_study_lock(study, false, &h.lock));
    TRY(fracas_study_reindex(study, &header, &campaign->table, said));
    TRY(fracas_index_open(study, true, &h.index));
    TRY(fracas_rounds_init(&h.rounds, campaign, h.index));
    return fracas_index_count(h.index, end);
}

/* ---- merge ---- */

fracas_err fracas_upkeep_merge(const char *study, const fracas_campaign *campaign,
                               const fracas_said *said, fracas_index_counts *end, bool *written)
{
    FRACAS_CLEARED(holding) h = {.study = study, .lock = -1};
    FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
    bool complete;
    int64_t failed;
    const fracas_file_header header = fracas_campaign_header(campaign);
    const fracas_mesh_source meshes = fracas_campaign_meshes(campaign);
    *written = false;
    TRY(fracas_study_lock(study, false, &h.lock));
    TRY(resume(&h, campaign, said));
    TRY(fracas_index_count(h.index, end));
    const int64_t missing = fracas_index_missing(end);
    if (missing)
        return fracas_fail(FRACAS_INTERRUPTED,
                           "%" PRId64 " of %" PRId64
                           " realizations of %s are not computed yet; `fracas run %s --study %s` "
                           "computes them",
                           missing, end->realizations, study,
                           fracas_shell_path(study, "campaign.yaml").text,
                           fracas_shell_path(study, NULL).text);
    TRY(fracas_rounds_check(campaign, h.index));
    TRY(fracas_study_is_complete(study, h.index, campaign, &complete, &failed));
    if (complete) return fracas_failure_report(study, h.index, &campaign->table);
    TRY(fracas_campaign_copy_make(campaign, &copy));
    TRY(fracas_study_merge(study, h.index, &header, &h.rounds.table, &meshes, &copy));
    *written = true;
    TRY(fracas_index_event(h.index, "merged", "study.h5 is written"));
    return fracas_failure_report(study, h.index, &campaign->table);
}

/* ---- a study of study.h5 ---- */

/* Segments and attachments alone: it was cut off. */
static fracas_err note_entry(void *any, const char *path, const char *name)
{
    (void)path;
    *(bool *)any |= strcmp(name, "segments") != 0 && strcmp(name, FRACAS_ATTACHMENTS) != 0;
    return FRACAS_OK;
}

static fracas_err check_empty(const char *folder)
{
    struct stat info;
    bool any = false;
    if (lstat(folder, &info) && errno == ENOENT) return FRACAS_OK;
    if (S_ISDIR(info.st_mode)) TRY(fracas_disk_each(folder, note_entry, &any));
    if (S_ISDIR(info.st_mode) && !any) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is there already, and is no empty folder: name a new one for the study; "
                       "if it is one that was cut off, `fracas merge %s` completes it",
                       folder, fracas_shell_path(folder, NULL).text);
}

fracas_err fracas_upkeep_unpack(const char *file, const fracas_campaign *campaign, bool results,
                                const char *study, const fracas_said *said,
                                fracas_index_counts *end)
{
    OWNED char *segments = NULL;
    bool written;
    *end = (fracas_index_counts){0};
    TRY(check_empty(study));
    TRY(fracas_folder_make(study));
    if (results) { /* first: with a campaign.yaml alone a run would compute them again */
        TRY(fracas_folder_make_own(study, "segments", &segments));
        TRY(fracas_study_bring(file, study));
    }
    TRY(fracas_campaign_keep(campaign, study, "campaign.yaml", NULL));
    if (!results) return FRACAS_OK;
    return fracas_upkeep_merge(study, campaign, said, end, &written);
}

/* ---- gc ---- */

fracas_err fracas_upkeep_collect(const char *study, const fracas_campaign *campaign, bool dry,
                                 bool merged,
                                 void (*found)(void *context, const fracas_collected *item),
                                 void *context, uint64_t *freed)
{
    FRACAS_CLEARED(holding) h = {.study = study, .lock = -1};
    fracas_collect_options options = {.dry = dry, .found = found, .context = context};
    for (const fracas_attached *a = campaign->attached; a; a = a->next) options.nattachments++;
    OWNED const char **digest = calloc(options.nattachments + 1, sizeof *digest);
    if (!digest) return fracas_no_memory("the files that the campaign names");
    size_t i = 0;
    for (const fracas_attached *a = campaign->attached; a; a = a->next)
        digest[i++] = a->attachment.digest;
    options.attachment = digest;
    TRY(fracas_study_lock(study, false, &h.lock));
    TRY(dry ? fracas_index_open(study, false, &h.index) : open_index(study, &h.index));
    const fracas_file_header header = fracas_campaign_header(campaign);
    if (merged && !dry) TRY(fracas_study_fold(study, h.index, &header));
    return fracas_study_collect(study, h.index, &options, freed);
}

/* ---- retry ---- */

fracas_err fracas_upkeep_retry(const char *study, const fracas_campaign *campaign, int64_t point,
                               int64_t *rows)
{
    FRACAS_CLEARED(holding) h = {.study = study, .lock = -1};
    const fracas_file_header header = fracas_campaign_header(campaign);
    if (point >= (int64_t)campaign->npoints)
        return fracas_fail(FRACAS_USAGE, "--point %" PRId64 ": %s has the points 0 to %zu", point,
                           study, campaign->npoints - 1);
    TRY(fracas_study_lock(study, false, &h.lock));
    TRY(open_index(study, &h.index));
    TRY(fracas_index_claim(h.index, &header)); /* refused: this program cannot recompute it */
    return fracas_index_retry(h.index, point < 0 ? NULL : &campaign->point[point].hash, rows);
}

/* ---- merge-studies ---- */

typedef struct {
    holding into, from;
    fracas_campaign *ours, *theirs;
    const fracas_campaign *longer; /* the longer campaign */
    const fracas_said *said;
} joining;

static void joining_clear(joining *j)
{
    holding_clear(&j->from);
    holding_clear(&j->into);
    fracas_campaign_destroy(j->ours);
    fracas_campaign_destroy(j->theirs);
}

static fracas_err read_campaign(const char *study, fracas_campaign **campaign)
{
    OWNED char *file = NULL;
    TRY(fracas_path(&file, "%s/campaign.yaml", study));
    fracas_err err = fracas_campaign_read(file, campaign);
    return err == FRACAS_USAGE
               ? fracas_fail_within(FRACAS_DAMAGED,
                                    "the campaign file of %s is damaged; restore it", study)
               : err;
}

/* Reads both campaigns; one must extend the other. */
static fracas_err choose_longer(joining *j)
{
    TRY(read_campaign(j->into.study, &j->ours));
    TRY(read_campaign(j->from.study, &j->theirs));
    j->longer = j->ours;
    if (!fracas_campaign_extends(j->ours, j->theirs)) return FRACAS_OK;
    j->longer = j->theirs;
    fracas_err err = fracas_campaign_extends(j->theirs, j->ours);
    if (!err) return FRACAS_OK;
    return fracas_fail_within(
        err, "%s (\"the study\") and %s are not of one campaign, and neither extends the other",
        j->into.study, j->from.study);
}

static fracas_err lock_both(joining *j)
{
    struct stat a, b;
    if (!stat(j->into.study, &a) && !stat(j->from.study, &b) && a.st_dev == b.st_dev &&
        a.st_ino == b.st_ino)
        return fracas_fail(FRACAS_USAGE, "%s and %s are one study; name two", j->into.study,
                           j->from.study);
    TRY(fracas_study_lock(j->into.study, false, &j->into.lock));
    return fracas_study_lock(j->from.study, false, &j->from.lock);
}

/* A damaged study is not joined: its own run computes again what it lost, and reads it here as it
 * is. */
static fracas_err check_whole(const char *study)
{
    OWN(fracas_index) index = NULL;
    if (!fracas_index_exists(study)) return FRACAS_OK;
    TRY(fracas_index_open(study, false, &index));
    fracas_err err = fracas_study_check_segments(study, index);
    if (err != FRACAS_DAMAGED) return err;
    return fracas_fail_within(err,
                              "nothing is taken from a damaged study; `fracas run %s --study %s` "
                              "repairs it",
                              fracas_shell_path(study, "campaign.yaml").text,
                              fracas_shell_path(study, NULL).text);
}

static fracas_err join(joining *j, fracas_joined *joined, int64_t *both, fracas_index_counts *end)
{
    const fracas_file_header header = fracas_campaign_header(j->longer);
    TRY(check_whole(j->from.study));
    TRY(resume(&j->from, j->theirs, j->said));
    TRY(resume(&j->into, j->ours, j->said));
    TRY(fracas_study_compare(j->into.study, j->into.index, j->from.study, j->from.index, &header,
                             &j->from.rounds.table, both));
    if (j->longer != j->ours) {
        fracas_rounds_clear(&j->into.rounds);
        fracas_index_close(j->into.index);
        j->into.index = NULL;
        TRY(resume(&j->into, j->longer, j->said));
    }
    /* Replicas planned by a rule are in no campaign file. */
    TRY(fracas_index_plan(j->into.index, &j->from.rounds.table));
    TRY(fracas_study_join(j->into.study, j->into.index, j->from.study, j->from.index,
                          &j->from.rounds.table, joined));
    TRY(fracas_index_set_part(j->into.index, 1, 1)); /* this study computes all the rest */
    fracas_rounds_clear(&j->into.rounds);
    /* More rounds may be complete now. */
    TRY(fracas_rounds_init(&j->into.rounds, j->longer, j->into.index));
    return fracas_index_count(j->into.index, end);
}

fracas_err fracas_upkeep_join(const char *into, const char *from, const fracas_said *said,
                              fracas_joined *joined, int64_t *both, fracas_index_counts *end)
{
    FRACAS_CLEARED(joining)
    j = {.into = {.study = into, .lock = -1}, .from = {.study = from, .lock = -1}, .said = said};
    *joined = (fracas_joined){0};
    *both = 0;
    TRY(choose_longer(&j));
    TRY(lock_both(&j));
    return join(&j, joined, both, end);
}
