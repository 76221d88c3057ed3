/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/upkeep.h"

#include "campaigns/campaign.h"

#include <stdio.h>

static fracas_err merge(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    const char *study = arguments->operand;
    fracas_cli_upkeep upkeep;
    fracas_upkeep end = {0};
    bool written = false;
    fracas_cli_upkeep_begin(&upkeep, study, fracas_given(arguments, "json"));
    fracas_err code = fracas_upkeep_merge(study, campaign, &upkeep.said, &end, &written);
    if (!code || code == FRACAS_SOME_FAILED ||
        (code == FRACAS_INTERRUPTED && fracas_given(arguments, "json"))) {
        fracas_cli_upkeep_counts(&upkeep, &end);
        if (fracas_given(arguments, "json")) fracas_json_boolean(&upkeep.json, "written", written);
        else printf("%s/study.h5 is %s\n", study, written ? "written" : "there already");
    }
    fracas_cli_upkeep_end(&upkeep);
    return code;
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
