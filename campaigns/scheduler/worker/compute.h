/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computing the batches of a lease, in the server or in the process of the lease. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_COMPUTE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_COMPUTE_H

#include "campaigns/scheduler/types/packet.h"
#include "campaigns/scheduler/worker/solve.h"

/* Computes the batch from realization `from` of the lease on: *count realizations, fracas_run_width
 * or the rest of the lease (also set on failure). record[i] is the RECORD message for
 * lease->replica[from + i], freed by the caller; on failure there is none. It allocates at most
 * options->memory_limit bytes, if not 0. FRACAS_ENVIRONMENT without memory, FRACAS_USAGE for
 * strengths outside the range of the law. */
FRACAS_MUST_USE fracas_err fracas_compute_batch(const fracas_computation *computation, size_t from,
                                                fracas_packet *record[FRACAS_LANES_MAX],
                                                size_t *count);

#endif
