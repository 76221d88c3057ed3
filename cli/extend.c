/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/run_options.h"

#include "campaigns/campaign.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>

/* Prints present and future numbers of realizations. FRACAS_USAGE for fewer, or with a rule. */
static fracas_err check(const char *study, const fracas_campaign *campaign, int replicas)
{
    int64_t before = 0;
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_point *point = &campaign->point[p];
        if (point->rule.maximum > 0)
            return fracas_fail(
                FRACAS_USAGE,
                "extend: a rule decides the replicas of point %zu of %s; to get more, raise "
                "`maximum` or lower `relative-half-width` of `replicas` in a copy of "
                "%s/campaign.yaml, put it beside that, and `fracas run` it with --study %s",
                p, study, study, study);
        if (point->replicas > replicas)
            return fracas_fail(FRACAS_USAGE,
                               "extend: --replicas %d: point %zu of %s has %" PRId64
                               " already; a study can only grow",
                               replicas, p, study, point->replicas);
        before += point->replicas;
    }
    const int64_t after = (int64_t)campaign->npoints * replicas;
    if (fracas_run_speaks() && after > before)
        fprintf(stderr, "fracas: %s is to grow from %" PRId64 " realizations to %" PRId64 "\n",
                study, before, after);
    return FRACAS_OK;
}

static fracas_err extend(const fracas_arguments *arguments)
{
    int replicas = 0;
    OWN(fracas_campaign) campaign = NULL;
    TRY(fracas_arguments_integer(arguments, "replicas", 1, INT_MAX, &replicas));
    if (!replicas)
        return fracas_fail(FRACAS_USAGE,
                           "extend: --replicas N is missing: how many every point shall have");
    TRY(fracas_cli_read_campaign(arguments->operand, &campaign));
    TRY(check(arguments->operand, campaign, replicas));
    return fracas_cli_run_study(arguments);
}

const fracas_command fracas_command_extend = {
    .name = "extend",
    .operand = "STUDY",
    .doc = "Gives the points of STUDY more replicas: --replicas N of each",
    .more = "\nWhat is there stays: only what is new is computed, and study.h5 becomes that of a "
            "campaign that had N replicas from the\n"
            "start. More points, or a tighter rule for replicas, come by `fracas run` with a "
            "longer campaign file.\n",
    .options = FRACAS_STUDY_RUN_OPTIONS,
    .run = extend,
};
