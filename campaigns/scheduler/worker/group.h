/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A group: processes of leases on several hosts for one body, peer 0 being the
 * lease's own. It computes alone until others have come, and again when one of them is gone. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_GROUP_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_GROUP_H

#include "base/own.h"
#include "campaigns/scheduler/types/lease.h"
#include "campaigns/scheduler/worker/connections.h"

/* Where a process listens. */
typedef struct {
    uint64_t port;
    char host[FRACAS_MEETING_HOST];
} fracas_address;

typedef struct fracas_group {
    int listener;                  /* for others; -1: closed */
    int guest;                     /* who comes and has not told the token yet; -1: nobody */
    double guest_came;             /* fracas_now */
    uint64_t token[2];             /* told by those who come; by the leading process at the start */
    size_t most;                   /* processes */
    int waiting[FRACAS_PEERS_MAX]; /* connections to those who have come, from 1 on ... */
    fracas_address address[FRACAS_PEERS_MAX]; /* ... and where they listen */
    size_t count;                             /* they and this one; 0: others cannot come */
    double opened, first; /* fracas_now of the opening, and when the first of them came */
    fracas_connections connections;
    fracas_peers peers;
} fracas_group;

/* No group: a process alone. */
void fracas_group_init(fracas_group *group);

/* Listens for up to `most` processes with this one; *meeting says where.
 * FRACAS_ENVIRONMENT without a socket. */
FRACAS_MUST_USE fracas_err fracas_group_open(fracas_group *group, size_t most,
                                             fracas_meeting *meeting);

/* Comes to a meeting, and waits until its computation starts from realization *from of the lease.
 * FRACAS_ENVIRONMENT if it never does, or if a stranger answers. */
FRACAS_MUST_USE fracas_err fracas_group_join(fracas_group *group, const fracas_meeting *meeting,
                                             size_t *from);

/* Others have come, and those behind the first have had time to. Waits for nobody. Call it now and
 * then. */
bool fracas_group_has_come(fracas_group *group);
/* Then: starts with them from realization `from` of the lease on. FRACAS_ENVIRONMENT: alone. */
FRACAS_MUST_USE fracas_err fracas_group_start(fracas_group *group, size_t from);

/* The others, for fracas_batch_options; NULL: alone. */
const fracas_peers *fracas_group_peers(const fracas_group *group);

/* Leaves the others, who notice, and stays alone. */
void fracas_group_leave(fracas_group *group);
static inline void fracas_group_clear(fracas_group *group)
{
    fracas_group_leave(group);
}

#endif
