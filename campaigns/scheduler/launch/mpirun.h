/* SPDX-License-Identifier: GPL-3.0-or-later */
/* mpirun as a child process. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_MPIRUN_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_MPIRUN_H

#include "base/err.h"
#include "campaigns/scheduler/launch/scratch.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

typedef struct {
    pid_t pid;  /* also its process group */
    int out;    /* its stdout: the status channel */
    int errors; /* its stderr */
} fracas_mpirun;

enum { FRACAS_MPIRUN_MISSING = 127 }; /* its exit status when there is no mpirun */

/* Starts `mpirun -n jobs <this program> argv[1] ...` in a process group of its own; it dies with
 * this process. */
FRACAS_MUST_USE fracas_err fracas_mpirun_start(int jobs, int argc, char **argv,
                                               const fracas_scratch *scratch,
                                               fracas_mpirun *mpirun);

/* True, with the reason and its remedy in `text`, if no further start can help: the output names
 * a missing component of Open MPI. */
bool fracas_mpirun_hopeless(const char *output, char *text, size_t size);

/* The reason for an early end: the most telling line of the output of mpirun and the ranks; ""
 * without any. */
void fracas_mpirun_reason(const char *output, char *text, size_t size);

#endif
