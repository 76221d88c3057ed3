/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The launcher: owns terminal, signals and exit status, and starts mpirun. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_LAUNCHER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_LAUNCHER_H

#include "base/err.h"
#include "campaigns/scheduler/types/options.h"

/* Runs `mpirun -n jobs <this program> argv[1] ...` to its end and returns the result of rank 0.
 * The caller has called fracas_signals_catch: a signal drains the run, a second one (not SIGUSR1,
 * SIGUSR2) kills it, and done realizations are kept. A run with options->walltime, counted from
 * `began` (fracas_now), is drained and at last killed before its end: FRACAS_INTERRUPTED. If mpirun
 * ends early it is started again, k seconds after the k-th start in a row with no new durable
 * realization; the third such start, the first one counts, ends the run: FRACAS_ENVIRONMENT. On
 * return no process of the run is left on this machine. */
FRACAS_MUST_USE fracas_err fracas_launcher_run(const fracas_run_options *options, int jobs,
                                               double began, int argc, char **argv, bool *ran);

#endif
