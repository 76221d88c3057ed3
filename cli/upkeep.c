/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/upkeep.h"

#include <inttypes.h>

static void print_line(void *json, const char *text)
{
    if (json) fracas_json_text(json, NULL, text);
    else puts(text);
}

void fracas_cli_upkeep_begin(fracas_cli_upkeep *upkeep, const char *study, bool json)
{
    *upkeep = (fracas_cli_upkeep){.study = study, .with_json = json};
    if (json) {
        fracas_json_begin(&upkeep->json, stdout);
        fracas_json_object(&upkeep->json, NULL);
        fracas_json_text(&upkeep->json, "study", study);
        fracas_json_array(&upkeep->json, "said");
    }
    upkeep->said = (fracas_said){print_line, json ? &upkeep->json : NULL};
}

void fracas_cli_upkeep_counts(fracas_cli_upkeep *upkeep, const fracas_upkeep *end)
{
    if (upkeep->with_json) {
        fracas_json_close_array(&upkeep->json);
        upkeep->closed = true;
        fracas_json_integer(&upkeep->json, "realizations", end->realizations);
        fracas_json_integer(&upkeep->json, "done", end->done);
        fracas_json_integer(&upkeep->json, "failed", end->failed);
        fracas_json_integer(&upkeep->json, "missing", end->missing);
        fracas_json_integer(&upkeep->json, "segments", end->segments);
        return;
    }
    printf("%s: %" PRId64 " realizations, %" PRId64 " done in %" PRId64 " segments, %" PRId64
           " failed, %" PRId64 " missing\n",
           upkeep->study, end->realizations, end->done, end->segments, end->failed, end->missing);
}

void fracas_cli_upkeep_next(const fracas_cli_upkeep *upkeep, const fracas_upkeep *end)
{
    if (upkeep->with_json) return;
    if (end->missing)
        printf("`fracas run %s/campaign.yaml --study %s` computes what is missing\n", upkeep->study,
               upkeep->study);
    else printf("`fracas merge %s` writes study.h5\n", upkeep->study);
}

void fracas_cli_upkeep_end(fracas_cli_upkeep *upkeep)
{
    if (!upkeep->with_json) return;
    if (!upkeep->closed) fracas_json_close_array(&upkeep->json);
    fracas_json_close_object(&upkeep->json);
    fracas_json_end(&upkeep->json);
}
