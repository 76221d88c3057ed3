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

enum { CELLS = 8, NAME = 3, FILLING = 3000 /* bytes: a checkpoint has several sectors */ };

typedef struct {
    uint64_t steps, running, cell[CELLS];
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
    unsigned char *parcel; /* the farm's bytes beside the cells of a message */
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

/* Bodies are shared, by eight processes at most. */
const struct fracas_surface *__real_fracas_model_surface(const fracas_model *model);
const struct fracas_surface *__wrap_fracas_model_surface(const fracas_model *model)
{
    return world.current ? (const struct fracas_surface *)&farm
                         : __real_fracas_model_surface(model);
}

size_t __real_fracas_model_elements(const fracas_model *model);
size_t __wrap_fracas_model_elements(const fracas_model *model)
{
    return world.current ? 16 * CELLS * CELLS : __real_fracas_model_elements(model);
}

/* ---- batches ---- */

fracas_err __wrap_fracas_batch_create(const fracas_model *model, size_t count,
                                      const fracas_batch_options *options, fracas_batch **batch)
{
    (void)model;
    *batch = need(calloc(1, sizeof **batch));
    (*batch)->count = count;
    (*batch)->options = *options;
    (*batch)->parcel = need(calloc(CELLS, farm.parcel + sizeof(state[FRACAS_LANES_MAX])));
    return FRACAS_OK;
}

void __wrap_fracas_batch_destroy(fracas_batch *batch)
{
    if (batch) free(batch->parcel);
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

static void advance(const lane_state *lane, const uint64_t cell[CELLS], size_t from, size_t to,
                    uint64_t next[CELLS])
{
    for (size_t c = from; c < to; c++)
        next[c] = farm_hash(lane->point, lane->replica,
                            cell[c] * 3 + cell[(c + CELLS - 1) % CELLS]);
}

/* Cells after so many steps. */
static void cells_at(const lane_state *lane, uint64_t steps, uint64_t cell[CELLS])
{
    memset(cell, 0, CELLS * sizeof *cell);
    for (uint64_t s = 0; s < steps; s++) {
        uint64_t next[CELLS];
        advance(lane, cell, 0, CELLS, next);
        memcpy(cell, next, sizeof next);
    }
}

static size_t first_of(size_t peer, size_t peers)
{
    return peer * CELLS / peers;
}

/* Messages of the cells of each peer, with the farm's other bytes. */
static size_t parcel_of(const fracas_batch *batch, size_t peer, fracas_parcel *parcel)
{
    const size_t peers = batch->options.peers->count,
                 cells = first_of(peer + 1, peers) - first_of(peer, peers);
    const size_t room = farm.parcel + sizeof(state[FRACAS_LANES_MAX]);
    *parcel = (fracas_parcel){batch->parcel + peer * room,
                              cells * batch->count * sizeof(uint64_t) + farm.parcel};
    return cells;
}

static void copy_cells(fracas_batch *batch, size_t peer, bool out)
{
    const size_t first = first_of(peer, batch->options.peers->count);
    fracas_parcel parcel;
    const size_t bytes = parcel_of(batch, peer, &parcel) * sizeof(uint64_t);
    for (size_t l = 0; l < batch->count; l++) {
        unsigned char *at = (unsigned char *)parcel.bytes + l * bytes;
        uint64_t *cells = batch->lane[l].now.cell + first;
        if (out) memcpy(at, cells, bytes);
        else memcpy(cells, at, bytes);
    }
}

/* All get the cells of all. */
static fracas_err share_cells(fracas_batch *batch)
{
    const fracas_peers *peers = batch->options.peers;
    fracas_parcel out[FRACAS_PEERS_MAX] = {{0}}, in[FRACAS_PEERS_MAX] = {{0}};
    if (peers->count > CELLS) broken("%zu processes for one body", peers->count);
    copy_cells(batch, peers->number, true);
    for (size_t p = 0; p < peers->count; p++) {
        if (p == peers->number) continue;
        parcel_of(batch, peers->number, &out[p]);
        parcel_of(batch, p, &in[p]);
    }
    TRY(peers->exchange(peers->context, out, in));
    for (size_t p = 0; p < peers->count; p++)
        if (p != peers->number) copy_cells(batch, p, false);
    return FRACAS_OK;
}

/* The leading one tells the others. */
static fracas_err tell(const fracas_peers *peers, void *what, size_t size)
{
    fracas_parcel out[FRACAS_PEERS_MAX] = {{0}}, in[FRACAS_PEERS_MAX] = {{0}};
    if (!peers) return FRACAS_OK;
    for (size_t p = 1; p < peers->count && !peers->number; p++)
        out[p] = (fracas_parcel){what, size};
    if (peers->number) in[0] = (fracas_parcel){what, size};
    return peers->exchange(peers->context, out, in);
}

/* Its bytes are a function of point and replica, through all of its steps. */
static void fill(const lane_state *lane, fracas_record *record)
{
    const uint64_t point = lane->point;
    const int64_t replica = lane->replica;
    uint64_t all = 0;
    for (size_t c = 0; c < CELLS; c++) all += lane->now.cell[c] * (2 * c + 1);
    record->outcome = FRACAS_FRAGMENTED;
    record->fragments = 3 + (int64_t)(farm_hash(point, replica, 1) % 6);
    record->fragments_dust = 1;
    record->steps = (int64_t)lane->now.steps;
    record->dissipated = share(point, replica, 3);
    record->residual = 1e-9 * share(point, replica, all);
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
    const fracas_peers *peers = batch->options.peers;
    const size_t from = peers ? first_of(peers->number, peers->count) : 0,
                 to = peers ? first_of(peers->number + 1, peers->count) : CELLS;
    process_sleep(world.now + duration(batch) / (double)(peers ? peers->count : 1));
    for (size_t l = 0; l < batch->count; l++) {
        lane_state *lane = &batch->lane[l];
        uint64_t next[CELLS];
        if (!lane->now.running) continue;
        TRY(act_on_curse(lane));
        advance(lane, lane->now.cell, from, to, next);
        memcpy(lane->now.cell + from, next + from, (to - from) * sizeof *next);
        lane->now.steps++;
    }
    if (peers) TRY(share_cells(batch));
    for (size_t l = 0; l < batch->count; l++) {
        lane_state *lane = &batch->lane[l];
        if (!lane->now.running || !is_over(lane)) continue;
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
        to->filling[i] = (unsigned char)((lane->now.cell[i % CELLS] >> (i % 57)) + i);
}

void engine_spoil(void *at)
{
    state now;
    memcpy(&now, at, sizeof now);
    now.cell[0]++;
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
    uint64_t cell[CELLS];
    saved all, whole;
    TRY(get(context, &all.now, sizeof all.now));
    TRY(get(context, all.filling, FILLING));
    to->now = all.now;
    cells_at(to, to->now.steps < 1000000 ? to->now.steps : 0, cell);
    save_state(to, &whole);
    if (memcmp(cell, to->now.cell, sizeof cell) != 0 || memcmp(&whole, &all, sizeof all) != 0)
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

static fracas_err begin_together(fracas_batch *batch)
{
    const fracas_peers *peers = batch->options.peers;
    for (size_t l = 0; l < batch->count; l++)
        TRY(tell(peers, &batch->lane[l].now, sizeof batch->lane[l].now));
    return FRACAS_OK;
}

static fracas_err look(fracas_batch *batch, const fracas_record *record)
{
    const fracas_batch_watch *watch = batch->options.watch;
    bool due = watch && watch->due(watch->context);
    TRY(tell(batch->options.peers, &due, sizeof due));
    if (!due || !watch) return FRACAS_OK;
    fracas_err err = watch->pause(watch->context, batch, record);
    for (size_t l = 0; l < batch->count && err == FRACAS_INTERRUPTED; l++)
        oracle_interrupts(batch->lane[l].point, batch->lane[l].replica, batch->lane[l].now.steps);
    return err;
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
    if (batch->options.peers)
        trace("is %zu of %zu processes for one body", batch->options.peers->number,
              batch->options.peers->count);
    TRY(begin_together(batch));
    while (runs(batch)) {
        TRY(step(batch, record));
        if (runs(batch)) TRY(look(batch, record));
    }
    return FRACAS_OK;
}
