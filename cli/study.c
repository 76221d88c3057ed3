/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The study of a command: a folder, or study.h5 alone with the campaign in it. */
#include "analysis/analysis.h"
#include "base/file.h"
#include "base/text.h"
#include "base/version.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/meshes.h"
#include "campaigns/scheduler/types/header.h"
#include "campaigns/store/datafile.h"
#include "cli/cli.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* STUDY/NAME is not there. */
static bool lacks(const char *study, const char *name)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", study, name);
    return access(path, F_OK) && errno == ENOENT;
}

bool fracas_cli_alone(const char *study)
{
    char file[PATH_MAX];
    uint64_t version;
    snprintf(file, sizeof file, "%s/study.h5", study);
    if (access(file, F_OK)) return false;
    if (lacks(study, "campaign.yaml")) /* not one that a study has lost */
        return lacks(study, "index.sqlite") && lacks(study, "segments");
    return !fracas_file_version(file, &version) && version < FRACAS_FORMAT_VERSION;
}

static fracas_err refuse_alone(const char *study)
{
    char file[PATH_MAX];
    uint64_t version;
    snprintf(file, sizeof file, "%s/study.h5", study);
    if (!fracas_file_version(file, &version) && version < FRACAS_FORMAT_CAMPAIGN)
        return fracas_fail(
            FRACAS_DAMAGED,
            "%s has a study.h5 of an earlier version of fracas, to look at by report, "
            "export, compare, fit, picture and verify: the version that wrote it goes "
            "on with it, or run its campaign file anew",
            study);
    return fracas_fail(FRACAS_DAMAGED,
                       "%s has study.h5 alone, to look at by report, export, compare, fit, "
                       "picture, replay, plan, sample and verify: this command needs the whole "
                       "study, which `fracas export %s --study NEW` makes of it",
                       study, fracas_shell_path(study, "study.h5").text);
}

fracas_err fracas_cli_check_study(const char *study)
{
    char file[PATH_MAX];
    snprintf(file, sizeof file, "%s/campaign.yaml", study);
    if (!access(file, R_OK)) return FRACAS_OK;
    const int reason = errno;
    if (reason == ENOTDIR)
        return fracas_fail(FRACAS_DAMAGED,
                           "%s is no study: name a study's folder, or its file study.h5, which "
                           "must have that name",
                           study);
    if (fracas_cli_alone(study)) return refuse_alone(study);
    return fracas_fail(FRACAS_DAMAGED, "%s is no study: %s: %s; `fracas run FILE` makes one", study,
                       file, strerror(reason));
}

/* No run has been where study.h5 is without an index and segments. */
static bool is_put_there(const char *study)
{
    return lacks(study, "index.sqlite") && lacks(study, "segments") && !lacks(study, "study.h5");
}

fracas_err fracas_cli_check_run(const char *study)
{
    TRY(fracas_cli_check_study(study));
    if (!is_put_there(study)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s has a study.h5 without the index and the segments of its run, from "
                       "which studies are merged: `fracas export %s --study NEW` makes a study "
                       "with them; if index and segments were lost, `fracas reindex %s` makes an "
                       "index",
                       study, fracas_shell_path(study, "study.h5").text,
                       fracas_shell_path(study, NULL).text);
}

/* Somebody has put a study.h5 beside the campaign file of another. */
static fracas_err check_pair(const char *study, const fracas_campaign *campaign)
{
    char file[PATH_MAX];
    OWN(fracas_reader) reader = NULL;
    snprintf(file, sizeof file, "%s/study.h5", study);
    if (!is_put_there(study) || fracas_reader_open(file, &reader) ||
        fracas_hash_equal(&fracas_reader_header(reader)->campaign, &campaign->hash))
        return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s is of another campaign than the campaign.yaml beside it, and is there "
                       "without the index and the segments of its run: `fracas export %s --study "
                       "NEW` makes a study of it, or move it away",
                       file, fracas_shell_path(study, "study.h5").text);
}

fracas_err fracas_cli_read_campaign(const char *study, fracas_campaign **campaign)
{
    char file[PATH_MAX];
    OWN(fracas_campaign) made = NULL;
    *campaign = NULL;
    TRY(fracas_cli_check_study(study));
    snprintf(file, sizeof file, "%s/campaign.yaml", study);
    fracas_err code = fracas_campaign_read(file, &made);
    if (!code) code = check_pair(study, made);
    if (!code) {
        *campaign = made;
        made = NULL;
    }
    if (code != FRACAS_USAGE) return code;
    return fracas_fail_within(
        FRACAS_DAMAGED, "the study's campaign file is damaged, or another version of fracas "
                        "wrote it, which knows more: use that version, or remove it and run the "
                        "campaign file it was made from, or restore it");
}

/* ---- the campaign in a file ---- */

bool fracas_cli_is_study_file(const char *path)
{
    static const char signature[] = "\x89HDF\r\n\x1a\n";
    struct stat info;
    return !stat(path, &info) && S_ISREG(info.st_mode) && info.st_size > 0 &&
           fracas_file_begins(path, signature);
}

static bool is_ours(const fracas_reader *reader)
{
    return strcmp(fracas_reader_header(reader)->version, FRACAS_VERSION) == 0;
}

fracas_err fracas_cli_campaign_in(fracas_reader *reader, const char *file,
                                  fracas_campaign **campaign)
{
    const fracas_file_header *header = fracas_reader_header(reader);
    FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
    OWN(fracas_campaign) made = NULL;
    *campaign = NULL;
    TRY(fracas_reader_campaign(reader, &copy));
    if (!copy.text && header->format >= FRACAS_FORMAT_CAMPAIGN)
        return fracas_fail(FRACAS_DAMAGED,
                           "%s: /campaign is not there, which files of format version %d have: the "
                           "file is damaged, or was edited: get another copy",
                           file, FRACAS_FORMAT_CAMPAIGN);
    if (!copy.text) return FRACAS_OK;
    const fracas_err err = fracas_campaign_copy_read(&copy, file, &made);
    if (err == FRACAS_USAGE)
        return fracas_fail_within(FRACAS_DAMAGED,
                                  "the campaign in the file is damaged, or not for this version, "
                                  "%s: fracas %s wrote it",
                                  FRACAS_VERSION, header->version);
    TRY(err);
    if (is_ours(reader) && !fracas_hash_equal(&header->campaign, &made->hash))
        return fracas_fail(FRACAS_DAMAGED,
                           "%s: /campaign is not the campaign of its results: the file is damaged, "
                           "or was edited",
                           file);
    *campaign = made;
    made = NULL;
    return FRACAS_OK;
}

static fracas_err pass(void *context, fracas_result *result)
{
    (void)context, (void)result;
    return FRACAS_OK;
}

/* Points, attributes and meshes of results of this version against the campaign. */
static fracas_err check_against(fracas_reader *reader, const char *file,
                                const fracas_campaign *campaign, bool full)
{
    const fracas_mesh_source meshes = fracas_campaign_meshes(campaign);
    const fracas_file_header *is = fracas_reader_header(reader),
                             should = fracas_campaign_header(campaign);
    if (is->seed != should.seed || is->history != should.history ||
        is->interfaces != should.interfaces || is->reactions != should.reactions)
        return fracas_fail(FRACAS_DAMAGED,
                           "%s: an attribute, seed, history, interfaces or reactions, is not that "
                           "of the campaign in it: the file is damaged, or was edited",
                           file);
    TRY(fracas_reader_check_points(reader, &campaign->table));
    return full ? fracas_reader_check_meshes(reader, &meshes) : FRACAS_OK;
}

fracas_err fracas_cli_check_values(fracas_reader *reader, const char *file,
                                   const fracas_campaign *campaign, bool full)
{
    if (campaign && is_ours(reader)) TRY(check_against(reader, file, campaign, full));
    TRY(fracas_reader_each(reader, FRACAS_READ_ALL, pass, NULL));
    for (size_t p = 0; p < fracas_reader_points(reader)->npoints; p++) {
        FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
        TRY(fracas_reader_mesh(reader, p, &mesh));
    }
    return FRACAS_OK;
}

/* ---- a file that is damaged ---- */

/* Some value cannot be read, but not because a later version of fracas wrote the file. */
static bool is_broken(const char *file)
{
    OWN(fracas_reader) reader = NULL;
    uint64_t version;
    fracas_err err = fracas_reader_open_old(file, &reader);
    if (!err) err = fracas_cli_check_values(reader, file, NULL, false);
    return err == FRACAS_DAMAGED &&
           (fracas_file_version(file, &version) || version <= FRACAS_FORMAT_VERSION);
}

fracas_err fracas_cli_remedy(const char *operand, fracas_err err)
{
    char file[PATH_MAX];
    const bool named = operand && fracas_cli_is_study_file(operand);
    if (err != FRACAS_DAMAGED || !operand) return err;
    OWNED char *said = strdup(fracas_message());
    snprintf(file, sizeof file, named ? "%s" : "%s/study.h5", operand);
    if (!said || access(file, F_OK) || !is_broken(file))
        return said ? fracas_fail(err, "%s", said) : err;
    if (named || fracas_cli_alone(operand))
        return fracas_fail(err,
                           "%s; %s is damaged: get another copy, or "
                           "`fracas merge` the study that it is from",
                           said, file);
    return fracas_fail(err,
                       "%s; %s is damaged: remove it, and `fracas merge "
                       "%s` makes it again",
                       said, file, fracas_shell_path(operand, NULL).text);
}

fracas_err fracas_cli_campaign_of_file(const char *file, bool *ours, fracas_campaign **campaign)
{
    OWN(fracas_reader) reader = NULL;
    TRY(fracas_reader_open_old(file, &reader));
    if (ours) *ours = is_ours(reader);
    TRY(fracas_cli_campaign_in(reader, file, campaign));
    if (*campaign) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s has no campaign (format version %" PRId64
                       "; study.h5 has it since 6): name the campaign file, or the study's folder",
                       file, fracas_reader_header(reader)->format);
}

fracas_err fracas_cli_campaign_of(const char *study, fracas_campaign **campaign)
{
    char file[PATH_MAX];
    if (!fracas_cli_alone(study)) return fracas_cli_read_campaign(study, campaign);
    snprintf(file, sizeof file, "%s/study.h5", study);
    return fracas_cli_campaign_of_file(file, NULL, campaign);
}

fracas_err fracas_cli_campaign_seen(const char *study, fracas_campaign **campaign)
{
    char file[PATH_MAX];
    OWN(fracas_reader) reader = NULL;
    *campaign = NULL;
    if (!fracas_cli_alone(study)) return fracas_cli_read_campaign(study, campaign);
    snprintf(file, sizeof file, "%s/study.h5", study);
    TRY(fracas_reader_open_old(file, &reader));
    if (!is_ours(reader)) return FRACAS_OK;
    return fracas_cli_campaign_in(reader, file, campaign);
}

fracas_err fracas_cli_analyse(const char *study, fracas_campaign **campaign,
                              fracas_analysis **analysis)
{
    TRY(fracas_cli_campaign_seen(study, campaign));
    const fracas_campaign *known = *campaign;
    if (fracas_cli_alone(study)) TRY(fracas_analysis_create(study, NULL, NULL, analysis));
    else TRY(fracas_analysis_create(study, &known->hash, &known->table, analysis));
    if (known && known->common_random_numbers) fracas_analysis_share_numbers(*analysis);
    return FRACAS_OK;
}

fracas_err fracas_cli_read_file(const char *file, fracas_campaign **campaign)
{
    return fracas_cli_is_study_file(file) ? fracas_cli_campaign_of_file(file, NULL, campaign)
                                          : fracas_campaign_read(file, campaign);
}
