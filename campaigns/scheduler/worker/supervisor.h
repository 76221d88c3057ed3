/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The supervisor: a process between a rank and its compute server. A rank must not fork once MPI
 * runs. The supervisor is forked before, does not know MPI, and restarts dead servers.
 *
 *   rank - supervisor - server - lease        each the parent of the next, which dies with it
 *
 * The rank sends messages to its server directly, and asks the supervisor only for new servers. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SUPERVISOR_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SUPERVISOR_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/options.h"

#include <sys/types.h>

typedef struct {
    pid_t pid;   /* its process; 0: none */
    int control; /* connection to it */
    int server;  /* connection to the server, for messages; -1: none */
} fracas_supervisor;

/* Forks the supervisor, which forks the first server. Call it before MPI_Init and in the main
 * thread; the supervisor dies with this process. The campaign, the options and the folder are for
 * servers. FRACAS_ENVIRONMENT without a process or socket: *supervisor is empty then. */
FRACAS_MUST_USE fracas_err fracas_supervisor_start(const fracas_campaign *campaign,
                                                   const fracas_run_options *options,
                                                   const char *study,
                                                   fracas_supervisor *supervisor);

/* After an unexpected end of the connection to the server: text of its death, "died of signal 11
 * (Segmentation fault)". FRACAS_ENVIRONMENT if the supervisor is gone as well: *supervisor is empty
 * then. */
FRACAS_MUST_USE fracas_err fracas_supervisor_reap(fracas_supervisor *supervisor, char *how,
                                                  size_t size);

/* Then: a new server. FRACAS_ENVIRONMENT if there is none: *supervisor is empty then. */
FRACAS_MUST_USE fracas_err fracas_supervisor_restart(fracas_supervisor *supervisor);

/* Ends the server, by force after 2 s, and the supervisor, and waits for it. */
void fracas_supervisor_end(fracas_supervisor *supervisor);

#endif
