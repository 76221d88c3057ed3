/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lease logic when the k-th allocation fails, for every k: an error, and nothing is lost. */
#include "campaigns/scheduler/lease/scheduler.h"
#include "tests/support/test.h"

#include <limits.h>

#ifdef __SANITIZE_ADDRESS__
/* AddressSanitizer owns malloc; this program has nothing to do there. */
int fracas_test(void)
{
    return 0;
}
#else

#include "tests/support/fail_each.h"

enum { ROWS = 40, WORKERS = 2 };

/* Tries a call again where memory was short, which leaves everything as it was. */
#define AGAIN(call)                                       \
    do {                                                  \
        err = call;                                       \
        if (err != FRACAS_ENVIRONMENT || short_of) break; \
        short_of = true;                                  \
    } while (true)

/* One worker computes all that it gets; the other one says that a third of each lease is computed
 * and the rest of the batch failed, until it is single realizations. */
static fracas_err compute_all(fracas_scheduler *scheduler)
{
    bool short_of = false, given = true;
    fracas_err err = FRACAS_OK;
    for (size_t turn = 0; given && !err; turn++) {
        const size_t worker = turn % WORKERS;
        fracas_lease lease, failed;
        bool final;
        AGAIN(fracas_scheduler_next(scheduler, worker, 0, &lease, &given));
        if (err || !given) break;
        const size_t kept = lease.count / 3;
        if (worker == 0) AGAIN(fracas_scheduler_computed(scheduler, 0, lease.id, 0, 1));
        else
            AGAIN(fracas_scheduler_failed(scheduler, 1, lease.id, 0, kept, lease.count - kept,
                                          &failed, &final));
    }
    if (err) return err;
    for (size_t worker = 0; worker < WORKERS; worker++) fracas_scheduler_durable(scheduler, worker);
    const fracas_counts count = fracas_scheduler_count(scheduler);
    assert_int_equal(count.done + count.failed, ROWS);
    assert_true(fracas_scheduler_computed_all(scheduler));
    return short_of ? fracas_no_memory("what was tried again") : FRACAS_OK;
}

static fracas_err plan_and_compute(const void *context)
{
    static const double cost[] = {1, 2};
    static const bool first[] = {false, true};
    const fracas_index_row *row = context;
    const fracas_scheduler_options options = {
        .cost = cost, .first = first, .npoints = 2, .workers = WORKERS, .width = 4, .seconds = 1};
    OWN(fracas_scheduler) scheduler = NULL;
    TRY(fracas_scheduler_create(row, ROWS / 2, &options, &scheduler));
    TRY(fracas_scheduler_add(scheduler, row + ROWS / 2, ROWS / 2));
    return compute_all(scheduler);
}

static void every_allocation_fails_once(void **state)
{
    fracas_index_row row[ROWS];
    for (size_t i = 0; i < ROWS; i++)
        row[i] = (fracas_index_row){
            .point = i % 20 / 10, .replica = (int64_t)i, .attempts = i % 10 == 0};
    fail_each_of(plan_and_compute, row, LONG_MAX);
}

TESTS(every_allocation_fails_once)

#endif
