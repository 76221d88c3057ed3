/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running a campaign: the launcher, the ranks and their starter, compute servers, a process per
 * lease. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_RUN_H
#define FRACAS_CAMPAIGNS_SCHEDULER_RUN_H

#include "base/err.h"
#include "campaigns/scheduler/types/facts.h"
#include "campaigns/scheduler/types/options.h"

/* Runs, resumes or extends the campaign until study.h5 is there. The launcher starts the ranks, by
 * itself or by `mpirun -n jobs <this program> argv[1] ...`, and returns the result of the run.
 * Under mpirun or srun this process is one rank, and only rank 0's result has a meaning. FRACAS_OK,
 * FRACAS_SOME_FAILED, FRACAS_INTERRUPTED and the errors of exit statuses 2 to 70. *facts: of the
 * campaign, cleared by the caller, also after an error. */
FRACAS_MUST_USE fracas_err fracas_run(const fracas_run_options *options, int argc, char **argv,
                                      fracas_run_facts *facts);

/* True in a process started by mpirun, srun or another PMI launcher: a rank of MPI. */
bool fracas_run_is_rank(void);

/* True in the only process with reports to the user: the launcher, or rank 0 under the user's own
 * mpirun or srun. */
bool fracas_run_owns_terminal(void);

#endif
