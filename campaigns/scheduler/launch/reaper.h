/* SPDX-License-Identifier: GPL-3.0-or-later */
/* This process as the reaper of all processes that come from it: the end of each is waited for
 * here, whoever started it. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_REAPER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_REAPER_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

enum { FRACAS_FOREIGN_MAX = 64 };

/* Children that this process had before, as one that a shell started before it became fracas: they
 * are left alone. */
typedef struct {
    pid_t foreign[FRACAS_FOREIGN_MAX];
    size_t nforeign;
} fracas_reaper;

/* From here on processes whose parent dies become children of this one. */
void fracas_reaper_begin(fracas_reaper *reaper);

/* Takes the end of all children that have ended, without waiting; *status becomes that of `pid`
 * when it is among them. False when no child is left but foreign ones. */
bool fracas_reaper_wait(fracas_reaper *reaper, pid_t pid, int *status);

/* Kills every child but foreign ones. Theirs become children in turn: call it until
 * fracas_reaper_wait is false. */
void fracas_reaper_kill(const fracas_reaper *reaper);

#endif
