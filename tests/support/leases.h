/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scheduler of leases and what tests ask of it. */
#ifndef FRACAS_TESTS_SUPPORT_LEASES_H
#define FRACAS_TESTS_SUPPORT_LEASES_H

#include "campaigns/scheduler/lease/scheduler.h"
#include "tests/support/test.h"

enum { POINTS = 3, MANY = 10000 };
static const double cost[POINTS] = {1, 100, 10};

/* `replicas` of each of `points` points, from point 0. Freed by the caller. */
static inline fracas_index_row *rows(size_t points, size_t replicas)
{
    fracas_index_row *row = zeroed(points * replicas, sizeof *row);
    for (size_t i = 0; i < points * replicas; i++)
        row[i] = (fracas_index_row){.point = i / replicas, .replica = (int64_t)(i % replicas)};
    return row;
}

static inline fracas_scheduler *create_with(const fracas_index_row *row, size_t count,
                                            const fracas_scheduler_options *options)
{
    fracas_scheduler *scheduler;
    OK(fracas_scheduler_create(row, count, options, &scheduler));
    return scheduler;
}

static inline fracas_scheduler_options options_for(size_t workers)
{
    return (fracas_scheduler_options){
        .cost = cost, .npoints = POINTS, .workers = workers, .width = 8, .seconds = 1, .seed = 7};
}

/* `replicas` of each of `points` points for so many workers, in batches of 8 and leases of 1 s. */
static inline fracas_scheduler *create(size_t points, size_t replicas, size_t workers)
{
    OWNED fracas_index_row *row = rows(points, replicas);
    const fracas_scheduler_options options = options_for(workers);
    fracas_scheduler *scheduler = create_with(row, points * replicas, &options);
    return scheduler;
}

static inline bool next(fracas_scheduler *scheduler, size_t worker, double now, fracas_lease *lease)
{
    bool given;
    OK(fracas_scheduler_next(scheduler, worker, now, lease, &given));
    return given;
}

static inline void computed(fracas_scheduler *scheduler, size_t worker, const fracas_lease *lease,
                            double seconds)
{
    OK(fracas_scheduler_computed(scheduler, worker, lease->id, 0, seconds));
}

static inline void assert_lease(const fracas_lease *lease, uint64_t point, int64_t first,
                                uint64_t count)
{
    assert_int_equal(lease->point, point);
    assert_int_equal(lease->replica[0], first);
    assert_int_equal(lease->count, count);
}

static inline void assert_counts(const fracas_scheduler *scheduler, int64_t done, int64_t memory,
                                 int64_t failed)
{
    fracas_counts count = fracas_scheduler_count(scheduler);
    assert_int_equal(count.done, done);
    assert_int_equal(count.memory, memory);
    assert_int_equal(count.failed, failed);
    /* sums of some hundreds of costs: a few roundings from the exact share */
    assert_true(count.work > -1e-12 && count.work < 1 + 1e-12);
    assert_int_equal(count.work > 1 - 1e-12, fracas_scheduler_computed_all(scheduler));
}

#endif
