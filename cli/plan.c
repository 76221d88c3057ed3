/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/written_fields.h"

#include <limits.h>

static const fracas_option known[] = {{"json", NULL, "print it as JSON"},
                                      {"points", NULL, "list more than 100 points, too"},
                                      {"quick", NULL, "estimate large surfaces, unchecked"},
                                      {"jobs", "N", "processes that would compute (one a core)"},
                                      FRACAS_WIDE_OPTION,
                                      {0}};

static fracas_err plan(const fracas_arguments *arguments)
{
    fracas_plan_options options = {.quick = fracas_given(arguments, "quick"),
                                   .json = fracas_given(arguments, "json"),
                                   .points = fracas_given(arguments, "points"),
                                   .columns = fracas_cli_columns(arguments)};
    TRY(fracas_arguments_integer(arguments, "jobs", 1, INT_MAX, &options.jobs));
    OWN(fracas_campaign) campaign = NULL;
    TRY(fracas_cli_read_file(arguments->operand, &campaign));
    TRY(fracas_cli_check_report(arguments->operand, campaign));
    /* as `fracas run` here, which may refuse what another machine is to compute */
    if (!options.jobs && fracas_allocation_jobs(0, campaign->parallel.parts, &options.jobs))
        options.jobs = 1;
    if (!options.quick) TRY(fracas_written_fields_size(campaign, &options.fields));
    return fracas_plan_print(campaign, &options, stdout);
}

const fracas_command fracas_command_plan = {
    .name = "plan",
    .operand = "FILE",
    .doc = "Says what `fracas run FILE` would compute from its start, and computes nothing",
    .more = "\nPoints, replicas, elements, steps, predicted time and size. An error in FILE is "
            "found here too.\n"
            "A study that exists is not looked at: `fracas status STUDY` says what is done of it "
            "and how long the rest takes. FILE may be a study.h5, for the campaign in it.\n",
    .from_study = true,
    .options = known,
    .run = plan,
};
