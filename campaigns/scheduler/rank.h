/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One MPI rank: a thin proxy between its compute server and rank 0; rank 0 directs the run besides.
 */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_RANK_H
#define FRACAS_CAMPAIGNS_SCHEDULER_RANK_H

#include "campaigns/scheduler/run.h"

/* Runs this rank from before MPI_Init to after MPI_Finalize. Under a parent it returns FRACAS_OK,
 * *ran false: the parent is told. Else rank 0 returns how the run ended, and the others FRACAS_OK,
 * *ran false. */
FRACAS_MUST_USE fracas_err fracas_rank_run(const fracas_run_options *options, bool *ran);

#endif
