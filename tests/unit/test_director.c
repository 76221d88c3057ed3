/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The orders of rank 0 to its workers, by rounds, time and parts, and how a run ends. */
#include "tests/support/director.h"

/* ---- rounds ---- */

/* Two points of 16 realizations each. When the second worker has nothing left to do, both are asked
 * for what they have in memory, though the first still computes: the round of the other point may
 * be complete with it. */
static void nobody_waits_for_records_of_one_that_computes(void **state)
{
    prepare("replicas: {minimum: 16, maximum: 64, until: {quantity: dissipated, "
            "relative-half-width: 0.1}}",
            "sweep:\n  - loading.rate: [1e3, 1e4]\n");
    begin_ready(0);
    assert_leases(2, 1); /* the first took one ahead */
    computed(0, 0, 8);   /* so long that leases are one batch */
    assert_int_equal(worker[0].flushes + worker[1].flushes, 0); /* everyone has something to do */
    computed(1, 0, 8);
    assert_int_equal(worker[1].nleases, 2);
    assert_int_equal(worker[0].flushes + worker[1].flushes, 0);
    computed(1, 1, 8);
    assert_int_equal(worker[0].nleases, 2); /* which is not computed yet */
    assert_int_equal(worker[0].flushes, 1);
    assert_int_equal(worker[1].flushes, 1);
    computed(0, 1, 8);
    assert_int_equal(worker[0].flushes, 1); /* once until its segment comes */
}

/* A point whose replicas a rule decides goes before a longer one with a number of them. */
static void what_rounds_wait_for_goes_first(void **state)
{
    prepare("replicas: 40", "sweep:\n  - cases:\n      - {name: long, time: {end: 900 ns}}\n      "
                            "- {name: ruled, replicas: {minimum: 16, maximum: 64, until: "
                            "{quantity: dissipated, relative-half-width: 0.1}}}\n");
    begin_ready(0);
    for (size_t w = 0; w < WORKERS; w++) assert_int_equal(worker[w].lease[0].point, w == 0 ? 1 : 0);
    assert_int_equal(worker[0].lease[1].point, 1);
}

/* ---- time ---- */

/* Nobody sends anything any more: only the clock goes on. */
static void an_overdue_lease_is_offered_when_time_passes(void **state)
{
    half_done(0);
    pass(9);
    assert_int_equal(worker[1].nleases, 1);
    pass(2);
    assert_int_equal(worker[1].nleases, 2);
    assert_int_equal(worker[1].lease[1].id, worker[0].lease[0].id);
    pass(100);
    assert_int_equal(worker[1].nleases, 2); /* it is at work */
}

static void a_look_at_the_time_is_rare(void **state)
{
    half_done(0);
    pass(0);
    time_ += 11;
    fracas_director_tick(director);
    assert_int_equal(worker[1].nleases, 2);
    half_done(0);
    pass(9.9);
    pass(0.2); /* overdue, but looked at 0.2 s ago */
    assert_int_equal(worker[1].nleases, 1);
    pass(0.1);
    assert_int_equal(worker[1].nleases, 2);
}

/* Everything is there, but worker 0 hangs in a lease that was computed by the other. */
static void a_worker_that_is_not_needed_is_given_up(void **state)
{
    half_done(0);
    pass(11);
    computed(1, 1, 1);
    assert_int_equal(
        worker[1].flushes,
        1); /* nobody stops before everything is durable: should this one die now ... */
    assert_int_equal(worker[0].stops + worker[1].stops, 0);
    segment(1, 1, 1, 1000);
    assert_stops(1, 1); /* its work is not needed */
    say_ended(1);
    pass(9.9);
    assert_false(fracas_director_over(director));
    pass(0.3);
    assert_true(fracas_director_over(director));
    say_ended(0); /* too late to be of any effect */
    hear(0, FRACAS_PACKET_TROUBLE, &(fracas_trouble){.code = FRACAS_BUG}, sizeof(fracas_trouble));
    assert_merged();
}

/* Worker 0 has computed everything that is missing, and hangs before it is on disk: the other one
 * computes it. */
static void what_stays_in_memory_is_computed_again(void **state)
{
    half_done(0);
    computed(0, 0, 1);
    assert_int_equal(worker[0].flushes, 1);
    pass(14.9);
    assert_int_equal(worker[1].nleases, 1);
    pass(0.3); /* segment_age and 10 s */
    assert_int_equal(worker[1].nleases, 2);
    computed(1, 1, 1);
    segment(1, 1, 1, 1000);
    assert_int_equal(worker[0].stops, 1);
}

/* A worker that never came up. */
static void a_worker_that_does_not_start_is_given_up(void **state)
{
    prepare("replicas: 8", "");
    begin(0);
    hear(1, FRACAS_PACKET_READY, &campaign->hash, sizeof campaign->hash);
    for (size_t i = 0; i < worker[1].nleases; i++) computed(1, i, 1);
    segment(1, 0, worker[1].nleases - 1, 1000);
    say_ended(1);
    pass(10.5);
    assert_true(fracas_director_over(director));
}

/* ---- the deadline ---- */

/* Leases of 1 s until the next one would not end 2 s before the deadline. */
static void compute_until_late(void)
{
    prepare("replicas: 160", "");
    begin_ready(1000 + 6.5);
    for (size_t i = 0; worker[0].stops == 0; i++) {
        assert_true(i < 10);
        time_ += 1;
        for (size_t w = 0; w < WORKERS; w++)
            if (i < worker[w].nleases) computed(w, i, 1);
        pass(0);
    }
    assert_true(time_ == 1004); /* a fifth lease would end at 1005, later than 1004.5 */
    assert_stops(1, 0);
}

/* Then nobody computes, and the run drains in order. */
static void no_lease_is_given_that_does_not_end_in_time(void **state)
{
    compute_until_late();
    assert_leases(4, 4);
    for (size_t w = 0; w < WORKERS; w++) {
        segment(w, 0, 3, 1000);
        say_ended(w);
    }
    assert_result(FRACAS_INTERRUPTED,
                  "the walltime is nearly over: 64 of 160 realizations are done");
}

/* A segment took 0.5 s to be committed, so two workers need 1 s more than the 2 s before the
 * deadline. */
static void commits_take_time_as_well(void **state)
{
    prepare("replicas: 160", "");
    begin(1000 + 6.5);
    step = 0.5; /* by which the clock goes on whenever it is looked at */
    ready();
    computed(0, 0, 0.01);
    segment(0, 0, 0, 1000);
    step = 0;
    time_ = 1000 + 6.5 - 2 - 0.9;
    fracas_director_tick(director);
    assert_int_equal(worker[0].stops + worker[1].stops, 2);
    assert_int_equal(worker[1].kill, 1);
}

/* What runs 2 s before the deadline is killed; who does not answer until the deadline is left
 * behind. */
static void what_runs_at_the_deadline_is_killed(void **state)
{
    half_done(1000 + 60);
    options.lease_seconds = 1;
    pass(9);
    assert_int_equal(worker[0].stops, 0);
    pass(48.9);
    assert_int_equal(worker[0].stops, 0);
    pass(0.3); /* 1.8 s are left */
    assert_stops(1, 1);
    say_ended(1);
    pass(1.5);
    assert_false(fracas_director_over(director));
    pass(0.4);
    assert_result(FRACAS_INTERRUPTED, "the walltime is nearly over: 8 of 16 realizations are done");
}

/* Nobody has a lease, and what is computed is not yet durable. */
static void a_lull_is_no_end(void **state)
{
    half_done(1000 + 60);
    computed(0, 0, 1);
    pass(1);
    assert_int_equal(worker[0].stops + worker[1].stops, 0);
}

/* No lease would end in time, so both drain; then the time is over for the one that still does. */
static void what_is_late_is_killed_at_last(void **state)
{
    compute_until_late();
    say_ended(0);
    pass(0.6);
    assert_int_equal(worker[0].stops, 1);
    assert_int_equal(worker[1].stops, 2);
    assert_int_equal(worker[1].kill, 1);
    say_ended(1);
    assert_result(FRACAS_INTERRUPTED, "the walltime is nearly over: 0 of 160 realizations");
}

static void what_drains_at_the_deadline_is_killed(void **state)
{
    half_done(1000 + 60);
    fracas_director_drain(director);
    assert_stops(1, 0);
    pass(30);
    assert_int_equal(worker[0].stops, 1);
    pass(29);
    assert_stops(2, 1);
    pass(0.5);
    assert_int_equal(worker[0].stops, 2); /* once is enough */
    say_ended(0);
    say_ended(1);
    assert_result(FRACAS_INTERRUPTED,
                  "interrupted: 8 of 16 realizations are done"); /* which came first */
}

/* Segments of 1 GB in all: 20 s to merge. */
static void everything(double deadline)
{
    half_done(deadline);
    computed(0, 0, 1);
    segment(0, 0, 0, 1000000000);
    for (size_t w = 0; w < WORKERS; w++) say_ended(w);
}

static void a_merge_that_would_not_end_is_not_begun(void **state)
{
    everything(1000 + 19);
    assert_result(FRACAS_INTERRUPTED,
                  "all 16 realizations are done and kept, only study.h5 is missing");
    everything(1000 + 21);
    assert_merged();
}

/* ---- parts ---- */

static void a_part_is_every_so_many_th(void **state)
{
    prepare("replicas: 3", "sweep:\n  - loading.rate: [1e3, 1e4, 2e4]\n");
    options.part = 2;
    options.parts = 4; /* of 9: the second and the sixth */
    begin_ready(0);
    assert_int_equal(worker[0].nleases + worker[1].nleases, 2);
    bool found[3][3] = {{false}};
    for (size_t w = 0; w < WORKERS; w++) {
        assert_int_equal(worker[w].lease[0].count, 1);
        found[worker[w].lease[0].point][worker[w].lease[0].replica[0]] = true;
        computed(w, 0, 1);
        segment(w, 0, 0, 1000);
        say_ended(w);
    }
    assert_true(found[0][1] && found[1][2]);
    assert_result(FRACAS_INTERRUPTED, "part 2 of 4 is complete, 2 realizations, 0 of them FAILED; "
                                      "when the other parts are, `fracas merge-studies`");
}

/* A part that has everything is the study. */
static void the_only_part_is_merged(void **state)
{
    prepare("replicas: 1", "");
    options.part = 1;
    options.parts = 2;
    begin_ready(0);
    computed(0, 0, 1);
    segment(0, 0, 0, 1000);
    for (size_t w = 0; w < WORKERS; w++) say_ended(w);
    assert_merged();
}

TESTS_EACH(NULL, end, nobody_waits_for_records_of_one_that_computes,
           what_rounds_wait_for_goes_first, an_overdue_lease_is_offered_when_time_passes,
           a_look_at_the_time_is_rare, a_worker_that_is_not_needed_is_given_up,
           what_stays_in_memory_is_computed_again, a_worker_that_does_not_start_is_given_up,
           no_lease_is_given_that_does_not_end_in_time, commits_take_time_as_well,
           what_runs_at_the_deadline_is_killed, what_drains_at_the_deadline_is_killed,
           a_merge_that_would_not_end_is_not_begun, a_part_is_every_so_many_th,
           the_only_part_is_merged, a_lull_is_no_end, what_is_late_is_killed_at_last)
