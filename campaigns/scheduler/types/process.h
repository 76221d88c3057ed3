/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Set-up and end of the processes of a run. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_PROCESS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_PROCESS_H

#include "base/err.h"

#include <sys/types.h>

/* Out of memory, the kernel first kills the process with the highest score (0 to 1000). A process
 * of a lease should go before a server with records in memory, and both before a rank. */
enum { FRACAS_OOM_SAME = 0, FRACAS_OOM_COMPUTING_SERVER = 900, FRACAS_OOM_CHILD = 1000 };

/* Forks a process to die with this one: *pid is 0 in it. Its name has 15 bytes at most, its
 * out-of-memory score is `oom_score` (FRACAS_OOM_SAME: as its parent). To be called in the main
 * thread, since the signal follows the thread. FRACAS_ENVIRONMENT, naming its `purpose`, without a
 * process. */
FRACAS_MUST_USE fracas_err fracas_process_fork(const char *name, int oom_score, const char *purpose,
                                               pid_t *pid);

/* The end of a process, from the status of waitpid: "died of signal 11 (Segmentation fault)",
 * "ended with status 3". */
void fracas_process_end_text(int status, char *text, size_t size);

#endif
