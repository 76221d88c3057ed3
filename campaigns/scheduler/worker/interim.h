/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkpoints of the batch at hand: its lanes begin at those that are there, and leave new ones
 * from time to time. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_INTERIM_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_INTERIM_H

#include "campaigns/scheduler/worker/solve.h"

typedef struct {
    const fracas_computation *computation;
    const int64_t *replica;
    size_t count;
    double due;               /* fracas_now of the next checkpoints */
    fracas_batch_watch watch; /* for fracas_batch_options */
} fracas_interim;

/* NULL without a study. `interim`, filled here, must outlive the batch. A
 * checkpoint that cannot be used or written costs time alone. */
const fracas_batch_watch *fracas_interim_watch(fracas_interim *interim,
                                               const fracas_computation *computation,
                                               const int64_t *replica, size_t count);

#endif
