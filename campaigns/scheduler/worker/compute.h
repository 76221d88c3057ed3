/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computing a batch of a lease: in the server, or in a child of it. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_COMPUTE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_COMPUTE_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/packet.h"
#include "campaigns/scheduler/run.h"
#include "campaigns/scheduler/worker/models.h"
#include "engine/engine.h"

/* A lease, and all that is needed to compute it. */
typedef struct {
    const fracas_campaign *campaign;
    const fracas_run_options *options;
    const fracas_model *model; /* of the lease's point, and */
    const fracas_field *field; /* of its strengths: fracas_compute_prepare */
    const fracas_lease *lease;
} fracas_computation;

/* Realizations that are computed side by side, 1 to FRACAS_BATCH_MAX. */
size_t fracas_compute_width(const fracas_run_options *options);

/* The model and the field, which are in `models` then: built, unless they were there already. */
FRACAS_MUST_USE fracas_err fracas_compute_prepare(fracas_computation *computation,
                                                  fracas_models *models);

/* Computes the batch that begins with realization `from` of the lease: *count realizations,
 * fracas_compute_width but at the lease's end (also told on failure). record[i] is the RECORD
 * message for lease->replica[from + i], to be freed with free(); on failure there is none. At most
 * options->memory_limit bytes are allocated on the way, if it is not 0. FRACAS_ENVIRONMENT without
 * memory, FRACAS_USAGE for strengths that the law cannot have. A fault that a test asks for
 * (fault.h) happens here. */
FRACAS_MUST_USE fracas_err fracas_compute_batch(const fracas_computation *computation, size_t from,
                                                fracas_packet *record[FRACAS_BATCH_MAX],
                                                size_t *count);

#endif
