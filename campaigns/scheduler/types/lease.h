/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A lease as rank 0 sends it to a worker, and the progress counts of a run. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_LEASE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_LEASE_H

#include <stddef.h>
#include <stdint.h>

enum {
    FRACAS_LEASE_MAX = 4096, /* realizations of a lease */
    FRACAS_LEASES_HELD = 2,  /* by one worker: one runs, one is ahead */
    FRACAS_ATTEMPTS_MAX = 3  /* at one realization alone, before it is FAILED */
};

/* Only the first fracas_lease_bytes are sent. */
typedef struct {
    uint64_t id;
    uint64_t point;    /* in the campaign */
    uint64_t count;    /* replicas, 1 to FRACAS_LEASE_MAX */
    uint64_t isolated; /* not 0: a worker died with it, so a process of its own computes it */
    double limit;      /* longest allowed time [s] */
    uint64_t parts;    /* threads for a surface */
    int64_t replica[FRACAS_LEASE_MAX];
} fracas_lease;

static inline size_t fracas_lease_bytes(const fracas_lease *lease)
{
    return offsetof(fracas_lease, replica) + (size_t)lease->count * sizeof *lease->replica;
}

/* Realizations by state. All others wait or are held by a worker. */
typedef struct {
    int64_t total;
    int64_t done;       /* durable */
    int64_t memory;     /* computed, not yet durable */
    int64_t failed;     /* for good */
    double work;        /* predicted cost of this run: computed over all, 0 to 1 */
    int64_t duplicates; /* computed again because the first copy took too long; in no other count */
} fracas_counts;

#endif
