/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Number of processes of a run: one for each core of its allocation. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_ALLOCATION_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_ALLOCATION_H

#include "base/err.h"

#include <stdbool.h>
#include <stdint.h>

/* Sum of a list as Slurm writes it, "16(x2),8" = 40; 0 if it is none. */
long fracas_allocation_sum(const char *list);

/* max(1, min(mask, floor(quota))): whole cores of an affinity mask and of processor time (quota.h)
 * [cores]. */
int fracas_allocation_within(int mask, double quota);
/* The same of this process. */
int fracas_allocation_cores(void);

/* *jobs = `wanted`; if 0, in a Slurm job its tasks (or cores, if it has no number of tasks), else
 * the cores available to this process over `parts`, the threads of a job (0: 1). FRACAS_USAGE
 * outside Slurm when `wanted` is far above the cores, as after a typing error, or has several parts
 * and more threads than cores. */
FRACAS_MUST_USE fracas_err fracas_allocation_jobs(int wanted, int64_t parts, int *jobs);

/* The surroundings may name several machines: nodes of a Slurm job, or a list of hosts. */
bool fracas_allocation_spreads(void);

/* FRACAS_USAGE in one of several processes started by srun without MPI: each would run the whole
 * campaign. */
FRACAS_MUST_USE fracas_err fracas_allocation_check(void);

#endif
