/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running a campaign: the parent, mpirun and its ranks, compute servers, a child per lease. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_RUN_H
#define FRACAS_CAMPAIGNS_SCHEDULER_RUN_H

#include "base/err.h"
#include "engine/engine.h"

#include <stdbool.h>

/* What a crash of a realization can take with it. */
typedef enum {
    FRACAS_ISOLATION_LEASE, /* its lease: a process for each */
    FRACAS_ISOLATION_NONE /* its compute server, which is started anew: leases are computed in it */
} fracas_isolation;
extern const char *const fracas_isolation_name[2]; /* "lease", "none" */

typedef struct {
    const char *file;  /* campaign file */
    const char *study; /* study folder; NULL: studies/<name> */
    int jobs;          /* MPI ranks; 0: all cores */
    int width;         /* lanes of a batch: 1, 4, 8; 0: by the number of realizations */
    fracas_isa isa;
    double segment_age;   /* s: a segment is written when it is this old ... */
    double segment_bytes; /* ... or this big */
    bool shuffle;         /* lease in a shuffled order: a test of the schedule's independence */
    fracas_isolation isolation;
    double lease_seconds; /* s that a lease should take */
    double lease_limit;   /* s after which one is killed; 0: 600 s and 50 times what is predicted */
    double memory_limit;  /* bytes that the process of a lease may allocate; 0: no limit but the
                             machine's */
    double walltime;      /* s after which the run must have drained; 0: none */
    int64_t replicas;     /* of every point, instead of the campaign file's; 0: as the file says */
    int part, parts; /* compute every parts-th realization, from the part-th on (1 to parts); parts
                        0 or 1: all */
    bool force;      /* take over the lock of another host */
    bool ignore_space; /* start although the disk is too small for what is predicted */
    const char
        *stand_in; /* NULL, or what leases do instead of computing (fracas bench scheduler) */
} fracas_run_options;

/* Defaults: jobs 0, width 0, best instruction set, segment_age 5 s, segment_bytes 64 MiB,
 * lease_seconds 1, all else 0. */
void fracas_run_options_init(fracas_run_options *options);

/* Runs (or resumes, or extends) the campaign until study.h5 is there. Called by the parent it
 * starts `mpirun -n jobs <this program> run ...` in a process group of its own and returns how the
 * run ended; called under mpirun or srun it is one rank (`argc`, `argv` of the program) and only
 * rank 0's return value has a meaning. FRACAS_OK, FRACAS_SOME_FAILED, FRACAS_INTERRUPTED and the
 * errors of exit statuses 2 to 70. *ran is false when the study was complete already and nothing
 * had to be done. */
FRACAS_MUST_USE fracas_err fracas_run(const fracas_run_options *options, int argc, char **argv,
                                      bool *ran);

/* True in a process that mpirun, srun or another PMI launcher started. */
bool fracas_run_is_rank(void);

/* True in the one process that reports to the user: the parent, else rank 0 of a run under the
 * user's own launcher. */
bool fracas_run_speaks(void);

#endif
