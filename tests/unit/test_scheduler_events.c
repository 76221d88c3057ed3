/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lease logic under everything that can happen to it: copies of overdue leases, losses, and
 * random courses of events. */
#include "tests/support/leases.h"

#include <malloc.h>
#include <time.h>

/* A lease, or (*copy) one that is overdue. */
static bool any_or_copy(fracas_scheduler *scheduler, size_t worker, double now, fracas_lease *lease,
                        bool *copy)
{
    size_t late;
    bool given = next(scheduler, worker, now, lease);
    *copy = !given;
    if (!given) fracas_scheduler_overdue(scheduler, worker, now, lease, &late, &given);
    return given;
}

static bool any(fracas_scheduler *scheduler, size_t worker, double now, fracas_lease *lease)
{
    bool copy;
    return any_or_copy(scheduler, worker, now, lease, &copy);
}

/* Only a copy, of what `late` holds. */
static void copy_of(fracas_scheduler *scheduler, size_t worker, double now, size_t late,
                    fracas_lease *lease)
{
    size_t found;
    bool given;
    assert_false(next(scheduler, worker, now, lease));
    fracas_scheduler_overdue(scheduler, worker, now, lease, &found, &given);
    assert_true(given);
    assert_int_equal(found, late);
}

/* ---- copies of overdue leases ---- */

static const double flat[] = {1, 1, 1, 1, 1};

/* 24 realizations of 1 s for 3 workers. At 0 each was given 8; worker 2 has computed its own, and
 * they are durable. */
static fracas_scheduler *create_late(fracas_lease *first, fracas_lease *second)
{
    OWNED fracas_index_row *row = rows(1, 24);
    const fracas_scheduler_options options = {
        .cost = flat, .npoints = 1, .workers = 3, .width = 8, .seconds = 1, .memory = 5};
    fracas_scheduler *scheduler = create_with(row, 24, &options);
    fracas_lease other;
    assert_true(next(scheduler, 0, 0, first) && next(scheduler, 1, 0, second));
    assert_int_equal(first->count, 8);
    assert_int_equal(second->count, 8);
    while (next(scheduler, 2, 0, &other))
        OK(fracas_scheduler_computed(scheduler, 2, other.id, 0, (double)other.count));
    fracas_scheduler_durable(scheduler, 2);
    return scheduler;
}

static void assert_done(const fracas_scheduler *scheduler, int64_t done, int64_t memory,
                        int64_t duplicates)
{
    const fracas_counts count = fracas_scheduler_count(scheduler);
    assert_int_equal(count.total, 24);
    assert_int_equal(count.done, done);
    assert_int_equal(count.memory, memory);
    assert_int_equal(count.failed, 0);
    assert_int_equal(count.duplicates, duplicates);
}

static void an_overdue_lease_goes_to_an_idle_worker(void **state)
{
    fracas_lease first, second, copy;
    OWN(fracas_scheduler) scheduler = create_late(&first, &second);
    assert_done(scheduler, 8, 0, 0);
    assert_false(any(scheduler, 2, 9, &copy));
    assert_false(any(scheduler, 2, 32, &copy)); /* 4 times 8 s */
    assert_false(any(scheduler, 0, 33, &copy)); /* which is not idle */
    copy_of(scheduler, 2, 33, 0, &copy);
    assert_int_equal(copy.id, first.id);
    assert_int_equal(copy.count, 8);
    assert_memory_equal(copy.replica, first.replica, 8 * sizeof *copy.replica);
    assert_false(fracas_scheduler_computed_all(scheduler));
    assert_false(any(scheduler, 2, 999, &copy)); /* it has enough */
    OK(fracas_scheduler_computed(scheduler, 2, first.id, 41, 8));
    fracas_scheduler_durable(scheduler, 2);
    assert_done(scheduler, 16, 0, 0);
    copy_of(scheduler, 2, 41, 1, &copy); /* the other one; the one before is not needed any more */
    assert_int_equal(copy.id, second.id);
    OK(fracas_scheduler_computed(scheduler, 2, copy.id, 49, 8));
    assert_true(fracas_scheduler_computed_all(scheduler)); /* though two workers are at it */
    assert_false(any(scheduler, 2, 999, &copy));
    fracas_scheduler_durable(scheduler, 2);
    assert_done(scheduler, 24, 0, 0);
    /* What they computed is there twice. */
    OK(fracas_scheduler_computed(scheduler, 0, first.id, 1000, 1000));
    fracas_scheduler_durable(scheduler, 0);
    assert_done(scheduler, 24, 0, 8);
}

/* A lease that never ends, in two hands: when the first is killed for it the second's is not copied
 * before its time is over, too, and then it is bisected. With a copy at once, two workers would
 * take turns for ever. */
static void two_do_not_take_turns_with_what_never_ends(void **state)
{
    fracas_lease first, second, copy;
    bool final;
    OWN(fracas_scheduler) scheduler = create_late(&first, &second);
    OK(fracas_scheduler_computed(scheduler, 1, second.id, 8, 8));
    fracas_scheduler_durable(scheduler, 1);
    copy_of(scheduler, 2, 33, 0, &copy);
    OK(fracas_scheduler_failed(scheduler, 0, first.id, 1000, 0, 8, &first, &final));
    assert_int_equal(first.count, 0);
    assert_false(any(scheduler, 0, 1000, &first));
    assert_false(any(scheduler, 0, 33 + first.limit, &first));
    OK(fracas_scheduler_failed(scheduler, 2, copy.id, 1033, 0, 8, &copy, &final));
    assert_int_equal(copy.count, 8);
    assert_true(next(scheduler, 0, 1033, &first));
    assert_int_equal(first.count, 4);
}

/* 10 s at least; of a lease ahead from when it was given, and from when it began when the one
 * before it was computed. */
static void short_leases_are_overdue_after_10_s(void **state)
{
    enum { ROWS = 72 };
    OWNED fracas_index_row *row = rows(1, ROWS);
    const fracas_scheduler_options options = {.cost = flat, .npoints = 1, .workers = 2, .width = 8};
    OWN(fracas_scheduler) scheduler = create_with(row, ROWS, &options);
    fracas_lease first, ahead, other;
    assert_true(next(scheduler, 0, 0, &first) && next(scheduler, 0, 0, &ahead));
    for (size_t i = 16; i < ROWS; i += other.count) {
        assert_true(next(scheduler, 1, 0, &other));
        OK(fracas_scheduler_computed(scheduler, 1, other.id, 0, 0.01));
    }
    fracas_scheduler_durable(scheduler, 1);
    assert_false(any(scheduler, 1, 1, &other));
    copy_of(scheduler, 1, 10.5, 0,
            &other); /* of both it would be the first; lost, it is not missed */
    assert_int_equal(other.id, first.id);
    fracas_scheduler_lost(scheduler, 1);
    OK(fracas_scheduler_computed(scheduler, 0, first.id, 5, 0.01));
    assert_false(any(scheduler, 1, 11, &other));
    assert_false(any(scheduler, 1, 15, &other)); /* 10 s after it began */
    copy_of(scheduler, 1, 21, 0, &other);
    assert_int_equal(other.id, ahead.id);
}

/* What a worker has computed and does not make durable is computed by another as well: 5 s after a
 * lease would be overdue. */
static void a_lease_that_stays_in_memory_is_overdue(void **state)
{
    fracas_lease first, second, copy;
    OWN(fracas_scheduler) scheduler = create_late(&first, &second);
    OK(fracas_scheduler_computed(scheduler, 1, second.id, 8, 8));
    fracas_scheduler_durable(scheduler, 1);
    OK(fracas_scheduler_computed(scheduler, 0, first.id, 10, 8));
    assert_true(fracas_scheduler_computed_all(scheduler));
    assert_false(any(scheduler, 2, 10 + 32 + 5, &copy));
    assert_false(any(scheduler, 0, 10 + 32 + 6, &copy)); /* its own */
    copy_of(scheduler, 2, 10 + 32 + 6, 0, &copy);
    assert_int_equal(copy.id, first.id);
    assert_true(fracas_scheduler_computed_all(scheduler)); /* still */
    assert_false(any(scheduler, 1, 999, &copy));
    OK(fracas_scheduler_computed(scheduler, 2, first.id, 60, 8));
    assert_false(any(scheduler, 1, 9999, &copy));
    fracas_scheduler_durable(scheduler, 2);
    assert_done(scheduler, 24, 0, 0);
    fracas_scheduler_durable(scheduler, 0);
    assert_done(scheduler, 24, 0, 8);
}

/* Where the original and the copy of a lease may be lost, and in what order. */
enum {
    LOSE_ORIGINAL,
    LOSE_COPY,
    COMPUTE_ORIGINAL,
    COMPUTE_COPY,
    COMMIT_ORIGINAL,
    COMMIT_COPY,
    NEVENTS
};

/* Every order of every subset of what can happen to a lease that two workers have: nothing of it is
 * lost, nothing counts twice. */
static void a_loss_at_any_stage_loses_nothing(void **state)
{
    for (int course = 0; course < NEVENTS * NEVENTS * NEVENTS * NEVENTS; course++) {
        fracas_lease first, second, copy;
        OWN(fracas_scheduler) scheduler = create_late(&first, &second);
        OK(fracas_scheduler_computed(scheduler, 1, second.id, 9, 8));
        fracas_scheduler_durable(scheduler, 1);
        copy_of(scheduler, 2, 50, 0, &copy);
        bool held[2] = {true, true}, memory[2] = {false, false}, done = false;
        int64_t duplicates = 0;
        for (int rest = course, i = 0; i < 4; i++, rest /= NEVENTS) {
            const int event = rest % NEVENTS, who = event % 2;
            const size_t worker = who ? 2 : 0;
            if (event <= LOSE_COPY) {
                fracas_scheduler_lost(scheduler, worker);
                held[who] = memory[who] = false;
            } else if (event <= COMPUTE_COPY && held[who]) {
                OK(fracas_scheduler_computed(scheduler, worker, first.id, 60, 8));
                held[who] = false;
                memory[who] = true;
            } else if (event >= COMMIT_ORIGINAL) {
                fracas_scheduler_durable(scheduler, worker);
                if (memory[who] && done) duplicates += 8;
                done = done || memory[who];
                memory[who] = false;
            }
            const bool there = memory[0] || memory[1];
            assert_done(scheduler, done ? 24 : 16, !done && there ? 8 : 0, duplicates);
            assert_int_equal(fracas_scheduler_computed_all(scheduler), done || there);
            if (!done && !there && !held[0] && !held[1]) { /* it waits again, once */
                assert_true(next(scheduler, 1, 70, &copy));
                assert_int_equal(copy.id, first.id);
                assert_false(any(scheduler, 0, 70, &copy));
                break;
            }
        }
    }
}

/* A lease that fails while another worker has it: what the other says counts. */
static void a_copy_that_fails_is_forgotten(void **state)
{
    for (int stage = 0; stage < 3;
         stage++) { /* the other one holds it, has it in memory, has it on disk */
        fracas_lease first, second, copy, fault;
        bool final;
        fracas_scheduler *scheduler = create_late(&first, &second);
        OK(fracas_scheduler_computed(scheduler, 1, second.id, 9, 8));
        copy_of(scheduler, 2, 50, 0, &copy);
        if (stage > 0) OK(fracas_scheduler_computed(scheduler, 2, first.id, 60, 8));
        if (stage > 1) fracas_scheduler_durable(scheduler, 2);
        OK(fracas_scheduler_failed(scheduler, 0, first.id, 61, 0, 8, &fault, &final));
        assert_int_equal(fault.count, 0);
        assert_false(final);
        assert_done(scheduler, stage > 1 ? 16 : 8, stage == 1 ? 16 : 8, 0);
        assert_int_equal(fracas_scheduler_computed_all(scheduler), stage > 0);
        if (stage == 0) { /* and when the other fails as well, it is bisected */
            OK(fracas_scheduler_failed(scheduler, 2, first.id, 61, 0, 8, &fault, &final));
            assert_int_equal(fault.count, 8);
            assert_true(next(scheduler, 2, 62, &copy));
            assert_int_equal(copy.count, 4);
        }
        fracas_scheduler_destroy(scheduler);
    }
}

/* ---- any course of events ---- */

enum { PLACES = 5, REPLICAS = 61, ROWS = PLACES * REPLICAS, WORKERS = 4, SEEDS = 60 };

/* What must be true of every realization, kept apart from the scheduler. */
typedef struct {
    fracas_scheduler *scheduler;
    unsigned dice;
    double now;
    size_t width, added; /* rows that the scheduler knows */
    bool done[ROWS], failed[ROWS];
    int attempts[ROWS];
    int held[ROWS], memory[ROWS]; /* by so many workers */
    int own_memory[WORKERS][ROWS];
    int64_t duplicates;
    fracas_lease lease[WORKERS][FRACAS_LEASES_HELD];
    size_t nheld[WORKERS];
} world;

static int roll(world *w, int sides)
{
    return rand_r(&w->dice) % sides;
}

static size_t row_of(const fracas_lease *lease, size_t i)
{
    return lease->point * REPLICAS + (size_t)lease->replica[i];
}

static void drop(world *w, size_t worker, size_t place)
{
    for (size_t i = 0; i < w->lease[worker][place].count; i++)
        w->held[row_of(&w->lease[worker][place], i)]--;
    w->nheld[worker]--;
    for (size_t h = place; h < w->nheld[worker]; h++) w->lease[worker][h] = w->lease[worker][h + 1];
}

static bool is_copy(const world *w, uint64_t id)
{
    for (size_t worker = 0; worker < WORKERS; worker++)
        for (size_t h = 0; h < w->nheld[worker]; h++)
            if (w->lease[worker][h].id == id) return true;
    return false;
}

static void ask(world *w, size_t worker)
{
    fracas_lease lease;
    bool copy;
    if (!any_or_copy(w->scheduler, worker, w->now, &lease, &copy)) return;
    assert_true(w->nheld[worker] < FRACAS_LEASES_HELD);
    assert_true(lease.count >= 1);
    assert_true(copy || !is_copy(w, lease.id));
    if (copy) assert_int_equal(w->nheld[worker], 0);
    for (size_t i = 0; i < lease.count; i++) { /* nothing is given out that somebody has */
        const size_t r = row_of(&lease, i);
        assert_true(r < w->added && !w->done[r] && !w->failed[r]);
        assert_int_equal(w->memory[r] + w->held[r]++, copy ? 1 : 0);
    }
    w->lease[worker][w->nheld[worker]++] = lease;
}

static void remember(world *w, size_t worker, const fracas_lease *lease, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        w->memory[row_of(lease, i)]++;
        w->own_memory[worker][row_of(lease, i)]++;
    }
}

static void forget(world *w, size_t worker, bool durable)
{
    for (size_t r = 0; r < ROWS; r++) {
        const int n = w->own_memory[worker][r];
        w->memory[r] -= n;
        w->own_memory[worker][r] = 0;
        if (!n || !durable) continue;
        w->duplicates += n - !w->done[r];
        w->done[r] = true;
    }
}

static void go_wrong(world *w, size_t worker, size_t place)
{
    const fracas_lease lease = w->lease[worker][place];
    const size_t batches = (lease.count + w->width - 1) / w->width,
                 kept = (size_t)roll(w, (int)batches) * w->width;
    const size_t rest = lease.count - kept, count = rest < w->width ? rest : w->width,
                 r = row_of(&lease, kept);
    fracas_lease fault;
    bool final;
    drop(w, worker, place);
    OK(fracas_scheduler_failed(w->scheduler, worker, lease.id, w->now, kept, count, &fault,
                               &final));
    if (is_copy(w, lease.id) || w->memory[r] || w->done[r]) {
        assert_int_equal(fault.count, 0);
        return;
    }
    assert_int_equal(fault.count, count);
    assert_memory_equal(fault.replica, lease.replica + kept, count * sizeof *fault.replica);
    remember(w, worker, &lease, kept);
    if (count > 1) {
        assert_false(final);
        return;
    }
    assert_int_equal(final, ++w->attempts[r] == FRACAS_ATTEMPTS_MAX);
    w->failed[r] = final;
}

static void happen(world *w)
{
    const size_t worker = (size_t)roll(w, WORKERS);
    const int event = roll(w, 60);
    w->now += roll(w, 20) ? 0.1 * roll(w, 20) : 30;
    if (event == 0) {
        fracas_scheduler_lost(w->scheduler, worker);
        while (w->nheld[worker]) drop(w, worker, 0);
        forget(w, worker, false);
    } else if (event < 6) {
        fracas_scheduler_durable(w->scheduler, worker);
        forget(w, worker, true);
    } else if (event < 8 && w->added < ROWS) {
        fracas_index_row row[ROWS];
        size_t more = 1 + (size_t)roll(w, 20);
        if (more > ROWS - w->added) more = ROWS - w->added;
        for (size_t i = 0; i < more; i++)
            row[i] = (fracas_index_row){.point = (w->added + i) / REPLICAS,
                                        .replica = (int64_t)((w->added + i) % REPLICAS)};
        OK(fracas_scheduler_add(w->scheduler, row, more));
        w->added += more;
    } else if (event < 35 || !w->nheld[worker]) {
        ask(w, worker);
    } else {
        const size_t place = (size_t)roll(w, (int)w->nheld[worker]);
        const fracas_lease lease = w->lease[worker][place];
        const bool bad = lease.count == 1 &&
                         lease.replica[0] % 16 == 3; /* alone it fails most of the time */
        if (roll(w, 5) < (bad ? 4 : 1)) {
            go_wrong(w, worker, place);
            return;
        }
        drop(w, worker, place);
        OK(fracas_scheduler_computed(w->scheduler, worker, lease.id, w->now,
                                     0.01 * (double)(lease.count * (1 + lease.point))));
        remember(w, worker, &lease, lease.count);
    }
}

/* total = done + memory + failed + waiting + held, each realization in one of them. */
static void check(const world *w)
{
    int64_t done = 0, memory = 0, failed = 0, open = 0;
    for (size_t r = 0; r < w->added; r++) {
        assert_true(!(w->done[r] && w->failed[r]));
        if (w->done[r]) done++;
        else if (w->failed[r]) failed++;
        else if (w->memory[r]) memory++;
        else open++;
    }
    const fracas_counts count = fracas_scheduler_count(w->scheduler);
    assert_int_equal(count.total, w->added);
    assert_int_equal(count.done, done);
    assert_int_equal(count.memory, memory);
    assert_int_equal(count.failed, failed);
    assert_int_equal(count.duplicates, w->duplicates);
    assert_int_equal(fracas_scheduler_computed_all(w->scheduler), open == 0);
    for (size_t worker = 0; worker < WORKERS; worker++)
        assert_int_equal(fracas_scheduler_idles(w->scheduler, worker), w->nheld[worker] == 0);
}

static void any_course_of_events(void **state)
{
    static const double costs[PLACES] = {1, 3, 2, 5, 4};
    int64_t failed = 0, duplicates = 0;
    for (unsigned seed = 1; seed <= SEEDS; seed++) {
        OWNED world *w = zeroed(1, sizeof *w);
        w->dice = seed;
        w->width = seed % 3 ? 8 : 3;
        const fracas_scheduler_options options = {.cost = costs,
                                                  .npoints = PLACES,
                                                  .workers = WORKERS,
                                                  .width = w->width,
                                                  .memory = 2,
                                                  .seconds = seed % 5 ? 0.5 : 0,
                                                  .shuffle = seed % 2,
                                                  .seed = seed};
        OK(fracas_scheduler_create(NULL, 0, &options, &w->scheduler));
        for (int step = 0;
             step < 100 || w->added < ROWS || !fracas_scheduler_computed_all(w->scheduler);
             step++) {
            assert_true(step < 100000);
            happen(w);
            check(w);
        }
        for (size_t worker = 0; worker < WORKERS; worker++) {
            fracas_scheduler_durable(w->scheduler, worker);
            forget(w, worker, true);
        }
        check(w);
        for (size_t r = 0; r < ROWS; r++) assert_true(w->done[r] != w->failed[r]);
        failed += fracas_scheduler_count(w->scheduler).failed;
        duplicates += w->duplicates;
        fracas_scheduler_destroy(w->scheduler);
    }
    print_message("%lld failed for good, %lld duplicates\n", (long long)failed,
                  (long long)duplicates);
    assert_true(failed > SEEDS && duplicates > SEEDS); /* it was not all plain sailing */
}

/* ---- a million ---- */

/* s that a million realizations of `npoints` points take for 64 workers, of 0.1 ms each; *bytes:
 * allocated at most. */
static double run_million(size_t npoints, size_t *bytes)
{
    enum { MILLION = 1000000, CROWD = 64 };
    OWNED fracas_index_row *row = taken(MILLION * sizeof *row);
    OWNED double *costs = taken(npoints * sizeof *costs);
    for (size_t i = 0; i < MILLION; i++)
        row[i] = (fracas_index_row){.point = i * npoints / MILLION, .replica = (int64_t)i};
    for (size_t p = 0; p < npoints; p++) costs[p] = 1 + (double)(p * 7919 % npoints);
    const fracas_scheduler_options options = {
        .cost = costs, .npoints = npoints, .workers = CROWD, .width = 8, .seconds = 1};
    struct timespec a, b;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &a);
    const struct mallinfo2 before = mallinfo2();
    OWN(fracas_scheduler) scheduler;
    fracas_lease lease;
    OK(fracas_scheduler_create(row, MILLION, &options, &scheduler));
    *bytes = 0;
    for (size_t turn = 0; !fracas_scheduler_computed_all(scheduler); turn++) {
        assert_true(next(scheduler, turn % CROWD, (double)turn, &lease));
        OK(fracas_scheduler_computed(scheduler, turn % CROWD, lease.id, (double)turn,
                                     1e-4 * (double)lease.count));
        if (turn % 1000 ==
            0) { /* the memory of a worker is at its largest: nothing is durable yet */
            const struct mallinfo2 now = mallinfo2();
            const size_t used = now.uordblks + now.hblkhd - before.uordblks - before.hblkhd;
            if (used > *bytes) *bytes = used;
        }
    }
    for (size_t worker = 0; worker < CROWD; worker++) fracas_scheduler_durable(scheduler, worker);
    assert_int_equal(fracas_scheduler_count(scheduler).done, MILLION);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &b);
    return (double)(b.tv_sec - a.tv_sec) + 1e-9 * (double)(b.tv_nsec - a.tv_nsec);
}

static void a_million_is_not_too_many(void **state)
{
    static const size_t npoints[] = {1, 1000, 1000000};
    for (size_t i = 0; i < 3; i++) {
        size_t bytes;
        const double seconds = run_million(npoints[i], &bytes);
        print_message("1e6 realizations of %zu points: %.2f s, %.0f bytes each\n", npoints[i],
                      seconds, (double)bytes * 1e-6);
        assert_true(bytes < 500000000);
        assert_true(seconds < 60); /* of a machine that is busy, with sanitizers; a step per point
                                      and lease would take hours */
    }
}

/* A worker without a lease, as it is where the next would be too late, gets no copy meanwhile. */
static void what_nobody_has_goes_before_a_copy(void **state)
{
    OWN(fracas_scheduler) scheduler = create(1, 30, 2);
    fracas_lease first, other;
    size_t late;
    bool given;
    assert_true(next(scheduler, 0, 0, &first));
    assert_true(next(scheduler, 1, 0, &other));
    computed(scheduler, 1, &other, 8);
    fracas_scheduler_overdue(scheduler, 1, 1000, &other, &late, &given);
    assert_false(given);
    while (next(scheduler, 1, 1000, &other)) computed(scheduler, 1, &other, 8);
    copy_of(scheduler, 1, 1000, 0, &other);
    assert_int_equal(other.id, first.id);
}

TESTS(an_overdue_lease_goes_to_an_idle_worker, what_nobody_has_goes_before_a_copy,
      two_do_not_take_turns_with_what_never_ends, short_leases_are_overdue_after_10_s,
      a_lease_that_stays_in_memory_is_overdue, a_loss_at_any_stage_loses_nothing,
      a_copy_that_fails_is_forgotten, any_course_of_events, a_million_is_not_too_many)
