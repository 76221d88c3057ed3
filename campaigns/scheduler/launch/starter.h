/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The starter: a process that starts the ranks of a run and ends with them. It is mpirun, or, where
 * the run has one machine, a process of this program. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_STARTER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_STARTER_H

#include "base/err.h"
#include "campaigns/scheduler/launch/scratch.h"
#include "campaigns/scheduler/types/facts.h"
#include "campaigns/scheduler/types/mailbox.h"
#include "campaigns/scheduler/types/options.h"

#include <stdbool.h>
#include <sys/types.h>

typedef struct {
    pid_t pid;  /* also its process group */
    int out;    /* its stdout: the status channel */
    int errors; /* its stderr */
} fracas_starter;

/* The life of one rank: fracas_rank_run. */
typedef fracas_err fracas_rank_life(const fracas_run_options *options, const fracas_mailbox *box,
                                    fracas_run_facts *facts);

/* The ranks of a run. */
typedef struct {
    const fracas_run_options *options;
    fracas_run_facts *facts; /* for ranks that are forked */
    fracas_rank_life *life;
    int jobs;
    int argc; /* to start this program again */
    char **argv;
} fracas_ranks;

typedef struct {
    const char *name; /* "mpirun" */
    /* Before the start: raises this process's limit on open files. FRACAS_ENVIRONMENT, naming the
     * limit, if the start would fail or hang under the limits of this process. */
    fracas_err (*check)(int jobs);
    /* Starts the ranks by a process in a group of its own, which dies with this process. The
     * folders that it needs are in *scratch, which holds none. */
    fracas_err (*start)(const fracas_ranks *ranks, fracas_scratch *scratch,
                        fracas_starter *starter);
} fracas_starter_kind;

extern const fracas_starter_kind fracas_starter_mpirun, fracas_starter_local;

/* mpirun where the surroundings name several machines, or FRACAS_MPIRUN asks for it. */
const fracas_starter_kind *fracas_starter_choose(void);

/* ---- for the kinds ---- */

/* Forks the starter: starter->pid is 0 in it. */
FRACAS_MUST_USE fracas_err fracas_starter_fork(fracas_starter *starter);

/* Raises the limit on open files of this process to `files` or more. */
FRACAS_MUST_USE fracas_err fracas_starter_raise_files(unsigned long files);

#endif
