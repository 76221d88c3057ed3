/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The batch script of `fracas submit`. */
#ifndef FRACAS_CLI_JOB_H
#define FRACAS_CLI_JOB_H

#include "base/err.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    const char *name; /* the job's */
    int nodes;
    int tasks;                       /* on each node; 0: the whole node, a process a core */
    double time;                     /* limit of the job [s] */
    int lead;                        /* time of Slurm's signal before the end [s] */
    const char *partition, *account; /* NULL: the cluster's defaults */
    const char *output;              /* file for the messages of the run */
    char *const *more;               /* further options of sbatch */
    int nmore;
    const char *folder;  /* working folder of the run */
    const char *program; /* fracas, as an absolute path */
    const char *study;
    const char *script; /* its own path */
    char *const *run;   /* the run's command line, from "run" on, without --walltime */
    int nrun;
} fracas_job;

/* The commands of every script, after its settings: cli/job.sh. */
extern const char fracas_job_body[];

/* FRACAS_USAGE for a value unfit for a line of the script. */
FRACAS_MUST_USE fracas_err fracas_job_check(const fracas_job *job);

/* Writes the script, which resumes the run at each start and queues itself again after an
 * interruption. Its last line is a checksum. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_job_write(const fracas_job *job, FILE *out);

/* *own: the file is empty, or an unchanged script of fracas_job_write. */
FRACAS_MUST_USE fracas_err fracas_job_is_own(FILE *in, bool *own);

#endif
