/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/run.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/clock.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/launch/parent.h"
#include "campaigns/scheduler/launch/signals.h"
#include "campaigns/scheduler/launch/voice.h"
#include "campaigns/scheduler/rank.h"
#include "campaigns/scheduler/study/costs.h"
#include "campaigns/scheduler/study/prepare.h"
#include "campaigns/scheduler/study/share.h"
#include "campaigns/scheduler/study/space.h"
#include "campaigns/scheduler/study/verdict.h"

#include <stdlib.h>

const char *const fracas_isolation_name[2] = {"lease", "none"};

void fracas_run_options_init(fracas_run_options *options)
{
    *options = (fracas_run_options){.isa = FRACAS_ISA_BEST,
                                    .segment_age = 5,
                                    .segment_bytes = 64.0 * 1024 * 1024,
                                    .lease_seconds = 1};
}

/* Rank that a launcher gave to this process; -1 if none did. */
static int launched_rank(void)
{
    static const char *const set_by_launchers[] = {"PMIX_RANK", "PMI_RANK", "OMPI_COMM_WORLD_RANK"};
    for (size_t i = 0; i < FRACAS_COUNT(set_by_launchers); i++)
        if (getenv(set_by_launchers[i])) return atoi(getenv(set_by_launchers[i]));
    return -1;
}

bool fracas_run_is_rank(void)
{
    return launched_rank() >= 0;
}

bool fracas_run_speaks(void)
{
    int rank = launched_rank();
    return rank < 0 || (rank == 0 && !getenv(FRACAS_PARENT_MARK));
}

static fracas_err examine_needs(const char *study, const fracas_campaign *campaign,
                                const fracas_run_options *options)
{
    double *cost, *bytes;
    TRY(fracas_costs_create(campaign, options, &cost, &bytes));
    fracas_err err = fracas_space_check(study, campaign, options, bytes);
    free(cost);
    free(bytes);
    return err;
}

/* What is wrong with the campaign or the study is found here, before anything is written or
 * started. */
static fracas_err examine(const fracas_run_options *options, bool *settled, fracas_err *verdict)
{
    fracas_campaign *campaign;
    TRY(fracas_run_campaign(options, &campaign));
    char study[4096];
    int64_t failed = 0;
    fracas_err err = fracas_study_folder(options, campaign, study, sizeof study);
    if (!err) err = fracas_study_examine(study, campaign, options->force, settled, &failed);
    *verdict = err || !failed ? err : fracas_failed_verdict(study, NULL, &campaign->table);
    if (!err && !*settled) err = fracas_limits_check(options);
    if (!err && !*settled) err = examine_needs(study, campaign, options);
    fracas_campaign_destroy(campaign);
    return err;
}

fracas_err fracas_run(const fracas_run_options *options, int argc, char **argv, bool *ran)
{
    *ran = false;
    if (fracas_run_is_rank()) return fracas_rank_run(options, ran);
    const double began = fracas_now();
    fracas_signals_catch();
    bool settled = false;
    fracas_err verdict;
    TRY(fracas_allocation_check());
    TRY(examine(options, &settled, &verdict));
    if (!settled) verdict = fracas_parent_run(options, began, argc, argv, ran);
    fracas_signals_end();
    return verdict;
}
