/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/plan/plan.h"

#include <limits.h>

static const fracas_option options[] = {{"json", NULL, "print it as JSON"},
                                        {"quick", NULL, "estimate large surfaces, unchecked"},
                                        {"jobs", "N", "processes that would compute (one a core)"},
                                        {0}};

static fracas_err plan(const fracas_arguments *arguments)
{
    int jobs = 0;
    TRY(fracas_arguments_integer(arguments, "jobs", 1, INT_MAX, &jobs));
    OWN(fracas_campaign) campaign = NULL;
    TRY(fracas_campaign_read(arguments->operand, &campaign));
    return fracas_plan_print(campaign, jobs, fracas_given(arguments, "quick"), stdout,
                             fracas_given(arguments, "json"));
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
    .run = plan,
};
