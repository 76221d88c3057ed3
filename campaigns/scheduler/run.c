/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/run.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/launch/guard.h"
#include "campaigns/scheduler/launch/launcher.h"
#include "campaigns/scheduler/launch/signals.h"
#include "campaigns/scheduler/rank.h"
#include "campaigns/scheduler/session/failures.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/session/space.h"
#include "campaigns/scheduler/status/channel.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/transport.h"
#include "engine/integrator/frequencies.h"

#include <stdio.h>
#include <stdlib.h>

/* Rank of this process, as a launcher has set it; -1: none. */
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

bool fracas_run_owns_terminal(void)
{
    int rank = launched_rank();
    return rank < 0 || (rank == 0 && !getenv(FRACAS_LAUNCHER_MARK));
}

/* A process manager takes this process once as one of its job. */
static bool is_of_a_job(void)
{
    return getenv("PMIX_RANK") || getenv("PMI_RANK");
}

/* Finds all faults of the campaign and the study before anything is written or started. Leaves the
 * frequencies of its models, and its name, to the processes of the run. */
static fracas_err examine(const fracas_run_options *options, const fracas_starter_kind *kind,
                          int *jobs, fracas_run_facts *facts, bool *complete, fracas_err *result)
{
    OWNED double *bytes = NULL;
    int64_t failed = 0;
    TRY(fracas_run_campaign(options, &facts->campaign));
    const fracas_campaign *campaign = facts->campaign;
    if (options->check) TRY(options->check(options->file, campaign));
    TRY(fracas_study_folder(options, campaign, facts->study, sizeof facts->study));
    TRY(fracas_study_examine(facts->study, campaign, options->force, complete, &failed));
    *result = failed ? fracas_failure_report(facts->study, NULL, &campaign->table) : FRACAS_OK;
    if (*complete) return FRACAS_OK;
    TRY(fracas_allocation_jobs(options->jobs, campaign->parallel.parts, jobs));
    TRY(kind->check(*jobs));
    TRY(fracas_costs_create(campaign, options, stderr, &facts->cost, &bytes));
    TRY(fracas_space_check(facts->study, campaign, options, bytes));
    OWNED char *frequencies = fracas_frequencies_write(campaign->frequencies);
    if (!frequencies) return fracas_no_memory("the run");
    setenv(FRACAS_FREQUENCIES, frequencies, 1);
    setenv(FRACAS_OF, fracas_run_name_of(facts).text, 1);
    return FRACAS_OK;
}

fracas_err fracas_run(const fracas_run_options *options, int argc, char **argv,
                      fracas_run_facts *facts)
{
    *facts = (fracas_run_facts){0};
    const fracas_mailbox mpi = {.transport = &fracas_transport_mpi};
    if (fracas_run_is_rank()) {
        if (is_of_a_job() && !getenv(FRACAS_LAUNCHER_MARK)) TRY(fracas_guard_begin());
        return fracas_rank_run(options, &mpi, facts);
    }
    const double began = fracas_now();
    fracas_signals_catch();
    bool complete = false;
    fracas_err result;
    TRY(fracas_allocation_check());
    const fracas_starter_kind *kind = fracas_starter_choose();
    fracas_ranks ranks = {
        .options = options, .facts = facts, .life = fracas_rank_run, .argc = argc, .argv = argv};
    TRY(examine(options, kind, &ranks.jobs, facts, &complete, &result));
    if (!complete) result = fracas_launcher_run(kind, &ranks, began, &facts->ran);
    fracas_signals_end();
    return result;
}
