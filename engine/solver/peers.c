/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/peers.h"

#include "base/hash.h"

#include <stdlib.h>

fracas_err fracas_peers_tell(const fracas_peers *peers, void *bytes, size_t size)
{
    if (!peers) return FRACAS_OK;
    const size_t count = peers->count;
    OWNED fracas_parcel *parcel = calloc(2 * count, sizeof *parcel);
    if (!parcel) return fracas_no_memory("a shared body");
    if (peers->number > 0) parcel[count] = (fracas_parcel){bytes, size};
    for (size_t p = 1; p < count && peers->number == 0; p++)
        parcel[p] = (fracas_parcel){bytes, size};
    return peers->exchange(peers->context, parcel, parcel + count);
}

static fracas_err transfer(void *peers, void *bytes, size_t size)
{
    return fracas_peers_tell(peers, bytes, size);
}

/* Sizes, time step, mass, and strengths of all lanes: other builds and libraries of mathematics may
 * have others. */
static fracas_err name_body(fracas_batch *batch, uint64_t *name)
{
    const fracas_model *m = batch->model;
    const double numbers[] = {(double)m->elements, (double)m->interfaces, m->time_step, m->mass};
    OWN(fracas_checksum) sum = NULL;
    TRY(fracas_checksum_create(&sum));
    fracas_checksum_add(sum, numbers, sizeof numbers);
    for (size_t l = 0; l < batch->count; l++) {
        size_t stride;
        const double *strength = fracas_batch_strength(batch, l, &stride);
        for (size_t k = 0; k < m->interfaces * m->strengths; k++)
            fracas_checksum_add(sum, &strength[k * stride], sizeof *strength);
    }
    *name = fracas_checksum_end(sum);
    return FRACAS_OK;
}

static fracas_err check_body(fracas_batch *batch, const fracas_peers *peers)
{
    uint64_t own, told;
    TRY(name_body(batch, &own));
    told = own;
    TRY(fracas_peers_tell(peers, &told, sizeof told));
    if (told == own) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "a process for one body has another body: give all hosts one program and "
                       "one libc");
}

fracas_err fracas_peers_begin(fracas_batch *batch, fracas_record *record)
{
    const fracas_peers *peers = batch->step.division.peers;
    if (!peers) return FRACAS_OK;
    bool loaded = false;
    int lanes = batch->step.lanes;
    for (size_t l = 0; l < batch->count; l++)
        loaded = loaded || batch->lane[l].steps > 0 || !batch->lane[l].running;
    TRY(fracas_peers_tell(peers, &loaded, sizeof loaded));
    TRY(fracas_peers_tell(peers, &lanes, sizeof lanes));
    if (lanes != batch->step.lanes)
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "processes for one body have kernels of %d and %d lanes: give them one "
                           "instruction set with --isa",
                           lanes, batch->step.lanes);
    TRY(check_body(batch, peers));
    for (size_t l = 0; l < batch->count && loaded; l++) {
        TRY(peers->number == 0 ? fracas_batch_save(batch, l, transfer, (void *)peers)
                               : fracas_batch_load(batch, l, transfer, (void *)peers));
        TRY(fracas_peers_tell(peers, &record[l].outcome, sizeof record[l].outcome));
    }
    return FRACAS_OK;
}

fracas_err fracas_peers_gather(const fracas_model *model, fracas_step *step, int lane)
{
    return step->division.peers ? model->formulation->gather(model, step, lane) : FRACAS_OK;
}
