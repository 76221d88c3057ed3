/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the processes of a run have in common. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_PROCESS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_PROCESS_H

#include <stddef.h>
#include <sys/types.h>

/* The kernel kills the process with the highest score (0 to 1000) first where memory runs out. What
 * computes should go before what has records in memory, and both before ranks. */
enum { FRACAS_OOM_SAME = 0, FRACAS_OOM_COMPUTING_SERVER = 900, FRACAS_OOM_CHILD = 1000 };

/* The first thing in a new process: it is called `name` (15 bytes at most), dies with the process
 * `parent` that forked it (which must have done so in its main thread: the signal follows the
 * thread), and has this score, FRACAS_OOM_SAME: its parent's. */
void fracas_process_begin(const char *name, pid_t parent, int oom_score);

/* How a process ended, by the status of waitpid: "died of signal 11 (Segmentation fault)", "ended
 * with status 3". */
void fracas_process_end_text(int status, char *text, size_t size);

#endif
