/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "base/json.h"
#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/upkeep.h"

#include <inttypes.h>
#include <stdio.h>

static const fracas_option options[] = {
    {"dry-run", NULL, "only say what it would remove"}, {"json", NULL, "print it as JSON"}, {0}};

typedef struct {
    fracas_json *json; /* NULL: in words */
    bool dry;
} printing;

static void print_item(void *context, const fracas_collected *item)
{
    const printing *p = context;
    if (!p->json) {
        printf("%s %s (%" PRIu64 " bytes): %s\n",
               !item->removed ? "left"
               : p->dry       ? "would free"
                              : "freed",
               item->path, item->bytes, item->why);
        return;
    }
    fracas_json_object(p->json, NULL);
    fracas_json_text(p->json, "path", item->path);
    fracas_json_integer(p->json, "bytes", (int64_t)item->bytes);
    fracas_json_boolean(p->json, "removed", item->removed);
    fracas_json_text(p->json, "why", item->why);
    fracas_json_close_object(p->json);
}

static fracas_err gc(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    const char *study = arguments->operand;
    const bool dry = fracas_given(arguments, "dry-run"),
               with_json = fracas_given(arguments, "json");
    fracas_json json;
    uint64_t freed = 0;
    printing p = {.json = with_json ? &json : NULL, .dry = dry};
    if (with_json) {
        fracas_json_begin(&json, stdout);
        fracas_json_object(&json, NULL);
        fracas_json_text(&json, "study", study);
        fracas_json_boolean(&json, "dry_run", dry);
        fracas_json_array(&json, "found");
    }
    fracas_err code = fracas_upkeep_collect(study, campaign, dry, print_item, &p, &freed);
    if (with_json) {
        fracas_json_close_array(&json);
        fracas_json_integer(&json, "bytes", (int64_t)freed);
        fracas_json_close_object(&json);
        fracas_json_end(&json);
    } else if (!code) {
        printf("%s: %" PRIu64 " bytes %s\n", study, freed, dry ? "would be freed" : "freed");
    }
    return code;
}

const fracas_command fracas_command_gc = {
    .name = "gc",
    .operand = "STUDY",
    .doc = "Removes from STUDY what nobody needs",
    .more = "\nHalf-written files, segments whose realizations another segment has, damaged ones "
            "that were set aside, what interrupted\n"
            "commands left behind, attachments that campaign.yaml does not name; and gives free "
            "pages of the index back. What it does not know it lists and leaves.\n",
    .options = options,
    .run_on = gc,
};
