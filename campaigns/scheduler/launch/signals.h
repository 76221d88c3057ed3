/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Signals of the launcher and of the ranks: they ask for the end of the run and never end the
 * process. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_SIGNALS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_SIGNALS_H

#include <stdbool.h>

/* From here on SIGINT, SIGTERM, SIGHUP, SIGUSR1 and SIGUSR2 are counted (SIGHUP not under nohup).
 * SIGPIPE is ignored: a run continues when nobody reads its progress. */
void fracas_signals_catch(void);

/* The same of a rank: SIGUSR1 (the launcher, through mpirun), SIGUSR2, SIGTERM and SIGINT (mpirun,
 * srun, a batch system). Faults of pipes and files become errors of write. */
void fracas_signals_catch_rank(void);

/* One of them came: the run is to drain. */
bool fracas_signals_ask(void);

/* SIGINT, SIGTERM and SIGHUP came twice: stop at once. SIGUSR1 and SIGUSR2 never insist, as batch
 * systems may send them often. */
bool fracas_signals_insist(void);

/* Nothing runs any more: SIGUSR1 and SIGUSR2 are ignored, the others end the process with
 * FRACAS_INTERRUPTED. */
void fracas_signals_end(void);

#endif
