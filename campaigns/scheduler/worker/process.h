/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Set-up and end of the processes of a run. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_PROCESS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_PROCESS_H

#include <stddef.h>
#include <sys/types.h>

/* Out of memory, the kernel first kills the process with the highest score (0 to 1000). A process
 * of a lease should go before a server with records in memory, and both before a rank. */
enum { FRACAS_OOM_SAME = 0, FRACAS_OOM_COMPUTING_SERVER = 900, FRACAS_OOM_CHILD = 1000 };

/* First call in a new process: sets its name (15 bytes at most), its out-of-memory score
 * (FRACAS_OOM_SAME: as its parent), and lets it die with `parent`. The parent must have forked in
 * its main thread, since the signal follows the thread. */
void fracas_process_begin(const char *name, pid_t parent, int oom_score);

/* The end of a process, from the status of waitpid: "died of signal 11 (Segmentation fault)",
 * "ended with status 3". */
void fracas_process_end_text(int status, char *text, size_t size);

#endif
