/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/solve.h"

#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/worker/interim.h"

/* Parts that the run chooses are no more than this process has cores. */
static int parts_of(const fracas_computation *computation)
{
    const int parts = (int)computation->lease->parts, cores = fracas_allocation_cores();
    return computation->campaign->parallel.parts || parts < cores ? parts : cores;
}

fracas_err fracas_solve(const fracas_computation *computation, const int64_t *replica, size_t count,
                        fracas_record *record)
{
    fracas_interim interim;
    fracas_batch_options options = fracas_campaign_batch(computation->campaign);
    options.width = computation->options->width;
    options.isa = computation->options->isa;
    options.parts = parts_of(computation);
    options.watch = computation->watch
                        ? computation->watch
                        : fracas_interim_watch(&interim, computation, replica, count);
    return fracas_realize(computation->realizer, replica, count, NULL, &options, record);
}
