/* Which realizations are computed next, and by whom: the lease logic alone, without processes, MPI or files.
 *
 * A lease is a batch of realizations of one point. It waits, is held by a worker, is in the worker's memory once it is
 * computed, and is durable when its segment is committed. A lease that fails costs nothing but itself: its
 * realizations wait again one by one, so that the faulty one is found. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SCHEDULER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SCHEDULER_H

#include "base/err.h"
#include "campaigns/store/store.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    FRACAS_LEASE_MAX = 8,     /* realizations of a lease: lanes of the widest batch */
    FRACAS_LEASES_HELD = 2,   /* by one worker: the one that runs and the one ahead */
    FRACAS_ATTEMPTS_MAX = 3   /* of one realization alone, before it is FAILED */
};

/* A lease as it is sent to a worker. */
typedef struct {
    uint64_t id;
    uint64_t point; /* in the campaign */
    uint64_t count; /* of replicas, 1 to FRACAS_LEASE_MAX */
    int64_t replica[FRACAS_LEASE_MAX];
} fracas_lease;

typedef struct {
    const double *cost; /* predicted, one per point, any unit: longest leases go first; must outlive the scheduler */
    size_t workers;
    size_t width;       /* most realizations of a lease, 1 to FRACAS_LEASE_MAX */
    bool shuffle;       /* random replicas in a batch and random leases first, instead of the longest */
    uint64_t seed;      /* of the shuffle */
} fracas_scheduler_options;

/* Realizations by state; what is in none of these waits or is held. */
typedef struct {
    int64_t total;
    int64_t done;   /* durable */
    int64_t memory; /* computed, not yet durable */
    int64_t failed; /* for good */
    double work;    /* predicted cost of what this run has computed, as a share of all it has to: 0 to 1 */
} fracas_scheduler_counts;

typedef struct fracas_scheduler fracas_scheduler;

/* Leases for every planned row of an index (`count` rows in plan order). A row with attempts is leased alone. */
FRACAS_MUST_USE fracas_err fracas_scheduler_create(const fracas_index_row *row, size_t count,
                                                   const fracas_scheduler_options *options,
                                                   fracas_scheduler **scheduler);
/* The same for more rows, in plan order, of a plan that grows; their leases wait last. */
FRACAS_MUST_USE fracas_err fracas_scheduler_add(fracas_scheduler *scheduler, const fracas_index_row *row, size_t count);
void fracas_scheduler_destroy(fracas_scheduler *scheduler); /* NULL is allowed */

/* Gives `worker` the next lease; false when none waits or the worker has enough: one that runs and one ahead, or
 * only one that runs while no more leases wait than there are workers, so that the last ones are spread evenly. */
bool fracas_scheduler_next(fracas_scheduler *scheduler, size_t worker, fracas_lease *lease);

/* The worker has computed lease `id`: it is in its memory. FRACAS_BUG unless the worker held it. */
FRACAS_MUST_USE fracas_err fracas_scheduler_computed(fracas_scheduler *scheduler, size_t worker, uint64_t id);

/* Lease `id` of the worker ended without its records. *lease is what it was; a lease of one realization counts
 * an attempt, and *final tells whether it was the last one. FRACAS_BUG unless the worker held it. */
FRACAS_MUST_USE fracas_err fracas_scheduler_failed(fracas_scheduler *scheduler, size_t worker, uint64_t id,
                                                   fracas_lease *lease, bool *final);

/* All that the worker had in memory is durable. */
void fracas_scheduler_durable(fracas_scheduler *scheduler, size_t worker);

/* The worker is gone: what it held and had in memory waits again, first in line. */
void fracas_scheduler_lost(fracas_scheduler *scheduler, size_t worker);

/* True when the worker holds no lease. */
bool fracas_scheduler_idles(const fracas_scheduler *scheduler, size_t worker);
/* True when it has computed leases that are not durable yet. */
bool fracas_scheduler_keeps(const fracas_scheduler *scheduler, size_t worker);

/* True when no lease waits or is held: everything is in memory, durable or failed. */
bool fracas_scheduler_computed_all(const fracas_scheduler *scheduler);

fracas_scheduler_counts fracas_scheduler_count(const fracas_scheduler *scheduler);

#endif
