/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/solve.h"

#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/worker/group.h"
#include "campaigns/scheduler/worker/interim.h"

/* Parts that the run chooses are no more than this process has cores. */
static int parts_of(const fracas_computation *computation)
{
    const int parts = (int)computation->lease->parts, cores = fracas_allocation_cores();
    return computation->campaign->parallel.parts || parts < cores ? parts : cores;
}

static fracas_err solve(const fracas_computation *computation, const int64_t *replica, size_t count,
                        fracas_record *record)
{
    fracas_interim interim;
    const fracas_peers *peers = computation->group ? fracas_group_peers(computation->group) : NULL;
    fracas_batch_options options = fracas_campaign_batch(computation->campaign);
    options.width = computation->options->width;
    options.isa = computation->options->isa;
    options.parts = parts_of(computation);
    options.peers = peers;
    if (computation->watch) options.watch = computation->watch;
    else if (!peers || !peers->number)
        options.watch = fracas_interim_watch(&interim, computation, replica, count);
    return fracas_realize(computation->realizer, replica, count, NULL, &options, record);
}

/* With those who have come, or alone after the loss of one, from the last checkpoint on. */
static bool goes_on(const fracas_computation *computation, const int64_t *replica)
{
    fracas_group *group = computation->group;
    if (!group || computation->lease->role != FRACAS_LEASE_LEADS) return false;
    if (fracas_group_peers(group)) fracas_group_leave(group);
    else if (!fracas_group_has_come(group)) return false;
    else if (fracas_group_start(group, (size_t)(replica - computation->lease->replica)))
        fracas_group_leave(group);
    return true;
}

fracas_err fracas_solve(const fracas_computation *computation, const int64_t *replica, size_t count,
                        fracas_record *record)
{
    fracas_err err;
    while ((err = solve(computation, replica, count, record)) && goes_on(computation, replica))
        for (size_t l = 0; l < count; l++) {
            fracas_record_clear(&record[l]);
            fracas_record_init(&record[l]);
        }
    return err;
}
