/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/engine.h"

#include "tests/simulator/farm.h"
#include "tests/simulator/oracle.h"

#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/worker/models.h"
#include "engine/engine.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 3, FILLING = 3000 /* bytes: a checkpoint has several sectors */ };

typedef struct {
    uint64_t steps, running, link; /* of a chain of hashes */
} state;

typedef struct {
    double name[NAME]; /* bits of the stream of its strengths */
    uint64_t point;
    int64_t replica;
    uint64_t total; /* steps */
    state now;
} lane_state;

struct fracas_batch {
    size_t count;
    fracas_batch_options options;
    lane_state lane[FRACAS_LANES_MAX];
};

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

static double share(uint64_t point, int64_t replica, uint64_t of)
{
    return (double)(farm_hash(point, replica, of) >> 11) * 0x1p-53;
}

/* ---- models ---- */

fracas_err __wrap_fracas_models_get(fracas_models *models, fracas_computation *computation)
{
    fracas_realizer *realizer = &models->slot[0].realizer;
    if (!models->clock++) process_sleep(world.now + 0.2 * roll(DICE_DELAY));
    *realizer = (fracas_realizer){.campaign = computation->campaign,
                                  .point = (size_t)computation->lease->point};
    computation->realizer = realizer;
    return FRACAS_OK;
}

size_t __real_fracas_model_strengths(const fracas_model *model);
size_t __wrap_fracas_model_strengths(const fracas_model *model)
{
    return world.current ? NAME : __real_fracas_model_strengths(model);
}

int __wrap_fracas_allocation_cores(void)
{
    return 4;
}

/* ---- batches ---- */

fracas_err __wrap_fracas_batch_create(const fracas_model *model, size_t count,
                                      const fracas_batch_options *options, fracas_batch **batch)
{
    (void)model;
    *batch = need(calloc(1, sizeof **batch));
    (*batch)->count = count;
    (*batch)->options = *options;
    return FRACAS_OK;
}

void __wrap_fracas_batch_destroy(fracas_batch *batch)
{
    free(batch);
}

double *__wrap_fracas_batch_strength(fracas_batch *batch, size_t lane, size_t *stride)
{
    *stride = 1;
    return batch->lane[lane].name;
}

fracas_err __wrap_fracas_field_sample(const fracas_field *field, const fracas_stream *stream,
                                      size_t stride, double *sigma_c)
{
    const uint64_t name[NAME] = {stream->point[0], stream->point[1], stream->replica};
    (void)field, (void)stride;
    memcpy(sigma_c, name, sizeof name);
    return FRACAS_OK;
}

static void identify(lane_state *lane)
{
    uint64_t name[NAME], hash[2];
    memcpy(name, lane->name, sizeof name);
    const fracas_campaign *campaign = farm.kind->read;
    for (lane->point = 0; lane->point < campaign->npoints; lane->point++) {
        fracas_hash_words(&campaign->point[lane->point].hash, hash);
        if (!memcmp(hash, name, sizeof hash)) break;
    }
    if (lane->point == campaign->npoints) broken("strengths of no point");
    lane->replica = (int64_t)name[2];
    lane->total = 4 + farm_hash(lane->point, lane->replica, 2) % 9;
    lane->now = (state){.running = 1};
}

/* ---- steps ---- */

static uint64_t next(const lane_state *lane, uint64_t link)
{
    return farm_hash(lane->point, lane->replica, link);
}

/* After so many steps. */
static uint64_t link_at(const lane_state *lane, uint64_t steps)
{
    uint64_t link = 0;
    while (steps--) link = next(lane, link);
    return link;
}

/* Its bytes are a function of point and replica, through all of its steps. */
static void fill(const lane_state *lane, fracas_record *record)
{
    const uint64_t point = lane->point;
    const int64_t replica = lane->replica;
    record->outcome = FRACAS_FRAGMENTED;
    record->fragments = 3 + (int64_t)(farm_hash(point, replica, 1) % 6);
    record->fragments_dust = 1;
    record->steps = (int64_t)lane->now.steps;
    record->dissipated = share(point, replica, 3);
    record->residual = 1e-9 * share(point, replica, lane->now.link);
    record->nfragment = (uint64_t)record->fragments;
    record->fragment = need(calloc(record->nfragment, sizeof *record->fragment));
    for (uint64_t f = 0; f < record->nfragment; f++)
        record->fragment[f].size = share(point, replica, 5 + f);
}

static fracas_err act_on_curse(const lane_state *lane)
{
    if (lane->now.steps < lane->total / 2) return FRACAS_OK;
    switch (farm_curse(lane->point, lane->replica)) {
    case CRASHES: process_end(world.current, SIGSEGV); break;
    case LACKS_MEMORY: return fracas_no_memory("a realization");
    case NEVER_ENDS:
    case SOUND: break;
    }
    return FRACAS_OK;
}

static bool is_over(const lane_state *lane)
{
    return lane->now.steps >= lane->total && farm_curse(lane->point, lane->replica) != NEVER_ENDS;
}

/* Seconds of a step of the batch. */
static double duration(const fracas_batch *batch)
{
    double most = 0;
    for (size_t l = 0; l < batch->count; l++) {
        const lane_state *lane = &batch->lane[l];
        const double all = farm.seconds * (0.5 + share(lane->point, lane->replica, 20));
        const bool endless = lane->now.steps > lane->total;
        most = fmax(most, endless ? fmax(all, 0.5) : all / (double)lane->total);
    }
    return most * (0.8 + 0.4 * roll(DICE_DELAY));
}

static fracas_err step(fracas_batch *batch, fracas_record *record)
{
    process_sleep(world.now + duration(batch));
    for (size_t l = 0; l < batch->count; l++) {
        lane_state *lane = &batch->lane[l];
        if (!lane->now.running) continue;
        TRY(act_on_curse(lane));
        lane->now.link = next(lane, lane->now.link);
        lane->now.steps++;
        if (!is_over(lane)) continue;
        lane->now.running = 0;
        fill(lane, &record[l]);
    }
    call("steps");
    return FRACAS_OK;
}

/* ---- checkpoints ---- */

typedef struct {
    state now;
    unsigned char filling[FILLING];
} saved;

static void save_state(const lane_state *lane, saved *to)
{
    to->now = lane->now;
    for (size_t i = 0; i < FILLING; i++)
        to->filling[i] = (unsigned char)((lane->now.link >> (i % 57)) + i);
}

void engine_spoil(void *at)
{
    state now;
    memcpy(&now, at, sizeof now);
    now.link++;
    memcpy(at, &now, sizeof now);
}

fracas_err __wrap_fracas_batch_save(fracas_batch *batch, size_t lane, fracas_transfer *put,
                                    void *context)
{
    saved all;
    save_state(&batch->lane[lane], &all);
    TRY(put(context, &all.now, sizeof all.now));
    TRY(put(context, all.filling, FILLING / 3));
    return put(context, all.filling + FILLING / 3, FILLING - FILLING / 3);
}

fracas_err __wrap_fracas_batch_load(fracas_batch *batch, size_t lane, fracas_transfer *get,
                                    void *context)
{
    lane_state *to = &batch->lane[lane];
    saved all, whole;
    TRY(get(context, &all.now, sizeof all.now));
    TRY(get(context, all.filling, FILLING));
    to->now = all.now;
    const uint64_t link = link_at(to, to->now.steps < 1000000 ? to->now.steps : 0);
    save_state(to, &whole);
    if (link != to->now.link || memcmp(&whole, &all, sizeof all) != 0)
        broken("replica %lld of point %llu is loaded with another state", (long long)to->replica,
               (unsigned long long)to->point);
    return FRACAS_OK;
}

fracas_lane_progress __wrap_fracas_batch_progress(const fracas_batch *batch, size_t lane)
{
    const state *now = &batch->lane[lane].now;
    return (fracas_lane_progress){now->running != 0, (int64_t)now->steps, 1e-9 * (double)now->steps,
                                  5e-7};
}

static fracas_err begin(fracas_batch *batch, fracas_record *record)
{
    const fracas_batch_watch *watch = batch->options.watch;
    uint64_t before[FRACAS_LANES_MAX];
    if (!watch) return FRACAS_OK;
    for (size_t l = 0; l < batch->count; l++)
        before[l] = oracle_checkpoint(batch->lane[l].point, batch->lane[l].replica);
    TRY(watch->begin(watch->context, batch, record));
    for (size_t l = 0; l < batch->count; l++) {
        const lane_state *lane = &batch->lane[l];
        trace("replica %lld of point %llu begins at step %llu", (long long)lane->replica,
              (unsigned long long)lane->point, (unsigned long long)lane->now.steps);
        oracle_begins(lane->point, lane->replica, before[l], lane->now.steps);
    }
    return FRACAS_OK;
}

static fracas_err look(fracas_batch *batch, const fracas_record *record)
{
    const fracas_batch_watch *watch = batch->options.watch;
    if (!watch || !watch->due(watch->context)) return FRACAS_OK;
    return watch->pause(watch->context, batch, record);
}

static bool runs(const fracas_batch *batch)
{
    for (size_t l = 0; l < batch->count; l++)
        if (batch->lane[l].now.running) return true;
    return false;
}

fracas_err __wrap_fracas_batch_run(fracas_batch *batch, fracas_record *record)
{
    for (size_t l = 0; l < batch->count; l++) identify(&batch->lane[l]);
    TRY(begin(batch, record));
    while (runs(batch)) {
        TRY(step(batch, record));
        if (runs(batch)) TRY(look(batch, record));
    }
    return FRACAS_OK;
}
