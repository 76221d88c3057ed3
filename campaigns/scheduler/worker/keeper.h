/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The keeper: a process between a rank and its compute server. A rank must not fork once MPI runs;
 * the keeper is forked before and knows nothing of MPI, so it can replace a server that died.
 *
 *   rank - keeper - server - child        each the parent of the next, which dies with it
 *
 * The rank talks to its server directly, and to the keeper only about lives and deaths. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_KEEPER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_KEEPER_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/run.h"

#include <sys/types.h>

typedef struct {
    pid_t pid;   /* of the keeper; 0: there is none (any more) */
    int control; /* connection to it */
    int server;  /* connection to the server, for messages; -1: there is none */
} fracas_keeper;

/* Forks the keeper, which forks the first server, before MPI_Init, in the main thread; the keeper
 * dies with this process. The campaign, the options and the folder are those of servers.
 * FRACAS_ENVIRONMENT if there is no process or socket: *keeper holds nothing then. */
FRACAS_MUST_USE fracas_err fracas_keeper_start(const fracas_campaign *campaign,
                                               const fracas_run_options *options, const char *study,
                                               fracas_keeper *keeper);

/* After the end of the connection to the server, without a last word of it: `how` it died, "died of
 * signal 11 (Segmentation fault)". FRACAS_ENVIRONMENT if the keeper is gone as well, and how:
 * *keeper holds nothing then. */
FRACAS_MUST_USE fracas_err fracas_keeper_bury(fracas_keeper *keeper, char *how, size_t size);

/* Then: a new server. FRACAS_ENVIRONMENT if it cannot be had: *keeper holds nothing then. */
FRACAS_MUST_USE fracas_err fracas_keeper_renew(fracas_keeper *keeper);

/* Ends the server, by the end of its connection, and after 2 s by force, and the keeper; waits for
 * it. */
void fracas_keeper_end(fracas_keeper *keeper);

#endif
