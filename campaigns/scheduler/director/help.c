/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Idle workers of other hosts help with the last leases: their processes come to that of the lease,
 * and compute its bodies with it. A helper holds nothing: it may be lost, and any lease of its own
 * ends its help. */
#include "campaigns/scheduler/director/state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct fracas_helper {
    fracas_hash host;
    fracas_lease *lead; /* its lease, for helpers; its meeting has a port once it is open */
    size_t helpers;     /* so many were sent to it */
    size_t leader;      /* one more than the worker that it helps; 0: none */
    uint64_t last;      /* one more than the lease that it helped with last */
} fracas_helper;

fracas_err fracas_help_create(size_t workers, fracas_helper **helper)
{
    *helper = calloc(workers, sizeof **helper);
    return *helper ? FRACAS_OK : fracas_no_memory("the workers");
}

void fracas_help_destroy(fracas_helper *helper, size_t workers)
{
    for (size_t w = 0; helper && w < workers; w++) free(helper[w].lead);
    free(helper);
}

void fracas_help_ready(fracas_director *director, size_t worker, const fracas_hash *host)
{
    director->helper[worker].host = *host;
}

bool fracas_help_may_come(const fracas_director *director, size_t worker)
{
    const fracas_helper *h = director->helper;
    for (size_t w = 0; !director->setup.one_host && w < director->setup.workers; w++)
        if (director->phase[w] != ENDED && !fracas_hash_equal(&h[w].host, &h[worker].host))
            return true;
    return false;
}

fracas_err fracas_help_lease(fracas_director *director, size_t worker, const fracas_lease *lease)
{
    if (lease->role != FRACAS_LEASE_LEADS) return FRACAS_OK;
    fracas_lease *copy = calloc(1, sizeof *copy);
    if (!copy) return fracas_no_memory("a lease");
    memcpy(copy, lease, fracas_lease_bytes(lease));
    copy->role = FRACAS_LEASE_HELPS;
    fracas_help_end(director, worker);
    director->helper[worker].lead = copy;
    return FRACAS_OK;
}

fracas_err fracas_help_meet(fracas_director *director, size_t worker, const fracas_packet *message)
{
    fracas_meeting meeting;
    TRY(fracas_packet_body(message, &meeting, sizeof meeting));
    fracas_lease *lead = director->helper[worker].lead;
    if (!lead || lead->id != meeting.lease) return FRACAS_OK; /* it is over */
    director->meetings += lead->meeting.port == 0;
    lead->meeting = meeting;
    return FRACAS_OK;
}

void fracas_help_end(fracas_director *director, size_t worker)
{
    fracas_helper *h = &director->helper[worker];
    if (!h->lead) return;
    director->meetings -= h->lead->meeting.port > 0;
    free(h->lead);
    h->lead = NULL;
    h->helpers = 0;
}

void fracas_help_free(fracas_director *director, size_t worker)
{
    director->helper[worker].leader = 0;
}

fracas_err fracas_help_over(fracas_director *director, size_t worker, const fracas_packet *message)
{
    fracas_trouble why;
    char text[1200];
    TRY(fracas_packet_body(message, &why, sizeof why));
    snprintf(text, sizeof text, "rank %zu has helped rank %zu: %s", worker,
             director->helper[worker].leader - 1, why.text);
    fracas_help_free(director, worker);
    return fracas_index_event(director->index, "helped", text);
}

/* The worker's host has no part in the leader's lease, and the worker has not had one before. */
static bool may_help(const fracas_director *director, size_t worker, size_t leader)
{
    const fracas_helper *h = director->helper;
    if (!h[leader].lead || !h[leader].lead->meeting.port ||
        h[worker].last == h[leader].lead->id + 1 || h[leader].helpers + 1 >= FRACAS_PEERS_MAX)
        return false;
    for (size_t w = 0; w < director->setup.workers; w++)
        if ((w == leader || h[w].leader == leader + 1) &&
            fracas_hash_equal(&h[w].host, &h[worker].host))
            return false;
    return true;
}

static fracas_err offer(fracas_director *director, size_t worker)
{
    fracas_helper *h = director->helper;
    size_t leader = SIZE_MAX;
    for (size_t w = 0; w < director->setup.workers; w++)
        if (may_help(director, worker, w) &&
            (leader == SIZE_MAX || h[w].helpers < h[leader].helpers))
            leader = w;
    if (leader == SIZE_MAX) return FRACAS_OK;
    h[worker].leader = leader + 1;
    h[worker].last = h[leader].lead->id + 1;
    h[leader].helpers++;
    return fracas_director_post(director, worker, FRACAS_PACKET_LEASE, h[leader].lead,
                                fracas_lease_bytes(h[leader].lead));
}

fracas_err fracas_help_offer(fracas_director *director)
{
    for (size_t w = 0; director->meetings && !director->stopping && w < director->setup.workers;
         w++)
        if (director->phase[w] == WORKING && !director->helper[w].leader &&
            fracas_scheduler_idles(director->scheduler, w))
            TRY(offer(director, w));
    return FRACAS_OK;
}
