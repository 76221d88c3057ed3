/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parent: owns terminal, signals and exit status, and starts mpirun. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_PARENT_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_PARENT_H

#include "campaigns/scheduler/run.h"

/* Runs `mpirun -n jobs <this program> argv[1] ...` to its end and returns how rank 0 says the run
 * ended. The caller has called fracas_signals_catch: a signal drains the run, a second one (not
 * SIGUSR1, SIGUSR2) kills it, and nothing that is done is lost. With options->walltime, counted
 * from `began` (fracas_now), the run is drained and at last killed before that time is over:
 * FRACAS_INTERRUPTED. Where mpirun ends before rank 0's last word it is started again, until three
 * starts in a row made nothing durable: FRACAS_ENVIRONMENT. When this returns no process of the run
 * is left on this machine. */
FRACAS_MUST_USE fracas_err fracas_parent_run(const fracas_run_options *options, double began,
                                             int argc, char **argv, bool *ran);

#endif
