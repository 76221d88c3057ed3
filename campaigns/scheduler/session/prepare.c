/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/prepare.h"

#include "base/text.h"
#include "campaigns/scheduler/session/keep.h"
#include "campaigns/scheduler/types/header.h"
#include "campaigns/scheduler/types/packet.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/study.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- the campaign of a run ---- */

/* The replicas of a part must not depend on other runs. */
static fracas_err check_part(const fracas_run_options *options, const fracas_campaign *campaign)
{
    for (size_t p = 0; options->parts > 1 && p < campaign->npoints; p++)
        if (campaign->point[p].rule.maximum > 0)
            return fracas_fail(FRACAS_USAGE,
                               "--part %d/%d: in %s a rule decides the replicas of point %zu "
                               "(`replicas: {minimum: ..., until: ...}`) by all that are there, "
                               "which no part has; give a number of replicas, or leave --part out",
                               options->part, options->parts, options->file, p);
    return FRACAS_OK;
}

fracas_err fracas_run_campaign(const fracas_run_options *options, fracas_campaign **campaign)
{
    OWN(fracas_campaign) made = NULL;
    TRY(fracas_campaign_read(options->file, &made));
    if (options->replicas) {
        fracas_err err = fracas_campaign_replicas(made, options->replicas);
        if (err) return fracas_fail_within(err, "%s", options->file);
    }
    TRY(check_part(options, made));
    *campaign = made;
    made = NULL;
    return FRACAS_OK;
}

size_t fracas_run_part(int part, int parts, fracas_index_row *row, size_t count)
{
    if (parts < 2) return count;
    size_t mine = 0;
    for (size_t i = (size_t)part - 1; i < count; i += (size_t)parts) row[mine++] = row[i];
    return mine;
}

/* ---- the study ---- */

fracas_err fracas_study_folder(const fracas_run_options *options, const fracas_campaign *campaign,
                               char *study, size_t size)
{
    if (options->study && !*options->study)
        return fracas_fail(FRACAS_USAGE,
                           "--study is empty; name a folder, or leave it out for studies/%s",
                           campaign->name);
    struct stat found;
    if (options->study && !stat(options->study, &found) && !S_ISDIR(found.st_mode))
        return fracas_fail(FRACAS_USAGE, "--study %s is not a folder; name another, or remove it",
                           options->study);
    int n = options->study ? snprintf(study, size, "%s", options->study)
                           : snprintf(study, size, "studies/%s", campaign->name);
    if ((size_t)n < size) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE, "the path of the study is longer than %zu characters; choose another --study",
        size);
}

/* The index has points of `campaign` that the study's own file, `before`, does not have. */
static bool is_edited(const char *study, const fracas_campaign *before,
                      const fracas_campaign *campaign)
{
    OWN(fracas_index) index = NULL;
    return !fracas_index_open(study, false, &index) &&
           fracas_index_check_points(index, &before->table) == FRACAS_DAMAGED &&
           !fracas_index_check_points(index, &campaign->table);
}

fracas_err fracas_study_fits(const char *study, const fracas_campaign *campaign)
{
    OWNED char *path = NULL;
    TRY(fracas_path(&path, "%s/campaign.yaml", study));
    if (access(path, F_OK) && errno == ENOENT) return FRACAS_OK;
    OWN(fracas_campaign) before = NULL;
    fracas_err err = fracas_campaign_read(path, &before);
    if (err == FRACAS_USAGE)
        return fracas_fail_within(FRACAS_DAMAGED,
                                  "the study's own campaign file is damaged, or another version of "
                                  "fracas wrote it, which knows more: use that version, or another "
                                  "--study (or remove it and run again: it is written anew)");
    TRY(err);
    const bool extended = !fracas_campaign_extends(before, campaign);
    err = fracas_campaign_extends(campaign, before);
    if (err && extended)
        return fracas_fail_within(err,
                                  "%s has been extended since: `fracas run %s --study %s` goes on "
                                  "with it (or choose another --study)",
                                  study, fracas_shell_path(path, NULL).text,
                                  fracas_shell_path(study, NULL).text);
    if (err) {
        fracas_trouble trouble; /* a look at the index has words of its own */
        fracas_trouble_take(err, &trouble);
        if (is_edited(study, before, campaign))
            return fracas_fail(FRACAS_DAMAGED,
                               "%s is not the campaign of %s/index.sqlite: it is damaged, or was "
                               "edited; remove it and run again: it is written anew",
                               path, study);
        err = fracas_trouble_fail(&trouble);
    }
    if (err)
        return fracas_fail_within(err, "%s is a study of another campaign (choose another --study)",
                                  study);
    return FRACAS_OK;
}

fracas_err fracas_study_is_complete(const char *study, fracas_index *index,
                                    const fracas_campaign *campaign, bool *complete,
                                    int64_t *failed)
{
    *complete = false;
    *failed = 0;
    OWNED char *path = NULL;
    TRY(fracas_path(&path, "%s/study.h5", study));
    bool sealed;
    TRY(fracas_study_sealed(study, index, &sealed));
    if (!sealed) return FRACAS_OK;
    OWN(fracas_reader) reader = NULL;
    if (fracas_reader_open(path, &reader)) return FRACAS_OK; /* merge again */
    if (!fracas_hash_equal(&fracas_reader_header(reader)->campaign, &campaign->hash))
        return FRACAS_OK;
    fracas_index_counts counts;
    TRY(fracas_index_count(index, &counts));
    *complete = fracas_index_missing(&counts) == 0 &&
                counts.realizations == (int64_t)fracas_reader_realizations(reader);
    *failed = counts.failed;
    return FRACAS_OK;
}

/* The index is closed on return. */
static fracas_err look_at(const char *study, const fracas_campaign *campaign, bool *complete,
                          int64_t *failed)
{
    OWN(fracas_index) index = NULL;
    TRY(fracas_index_open(study, false, &index));
    TRY(fracas_study_is_complete(study, index, campaign, complete, failed));
    return *complete ? fracas_study_sound(study, index, complete) : FRACAS_OK;
}

static bool same_key(const char *a, const char *b)
{
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* The file of a complete study takes other keys of the report over: they are in no hash. */
static fracas_err keep_report_keys(const char *study, const char *file,
                                   const fracas_campaign *campaign)
{
    OWN(fracas_campaign) before = NULL;
    OWNED char *said = NULL;
    TRY(fracas_campaign_read(file, &before));
    const fracas_report_keys *was = &before->report, *is = &campaign->report;
    if (same_key(was->x, is->x) && same_key(was->series, is->series) &&
        same_key(was->panels, is->panels) && same_key(was->y, is->y))
        return FRACAS_OK;
    TRY(fracas_campaign_keep(campaign, study, "campaign.yaml", &said));
    if (said) fprintf(stderr, "fracas: %s", said);
    return FRACAS_OK;
}

fracas_err fracas_study_examine(const char *study, const fracas_campaign *campaign, bool force,
                                bool *complete, int64_t *failed)
{
    *complete = false;
    *failed = 0;
    OWNED char *file = NULL;
    TRY(fracas_path(&file, "%s/campaign.yaml", study));
    TRY(fracas_study_place(study));
    TRY(fracas_study_fits(study, campaign));
    if (!fracas_index_exists(study)) return fracas_campaign_keeps(campaign, study, "campaign.yaml");
    int lock;
    TRY(fracas_study_lock_to_look(study, force, &lock));
    fracas_err err = look_at(study, campaign, complete, failed);
    if (access(file, F_OK)) *complete = false;            /* to be written again */
    if (!err && *complete) fracas_checkpoints_end(study); /* left by a power cut, or written late */
    if (!err && *complete) err = keep_report_keys(study, file, campaign);
    close(lock);
    return err;
}

/* Puts `line` before the text *said, which may be NULL. */
static fracas_err put_before(const char *line, char **said)
{
    char *both = NULL;
    TRY(fracas_path(&both, "%s%s", line, *said ? *said : ""));
    free(*said);
    *said = both;
    return FRACAS_OK;
}

fracas_err fracas_study_plan(const char *study, const fracas_campaign *campaign,
                             fracas_index **index, char **report)
{
    OWN(fracas_index) made = NULL;
    OWNED char *said = NULL, *aside = NULL;
    const fracas_file_header header = fracas_campaign_header(campaign);
    *report = NULL;
    *index = NULL;
    TRY(fracas_study_fits(study, campaign));
    TRY(fracas_index_open(study, true, &made));
    TRY(fracas_index_claim(made, &header));
    TRY(fracas_campaign_keep(campaign, study, "campaign.yaml", &aside));
    TRY(fracas_study_recover(study, made, &header, &campaign->table, &said));
    if (aside) TRY(put_before(aside, &said));
    TRY(fracas_index_plan(made, &campaign->table));
    *index = made;
    *report = said;
    made = NULL;
    said = NULL;
    return FRACAS_OK;
}

static fracas_err note_takeover(fracas_index *index, int lock)
{
    char holder[FRACAS_HOLDER_TEXT], text[FRACAS_HOLDER_TEXT + 64];
    if (!fracas_study_took_over(lock, holder)) return FRACAS_OK;
    snprintf(text, sizeof text, "the lock, from a run that has ended without leaving it: %s",
             holder);
    return fracas_index_event(index, "took over", text);
}

fracas_err fracas_study_prepare(const char *study, const fracas_campaign *campaign, bool force,
                                int *lock, fracas_index **index, char **report)
{
    OWNED char *segments = NULL;
    TRY(fracas_study_place(study));
    TRY(fracas_folder_make(study));
    TRY(fracas_folder_make_own(study, "segments", &segments));
    TRY(fracas_study_lock(study, force, lock));
    fracas_err err = fracas_study_plan(study, campaign, index, report);
    if (!err) err = note_takeover(*index, *lock);
    if (!err) return FRACAS_OK;
    fracas_index_close(*index);
    free(*report);
    fracas_study_unlock(*lock);
    *index = NULL;
    *report = NULL;
    *lock = -1;
    return err;
}
