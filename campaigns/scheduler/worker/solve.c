/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/solve.h"

#include "campaigns/plan/point_model.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/worker/group.h"
#include "campaigns/scheduler/worker/interim.h"

static fracas_err fill_strengths(const fracas_computation *computation, const int64_t *replica,
                                 size_t count, fracas_batch *batch)
{
    for (size_t lane = 0; lane < count; lane++) {
        size_t stride;
        double *strength = fracas_batch_strength(batch, lane, &stride);
        const fracas_stream stream = fracas_point_stream(
            computation->campaign, (size_t)computation->lease->point, FRACAS_PURPOSE_STRENGTH,
            (uint64_t)replica[lane]);
        TRY(fracas_field_sample(computation->field, &stream, stride, strength));
    }
    return FRACAS_OK;
}

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
    const fracas_batch_options options = {
        .history = computation->campaign->output.history,
        .interfaces = computation->campaign->output.interfaces,
        .width = computation->options->width,
        .isa = computation->options->isa,
        .parts = parts_of(computation),
        .peers = peers,
        .watch = peers && peers->number
                     ? NULL
                     : fracas_interim_watch(&interim, computation, replica, count)};
    OWN(fracas_batch) batch = NULL;
    TRY(fracas_batch_create(computation->model, count, &options, &batch));
    TRY(fill_strengths(computation, replica, count, batch));
    return fracas_batch_run(batch, record);
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
