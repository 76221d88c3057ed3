/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of a run. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_OPTIONS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_OPTIONS_H

#include "engine/engine.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How much a crash of one realization can take with it. */
typedef enum {
    FRACAS_ISOLATION_LEASE, /* its lease: each lease is a process */
    FRACAS_ISOLATION_NONE   /* its compute server, which computes leases itself and is restarted */
} fracas_isolation;
extern const char *const fracas_isolation_name[2]; /* "lease", "none" */

struct fracas_campaign;

typedef struct {
    const char *file;  /* campaign file */
    const char *study; /* study folder; NULL: studies/<name> */
    /* Further check of the campaign before anything is computed; NULL: none. */
    fracas_err (*check)(const char *file, const struct fracas_campaign *campaign);
    int jobs;  /* MPI ranks; 0: one a core */
    int width; /* lanes of a batch: 1, 4, 8; 0: by the number of realizations */
    fracas_isa isa;
    double segment_age;   /* a segment is written at this age [s] ... */
    double segment_bytes; /* ... or at this size */
    bool shuffle;         /* lease in a shuffled order: a test of the schedule's independence */
    fracas_isolation isolation;
    double lease_seconds; /* target duration of a lease [s] */
    double lease_limit;   /* a lease is killed after this time [s]; 0: 600 s + 50 x predicted */
    double memory_limit;  /* bytes allocated for a lease, at most; 0: no limit */
    double checkpoint_seconds; /* between the checkpoints of a batch */
    double walltime;           /* the run has drained after this time [s]; 0: no limit */
    int64_t replicas;          /* for every point; 0: the campaign file's */
    int part, parts;           /* compute realizations part, part + parts, ...; parts 0 or 1: all */
    bool force;                /* take over the lock of another host */
    bool quiet;                /* show no progress, and no table at the end ... */
    bool wide;                 /* ... or one wider than the terminal */
    bool no_report;            /* compute and store, no more */
    bool ignore_space;         /* start although the disk is predicted to be too small */
} fracas_run_options;

/* Defaults: jobs 0, width 0, best instruction set, segment_age 5 s, segment_bytes 64 MiB,
 * lease_seconds 1, checkpoint_seconds 120, all else 0. */
void fracas_run_options_init(fracas_run_options *options);

/* Lanes of the batches of a run, 1 to FRACAS_LANES_MAX: options->width, or the maximum if 0. */
size_t fracas_run_width(const fracas_run_options *options);

#endif
