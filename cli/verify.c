#include "cli/cli.h"

#include "base/json.h"
#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/meshes.h"
#include "campaigns/scheduler/rounds.h"
#include "campaigns/store/store.h"

#include <limits.h>
#include <unistd.h>

enum { JSON };
static const fracas_option options[] = {[JSON] = {"json", NULL, "print the problems as JSON"}};

static void print_problem(void *json, const char *problem)
{
    if (json) fracas_json_text(json, NULL, problem);
    else puts(problem);
}

/* Decisions on replicas against the realizations that they are made of. */
static fracas_err check_decisions(const char *study, const fracas_campaign *campaign)
{
    fracas_index *index;
    TRY(fracas_index_open(study, false, &index));
    fracas_err err = fracas_rounds_check(campaign, index);
    fracas_index_close(index);
    return err;
}

/* The campaign file of the study against study.h5, where there is one. */
static void verify_campaign(const char *study, void *json, int64_t *problems)
{
    fracas_campaign *campaign;
    fracas_reader *reader;
    char file[PATH_MAX];
    if (fracas_cli_read_campaign(study, &campaign)) {
        print_problem(json, fracas_message());
        ++*problems;
        return;
    }
    snprintf(file, sizeof file, "%s/study.h5", study);
    const fracas_mesh_source meshes = fracas_campaign_meshes(campaign);
    if (access(file, F_OK) == 0 && !*problems && !fracas_reader_open(file, &reader)) {
        if (!fracas_hash_equal(&fracas_reader_header(reader)->campaign, &campaign->hash)) {
            print_problem(json, "campaign.yaml is not the campaign of study.h5, which is older: run the file it was made from");
            ++*problems;
        } else if (fracas_reader_check_meshes(reader, &meshes) || check_decisions(study, campaign)) {
            print_problem(json, fracas_message());
            ++*problems;
        }
        fracas_reader_close(reader);
    }
    fracas_campaign_destroy(campaign);
}

static fracas_err verify_all(const char *study, void *json, int64_t *problems)
{
    TRY(fracas_study_verify(study, print_problem, json, problems));
    verify_campaign(study, json, problems);
    return FRACAS_OK;
}

static fracas_err verify(const fracas_arguments *arguments)
{
    const char *study = arguments->operand;
    int64_t problems = 0;
    fracas_err code;
    TRY(fracas_cli_check_study(study));
    if (arguments->value[JSON]) {
        fracas_json json;
        fracas_json_begin(&json, stdout);
        fracas_json_object(&json, NULL);
        fracas_json_text(&json, "study", study);
        fracas_json_array(&json, "problems");
        code = verify_all(study, &json, &problems);
        fracas_json_close_array(&json);
        fracas_json_boolean(&json, "sound", !code && !problems);
        fracas_json_close_object(&json);
        fracas_json_end(&json);
    } else {
        code = verify_all(study, NULL, &problems);
        if (!code && !problems) printf("%s is sound\n", study);
    }
    if (code || !problems) return code;
    return fracas_fail(FRACAS_DAMAGED, "%s has %lld problem%s", study, (long long)problems, problems > 1 ? "s" : "");
}

const fracas_command fracas_command_verify = {
    .name = "verify", .operand = "STUDY", .doc = "Checks every byte of STUDY",
    .more = "\nSizes and checksums of all segments, the index against them row by row, study.h5 record by record, campaign.yaml with the\n"
            "files it names, and every decision on replicas.\n"
            "Each problem is one line: what, where, and what to do. Status 5 if there is any.\n",
    .options = options, .noptions = FRACAS_COUNT(options), .run = verify,
};
