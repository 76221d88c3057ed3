/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How many processes a run should have: one for each core that it was given. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_ALLOCATION_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_ALLOCATION_H

#include "base/err.h"

/* Sum of a list as Slurm writes it, "16(x2),8" = 40; 0 if it is none. */
long fracas_allocation_sum(const char *list);

/* *jobs is `wanted`, or if that is 0: in a Slurm job its tasks (its cores where it asked for no
 * number of tasks), else the cores of this machine that this process may use. FRACAS_USAGE outside
 * Slurm when `wanted` is far more than those: a slip of the keyboard. */
FRACAS_MUST_USE fracas_err fracas_allocation_jobs(int wanted, int *jobs);

/* FRACAS_USAGE in one of several processes that srun started without MPI: each would take itself
 * for the only one. */
FRACAS_MUST_USE fracas_err fracas_allocation_check(void);

#endif
