/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The compute server of a rank: builds models, computes leases or forks a process for each, writes
 * segments. It knows neither MPI nor the index. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SERVER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SERVER_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/options.h"

/* The life of a server, in a process of its own without signals of terminals. `rank` is
 * the connection to its rank; the server ends with it.
 *
 * FRACAS_ISOLATION_LEASE, and every `isolated` lease: a child process computes the lease. The
 * server reads messages all the time, and kills the child after lease.limit seconds.
 *
 * FRACAS_ISOLATION_NONE: the server computes the lease itself and reads messages between batches. A
 * crash, or a lease longer than lease.limit (SIGALRM), kills the server and loses its records in
 * memory.
 *
 * The memory limit holds for both, but not for models, which the server builds and keeps. If
 * building a model kills the server or takes longer than lease.limit, the lease comes back
 * isolated and the child builds the model. */
_Noreturn void fracas_server_run(const fracas_campaign *campaign, const fracas_run_options *options,
                                 const char *study, int rank);

#endif
