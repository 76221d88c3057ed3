/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One batch of realizations, from strengths to records. Benchmarks and fault tests link another
 * function in its place (ld --wrap). */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SOLVE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SOLVE_H

#include "campaigns/plan/realize.h"
#include "campaigns/scheduler/types/lease.h"
#include "campaigns/scheduler/types/options.h"

/* A lease and the objects for its computation. Nothing is owned. */
typedef struct {
    const fracas_campaign *campaign;
    const fracas_run_options *options;
    const char *study;               /* NULL: no checkpoints */
    const fracas_realizer *realizer; /* at the lease's point: fracas_models_get */
    const fracas_lease *lease;
    const fracas_batch_watch *watch; /* in the place of checkpoints; NULL: nobody */
} fracas_computation;

/* Computes `count` replicas of the lease's point side by side into record[0] ... record[count - 1],
 * which the caller has initialised and clears. Errors as fracas_compute_batch. */
FRACAS_MUST_USE fracas_err fracas_solve(const fracas_computation *computation,
                                        const int64_t *replica, size_t count,
                                        fracas_record *record);

#endif
