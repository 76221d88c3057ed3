/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lease logic where leases fail: bisecting, attempts, lost workers. */
#include "tests/support/leases.h"

/* A lease of `count` of one point for one worker, measured so that it is one lease. */
static fracas_scheduler *create_large(size_t count, fracas_lease *lease)
{
    fracas_scheduler *scheduler = create(2, 2 * count, 1);
    assert_true(next(scheduler, 0, 0, lease));
    computed(scheduler, 0, lease, 0.08);
    for (size_t i = 8; i < 2 * count; i += lease->count) { /* point 1 goes first: all of it */
        assert_true(next(scheduler, 0, 0, lease));
        assert_int_equal(lease->point, 1);
        computed(scheduler, 0, lease, 0.01 * (double)lease->count);
    }
    fracas_scheduler_durable(scheduler, 0);
    assert_true(next(scheduler, 0, 0, lease));
    assert_lease(lease, 0, 0, count);
    return scheduler;
}

/* 8 -> 4 -> 2 -> 1: the one at fault is found in log2 of the batch, has three attempts in all, and
 * everything else is computed. */
static void a_failed_batch_is_bisected(void **state)
{
    enum { COUNT = 24, KEPT = 8, BAD = 13 };
    fracas_lease lease;
    bool final;
    OWN(fracas_scheduler) scheduler = create_large(COUNT, &lease);
    OK(fracas_scheduler_failed(scheduler, 0, lease.id, 0, KEPT, 8, &lease, &final));
    assert_lease(&lease, 0, KEPT, 8); /* what was at fault */
    assert_false(final);
    assert_counts(scheduler, 2 * COUNT, KEPT, 0); /* the first batch is kept */
    /* 8-11 good, 12-15 bad: 12-13 bad: 12 good, 13 bad, 14-15 good, the batch that was not begun,
     * then 13 again twice. */
    static const int64_t order[] = {8, 12, 12, 12, 13, 14, 16, 13, 13};
    static const uint64_t size[] = {4, 4, 2, 1, 1, 2, 8, 1, 1};
    for (size_t i = 0; i < 9; i++) {
        assert_true(next(scheduler, 0, 0, &lease));
        assert_lease(&lease, 0, order[i], size[i]);
        assert_int_equal(lease.isolated, 0);
        if (order[i] > BAD || order[i] + (int64_t)size[i] <= BAD) {
            computed(scheduler, 0, &lease, 0.001);
            continue;
        }
        OK(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 0, (size_t)size[i], &lease, &final));
        assert_lease(&lease, 0, order[i], size[i]);
        assert_int_equal(final, i == 8);
    }
    assert_counts(scheduler, 2 * COUNT, COUNT - 1, 1);
    while (next(scheduler, 0, 0, &lease)) computed(scheduler, 0, &lease, 0.001);
    fracas_scheduler_durable(scheduler, 0);
    assert_counts(scheduler, 4 * COUNT - 1, 0, 1);
}

/* The last realization of a lease alone at fault: one attempt, as its server computed it alone. */
static void one_at_fault_has_had_an_attempt(void **state)
{
    fracas_lease lease;
    bool final;
    OWN(fracas_scheduler) scheduler = create_large(24, &lease);
    OK(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 23, 1, &lease, &final));
    assert_lease(&lease, 0, 23, 1);
    assert_false(final);
    assert_counts(scheduler, 48, 23, 0);
    for (int attempt = 2; attempt <= FRACAS_ATTEMPTS_MAX; attempt++) {
        assert_true(next(scheduler, 0, 0, &lease));
        assert_lease(&lease, 0, 23, 1);
        OK(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 0, 1, &lease, &final));
        assert_int_equal(final, attempt == FRACAS_ATTEMPTS_MAX);
    }
    fracas_scheduler_lost(scheduler,
                          0); /* what was kept is lost with the worker, what failed stays failed */
    assert_counts(scheduler, 48, 0, 1);
    assert_true(next(scheduler, 0, 0, &lease));
    assert_lease(&lease, 0, 0, 23);
}

/* Odd numbers: the first half is the larger one. */
static void a_part_of_a_batch_is_bisected_too(void **state)
{
    fracas_lease lease;
    bool final;
    OWN(fracas_scheduler) scheduler = create(1, 5, 1);
    assert_true(next(scheduler, 0, 0, &lease));
    OK(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 0, 5, &lease, &final));
    static const int64_t first[] = {0, 3};
    static const uint64_t count[] = {3, 2};
    for (size_t i = 0; i < 2; i++) {
        assert_true(next(scheduler, 0, 0, &lease));
        assert_lease(&lease, 0, first[i], count[i]);
        computed(scheduler, 0, &lease, 1);
    }
    assert_counts(scheduler, 0, 5, 0);
}

static void nonsense_is_refused(void **state)
{
    fracas_lease lease, other;
    bool final;
    OWN(fracas_scheduler) scheduler = create(1, 40, 2);
    assert_true(next(scheduler, 0, 0, &lease));
    assert_int_equal(fracas_scheduler_computed(scheduler, 1, lease.id, 0, 1),
                     FRACAS_BUG); /* not its own */
    assert_int_equal(fracas_scheduler_failed(scheduler, 1, lease.id, 0, 0, 8, &other, &final),
                     FRACAS_BUG);
    assert_int_equal(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 0, 9, &other, &final),
                     FRACAS_BUG);
    assert_int_equal(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 8, 0, &other, &final),
                     FRACAS_BUG);
    assert_int_equal(
        fracas_scheduler_failed(scheduler, 0, lease.id, 0, SIZE_MAX, 8, &other, &final),
        FRACAS_BUG);
    computed(scheduler, 0, &lease, 1); /* it is still held */
    assert_int_equal(fracas_scheduler_computed(scheduler, 0, lease.id, 0, 1),
                     FRACAS_BUG); /* once is enough */
    assert_counts(scheduler, 0, 8, 0);
}

static void a_lost_worker_costs_what_was_not_durable(void **state)
{
    OWN(fracas_scheduler) scheduler = create(1, 400, 2);
    fracas_lease first, second, third, fourth, again;
    assert_true(next(scheduler, 0, 0, &first));
    computed(scheduler, 0, &first, 8);
    fracas_scheduler_durable(scheduler, 0);
    assert_true(next(scheduler, 0, 0, &second));
    computed(scheduler, 0, &second, 8);
    assert_true(next(scheduler, 0, 0, &third));
    assert_true(next(scheduler, 0, 0, &fourth));
    assert_counts(scheduler, 8, 8, 0);
    fracas_scheduler_lost(scheduler, 0);
    assert_counts(scheduler, 8, 0, 0);
    assert_true(fracas_scheduler_idles(scheduler, 0) && !fracas_scheduler_keeps(scheduler, 0));
    /* First in line, though 368 others wait: what was in memory, and in isolation what it held, for
     * that may have killed it. */
    const fracas_lease *order[] = {&second, &third, &fourth};
    for (size_t i = 0; i < 3; i++) {
        assert_true(next(scheduler, 1, 0, &again));
        assert_lease(&again, 0, order[i]->replica[0], order[i]->count);
        assert_int_equal(again.isolated != 0, i > 0);
        computed(scheduler, 1, &again, 8);
    }
    assert_true(next(scheduler, 1, 0, &again));
    assert_lease(&again, 0, 32, 8);
    assert_int_equal(again.isolated, 0);
}

/* Of a lease in isolation only what was at fault stays isolated. */
static void halves_stay_isolated(void **state)
{
    fracas_lease lease;
    bool final;
    OWN(fracas_scheduler) scheduler = create_large(24, &lease);
    fracas_scheduler_lost(scheduler, 0);
    assert_true(next(scheduler, 0, 0, &lease));
    assert_int_not_equal(lease.isolated, 0);
    OK(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 0, 8, &lease, &final));
    for (size_t i = 0; i < 3; i++) {
        assert_true(next(scheduler, 0, 0, &lease));
        assert_int_equal(lease.count, i < 2 ? 4 : 16);
        assert_int_equal(lease.isolated != 0, i < 2);
        computed(scheduler, 0, &lease, 0.1);
    }
}

TESTS(a_failed_batch_is_bisected, one_at_fault_has_had_an_attempt,
      a_part_of_a_batch_is_bisected_too, nonsense_is_refused,
      a_lost_worker_costs_what_was_not_durable, halves_stay_isolated)
