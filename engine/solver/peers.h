/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peers of a batch in step with each other. All of it does nothing without peers. */
#ifndef FRACAS_ENGINE_SOLVER_PEERS_H
#define FRACAS_ENGINE_SOLVER_PEERS_H

#include "engine/solver/batch.h"

/* The leading peer's bytes, to all others. */
FRACAS_MUST_USE fracas_err fracas_peers_tell(const fracas_peers *peers, void *bytes, size_t size);

/* Before the first step: all have the same body; the leading peer's lanes and their outcomes, where
 * it has loaded some, to all others. FRACAS_ENVIRONMENT where one has another body or other lanes.
 */
FRACAS_MUST_USE fracas_err fracas_peers_begin(fracas_batch *batch, fracas_record *record);

/* Brings to the leading peer which interfaces of `lane` are broken, or, at -1, all state. */
FRACAS_MUST_USE fracas_err fracas_peers_gather(const fracas_model *model, fracas_step *step,
                                               int lane);

/* The one whose numbers count. */
static inline bool fracas_peers_leads(const fracas_step *step)
{
    return !step->division.peers || step->division.peers->number == 0;
}

#endif
