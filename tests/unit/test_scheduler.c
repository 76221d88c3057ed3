/* The lease logic: every realization is leased until it is done or failed, whatever workers do. */
#include "campaigns/scheduler/scheduler.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { POINTS = 3, REPLICAS = 11, ROWS = POINTS * REPLICAS };
static const double cost[POINTS] = {1, 100, 10};

static void plan(fracas_index_row row[ROWS])
{
    for (size_t i = 0; i < ROWS; i++)
        row[i] = (fracas_index_row){.point = i / REPLICAS, .replica = (int64_t)(i % REPLICAS)};
}

static fracas_scheduler *create(const fracas_index_row *row, size_t count, size_t workers, size_t width, bool shuffle)
{
    fracas_scheduler_options options = {.cost = cost, .workers = workers, .width = width,
                                        .shuffle = shuffle, .seed = 7};
    fracas_scheduler *scheduler;
    assert_int_equal(fracas_scheduler_create(row, count, &options, &scheduler), FRACAS_OK);
    return scheduler;
}

static void assert_counts(const fracas_scheduler *scheduler, int64_t done, int64_t memory, int64_t failed)
{
    fracas_scheduler_counts count = fracas_scheduler_count(scheduler);
    assert_int_equal(count.done, done);
    assert_int_equal(count.memory, memory);
    assert_int_equal(count.failed, failed);
    /* sums of some tens of costs: a few roundings from the exact share */
    assert_true(count.work > -1e-12 && count.work < 1 + 1e-12);
    assert_int_equal(count.work > 1 - 1e-12, fracas_scheduler_computed_all(scheduler));
}

static void test_longest_first(void **state)
{
    (void)state;
    fracas_index_row row[ROWS];
    plan(row);
    fracas_scheduler *scheduler = create(row, ROWS, 1, 8, false);
    /* Leases of 8 and 3 of each point: 800, 300, 80, 30, 8, 3. */
    static const size_t point[] = {1, 1, 2, 2, 0, 0}, count[] = {8, 3, 8, 3, 8, 3};
    fracas_lease lease;
    for (size_t i = 0; i < FRACAS_LEASES_HELD * 3; i++) {
        assert_true(fracas_scheduler_next(scheduler, 0, &lease));
        assert_int_equal(lease.point, point[i]);
        assert_int_equal(lease.count, count[i]);
        assert_int_equal(lease.replica[0], count[i] == 8 ? 0 : 8);
        assert_int_equal(fracas_scheduler_computed(scheduler, 0, lease.id), FRACAS_OK);
    }
    assert_false(fracas_scheduler_next(scheduler, 0, &lease));
    assert_true(fracas_scheduler_computed_all(scheduler));
    assert_counts(scheduler, 0, ROWS, 0);
    fracas_scheduler_durable(scheduler, 0);
    assert_counts(scheduler, ROWS, 0, 0);
    fracas_scheduler_destroy(scheduler);
}

/* A plan that grows: later rows wait last, longest first among themselves, and count. */
static void test_rows_are_added(void **state)
{
    (void)state;
    fracas_index_row row[ROWS], more[6];
    plan(row);
    fracas_scheduler *scheduler = create(row, REPLICAS, 1, 8, false); /* leases of 8 and 3 of point 0 */
    for (size_t i = 0; i < 6; i++)
        more[i] = (fracas_index_row){.point = i < 3 ? 2 : 1, .replica = (int64_t)(20 + i % 3)};
    more[1].status = FRACAS_DONE; /* computed before its round came */
    more[2].status = FRACAS_FAILED_ROW;
    fracas_lease lease;
    assert_true(fracas_scheduler_next(scheduler, 0, &lease));
    assert_int_equal(fracas_scheduler_add(scheduler, more, 6), FRACAS_OK);
    assert_int_equal(fracas_scheduler_count(scheduler).total, REPLICAS + 6);
    assert_counts(scheduler, 1, 0, 1);
    assert_false(fracas_scheduler_keeps(scheduler, 0));
    assert_int_equal(fracas_scheduler_computed(scheduler, 0, lease.id), FRACAS_OK);
    assert_true(fracas_scheduler_idles(scheduler, 0));
    assert_true(fracas_scheduler_keeps(scheduler, 0));
    static const size_t point[] = {0, 1, 2}, count[] = {3, 3, 1};
    for (size_t i = 0; i < 3; i++) {
        assert_false(fracas_scheduler_computed_all(scheduler));
        assert_true(fracas_scheduler_next(scheduler, 0, &lease));
        assert_int_equal(lease.point, point[i]);
        assert_int_equal(lease.count, count[i]);
        assert_int_equal(lease.id, i + 1);
        if (i == 1) { /* what is added can fail, too, and is tried one by one */
            bool final;
            assert_int_equal(fracas_scheduler_failed(scheduler, 0, lease.id, &lease, &final), FRACAS_OK);
            for (int r = 0; r < 3; r++) {
                assert_true(fracas_scheduler_next(scheduler, 0, &lease));
                assert_int_equal(lease.point, 1);
                assert_int_equal(lease.replica[0], 20 + r);
                assert_int_equal(fracas_scheduler_computed(scheduler, 0, lease.id), FRACAS_OK);
            }
        } else {
            assert_int_equal(fracas_scheduler_computed(scheduler, 0, lease.id), FRACAS_OK);
        }
    }
    assert_true(fracas_scheduler_computed_all(scheduler));
    fracas_scheduler_durable(scheduler, 0);
    assert_false(fracas_scheduler_keeps(scheduler, 0));
    assert_counts(scheduler, REPLICAS + 5, 0, 1);
    assert_int_equal(fracas_scheduler_add(scheduler, row + REPLICAS, REPLICAS), FRACAS_OK); /* again when all was done */
    assert_false(fracas_scheduler_computed_all(scheduler));
    assert_true(fracas_scheduler_next(scheduler, 0, &lease));
    assert_int_equal(lease.point, 1);
    fracas_scheduler_destroy(scheduler);
}

static void test_one_lease_ahead_until_the_last_ones(void **state)
{
    (void)state;
    fracas_index_row row[ROWS];
    plan(row);
    fracas_scheduler *scheduler = create(row, ROWS, 2, 8, false); /* 6 leases */
    fracas_lease lease;
    assert_true(fracas_scheduler_next(scheduler, 0, &lease));
    assert_true(fracas_scheduler_next(scheduler, 0, &lease)); /* one ahead */
    assert_false(fracas_scheduler_next(scheduler, 0, &lease));
    assert_true(fracas_scheduler_next(scheduler, 1, &lease));
    assert_true(fracas_scheduler_next(scheduler, 1, &lease));
    assert_int_equal(fracas_scheduler_computed(scheduler, 1, lease.id), FRACAS_OK);
    assert_false(fracas_scheduler_next(scheduler, 1, &lease)); /* 2 wait for 2 workers: one of them is for worker 0 */
    fracas_scheduler_destroy(scheduler);
}

static void test_rows_that_need_nothing(void **state)
{
    (void)state;
    fracas_index_row row[ROWS];
    plan(row);
    for (size_t i = 0; i < ROWS; i++) row[i].status = FRACAS_DONE;
    row[3].status = FRACAS_FAILED_ROW;
    row[4].status = FRACAS_PLANNED;
    row[5].status = FRACAS_PLANNED;
    row[5].attempts = 2;
    row[6].status = FRACAS_PLANNED;
    fracas_scheduler *scheduler = create(row, ROWS, 1, 8, false);
    assert_counts(scheduler, ROWS - 4, 0, 1);
    /* The one that failed before is leased alone: 4; 5; 6. */
    fracas_lease lease;
    for (int64_t replica = 4; replica <= 6; replica++) {
        assert_true(fracas_scheduler_next(scheduler, 0, &lease));
        assert_int_equal(lease.count, 1);
        assert_int_equal(lease.replica[0], replica);
        bool final;
        if (replica == 5) {
            assert_int_equal(fracas_scheduler_failed(scheduler, 0, lease.id, &lease, &final), FRACAS_OK);
            assert_true(final); /* its third attempt */
        } else {
            assert_int_equal(fracas_scheduler_computed(scheduler, 0, lease.id), FRACAS_OK);
        }
    }
    assert_true(fracas_scheduler_computed_all(scheduler));
    assert_counts(scheduler, ROWS - 4, 2, 2);
    fracas_scheduler_destroy(scheduler);
}

static void test_a_failed_batch_is_tried_one_by_one(void **state)
{
    (void)state;
    fracas_index_row row[4] = {{.replica = 0}, {.replica = 1}, {.replica = 2}, {.replica = 3}};
    fracas_scheduler *scheduler = create(row, 4, 1, 4, false);
    fracas_lease lease;
    bool final;
    assert_true(fracas_scheduler_next(scheduler, 0, &lease));
    assert_int_equal(lease.count, 4);
    assert_int_equal(fracas_scheduler_failed(scheduler, 0, lease.id, &lease, &final), FRACAS_OK);
    assert_int_equal(lease.count, 4);
    assert_false(final);
    /* Replica 2 fails three times; its second and third attempts come last. */
    static const int64_t replica[] = {0, 1, 2, 3, 2, 2};
    for (size_t i = 0; i < 6; i++) {
        assert_false(fracas_scheduler_computed_all(scheduler));
        assert_true(fracas_scheduler_next(scheduler, 0, &lease));
        assert_int_equal(lease.count, 1);
        assert_int_equal(lease.replica[0], replica[i]);
        if (replica[i] == 2) {
            assert_int_equal(fracas_scheduler_failed(scheduler, 0, lease.id, &lease, &final), FRACAS_OK);
            assert_int_equal(final, i == 5);
        } else {
            assert_int_equal(fracas_scheduler_computed(scheduler, 0, lease.id), FRACAS_OK);
        }
    }
    assert_true(fracas_scheduler_computed_all(scheduler));
    assert_counts(scheduler, 0, 3, 1);
    fracas_scheduler_destroy(scheduler);
}

static void test_a_lost_worker_costs_what_was_not_durable(void **state)
{
    (void)state;
    fracas_index_row row[ROWS];
    plan(row);
    fracas_scheduler *scheduler = create(row, ROWS, 2, 8, false);
    fracas_lease first, second, third, again;
    assert_true(fracas_scheduler_next(scheduler, 0, &first));
    assert_int_equal(fracas_scheduler_computed(scheduler, 0, first.id), FRACAS_OK);
    fracas_scheduler_durable(scheduler, 0);
    assert_true(fracas_scheduler_next(scheduler, 0, &second));
    assert_int_equal(fracas_scheduler_computed(scheduler, 0, second.id), FRACAS_OK);
    assert_true(fracas_scheduler_next(scheduler, 0, &third));
    assert_counts(scheduler, 8, 3, 0);
    fracas_scheduler_lost(scheduler, 0);
    assert_counts(scheduler, 8, 0, 0);
    assert_true(fracas_scheduler_next(scheduler, 1, &again));
    assert_true(again.id == second.id || again.id == third.id);
    assert_int_equal(fracas_scheduler_computed(scheduler, 1, first.id), FRACAS_BUG); /* not its own */
    fracas_scheduler_destroy(scheduler);
}

/* Random workers (fixed seed): in the end each realization was made durable exactly once or failed three times. */
static void test_any_course_of_events(void **state)
{
    (void)state;
    enum { WORKERS = 3 };
    for (unsigned seed = 1; seed <= 200; seed++) {
        fracas_index_row row[ROWS];
        plan(row);
        fracas_scheduler *scheduler = create(row, ROWS, WORKERS, seed % 3 ? 8 : 1, seed % 2);
        unsigned dice = seed;
        int memory[WORKERS][ROWS] = {0}, done[ROWS] = {0}, attempts[ROWS] = {0};
        fracas_lease held[WORKERS][FRACAS_LEASES_HELD], lease;
        size_t nheld[WORKERS] = {0};
        while (!fracas_scheduler_computed_all(scheduler)) {
            size_t w = (size_t)rand_r(&dice) % WORKERS;
            int event = rand_r(&dice) % 40;
            if (event == 0) {
                fracas_scheduler_lost(scheduler, w);
                nheld[w] = 0;
                memset(memory[w], 0, sizeof memory[w]);
            } else if (event < 4) {
                fracas_scheduler_durable(scheduler, w);
                for (size_t i = 0; i < ROWS; i++) done[i] += memory[w][i];
                memset(memory[w], 0, sizeof memory[w]);
            } else if (nheld[w] < FRACAS_LEASES_HELD && fracas_scheduler_next(scheduler, w, &lease)) {
                held[w][nheld[w]++] = lease;
            } else if (nheld[w]) {
                lease = held[w][--nheld[w]];
                bool fails = rand_r(&dice) % 4 == 0, final;
                size_t first = lease.point * REPLICAS;
                if (!fails) {
                    assert_int_equal(fracas_scheduler_computed(scheduler, w, lease.id), FRACAS_OK);
                    for (size_t i = 0; i < lease.count; i++) memory[w][first + (size_t)lease.replica[i]]++;
                } else {
                    assert_int_equal(fracas_scheduler_failed(scheduler, w, lease.id, &lease, &final), FRACAS_OK);
                    int *n = &attempts[first + (size_t)lease.replica[0]];
                    if (lease.count == 1) assert_int_equal(final, ++*n == FRACAS_ATTEMPTS_MAX);
                }
            }
        }
        int64_t failed = 0;
        for (size_t w = 0; w < WORKERS; w++) {
            fracas_scheduler_durable(scheduler, w);
            for (size_t i = 0; i < ROWS; i++) done[i] += memory[w][i];
        }
        for (size_t i = 0; i < ROWS; i++) {
            assert_int_equal(done[i], attempts[i] < FRACAS_ATTEMPTS_MAX);
            failed += attempts[i] == FRACAS_ATTEMPTS_MAX;
        }
        assert_counts(scheduler, ROWS - failed, 0, failed);
        fracas_scheduler_destroy(scheduler);
    }
}

static void test_shuffle_changes_order_and_batches(void **state)
{
    (void)state;
    fracas_index_row row[ROWS];
    plan(row);
    fracas_lease plain, shuffled, again;
    fracas_scheduler *a = create(row, ROWS, 1, 8, false), *b = create(row, ROWS, 1, 8, true),
                     *c = create(row, ROWS, 1, 8, true);
    bool differ = false;
    for (size_t i = 0; i < 6; i++) {
        assert_true(fracas_scheduler_next(a, 0, &plain));
        assert_true(fracas_scheduler_next(b, 0, &shuffled));
        assert_true(fracas_scheduler_next(c, 0, &again));
        assert_memory_equal(&shuffled, &again, sizeof again); /* by the seed alone */
        differ |= memcmp(plain.replica, shuffled.replica, sizeof plain.replica) != 0;
        assert_int_equal(fracas_scheduler_computed(a, 0, plain.id), FRACAS_OK);
        assert_int_equal(fracas_scheduler_computed(b, 0, shuffled.id), FRACAS_OK);
        assert_int_equal(fracas_scheduler_computed(c, 0, again.id), FRACAS_OK);
    }
    assert_true(differ);
    fracas_scheduler_destroy(a);
    fracas_scheduler_destroy(b);
    fracas_scheduler_destroy(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_longest_first),
        cmocka_unit_test(test_rows_are_added),
        cmocka_unit_test(test_one_lease_ahead_until_the_last_ones),
        cmocka_unit_test(test_rows_that_need_nothing),
        cmocka_unit_test(test_a_failed_batch_is_tried_one_by_one),
        cmocka_unit_test(test_a_lost_worker_costs_what_was_not_durable),
        cmocka_unit_test(test_any_course_of_events),
        cmocka_unit_test(test_shuffle_changes_order_and_batches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
