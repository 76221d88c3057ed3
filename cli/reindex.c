/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/upkeep.h"

#include "campaigns/campaign.h"

static fracas_err reindex(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    fracas_cli_upkeep upkeep;
    fracas_upkeep end;
    fracas_cli_upkeep_begin(&upkeep, arguments->operand, fracas_given(arguments, "json"));
    fracas_err code = fracas_upkeep_reindex(arguments->operand, campaign, &upkeep.said, &end);
    if (!code) fracas_cli_upkeep_counts(&upkeep, &end);
    if (!code) fracas_cli_upkeep_next(&upkeep, &end);
    fracas_cli_upkeep_end(&upkeep);
    return code;
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
