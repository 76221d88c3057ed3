/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reaps all descendants of this process. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_REAP_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_REAP_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

enum { FRACAS_FOREIGN_MAX = 64 };

/* Foreign children, which a shell started before it became fracas: these are left alone. */
typedef struct {
    pid_t foreign[FRACAS_FOREIGN_MAX];
    size_t nforeign;
} fracas_reap;

/* From here on, orphaned descendants become children of this process. */
void fracas_reap_begin(fracas_reap *reap);

/* Reaps all ended children without waiting; *status is set if `pid` is among them. False when only
 * foreign children are left. */
bool fracas_reap_wait(fracas_reap *reap, pid_t pid, int *status);

/* Kills all children but foreign ones. Their children become ours, so call it until
 * fracas_reap_wait is false. */
void fracas_reap_kill(fracas_reap *reap);

#endif
