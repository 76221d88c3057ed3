/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which realizations are computed next, and by whom: the lease logic alone, without processes, MPI,
 * files or a clock.
 *
 * A lease is a number of realizations of one point, cut when a worker asks for it: so many that it
 * takes about a second by what leases of this run took so far, a whole number of batches, and
 * towards the end never more than a share of what is left. It is held by a worker, is in the
 * worker's memory once it is computed, and is durable when its segment is committed. A lease that
 * fails costs nothing but the batch that failed: that is bisected until the faulty realization is
 * alone. A lease that takes much longer than predicted, or to become durable, is given to a second
 * worker as well; whichever is durable first counts, the other is a duplicate. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LEASE_SCHEDULER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LEASE_SCHEDULER_H

#include "base/err.h"
#include "campaigns/store/store.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    FRACAS_BATCH_MAX = 8,    /* realizations side by side: lanes of the widest batch */
    FRACAS_LEASE_MAX = 4096, /* realizations of a lease */
    FRACAS_LEASES_HELD = 2,  /* by one worker: the one that runs and the one ahead */
    FRACAS_ATTEMPTS_MAX = 3  /* of one realization alone, before it is FAILED */
};

/* A lease as it is sent to a worker: its first fracas_lease_bytes. */
typedef struct {
    uint64_t id;
    uint64_t point;    /* in the campaign */
    uint64_t count;    /* of replicas, 1 to FRACAS_LEASE_MAX */
    uint64_t isolated; /* not 0: it was held by a worker that died, and may be why: a process of its
                          own computes it, whatever --isolation */
    double limit;      /* s that it may take */
    int64_t replica[FRACAS_LEASE_MAX];
} fracas_lease;

size_t fracas_lease_bytes(const fracas_lease *lease);

typedef struct {
    const double *cost; /* predicted for a realization of each point, element-steps: must outlive
                           the scheduler */
    const bool *first; /* points that go before all others, because more work depends on them; NULL:
                          none; must outlive it, too */
    size_t npoints;
    size_t workers;
    size_t width;   /* realizations of a batch, 1 to FRACAS_BATCH_MAX */
    double seconds; /* that a lease should take; 0: one batch each */
    double memory;  /* s that results may stay in a worker's memory */
    double limit;   /* s that a lease may take; 0: 600 s and 50 times what is predicted */
    bool shuffle;   /* random points, replicas and sizes, instead of the longest first */
    uint64_t seed;  /* of the shuffle */
} fracas_scheduler_options;

/* Realizations by state; what is in none of these waits or is held. */
typedef struct {
    int64_t total;
    int64_t done;   /* durable */
    int64_t memory; /* computed, not yet durable */
    int64_t failed; /* for good */
    double work; /* predicted cost of what this run has computed, as a share of all it has to: 0 to
                    1 */
    int64_t duplicates; /* computed a second time because the first took too long: counted in none
                           of the above */
} fracas_scheduler_counts;

typedef struct fracas_scheduler fracas_scheduler;

/* The planned rows of an index (`count` rows in plan order) wait. A row with attempts is leased
 * alone. */
FRACAS_MUST_USE fracas_err fracas_scheduler_create(const fracas_index_row *row, size_t count,
                                                   const fracas_scheduler_options *options,
                                                   fracas_scheduler **scheduler);
/* The same for more rows, in plan order, of a plan that grows. */
FRACAS_MUST_USE fracas_err fracas_scheduler_add(fracas_scheduler *scheduler,
                                                const fracas_index_row *row, size_t count);
void fracas_scheduler_destroy(fracas_scheduler *scheduler); /* NULL is allowed */

/* Gives `worker` the next lease at time `now` [s, of any clock that only grows]; *given is false
 * when none waits or the worker has enough: one that runs and one ahead, or only one that runs when
 * no more than a batch waits for each worker. est_p = seconds per realization of point p: measured,
 * else cost_p times measured seconds / cost of all points n = min(seconds / est_p, sum_q waiting_q
 * est_q / (2 workers est_p), FRACAS_LEASE_MAX), down to whole batches, and a batch at least, or
 * when less than a batch waits for each worker, min(width, waiting / workers that will be free
 *       within half the time of a batch); while nothing is measured one batch, shared with the
 * workers that hold nothing of the point with the largest est_p among those that go first, else
 * among all. Failed or lost leases go first. Takes log(points) steps, and one per worker for the
 * last ones. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_scheduler_next(fracas_scheduler *scheduler, size_t worker,
                                                 double now, fracas_lease *lease, bool *given);

/* Gives `worker`, when it has nothing and nothing waits, a copy of the lease that is overdue
 * longest: held by one worker alone for more than 4 times what was predicted and 10 s, counted from
 * when it began to run, or for one ahead from when it was given; or for as long in its memory and
 * options->memory more. *late: that worker. *given is false when there is none. Takes a step for
 * every lease that workers have. */
void fracas_scheduler_overdue(fracas_scheduler *scheduler, size_t worker, double now,
                              fracas_lease *lease, size_t *late, bool *given);

/* At `now` the worker has computed lease `id`, in `seconds`: it is in its memory. FRACAS_BUG unless
 * the worker held it, FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_scheduler_computed(fracas_scheduler *scheduler, size_t worker,
                                                     uint64_t id, double now, double seconds);

/* Lease `id` of the worker ended early at `now`: its first `kept` realizations are computed and in
 * the worker's memory, the next `count` (one batch) are at fault, the others were not begun. *lease
 * is what was at fault; of one realization an attempt is counted, and *final tells whether it was
 * the last one; more are bisected. lease->count is 0 when another worker has the same lease, or had
 * it: then nothing is lost, and what it says counts. FRACAS_BUG unless the worker held it,
 * FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_scheduler_failed(fracas_scheduler *scheduler, size_t worker,
                                                   uint64_t id, double now, size_t kept,
                                                   size_t count, fracas_lease *lease, bool *final);

/* All that the worker had in memory is durable. */
void fracas_scheduler_durable(fracas_scheduler *scheduler, size_t worker);

/* The worker's server is gone: what it held waits again, to be computed in isolation, and what it
 * had in memory, first in line. */
void fracas_scheduler_lost(fracas_scheduler *scheduler, size_t worker);

/* True when the worker holds no lease. */
bool fracas_scheduler_idles(const fracas_scheduler *scheduler, size_t worker);
/* True when it has computed leases that are not durable yet. */
bool fracas_scheduler_keeps(const fracas_scheduler *scheduler, size_t worker);

/* True when no realization waits or is held without having been computed by another: everything is
 * in memory, durable or failed. */
bool fracas_scheduler_computed_all(const fracas_scheduler *scheduler);

/* s from `now` until the worker will have computed what it holds and the lease that comes next, as
 * predicted: NAN when nothing is measured, and for what it holds alone when nothing waits. */
double fracas_scheduler_predicted(const fracas_scheduler *scheduler, size_t worker, double now);

fracas_scheduler_counts fracas_scheduler_count(const fracas_scheduler *scheduler);

#endif
