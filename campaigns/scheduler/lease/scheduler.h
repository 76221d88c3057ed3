/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lease logic: which realizations are computed next and by which worker, without processes,
 * MPI, files or a clock.
 *
 * A lease is a number of realizations of one point, cut when a worker asks for it. It should take
 * about a second by the times measured in this run, is a whole number of batches, and near the end
 * at most a part of the remaining work. A worker holds it, has it in memory once it is computed,
 * and it is durable when its segment is committed. A failed lease loses only the batch at fault,
 * which is bisected until the faulty realization is alone. A lease that takes much longer than
 * predicted to compute or to become durable is leased to a second worker as well; the first copy to
 * be durable counts, the other is a duplicate. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LEASE_SCHEDULER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LEASE_SCHEDULER_H

#include "base/own.h"
#include "base/err.h"
#include "campaigns/scheduler/types/lease.h"
#include "campaigns/store/index.h"

#include <stdbool.h>

typedef struct {
    const double *cost; /* predicted for a realization of each point [element-steps]; not owned */
    const bool *first;  /* leased first, as more work depends on them; NULL: none; not owned */
    size_t npoints;
    size_t workers;
    size_t width;   /* realizations of a batch, 1 to FRACAS_LANES_MAX */
    double seconds; /* target duration of a lease [s]; 0: one batch each */
    double memory;  /* longest time of results in a worker's memory [s], --segment-age */
    double limit;   /* longest time of a lease [s]; 0: 600 s + 50 x predicted */
    size_t parts;   /* threads for a surface; 0: chosen lease by lease */
    bool shuffle;   /* random points, replicas and sizes instead of the longest first */
    uint64_t seed;  /* for the shuffle */
} fracas_scheduler_options;

typedef struct fracas_scheduler fracas_scheduler;

/* The planned rows of an index wait: `count` rows in plan order. A row with attempts is leased
 * alone. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_scheduler_create(const fracas_index_row *row, size_t count,
                                                   const fracas_scheduler_options *options,
                                                   fracas_scheduler **scheduler);
/* The same for more rows, in plan order, of a growing plan. */
FRACAS_MUST_USE fracas_err fracas_scheduler_add(fracas_scheduler *scheduler,
                                                const fracas_index_row *row, size_t count);
void fracas_scheduler_destroy(fracas_scheduler *scheduler); /* NULL is allowed */
FRACAS_OWNER(fracas_scheduler, fracas_scheduler_destroy)

/* Leases to `worker` at time `now` [s, of a monotonic clock]; *given is false when none waits or
 * the worker has enough. It may hold two leases, or one when at most a batch waits for each worker.
 * Failed and lost leases go first, then the longest of the `first` points, then the longest.
 *   est_p = seconds per realization of point p: measured, else cost_p x measured seconds / cost
 *   n     = min(seconds / est_p, sum_q waiting_q est_q / (2 workers est_p), FRACAS_LEASE_MAX),
 * down to whole batches. With less than a batch for each worker n = min(width, waiting / f), where
 * f workers are free within half the time of a batch. While nothing is measured, one batch.
 * The last leases have lease->parts above 1, where options->parts is 0: the number of workers over
 * that of realizations waiting and workers with a lease, so that no core is idle; but 1 where a
 * realization has failed, as it might have for want of threads or of their memory.
 * O(log points) steps, for the last leases O(workers). FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_scheduler_next(fracas_scheduler *scheduler, size_t worker,
                                                 double now, fracas_lease *lease, bool *given);

/* Leases to `worker`, when it has nothing and nothing waits, a copy of the lease that is overdue
 * longest; *late is the other worker. A lease is overdue when one worker alone has held it for more
 * than 10 s and 4 times its prediction, or had it in memory for options->memory longer. The time
 * counts from the start of its run. *given is false if there is none. O(leases) steps. */
void fracas_scheduler_overdue(fracas_scheduler *scheduler, size_t worker, double now,
                              fracas_lease *lease, size_t *late, bool *given);

/* The worker has computed lease `id` in `seconds`, at time `now`: it is in its memory. FRACAS_BUG
 * unless the worker held it, FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_scheduler_computed(fracas_scheduler *scheduler, size_t worker,
                                                     uint64_t id, double now, double seconds);

/* Lease `id` of the worker ended early at `now`. Its first `kept` realizations are in the worker's
 * memory, the next `count` (one batch) are at fault, the others were not begun. *lease holds the
 * ones at fault: several are bisected, a single one counts an attempt, *final if it was the last.
 * lease->count is 0 when another worker has or had the same lease, whose result counts. FRACAS_BUG
 * unless the worker held it, FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_scheduler_failed(fracas_scheduler *scheduler, size_t worker,
                                                   uint64_t id, double now, size_t kept,
                                                   size_t count, fracas_lease *lease, bool *final);

/* All leases in the worker's memory are durable. */
void fracas_scheduler_durable(fracas_scheduler *scheduler, size_t worker);

/* The worker's server is gone: its leases wait again, first in line. Those it held are to be
 * computed in isolation. */
void fracas_scheduler_lost(fracas_scheduler *scheduler, size_t worker);

/* True when the worker holds no lease. */
bool fracas_scheduler_idles(const fracas_scheduler *scheduler, size_t worker);
/* True when it has computed leases in memory. */
bool fracas_scheduler_keeps(const fracas_scheduler *scheduler, size_t worker);

/* True when every realization is in memory, durable or failed for good. */
bool fracas_scheduler_computed_all(const fracas_scheduler *scheduler);

/* Predicted seconds from `now` until the worker has computed its leases and the next one, or its
 * leases alone when nothing waits; NAN while nothing is measured. */
double fracas_scheduler_predicted(const fracas_scheduler *scheduler, size_t worker, double now);

fracas_counts fracas_scheduler_count(const fracas_scheduler *scheduler);

#endif
