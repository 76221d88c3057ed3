/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processes that compute one body together, over stream sockets between each two of them. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_CONNECTIONS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_CONNECTIONS_H

#include "base/err.h"
#include "engine/engine.h"

enum { FRACAS_PEERS_PATIENCE = 60 /* s */ };

typedef struct {
    size_t count, number;
    int fd[FRACAS_PEERS_MAX]; /* to each other peer; owned */
} fracas_connections;

/* fracas_peers.exchange. FRACAS_ENVIRONMENT where a peer is gone before all of its bytes have come;
 * in the leading peer also where none have come for FRACAS_PEERS_PATIENCE; in the others where the
 * leading one is gone. */
FRACAS_MUST_USE fracas_err fracas_connections_exchange(void *connections, const fracas_parcel *out,
                                                       const fracas_parcel *in);

void fracas_connections_close(fracas_connections *connections);

#endif
