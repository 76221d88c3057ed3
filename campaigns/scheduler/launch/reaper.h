/* This process as the reaper of all processes that come from it: the end of each is waited for here, whoever started it. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_REAPER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_REAPER_H

#include <stdbool.h>
#include <sys/types.h>

/* From here on processes whose parent dies become children of this one. */
void fracas_reaper_begin(void);

/* Takes the end of all children that have ended, without waiting; *status becomes that of `pid` when it is among them. False when no
 * child is left. */
bool fracas_reaper_wait(pid_t pid, int *status);

/* Kills every child. Theirs become children in turn: call it until fracas_reaper_wait is false. */
void fracas_reaper_kill(void);

#endif
