/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The launcher: owns terminal, signals and exit status, and starts the ranks. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_LAUNCHER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_LAUNCHER_H

#include "base/err.h"
#include "campaigns/scheduler/launch/starter.h"

/* Starts the ranks, runs them to their end and returns the result of rank 0. The caller has called
 * fracas_signals_catch: a signal drains the run, a second one (not SIGUSR1, SIGUSR2) kills it, and
 * done realizations are kept. A run with a walltime, counted from `began` (fracas_now), is drained
 * and at last killed before its end: FRACAS_INTERRUPTED. If the ranks end early they are started
 * again, k seconds after the k-th start in a row with no new durable realization; the third such
 * start, the first one counts, ends the run: FRACAS_ENVIRONMENT. On return no process of the run is
 * left on this machine. */
FRACAS_MUST_USE fracas_err fracas_launcher_run(const fracas_starter_kind *kind,
                                               const fracas_ranks *ranks, double began, bool *ran);

#endif
