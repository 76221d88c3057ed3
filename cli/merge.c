/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/upkeep.h"

#include "base/param.h"
#include "campaigns/campaign.h"

#include <stdio.h>

enum { JSON };
static const fracas_option options[] = {[JSON] = {"json", NULL, "print it as JSON"}};

static fracas_err merge(const fracas_arguments *arguments)
{
    const char *study = arguments->operand;
    fracas_campaign *campaign;
    fracas_cli_upkeep upkeep;
    fracas_upkeep end = {0};
    bool written = false;
    TRY(fracas_cli_read_campaign(study, &campaign));
    fracas_cli_upkeep_begin(&upkeep, study, arguments->value[JSON]);
    fracas_err code = fracas_upkeep_merge(study, campaign, &upkeep.said, &end, &written);
    if (!code || code == FRACAS_SOME_FAILED ||
        (code == FRACAS_INTERRUPTED && arguments->value[JSON])) {
        fracas_cli_upkeep_counts(&upkeep, &end);
        if (arguments->value[JSON]) fracas_json_boolean(&upkeep.json, "written", written);
        else printf("%s/study.h5 is %s\n", study, written ? "written" : "there already");
    }
    fracas_cli_upkeep_end(&upkeep);
    fracas_campaign_destroy(campaign);
    return code;
}

const fracas_command fracas_command_merge = {
    .name = "merge",
    .operand = "STUDY",
    .doc = "Writes STUDY/study.h5 from its segments, and computes nothing",
    .more = "\nWhat a run does at its end; for a study whose realizations are all there, as after "
            "`fracas reindex` or `fracas merge-studies`.\n"
            "Status 3, saying how many, if some are missing.\n",
    .options = options,
    .noptions = FRACAS_COUNT(options),
    .run = merge,
};
