/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lease logic: sizes, order, the plan. What fails: test_scheduler_failures.c; what random
 * events do to it: test_scheduler_events.c. */
#include "tests/support/leases.h"

/* ---- sizes and order ---- */

static void one_batch_while_nothing_is_measured(void **state)
{
    OWN(fracas_scheduler) scheduler = create(POINTS, MANY, 3);
    fracas_lease lease;
    for (size_t i = 0; i < 6; i++) {
        assert_true(next(scheduler, i / 2, 0, &lease));
        assert_lease(&lease, 1, 8 * (int64_t)i, 8);
    }
}

/* Time per realization: of the point where it was measured, else in proportion to its cost. */
static void sizes_are_by_measured_cost(void **state)
{
    OWN(fracas_scheduler) scheduler = create(POINTS, MANY, 1);
    fracas_lease lease;
    assert_true(next(scheduler, 0, 0, &lease));
    computed(scheduler, 0, &lease, 0.08); /* 0.01 s each: 100 in 1 s */
    assert_true(next(scheduler, 0, 0, &lease));
    assert_lease(&lease, 1, 8, 96);
    computed(scheduler, 0, &lease, 2); /* 104 in 2.08 s: 50 in 1 s */
    assert_true(next(scheduler, 0, 0, &lease));
    assert_lease(&lease, 1, 104, 48);
    computed(scheduler, 0, &lease, 0); /* 152 in 2.08 s: 73 in 1 s */
    for (int64_t first = 152; first < MANY; first += (int64_t)lease.count) {
        assert_true(next(scheduler, 0, 0, &lease));
        assert_lease(&lease, 1, first, first + 72 <= MANY ? 72 : (uint64_t)(MANY - first));
        computed(scheduler, 0, &lease, (double)lease.count / 73); /* as it was */
    }
    /* Point 2 was never measured: a tenth of the cost, so about 730 in 1 s; then measured a hundred
     * times slower than that. */
    assert_true(next(scheduler, 0, 0, &lease));
    assert_int_equal(lease.point, 2);
    assert_int_equal(lease.count % 8, 0);
    assert_true(lease.count >= 720 && lease.count <= 730);
    computed(scheduler, 0, &lease, 100 * (double)lease.count / 730);
    assert_true(next(scheduler, 0, 0, &lease));
    assert_int_equal(lease.point, 2);
    assert_true(lease.count == 8); /* 7.3 in 1 s, but a batch is not divided */
}

/* Towards the end: at most what is left / (2 workers), never less than a batch but for the last
 * ones, which are shared out. */
static void sizes_shrink_with_what_is_left(void **state)
{
    enum { WORKERS = 5 };
    OWN(fracas_scheduler) scheduler = create(1, 4000, WORKERS);
    fracas_lease lease;
    assert_true(next(scheduler, 0, 0, &lease));
    computed(scheduler, 0, &lease, 8e-6); /* 1e6 in 1 s: time is no bound */
    size_t leases = 0;
    for (size_t left = 3992; left > 0; left -= lease.count, leases++) {
        const size_t worker = leases % WORKERS, share = left / (2 * WORKERS) / 8 * 8,
                     even = (left + WORKERS - 1) / WORKERS;
        assert_true(next(scheduler, worker, 0, &lease));
        assert_int_equal(lease.count, share >= 8 ? share : even < 8 ? even : 8);
        computed(scheduler, worker, &lease, 1e-6 * (double)lease.count);
    }
    assert_counts(scheduler, 0, 4000, 0);
}

/* Which workers share the last ones: those that will be free soon enough to be of use, not those
 * that are lost. */
static void the_last_ones_are_shared_with_who_is_free_soon(void **state)
{
    for (int late = 0; late < 2; late++) {
        OWN(fracas_scheduler) scheduler = create(1, 56, 4);
        fracas_lease lease[4], last;
        for (size_t worker = 0; worker < 4; worker++) {
            assert_true(next(scheduler, worker, 0, &lease[worker]));
            assert_int_equal(lease[worker].count, 8);
        }
        computed(scheduler, 0, &lease[0], 8); /* a batch takes 8 s */
        fracas_scheduler_lost(scheduler, 3);
        for (int i = 0; i < 2; i++) { /* what was lost, and a batch of its own */
            assert_true(next(scheduler, 0, 0, &last));
            assert_int_equal(last.count, 8);
            computed(scheduler, 0, &last, 8);
        }
        /* 16 wait. Workers 1 and 2 will be free in 4 s, or a little later; 3 does not ask any more.
         */
        assert_true(next(scheduler, 0, late ? 4 : 3.9, &last));
        assert_int_equal(last.count, late ? 6 : 8);
    }
}

static void a_lease_has_a_largest_size(void **state)
{
    OWN(fracas_scheduler) scheduler = create(1, 100000, 1);
    fracas_lease lease;
    assert_true(next(scheduler, 0, 0, &lease));
    computed(scheduler, 0, &lease, 0); /* no time at all */
    for (int i = 0; i < 5; i++) {
        assert_true(next(scheduler, 0, 0, &lease));
        assert_int_equal(lease.count, FRACAS_LEASE_MAX);
        computed(scheduler, 0, &lease, 0);
    }
}

static void no_lease_time_means_one_batch(void **state)
{
    OWNED fracas_index_row *row = rows(1, 100);
    fracas_scheduler_options options = options_for(1);
    options.seconds = 0;
    options.width = 4;
    OWN(fracas_scheduler) scheduler = create_with(row, 100, &options);
    fracas_lease lease;
    for (int i = 0; i < 25; i++) {
        assert_true(next(scheduler, 0, 0, &lease));
        assert_lease(&lease, 0, 4 * i, 4);
        computed(scheduler, 0, &lease, 1e-6);
    }
    assert_false(next(scheduler, 0, 0, &lease));
}

static void the_longest_go_first(void **state)
{
    OWNED fracas_index_row *row = rows(POINTS, 11);
    fracas_scheduler_options options = options_for(1);
    options.seconds = 0;
    /* By cost, until point 2 turns out to be faster than point 0 is predicted to be, and point 0
     * faster still. */
    static const size_t point[2][6] = {{1, 1, 2, 2, 0, 0}, {1, 1, 2, 0, 2, 0}};
    static const double seconds[2][POINTS] = {{1e-5, 1e-3, 1e-4}, {1e-9, 1e-3, 1e-6}};
    for (int slow = 0; slow < 2; slow++) {
        OWN(fracas_scheduler) scheduler = create_with(row, POINTS * 11, &options);
        bool begun[POINTS] = {false};
        fracas_lease lease;
        for (size_t i = 0; i < 6; i++) {
            const size_t p = point[slow][i];
            assert_true(next(scheduler, 0, 0, &lease));
            assert_lease(&lease, p, begun[p] ? 8 : 0, begun[p] ? 3 : 8);
            computed(scheduler, 0, &lease, seconds[slow][p] * (double)lease.count);
            begun[p] = true;
        }
        assert_counts(scheduler, 0, POINTS * 11, 0);
        fracas_scheduler_durable(scheduler, 0);
        assert_counts(scheduler, POINTS * 11, 0, 0);
    }
}

/* Points on which more depends go before longer ones, measured or not, the longest of them first.
 */
static void some_points_go_first(void **state)
{
    static const bool first[POINTS] = {true, false, true};
    static const size_t point[] = {2, 2, 0, 0, 1, 1};
    OWNED fracas_index_row *row = rows(POINTS, 11);
    fracas_scheduler_options options = options_for(1);
    options.seconds = 0;
    options.first = first;
    OWN(fracas_scheduler) scheduler = create_with(row, POINTS * 11, &options);
    for (size_t i = 0; i < 6; i++) {
        fracas_lease lease;
        assert_true(next(scheduler, 0, 0, &lease));
        assert_lease(&lease, point[i], i % 2 ? 8 : 0, i % 2 ? 3 : 8);
        computed(scheduler, 0, &lease, cost[point[i]]);
    }
}

static void one_lease_ahead_until_the_last_ones(void **state)
{
    OWN(fracas_scheduler) scheduler = create(POINTS, 11, 2);
    fracas_lease lease, other;
    assert_true(next(scheduler, 0, 0, &lease));
    assert_true(next(scheduler, 0, 0, &lease)); /* one ahead */
    assert_false(next(scheduler, 0, 0, &lease));
    assert_true(next(scheduler, 1, 0, &lease)); /* now 14 wait: no more than 2 batches */
    assert_false(next(scheduler, 1, 0, &other));
    computed(scheduler, 1, &lease, 1);
    assert_true(fracas_scheduler_idles(scheduler, 1));
    assert_true(next(scheduler, 1, 0, &lease));
    assert_false(fracas_scheduler_idles(scheduler, 1));
}

static void what_comes_next_is_predicted(void **state)
{
    OWN(fracas_scheduler) scheduler = create(1, 1000, 1);
    fracas_lease lease, ahead;
    assert_true(isnan(fracas_scheduler_predicted(scheduler, 0, 5)));
    assert_true(next(scheduler, 0, 5, &lease));
    OK(fracas_scheduler_computed(scheduler, 0, lease.id, 13,
                                 8)); /* 1 s each: batches of 8 s from now on */
    assert_close(fracas_scheduler_predicted(scheduler, 0, 13), 8, 1e-9);
    assert_true(next(scheduler, 0, 13, &lease));
    assert_close(fracas_scheduler_predicted(scheduler, 0, 15), 6 + 8, 1e-9);
    assert_close(fracas_scheduler_predicted(scheduler, 0, 99), 0 + 8,
                 1e-9); /* late: it may end at any time */
    assert_true(next(scheduler, 0, 15, &ahead));
    assert_close(fracas_scheduler_predicted(scheduler, 0, 15), 6 + 8 + 8, 1e-9);
    OK(fracas_scheduler_computed(scheduler, 0, lease.id, 21, 8));
    assert_close(fracas_scheduler_predicted(scheduler, 0, 22), 7 + 8,
                 1e-9); /* the one ahead has run for 1 s */
}

/* The last ones of a plan: what waits again counts too, and when nothing waits, what is held. */
static void what_waits_again_is_predicted(void **state)
{
    OWN(fracas_scheduler) scheduler = create(1, 30, 2);
    fracas_lease first, second;
    assert_true(next(scheduler, 0, 0, &first));
    assert_true(next(scheduler, 1, 0, &second));
    computed(scheduler, 1, &second, 8);
    assert_true(next(scheduler, 1, 0, &second));
    assert_int_equal(second.count, 8);
    assert_close(fracas_scheduler_predicted(scheduler, 0, 3), 5 + 6,
                 1e-9); /* the rest of 8, and the last 6 */
    computed(scheduler, 1, &second, 8);
    fracas_scheduler_lost(scheduler, 0);
    assert_close(fracas_scheduler_predicted(scheduler, 1, 3), 8, 1e-9);
    assert_true(next(scheduler, 1, 3, &second));
    computed(scheduler, 1, &second, 8);
    assert_true(next(scheduler, 1, 3, &second));
    assert_int_equal(second.count, 6);
    assert_close(fracas_scheduler_predicted(scheduler, 1, 3.25), 5.75, 1e-9);
}

/* s that a lease may take: as the options say, or 600 s and 50 times its prediction. */
static void a_lease_has_a_time_limit(void **state)
{
    OWNED fracas_index_row *row = rows(POINTS, 100);
    fracas_scheduler_options options = options_for(1);
    fracas_scheduler *scheduler = create_with(row, POINTS * 100, &options);
    fracas_lease lease;
    assert_true(next(scheduler, 0, 0, &lease));
    assert_close(lease.limit, 600 + 50 * 8 * 100 / 1e6,
                 1e-9); /* nothing is measured: 1e6 element-steps/s at least */
    computed(scheduler, 0, &lease, 40);
    assert_true(next(scheduler, 0, 0, &lease));
    assert_close(lease.limit, 600 + 50 * 40, 1e-9);
    fracas_scheduler_destroy(scheduler);
    options.limit = 7;
    scheduler = create_with(row, POINTS * 100, &options);
    assert_true(next(scheduler, 0, 0, &lease));
    assert_close(lease.limit, 7, 0);
    fracas_scheduler_destroy(scheduler);
}

static void a_shuffle_changes_order_and_sizes(void **state)
{
    OWNED fracas_index_row *row = rows(POINTS, 11);
    fracas_scheduler_options options = options_for(1);
    OWN(fracas_scheduler) plain = create_with(row, POINTS * 11, &options);
    options.shuffle = true;
    OWN(fracas_scheduler) shuffled = create_with(row, POINTS * 11, &options),
                          *again = create_with(row, POINTS * 11, &options);
    bool point = false, size = false, order = false;
    size_t left = POINTS * 11;
    while (left > 0) {
        fracas_lease a, b, c;
        assert_true(next(shuffled, 0, 0, &b));
        assert_true(next(again, 0, 0, &c));
        assert_int_equal(fracas_lease_bytes(&b), fracas_lease_bytes(&c));
        assert_memory_equal(&b, &c, fracas_lease_bytes(&b)); /* by the seed alone */
        computed(shuffled, 0, &b, 1);
        computed(again, 0, &c, 1);
        left -= b.count;
        if (!next(plain, 0, 0, &a)) continue;
        computed(plain, 0, &a, 1);
        point |= a.point != b.point;
        size |= a.count != b.count;
        for (size_t i = 1; i < b.count; i++) order |= b.replica[i] < b.replica[i - 1];
    }
    assert_true(point && size && order);
    assert_counts(shuffled, 0, POINTS * 11, 0);
}

/* A shuffled lease is predicted as twice a batch at most; a measured time that is no time counts
 * for nothing. */
static void a_shuffled_lease_is_predicted(void **state)
{
    OWNED fracas_index_row *row = rows(1, 64);
    fracas_scheduler_options options = options_for(1);
    options.shuffle = true;
    fracas_lease lease;
    for (size_t i = 0; i < 8; i++) row[i].status = FRACAS_DONE;
    OWN(fracas_scheduler) scheduler = create_with(row, 64, &options);
    assert_true(next(scheduler, 0, 0, &lease));
    computed(scheduler, 0, &lease, NAN);
    assert_true(isnan(fracas_scheduler_predicted(scheduler, 0, 0)));
    assert_true(next(scheduler, 0, 0, &lease));
    computed(scheduler, 0, &lease, (double)lease.count);
    assert_true(fracas_scheduler_predicted(scheduler, 0, 0) == 16);
    OK(fracas_scheduler_add(scheduler, row, 8)); /* all of them done: none to shuffle */
    assert_int_equal(fracas_scheduler_count(scheduler).done, 16);
}

/* ---- the plan ---- */

/* A plan that grows: what is added waits like all else, longest first, and counts. */
static void rows_are_added(void **state)
{
    fracas_index_row more[6];
    OWN(fracas_scheduler) scheduler = create(1, 11, 1);
    for (size_t i = 0; i < 6; i++)
        more[i] = (fracas_index_row){.point = i < 3 ? 2 : 1, .replica = (int64_t)(20 + i % 3)};
    more[1].status = FRACAS_DONE; /* computed before its round came */
    more[2].status = FRACAS_FAILED_ROW;
    fracas_lease lease;
    assert_true(next(scheduler, 0, 0, &lease));
    OK(fracas_scheduler_add(scheduler, more, 6));
    assert_int_equal(fracas_scheduler_count(scheduler).total, 11 + 6);
    assert_counts(scheduler, 1, 0, 1);
    assert_false(fracas_scheduler_keeps(scheduler, 0));
    computed(scheduler, 0, &lease, 8 * cost[0]);
    assert_true(fracas_scheduler_keeps(scheduler, 0));
    static const size_t point[] = {1, 2, 0}, count[] = {3, 1, 3};
    static const int64_t first[] = {20, 20, 8};
    for (size_t i = 0; i < 3; i++) {
        assert_false(fracas_scheduler_computed_all(scheduler));
        assert_true(next(scheduler, 0, 0, &lease));
        assert_lease(&lease, point[i], first[i], count[i]);
        computed(scheduler, 0, &lease, cost[point[i]] * (double)count[i]);
    }
    assert_true(fracas_scheduler_computed_all(scheduler));
    fracas_scheduler_durable(scheduler, 0);
    assert_false(fracas_scheduler_keeps(scheduler, 0));
    assert_counts(scheduler, 11 + 5, 0, 1);
    for (int64_t i = 0; i < 6; i++) more[i] = (fracas_index_row){.point = 0, .replica = 11 + i};
    OK(fracas_scheduler_add(scheduler, more, 6)); /* again when all was done */
    assert_false(fracas_scheduler_computed_all(scheduler));
    assert_true(next(scheduler, 0, 0, &lease));
    assert_lease(&lease, 0, 11, 6);
}

static void rows_may_need_nothing(void **state)
{
    OWNED fracas_index_row *row = rows(POINTS, 11);
    for (size_t i = 0; i < POINTS * 11; i++) row[i].status = FRACAS_DONE;
    row[3].status = FRACAS_FAILED_ROW;
    row[7].status = FRACAS_QUARANTINED;
    for (size_t i = 4; i <= 6; i++) row[i].status = FRACAS_PLANNED;
    row[5].attempts = 2;
    const fracas_scheduler_options options = options_for(1);
    OWN(fracas_scheduler) scheduler = create_with(row, POINTS * 11, &options);
    assert_counts(scheduler, POINTS * 11 - 5, 0, 2);
    /* The one that failed before is leased alone, and first. */
    fracas_lease lease;
    bool final;
    assert_true(next(scheduler, 0, 0, &lease));
    assert_lease(&lease, 0, 5, 1);
    OK(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 0, 1, &lease, &final));
    assert_true(final); /* its third attempt */
    assert_true(next(scheduler, 0, 0, &lease));
    assert_lease(&lease, 0, 4, 2);
    assert_int_equal(lease.replica[1], 6);
    computed(scheduler, 0, &lease, 1);
    assert_true(fracas_scheduler_computed_all(scheduler));
    assert_counts(scheduler, POINTS * 11 - 5, 2, 3);
}

/* The last realizations have the workers that would be idle: workers / (waiting + busy) each, or
 * the parts that are asked for; one if it failed. */
static void a_body_gets_idle_workers(void **state)
{
    enum { CORES = 8 };
    for (size_t wanted = 0; wanted <= 5; wanted += 5)
        for (size_t count = 1; count <= CORES + 1; count++) {
            fracas_lease lease;
            fracas_scheduler_options options = options_for(CORES);
            options.parts = wanted;
            OWNED fracas_index_row *row = rows(1, count);
            OWN(fracas_scheduler) scheduler = create_with(row, count, &options);
            for (size_t worker = 0; worker < CORES; worker++) {
                if (!next(scheduler, worker, 0, &lease)) continue;
                assert_int_equal(lease.parts, wanted ? wanted : count < CORES ? CORES / count : 1);
            }
            if (count > 1) continue;
            bool final;
            OK(fracas_scheduler_failed(scheduler, 0, lease.id, 0, 0, 1, &lease, &final));
            assert_true(next(scheduler, 0, 0, &lease));
            assert_int_equal(lease.parts, wanted ? wanted : 1);
            assert_int_equal(fracas_scheduler_count(scheduler).total, count);
        }
}

TESTS(one_batch_while_nothing_is_measured, sizes_are_by_measured_cost,
      sizes_shrink_with_what_is_left, the_last_ones_are_shared_with_who_is_free_soon,
      a_lease_has_a_largest_size, no_lease_time_means_one_batch, the_longest_go_first,
      some_points_go_first, one_lease_ahead_until_the_last_ones, what_comes_next_is_predicted,
      what_waits_again_is_predicted, a_lease_has_a_time_limit, a_shuffle_changes_order_and_sizes,
      a_shuffled_lease_is_predicted, a_body_gets_idle_workers, rows_are_added,
      rows_may_need_nothing)
