/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The compute server of a rank: builds models, computes leases or forks a child for each, writes
 * segments. It knows neither MPI nor the index. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SERVER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SERVER_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/run.h"

/* The life of a server, in a process of its own that ignores the signals of terminals: `rank` is
 * the connection to its rank, and its end the server's.
 *
 * With FRACAS_ISOLATION_LEASE, and any lease that is `isolated`, a child computes the lease: the
 * server hears its rank all the time, and kills the child after lease.limit seconds. With
 * FRACAS_ISOLATION_NONE the server computes it itself and hears its rank between two batches: a
 * realization that crashes, or takes longer than lease.limit (SIGALRM), takes the server with it
 * and what that has in memory. The limit of memory holds in both; it is not one of models, which
 * the server builds, and keeps. One whose building kills the server, or takes longer than
 * lease.limit, is built in the child next time, for the lease is isolated then. */
_Noreturn void fracas_server_run(const fracas_campaign *campaign, const fracas_run_options *options,
                                 const char *study, int rank);

#endif
