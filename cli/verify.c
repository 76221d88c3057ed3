/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "analysis/fit/fits.h"
#include "base/json.h"
#include "base/param.h"
#include "base/text.h"
#include "base/version.h"
#include "campaigns/scheduler/types/header.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/meshes.h"
#include "campaigns/scheduler/session/rounds.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/index.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/study.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const fracas_option options[] = {
    {"full", NULL, "read every dataset, and compare every row and record"},
    {"json", NULL, "print the problems as JSON"},
    {0}};

typedef struct {
    const char *study;
    bool full;
    fracas_json *json; /* NULL: text */
    FILE *notes;       /* printed after all problems; each ends with NUL */
    int64_t problems;
} verification;

static void print_problem(void *context, const char *problem)
{
    const verification *v = context;
    if (v->json) fracas_json_text(v->json, NULL, problem);
    else puts(problem);
}

static void keep_note(void *context, const char *text)
{
    const verification *v = context;
    fputs(text, v->notes);
    fputc('\0', v->notes);
}

/* Checks decisions on replicas against their realizations. */
static fracas_err check_decisions(const char *study, const fracas_campaign *campaign)
{
    OWN(fracas_index) index = NULL;
    TRY(fracas_index_open(study, false, &index));
    return fracas_rounds_check(campaign, index);
}

static void report(verification *v, const char *problem)
{
    print_problem(v, problem);
    v->problems++;
}

/* Some realizations are not computed yet, or a run is at work. */
static bool is_growing(const char *study)
{
    OWN(fracas_index) index = NULL;
    fracas_index_counts counts = {0};
    fracas_lock_state lock;
    char holder[FRACAS_HOLDER_TEXT];
    if (!fracas_study_lock_state(study, &lock, holder) && lock == FRACAS_LOCK_HELD) return true;
    return !fracas_index_open(study, false, &index) && !fracas_index_count(index, &counts) &&
           fracas_index_missing(&counts) > 0;
}

/* The campaign file of the study against study.h5, where there is one. */
static void verify_campaign(verification *v, const fracas_campaign *campaign)
{
    OWN(fracas_reader) reader = NULL;
    char file[PATH_MAX];
    snprintf(file, sizeof file, "%s/study.h5", v->study);
    if (access(file, F_OK) || v->problems || fracas_reader_open(file, &reader)) return;
    const fracas_mesh_source meshes = fracas_campaign_meshes(campaign);
    OWN(fracas_campaign) copied = NULL;
    if (fracas_cli_campaign_in(reader, file, &copied)) {
        report(v, fracas_message());
        return;
    }
    if (fracas_hash_equal(&fracas_reader_header(reader)->campaign, &campaign->hash)) {
        if ((v->full && fracas_reader_check_meshes(reader, &meshes)) ||
            check_decisions(v->study, campaign))
            report(v, fracas_message());
    } else if (is_growing(v->study)) {
        fprintf(v->notes,
                "study.h5 is older than campaign.yaml, which asks for more: `fracas run "
                "%s --study %s` goes on%c",
                fracas_shell_path(v->study, "campaign.yaml").text,
                fracas_shell_path(v->study, NULL).text, '\0');
    } else {
        report(v, "campaign.yaml is not the campaign of study.h5, which is older: run the file it "
                  "was made from");
    }
}

/* fits.csv, where there is one. */
static void verify_fits(verification *v)
{
    OWN(fracas_fits) fits = NULL;
    if (!fracas_fits_read(v->study, &fits)) return;
    if (!fracas_fits_older(v->study)) report(v, fracas_message());
    else fprintf(v->notes, "%s%c", fracas_message(), '\0');
}

static void note_alone(const verification *v, const fracas_file_header *header)
{
    if (header->format < FRACAS_FORMAT_VERSION)
        fprintf(v->notes,
                "study.h5 is of fracas %s, format version %lld: index and segments are not looked "
                "at; the version that wrote them verifies them%c",
                header->version, (long long)header->format, '\0');
    else
        fprintf(v->notes,
                "there is no campaign.yaml: study.h5 is read as it is, and held against the "
                "campaign in it alone%c",
                '\0');
}

/* Every value of a study.h5 that is read as it is, and no more. */
static fracas_err verify_alone(verification *v)
{
    OWN(fracas_reader) reader = NULL;
    char file[PATH_MAX];
    snprintf(file, sizeof file, "%s/study.h5", v->study);
    OWN(fracas_campaign) campaign = NULL;
    fracas_err err = fracas_reader_open_old(file, &reader);
    if (!err) err = fracas_cli_campaign_in(reader, file, &campaign);
    if (!err) err = fracas_cli_check_values(reader, file, campaign, v->full);
    if (err && err != FRACAS_DAMAGED) return err;
    if (err) report(v, fracas_message());
    else note_alone(v, fracas_reader_header(reader));
    return FRACAS_OK;
}

static fracas_err verify_all(verification *v)
{
    if (fracas_cli_alone(v->study)) return verify_alone(v);
    OWN(fracas_campaign) campaign = NULL;
    OWNED char *fault = NULL;
    if (fracas_cli_read_campaign(v->study, &campaign)) {
        fault = strdup(fracas_message());
        if (!fault) return fracas_no_memory("a message");
    }
    const fracas_file_header header = campaign ? fracas_campaign_header(campaign)
                                               : (fracas_file_header){0};
    const fracas_verify_options how = {.full = v->full,
                                       .table = campaign ? &campaign->table : NULL,
                                       .header = campaign ? &header : NULL,
                                       .say = print_problem,
                                       .note = keep_note,
                                       .context = v};
    TRY(fracas_study_verify(v->study, &how, &v->problems));
    if (fault) report(v, fault);
    else verify_campaign(v, campaign);
    verify_fits(v);
    return FRACAS_OK;
}

static void begin_json(const verification *v)
{
    fracas_json_begin(v->json, stdout);
    fracas_json_text(v->json, "study", v->study);
    fracas_json_boolean(v->json, "full", v->full);
    fracas_json_array(v->json, "problems");
}

/* The notes, and whether the study is sound. */
static void print_end(const verification *v, const char *notes, size_t size, bool sound)
{
    if (v->json) {
        fracas_json_close(v->json);
        fracas_json_array(v->json, "notes");
    }
    for (const char *note = notes; note < notes + size; note += strlen(note) + 1) {
        if (v->json) fracas_json_text(v->json, NULL, note);
        else printf("note: %s\n", note);
    }
    if (v->json) {
        fracas_json_close(v->json);
        fracas_json_boolean(v->json, "sound", sound);
        fracas_json_end(v->json);
    } else if (sound) {
        printf("%s is sound%s\n", v->study,
               v->full ? "" : " (sizes, checksums, index; --full compares every value)");
    }
}

static fracas_err verify(const fracas_arguments *arguments)
{
    OWNED char *notes = NULL;
    size_t size = 0;
    fracas_json json;
    verification v = {.study = arguments->operand,
                      .full = fracas_given(arguments, "full"),
                      .json = fracas_given(arguments, "json") ? &json : NULL};
    if (!fracas_cli_alone(v.study)) TRY(fracas_cli_check_study(v.study));
    v.notes = open_memstream(&notes, &size);
    if (!v.notes) return fracas_no_memory("the notes");
    if (v.json) begin_json(&v);
    fracas_err code = verify_all(&v);
    fclose(v.notes);
    print_end(&v, notes, size, !code && !v.problems);
    if (code || !v.problems) return code;
    return fracas_fail(FRACAS_DAMAGED, "%s has %lld problem%s", v.study, (long long)v.problems,
                       v.problems > 1 ? "s" : "");
}

const fracas_command fracas_command_verify = {
    .name = "verify",
    .operand = "STUDY",
    .doc = "Checks every byte of STUDY",
    .more = "\nSTUDY is a folder, or study.h5 alone.\n"
            "Sizes and checksums of all segments and of study.h5, the index, campaign.yaml with "
            "the files it names, and every decision on\n"
            "replicas. With --full also every dataset of every segment, the index against them row "
            "by row, and study.h5 against them\n"
            "record by record: what a fault of fracas or a hand in the index could have left.\n"
            "Each problem is one line: what, where, and what to do. Status 5 if there is any. What "
            "an interrupted run left is noted, and is\n"
            "no problem: the next run puts it right.\n",
    .options = options,
    .run = verify,
};
