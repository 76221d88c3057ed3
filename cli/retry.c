/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/run_options.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/upkeep.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>

static const fracas_option options[] = {
    FRACAS_RUN_OPTIONS,
    {"failed", NULL, "those that FAILED; there is nothing else to retry"},
    {"point", "P", "those of point P, from 0 (all)"},
    {0}};

static fracas_err plan_again(const char *study, int point)
{
    OWN(fracas_campaign) campaign = NULL;
    int64_t rows = 0;
    TRY(fracas_cli_read_campaign(study, &campaign));
    TRY(fracas_upkeep_retry(study, campaign, point, &rows));
    fprintf(stderr, "fracas: %" PRId64 " failed realizations of %s are planned again\n", rows,
            study);
    return FRACAS_OK;
}

static fracas_err retry(const fracas_arguments *arguments)
{
    int point = -1;
    TRY(fracas_arguments_integer(arguments, "point", 0, INT_MAX, &point));
    if (!fracas_given(arguments, "failed"))
        return fracas_fail(FRACAS_USAGE,
                           "retry: --failed is missing: fracas retry STUDY --failed computes again "
                           "what FAILED; what was interrupted, `fracas run` computes");
    if (fracas_run_speaks()) TRY(plan_again(arguments->operand, point));
    return fracas_cli_run_study(arguments);
}

const fracas_command fracas_command_retry = {
    .name = "retry",
    .operand = "STUDY",
    .doc = "Computes again what FAILED in STUDY: --failed",
    .more = "\nA realization that crashed its process three times is FAILED for good: `fracas "
            "status STUDY` names it and the reason. This\n"
            "forgets its attempts and runs STUDY/campaign.yaml. Worth it after a machine or a "
            "limit was to blame (memory, time, a\n"
            "killed job); what crashes by itself fails again.\n",
    .options = options,
    .run = retry,
};
