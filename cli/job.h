/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The batch script of `fracas submit`. */
#ifndef FRACAS_CLI_JOB_H
#define FRACAS_CLI_JOB_H

#include "base/err.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    const char *name; /* of the job */
    int nodes;
    int tasks;                       /* on each node; 0: the whole node, a process a core */
    double time;                     /* s that the job may take */
    int lead;                        /* s before its end when Slurm signals */
    const char *partition, *account; /* NULL: the cluster's defaults */
    const char *output;              /* file of what the run says */
    char *const *more;               /* further options of sbatch */
    int nmore;
    const char *folder;  /* where the run is started */
    const char *program; /* fracas, as an absolute path */
    const char *study;
    const char *script; /* where it is written */
    char *const *run;   /* the run's command line, from "run" on, without --walltime */
    int nrun;
} fracas_job;

/* FRACAS_USAGE where a value cannot stand in a line of the script. */
FRACAS_MUST_USE fracas_err fracas_job_check(const fracas_job *job);

/* Writes the script: it resumes the run whenever Slurm starts it, and has itself queued again where
 * the run was interrupted. Its last line is a checksum of those before. FRACAS_ENVIRONMENT without
 * memory. */
FRACAS_MUST_USE fracas_err fracas_job_write(const fracas_job *job, FILE *out);

/* *own: the file is empty, or a script as fracas_job_write leaves it, in which nothing was changed.
 */
FRACAS_MUST_USE fracas_err fracas_job_is_own(FILE *in, bool *own);

#endif
