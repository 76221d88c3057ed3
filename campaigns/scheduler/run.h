/* Running a campaign: the parent, mpirun and its ranks, compute servers, a child per lease. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_RUN_H
#define FRACAS_CAMPAIGNS_SCHEDULER_RUN_H

#include "base/err.h"
#include "engine/engine.h"

#include <stdbool.h>

typedef struct {
    const char *file;    /* campaign file */
    const char *study;   /* study folder; NULL: studies/<name> */
    int jobs;            /* MPI ranks; 0: all cores */
    int width;           /* lanes of a batch: 1, 4, 8; 0: by the number of realizations */
    fracas_isa isa;
    double segment_age;  /* s: a segment is written when it is this old ... */
    double segment_bytes; /* ... or this big */
    bool shuffle;        /* lease in a shuffled order: a test of the schedule's independence */
} fracas_run_options;

/* Defaults: jobs 0, width 0, best instruction set, segment_age 5 s, segment_bytes 64 MiB. */
void fracas_run_options_init(fracas_run_options *options);

/* Runs (or resumes, or extends) the campaign until study.h5 is there. Called by the parent it starts
 * `mpirun -n jobs <this program> run ...` in a process group of its own and returns how the run ended; called under
 * mpirun or srun it is one rank (`argc`, `argv` of the program) and only rank 0's return value has a meaning.
 * FRACAS_OK, FRACAS_SOME_FAILED, FRACAS_INTERRUPTED and the errors of exit statuses 2 to 70. *ran is false when the
 * study was complete already and nothing had to be done. */
FRACAS_MUST_USE fracas_err fracas_run(const fracas_run_options *options, int argc, char **argv, bool *ran);

/* True in a process that mpirun, srun or another PMI launcher started. */
bool fracas_run_is_rank(void);

/* True in the one process that reports to the user: the parent, else rank 0 of a run under the user's own launcher. */
bool fracas_run_speaks(void);

#endif
