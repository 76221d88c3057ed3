/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The guard of a rank under somebody else's mpirun or srun. Open MPI ends a process itself where
 * MPI_Init fails: with status 1, SOME_FAILED here. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_GUARD_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_GUARD_H

#include "campaigns/scheduler/types/packet.h"

/* Forks. The child returns and is the rank. The parent forwards signals to it and ends as it does;
 * if the child ends before fracas_guard_pass, the parent says the remedy and ends with
 * FRACAS_ENVIRONMENT. The child dies with the parent. FRACAS_ENVIRONMENT if it cannot be forked. */
FRACAS_MUST_USE fracas_err fracas_guard_begin(void);
/* In the rank, before MPI starts: if MPI does not start, the guard says this trouble in place of
 * the remedy, and ends with its code. */
void fracas_guard_tell(const fracas_trouble *trouble);
/* In the rank, when MPI has started. Both do nothing without fracas_guard_begin. */
void fracas_guard_pass(void);

#endif
