/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cache of a server's models and strength fields, built at the first lease of their point. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_MODELS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_MODELS_H

#include "campaigns/plan/realize.h"
#include "campaigns/scheduler/worker/solve.h"

enum { FRACAS_MODELS_KEPT = 4 };

typedef struct {
    fracas_realizer realizer; /* all zero: free */
    uint64_t used;            /* clock of the last use */
} fracas_kept_model;

typedef struct {
    fracas_kept_model slot[FRACAS_MODELS_KEPT];
    uint64_t clock;
} fracas_models;

/* Sets the realizer of the lease's point, owned by `models` and valid until the
 * next call. */
FRACAS_MUST_USE fracas_err fracas_models_get(fracas_models *models,
                                             fracas_computation *computation);
void fracas_models_clear(fracas_models *models);

#endif
