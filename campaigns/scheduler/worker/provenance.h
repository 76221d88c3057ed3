/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where, when and by what a segment was computed: never part of study.h5. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_PROVENANCE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_PROVENANCE_H

#include "campaigns/scheduler/run.h"

#include <time.h>

typedef struct {
    const char *host;
    struct timespec began; /* time of day of the first record */
    double wall;           /* s since then */
    double compute;        /* s that its leases took */
} fracas_provenance;

/* *text: one JSON object (docs/formats/study.md), freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_provenance_make(const fracas_provenance *provenance,
                                                  const fracas_run_options *options, char **text);

#endif
