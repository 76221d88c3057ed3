/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Place, time and program of a segment's computation: never part of study.h5. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_PROVENANCE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_PROVENANCE_H

#include "base/err.h"
#include "campaigns/scheduler/types/options.h"

#include <time.h>

typedef struct {
    const char *host;
    struct timespec began; /* time of day of the first record */
    double wall;           /* since then [s] */
    double compute;        /* spent on its leases [s] */
} fracas_provenance;

/* *text: one JSON object (docs/formats/study.md), freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_provenance_make(const fracas_provenance *provenance,
                                                  const fracas_run_options *options, char **text);

#endif
