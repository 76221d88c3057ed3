/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/peers.h"

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

fracas_err fracas_peers_begin(fracas_batch *batch)
{
    const fracas_peers *peers = batch->step.division.peers;
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
    for (size_t l = 0; l < batch->count && peers && loaded; l++)
        TRY(peers->number == 0 ? fracas_batch_save(batch, l, transfer, (void *)peers)
                               : fracas_batch_load(batch, l, transfer, (void *)peers));
    return FRACAS_OK;
}

fracas_err fracas_peers_gather(const fracas_model *model, fracas_step *step, int lane)
{
    return step->division.peers ? model->formulation->gather(model, step, lane) : FRACAS_OK;
}
