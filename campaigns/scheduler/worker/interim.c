/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/interim.h"

#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/header.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/pack.h"

#include <math.h>

static const fracas_hash *point_of(const fracas_interim *interim)
{
    const fracas_computation *c = interim->computation;
    return &c->campaign->point[c->lease->point].hash;
}

/* The record of a lane that is over follows its state. */
static fracas_err put_record(fracas_checkpoint *file, const fracas_record *record)
{
    uint64_t size = fracas_record_packed_size(record);
    OWNED char *bytes = malloc(size);
    if (!bytes) return fracas_no_memory("a checkpoint");
    fracas_record_pack(record, bytes);
    TRY(fracas_checkpoint_put(file, &size, sizeof size));
    return fracas_checkpoint_put(file, bytes, size);
}

static fracas_err get_record(fracas_checkpoint *file, fracas_record *record)
{
    uint64_t size;
    TRY(fracas_checkpoint_get(file, &size, sizeof size));
    OWNED char *bytes = malloc(size);
    if (!bytes) return fracas_no_memory("a checkpoint");
    TRY(fracas_checkpoint_get(file, bytes, size));
    return fracas_record_unpack(bytes, size, record);
}

static fracas_err save(const fracas_interim *interim, fracas_batch *batch, size_t lane,
                       const fracas_record *record)
{
    const fracas_computation *c = interim->computation;
    const fracas_file_header header = fracas_campaign_header(c->campaign);
    const fracas_lane_progress now = fracas_batch_progress(batch, lane);
    fracas_checkpoint_head head = {.point = *point_of(interim),
                                   .replica = interim->replica[lane],
                                   .over = !now.running,
                                   .steps = now.steps,
                                   .time = now.time,
                                   .end = now.end};
    OWN(fracas_checkpoint) file = NULL;
    TRY(fracas_checkpoint_create(c->study, &header, &head, &file));
    TRY(fracas_batch_save(batch, lane, fracas_checkpoint_put, file));
    if (head.over) TRY(put_record(file, record));
    return fracas_checkpoint_finish(file);
}

static fracas_err load(const fracas_interim *interim, fracas_batch *batch, size_t lane,
                       fracas_record *record)
{
    const fracas_computation *c = interim->computation;
    const fracas_file_header header = fracas_campaign_header(c->campaign);
    fracas_checkpoint_head head;
    OWN(fracas_checkpoint) file = NULL;
    fracas_err err = fracas_checkpoint_open(c->study, &header, point_of(interim),
                                            interim->replica[lane], &head, &file);
    if (err == FRACAS_DAMAGED)
        return FRACAS_OK; /* rank 0 has told of older ones, and removed them */
    if (err || !file) return err;
    TRY(fracas_batch_load(batch, lane, fracas_checkpoint_get, file));
    return head.over ? get_record(file, record) : FRACAS_OK;
}

static fracas_err begin(void *context, fracas_batch *batch, fracas_record *record)
{
    const fracas_interim *interim = context;
    for (size_t l = 0; l < interim->count; l++) TRY(load(interim, batch, l, &record[l]));
    return FRACAS_OK;
}

static bool is_due(void *context)
{
    const fracas_interim *interim = context;
    return fracas_now() >= interim->due;
}

static fracas_err save_all(void *context, fracas_batch *batch, const fracas_record *record)
{
    fracas_interim *interim = context;
    const double began = fracas_now();
    fracas_err err = FRACAS_OK;
    /* A disk that is full stops a run at its segments, with a message. */
    for (size_t l = 0; l < interim->count && !err; l++) err = save(interim, batch, l, &record[l]);
    const double now = fracas_now(); /* a slow disk costs a twentieth at most */
    interim->due = now +
                   fmax(interim->computation->options->checkpoint_seconds, 20 * (now - began));
    return FRACAS_OK;
}

const fracas_batch_watch *fracas_interim_watch(fracas_interim *interim,
                                               const fracas_computation *computation,
                                               const int64_t *replica, size_t count)
{
    if (!computation->study) return NULL;
    *interim = (fracas_interim){computation,
                                replica,
                                count,
                                fracas_now() + computation->options->checkpoint_seconds,
                                {begin, is_due, save_all, interim}};
    return &interim->watch;
}
