/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/plan/plan.h"

#include <limits.h>

enum { JSON, JOBS };
static const fracas_option options[] = {
    [JSON] = {"json", NULL, "print it as JSON"},
    [JOBS] = {"jobs", "N", "processes that would compute (one a core)"},
};

static fracas_err plan(const fracas_arguments *arguments)
{
    int jobs = 0;
    TRY(fracas_arguments_integer(arguments, JOBS, 1, INT_MAX, &jobs));
    fracas_campaign *campaign;
    TRY(fracas_campaign_read(arguments->operand, &campaign));
    fracas_err code = fracas_plan_print(campaign, jobs, stdout, arguments->value[JSON]);
    fracas_campaign_destroy(campaign);
    return code;
}

const fracas_command fracas_command_plan = {
    .name = "plan",
    .operand = "FILE",
    .doc = "Says what `fracas run FILE` would compute from its start, and computes nothing",
    .more = "\nPoints, replicas, elements, steps, predicted time and size. An error in FILE is "
            "found here too.\n"
            "A study that exists is not looked at: `fracas status STUDY` says what is done of it "
            "and how long the rest takes.\n",
    .options = options,
    .noptions = FRACAS_COUNT(options),
    .run = plan,
};
