/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands on a study without computing: reindex, merge, merge-studies, gc. */
#include "cli/cli.h"

#include "base/json.h"
#include "base/param.h"
#include "base/text.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/upkeep.h"

#include <inttypes.h>
#include <stdio.h>

/* Actions as lines (in JSON: "said"), then counts of the study. */
typedef struct {
    const char *study;
    fracas_said said;
    fracas_json *json; /* NULL: in words */
    fracas_json writer;
    bool dry; /* gc --dry-run */
} output;

static void print_line(void *json, const char *text)
{
    if (json) fracas_json_text(json, NULL, text);
    else puts(text);
}

static void begin(output *out, const fracas_arguments *arguments)
{
    *out = (output){.study = arguments->operand};
    if (!fracas_given(arguments, "json")) return;
    out->json = &out->writer;
    fracas_json_begin(out->json, stdout);
    fracas_json_text(out->json, "study", out->study);
}

static void begin_lines(output *out, const fracas_arguments *arguments)
{
    begin(out, arguments);
    if (out->json) fracas_json_array(out->json, "said");
    out->said = (fracas_said){print_line, out->json};
}

/* After the last line. */
static void print_counts(const output *out, const fracas_index_counts *end)
{
    if (!out->json) {
        printf("%s: %" PRId64 " realizations, %" PRId64 " done in %" PRId64 " segments, %" PRId64
               " failed, %" PRId64 " missing\n",
               out->study, end->realizations, end->done, end->segments, end->failed,
               fracas_index_missing(end));
        return;
    }
    fracas_json_close(out->json);
    fracas_json_integer(out->json, "realizations", end->realizations);
    fracas_json_integer(out->json, "done", end->done);
    fracas_json_integer(out->json, "failed", end->failed);
    fracas_json_integer(out->json, "missing", fracas_index_missing(end));
    fracas_json_integer(out->json, "segments", end->segments);
}

/* In words, which command goes on. */
static void print_next(const output *out, const fracas_index_counts *end)
{
    const fracas_shell_word study = fracas_shell_path(out->study, NULL);
    if (out->json) return;
    if (fracas_index_missing(end))
        printf("`fracas run %s --study %s` computes what is missing\n",
               fracas_shell_path(out->study, "campaign.yaml").text, study.text);
    else printf("`fracas merge %s` writes study.h5\n", study.text);
}

/* Passes `code` on; after an error the output is ended, too. */
static fracas_err finish(output *out, fracas_err code)
{
    if (out->json) fracas_json_end(out->json);
    return code;
}

/* ---- reindex ---- */

static fracas_err reindex(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    output out;
    fracas_index_counts end;
    begin_lines(&out, arguments);
    fracas_err code = fracas_upkeep_reindex(out.study, campaign, &out.said, &end);
    if (!code) print_counts(&out, &end);
    if (!code) print_next(&out, &end);
    return finish(&out, code);
}

const fracas_command fracas_command_reindex = {
    .name = "reindex",
    .operand = "STUDY",
    .doc = "Makes the index of STUDY anew from its segments",
    .more = "\nFor an index.sqlite that is lost or damaged. Every segment is read; one that is "
            "damaged is set aside, one of another study\n"
            "is left and named. From an index that can still be read it takes over what no segment "
            "has: which realizations FAILED and why,\n"
            "attempts, provenance, events; one that cannot stays as index.sqlite.before-TIME. The "
            "new one takes its place when it is whole.\n",
    .options = fracas_json_option,
    .run_on = reindex,
};

/* ---- merge ---- */

static fracas_err merge(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    output out;
    fracas_index_counts end = {0};
    bool written = false;
    begin_lines(&out, arguments);
    fracas_err code = fracas_upkeep_merge(out.study, campaign, &out.said, &end, &written);
    if (!code || code == FRACAS_SOME_FAILED || (code == FRACAS_INTERRUPTED && out.json)) {
        print_counts(&out, &end);
        if (out.json) fracas_json_boolean(out.json, "written", written);
        else printf("%s/study.h5 is %s\n", out.study, written ? "written" : "there already");
    }
    return finish(&out, code);
}

const fracas_command fracas_command_merge = {
    .name = "merge",
    .operand = "STUDY",
    .doc = "Writes STUDY/study.h5 from its segments, and computes nothing",
    .more = "\nWhat a run does at its end; for a study whose realizations are all there, as after "
            "`fracas reindex` or `fracas merge-studies`.\n"
            "Status 3, saying how many, if some are missing.\n",
    .options = fracas_json_option,
    .run_on = merge,
};

/* ---- export --study ---- */

/* Before anything is written. */
static fracas_err check_whole(const char *file, const fracas_campaign *campaign)
{
    OWN(fracas_reader) reader = NULL;
    TRY(fracas_reader_open_old(file, &reader));
    return fracas_cli_check_values(reader, file, campaign, true);
}

fracas_err fracas_cli_unpack(const fracas_arguments *arguments, const char *folder)
{
    OWN(fracas_campaign) campaign = NULL;
    OWNED char *file = NULL;
    output out;
    fracas_index_counts end;
    bool ours;
    const bool named = fracas_cli_is_study_file(arguments->operand);
    TRY(fracas_path(&file, named ? "%s" : "%s/study.h5", arguments->operand));
    TRY(fracas_cli_campaign_of_file(file, &ours, &campaign));
    TRY(check_whole(file, campaign));
    begin_lines(&out, arguments);
    out.study = folder;
    const fracas_err code = fracas_upkeep_unpack(file, campaign, ours, folder, &out.said, &end);
    if (code && code != FRACAS_SOME_FAILED) return code;
    if (ours) print_counts(&out, &end);
    const fracas_shell_word study = fracas_shell_path(folder, NULL);
    printf("%s%s%s: `fracas run %s --study %s` %s\n", folder, ours ? "" : "/campaign.yaml",
           ours ? " is a study" : ", without the results, which are of another version of fracas",
           fracas_shell_path(folder, "campaign.yaml").text, study.text,
           ours ? "goes on with it" : "computes them");
    return code;
}

/* ---- merge-studies ---- */

static void print_joined(const output *out, const char *from, const fracas_joined *joined,
                         int64_t both)
{
    if (!out->json) {
        printf("from %s: %" PRId64 " realizations in %" PRId64 " segments, %" PRId64
               " failures; %" PRId64 " realizations are in both, and the same\n",
               from, joined->realizations, joined->segments, joined->failed, both);
        return;
    }
    fracas_json_text(out->json, "from", from);
    fracas_json_integer(out->json, "taken_realizations", joined->realizations);
    fracas_json_integer(out->json, "taken_segments", joined->segments);
    fracas_json_integer(out->json, "taken_failures", joined->failed);
    fracas_json_integer(out->json, "in_both", both);
}

static fracas_err merge_studies(const fracas_arguments *arguments)
{
    const char *from = arguments->second;
    output out;
    fracas_joined joined;
    fracas_index_counts end;
    int64_t both;
    TRY(fracas_cli_check_run(arguments->operand));
    TRY(fracas_cli_check_run(from));
    begin_lines(&out, arguments);
    fracas_err code = fracas_upkeep_join(out.study, from, &out.said, &joined, &both, &end);
    if (!code) {
        print_counts(&out, &end);
        print_joined(&out, from, &joined, both);
        print_next(&out, &end);
    }
    return finish(&out, code);
}

const fracas_command fracas_command_merge_studies = {
    .name = "merge-studies",
    .operand = "A",
    .second = "B",
    .doc = "Adds to study A what study B has of the same campaign",
    .more = "\nFor a campaign that was computed in two places, as by `fracas run FILE --part 1/2` "
            "and `--part 2/2`. The campaign of one may\n"
            "be an extension of the other's; program version, seed and output options must be the "
            "same. What both have is compared\n"
            "bit for bit before anything is copied: status 5 names the first difference. B stays "
            "as it is, and is refused if it is damaged.\n",
    .options = fracas_json_option,
    .run = merge_studies,
};

/* ---- gc ---- */

static const fracas_option gc_options[] = {
    {"dry-run", NULL, "only say what it would remove"},
    {"merged", NULL, "segments too: study.h5 stands for all"},
    {"json", NULL, "print it as JSON"},
    {0}};

static void print_item(void *context, const fracas_collected *item)
{
    const output *out = context;
    if (!out->json) {
        printf("%s %s (%" PRIu64 " bytes): %s\n",
               !item->removed ? "left"
               : out->dry     ? "would free"
                              : "freed",
               item->path, item->bytes, item->why);
        return;
    }
    fracas_json_object(out->json, NULL);
    fracas_json_text(out->json, "path", item->path);
    fracas_json_integer(out->json, "bytes", (int64_t)item->bytes);
    fracas_json_boolean(out->json, "removed", item->removed);
    fracas_json_text(out->json, "why", item->why);
    fracas_json_close(out->json);
}

static fracas_err gc(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    output out;
    uint64_t freed = 0;
    const bool merged = fracas_given(arguments, "merged");
    if (merged && fracas_given(arguments, "dry-run"))
        return fracas_fail(FRACAS_USAGE, "--dry-run says nothing of --merged: give one of the two");
    begin(&out, arguments);
    out.dry = fracas_given(arguments, "dry-run");
    if (out.json) fracas_json_boolean(out.json, "dry_run", out.dry);
    if (out.json) fracas_json_array(out.json, "found");
    fracas_err code = fracas_upkeep_collect(out.study, campaign, out.dry, merged, print_item, &out,
                                            &freed);
    if (out.json) {
        fracas_json_close(out.json);
        fracas_json_integer(out.json, "bytes", (int64_t)freed);
    } else if (!code) {
        printf("%s: %" PRIu64 " bytes %s\n", out.study, freed,
               out.dry ? "would be freed" : "freed");
    }
    return finish(&out, code);
}

const fracas_command fracas_command_gc = {
    .name = "gc",
    .operand = "STUDY",
    .doc = "Removes from STUDY what nobody needs",
    .more =
        "\nHalf-written files, segments whose realizations another segment has, damaged ones "
        "that were set aside, what interrupted\n"
        "commands left behind, attachments that campaign.yaml does not name; and gives free "
        "pages of the index back. What it does not know it lists and leaves.\n"
        "With --merged study.h5, once compared byte by byte, gets a second name in segments/ and "
        "stands for all others.\n",
    .options = gc_options,
    .run_on = gc,
};
