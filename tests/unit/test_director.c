/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rank 0 without MPI and with a clock of the test's: what it tells workers to do, and how a run
 * ends. */
#include "tests/support/campaign_text.h"
#include "tests/support/study_fixture.h"

#include "campaigns/scheduler/director/director.h"
#include "campaigns/scheduler/session/failures.h"

enum { WORKERS = 2 };

static double time_; /* s */
static double step;  /* s that pass whenever somebody asks */
static double now(void)
{
    return time_ += step;
}

static struct {
    size_t nleases, flushes, stops;
    int32_t kill; /* of the last STOP */
    struct {
        uint64_t id, point, count;
        int64_t replica[64];
    } lease[32]; /* in the order given */
} worker[WORKERS];

static fracas_err note(void *context, size_t to, const fracas_packet *message)
{
    if (message->kind == FRACAS_PACKET_FLUSH) worker[to].flushes++;
    if (message->kind == FRACAS_PACKET_STOP) {
        worker[to].stops++;
        memcpy(&worker[to].kill, message->body, sizeof worker[to].kill);
    }
    if (message->kind != FRACAS_PACKET_LEASE) return FRACAS_OK;
    fracas_lease lease;
    memcpy(&lease, message->body, message->size);
    const size_t i = worker[to].nleases++;
    assert_true(i < 32 && lease.count <= 64);
    worker[to].lease[i].id = lease.id;
    worker[to].lease[i].point = lease.point;
    worker[to].lease[i].count = lease.count;
    memcpy(worker[to].lease[i].replica, lease.replica, lease.count * sizeof *lease.replica);
    return FRACAS_OK;
}

/* ---- a run ---- */

static fracas_campaign *campaign;
static fracas_run_options options;
static fracas_channel channel;
static fracas_director *director;

/* Ends the run prepared last, if any. */
static int end(void **state)
{
    if (!study) return 0;
    fracas_director_destroy(director);
    fracas_campaign_destroy(campaign);
    sample_remove(study);
    study = NULL;
    return 0;
}

/* Of the plain campaign, in place of its three replicas and sweep: for `WORKERS` workers in a study
 * of its own. */
static void prepare(const char *replicas, const char *sweep)
{
    end(NULL);
    OWNED char *counted = replace(plain_campaign, "replicas: 3", replicas),
               *text = replace(counted, "", sweep);
    campaign = read_text(text);
    fracas_run_options_init(&options);
    options.width = 8;
    channel = (fracas_channel){0};
    fracas_channel_init(&channel);
    study = sample_folder();
    memset(worker, 0, sizeof worker);
    time_ = 1000;
}

static void begin(double deadline)
{
    const fracas_director_setup setup = {.campaign = campaign,
                                         .options = &options,
                                         .study = study,
                                         .workers = WORKERS,
                                         .send = note,
                                         .channel = &channel,
                                         .now = now,
                                         .deadline = deadline};
    fracas_err result;
    OK(fracas_director_create(&setup, &director, &result));
}

static void hear(size_t from, fracas_packet_kind kind, const void *body, size_t size)
{
    OWNED fracas_packet *message;
    OK(fracas_packet_create(kind, body, size, &message));
    fracas_director_receive(director, from, message);
}

static void ready(void)
{
    for (size_t w = 0; w < WORKERS; w++)
        hear(w, FRACAS_PACKET_READY, &campaign->hash, sizeof campaign->hash);
}

static void begin_ready(double deadline)
{
    begin(deadline);
    ready();
}

/* The worker has computed the lease that it was given as number `i`. */
static void computed(size_t from, size_t i, double seconds)
{
    const fracas_lease_report report = {.lease = worker[from].lease[i].id, .seconds = seconds};
    hear(from, FRACAS_PACKET_COMPUTED, &report, sizeof report);
}

/* The leases `first` to `last` of a worker are in a segment of so many bytes. */
static void segment(size_t from, size_t first, size_t last, uint64_t bytes)
{
    static int number;
    struct {
        fracas_segment_note note;
        fracas_segment_row row[1024];
    } body;
    memset(&body, 0, sizeof body);
    size_t rows = 0;
    for (size_t i = first; i <= last; i++)
        for (size_t k = 0; k < worker[from].lease[i].count; k++, rows++)
            body.row[rows] = (fracas_segment_row){
                .point = campaign->point[worker[from].lease[i].point].hash,
                .replica = worker[from].lease[i].replica[k],
                .row = (int64_t)rows};
    snprintf(body.note.name, sizeof body.note.name, "s%d.h5", number++);
    body.note.seal.bytes = bytes;
    body.note.rows = rows;
    const size_t size = sizeof body.note + rows * sizeof *body.row;
    memcpy((char *)&body + size, "{}", 3);
    hear(from, FRACAS_PACKET_SEGMENT, &body, size + 3);
}

static void pass(double seconds)
{
    time_ += seconds;
    fracas_director_tick(director);
}

/* How the run ends. */
static void assert_result(fracas_err code, const char *part)
{
    assert_true(fracas_director_over(director));
    FAILS(fracas_director_finish(director), code, part);
}

/* study.h5 is begun, and lacks the segments that this test did not write. */
static void assert_merged(void)
{
    assert_true(fracas_director_over(director));
    assert_int_not_equal(fracas_director_finish(director), FRACAS_OK);
    assert_has(fracas_message(), ".h5 is missing");
}

static void say_ended(size_t from)
{
    hear(from, FRACAS_PACKET_ENDED, NULL, 0);
}

static void assert_leases(size_t first, size_t second)
{
    assert_int_equal(worker[0].nleases, first);
    assert_int_equal(worker[1].nleases, second);
}

/* Worker 0 was told to stop so often, the last time at once (`kill`). */
static void assert_stops(size_t stops, int kill)
{
    assert_int_equal(worker[0].stops, stops);
    assert_int_equal(worker[0].kill, kill);
}

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

/* 16 realizations, 8 for each worker; the second worker is done with its own. */
static void half_done(double deadline)
{
    prepare("replicas: 16", "");
    begin_ready(deadline);
    assert_leases(1, 1);
    computed(1, 0, 1);
    segment(1, 0, 0, 1000);
}

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

/* ---- failures ---- */

/* The worker cannot compute the realization that it was given as number `i`. */
static void failed(size_t from, size_t i)
{
    const fracas_lease_failure failure = {
        .lease = worker[from].lease[i].id, .count = 1, .reason = "it is cursed"};
    hear(from, FRACAS_PACKET_FAILED, &failure, sizeof failure);
}

/* The result names the points, the first few of them. */
static void points_with_failures_are_named(void **state)
{
    prepare("replicas: 1", "sweep:\n  - loading.rate: [1e3, 1e4, 2e4, 3e4, 4e4, 5e4, 6e4]\n");
    options.width = 1;
    begin(0);
    hear(1, FRACAS_PACKET_READY, &campaign->hash, sizeof campaign->hash);
    OK(fracas_failure_report(study, NULL, &campaign->table));
    for (size_t i = 0; i < worker[1].nleases; i++) failed(1, i); /* each three times */
    assert_int_equal(worker[1].nleases, 21);
    assert_int_equal(worker[1].stops, 1);
    fracas_index *index;
    OK(fracas_index_open(study, false, &index));
    FAILS(fracas_failure_report(study, index, &campaign->table), FRACAS_SOME_FAILED,
          "7 realizations of",
          "FAILED: 1 of point 0, 1 of point 1, 1 of point 2, 1 of point 3, 1 of "
          "point 4, and of 2 points more (which and why: fracas status");
    fracas_index_close(index);
}

/* ---- workers that are lost, and messages that do not fit ---- */

static const fracas_trouble gone = {
    .code = FRACAS_ENVIRONMENT, .again = 1, .text = "its server is gone"};

static void say_lost(size_t from)
{
    hear(from, FRACAS_PACKET_LOST, &gone, sizeof gone);
}

static void the_last_worker_ends_the_run(void **state)
{
    prepare("replicas: 16", "");
    begin_ready(1000 + 60);
    computed(1, 0, 1);
    say_lost(0);
    assert_int_equal(worker[1].nleases, 2); /* of the lost one */
    pass(1);
    assert_int_equal(worker[1].stops, 0); /* it has a lease, and time */
    say_lost(1);
    assert_result(FRACAS_ENVIRONMENT, "its server is gone (0 of 16 realizations are done and kept");
    assert_false(channel.again);
    half_done(0);
    channel.launcher = true; /* which can start MPI again */
    say_lost(0);
    say_lost(1);
    assert_true(channel.again);
    assert_result(FRACAS_ENVIRONMENT, "its server is gone");
    assert_string_equal(fracas_message(), gone.text); /* the launcher goes on from there */
}

/* After an error nothing that a worker says makes a realization done. */
static void an_error_comes_before_what_is_flushed(void **state)
{
    prepare("replicas: 16", "");
    begin_ready(0);
    computed(1, 0, 1);
    hear(0, FRACAS_PACKET_TROUBLE, &gone, sizeof gone);
    hear(1, FRACAS_PACKET_FLUSHED, NULL, 0);
    say_ended(1);
    assert_result(FRACAS_ENVIRONMENT, "its server is gone (0 of 16 realizations are done and kept");
}

/* A rank asks for the end though its own server is gone. */
static void the_signal_of_any_rank_drains(void **state)
{
    half_done(0);
    say_lost(1);
    hear(1, FRACAS_PACKET_DRAIN, NULL, 0);
    assert_stops(1, 0);
    hear(1, FRACAS_PACKET_DRAIN, NULL, 0);
    assert_stops(1, 0); /* once */
    say_ended(0);
    assert_result(FRACAS_INTERRUPTED, "interrupted: 8 of 16 realizations are done");
}

/* A copy of an overdue lease: the first one is not harmed. */
static void a_copy_that_fails_is_no_failure(void **state)
{
    half_done(0);
    pass(11);
    failed(1, 1);
    OK(fracas_index_open(study, false, &index_));
    assert_int_equal(number("SELECT count(*) FROM event WHERE kind = 'copy failed'"), 1);
    assert_int_equal(number("SELECT count(*) FROM event WHERE kind LIKE '%failed'"), 1);
    fracas_index_close(index_);
    computed(0, 0, 1);
    segment(0, 0, 0, 1000);
    for (size_t w = 0; w < WORKERS; w++) say_ended(w);
    assert_merged();
}

/* Each stops the run, which keeps what is done. */
static void a_message_that_does_not_fit_ends_the_run(void **state)
{
    struct {
        fracas_segment_note note;
        fracas_segment_row row;
        char text[8];
    } body;
    static const struct {
        fracas_packet_kind kind;
        uint64_t rows;
        size_t size;
        int last; /* byte of the body */
        fracas_err code;
        const char *said;
    } wrong[] = {
        {99, 0, 0, 0, FRACAS_BUG, "rank 0 got a message of kind 99"},
        {FRACAS_PACKET_COMPUTED, 0, 4, 0, FRACAS_BUG, "has 4 bytes"},
        {FRACAS_PACKET_SEGMENT, 0, offsetof(typeof(body), row), 0, FRACAS_BUG, "is damaged"},
        {FRACAS_PACKET_SEGMENT, 2, sizeof body, 0, FRACAS_BUG, "is damaged"},
        {FRACAS_PACKET_SEGMENT, UINT64_MAX, sizeof body, 0, FRACAS_BUG, "is damaged"},
        {FRACAS_PACKET_SEGMENT, 1, sizeof body, 'x', FRACAS_BUG, "is damaged"},
        {FRACAS_PACKET_READY, 0, sizeof(fracas_hash), 1, FRACAS_ENVIRONMENT,
         "rank 1 read another campaign"},
    };
    for (size_t i = 0; i < FRACAS_COUNT(wrong); i++) {
        prepare("replicas: 16", "");
        begin_ready(0);
        memset(&body, 0, sizeof body);
        body.note.rows = wrong[i].rows;
        if (wrong[i].size) ((char *)&body)[wrong[i].size - 1] = (char)wrong[i].last;
        hear(1, wrong[i].kind, &body, wrong[i].size);
        assert_stops(1, 0);
        for (size_t w = 0; w < WORKERS; w++) say_ended(w);
        assert_result(wrong[i].code, wrong[i].said);
    }
}

TESTS_EACH(NULL, end, nobody_waits_for_records_of_one_that_computes,
           what_rounds_wait_for_goes_first, an_overdue_lease_is_offered_when_time_passes,
           a_look_at_the_time_is_rare, a_worker_that_is_not_needed_is_given_up,
           what_stays_in_memory_is_computed_again, a_worker_that_does_not_start_is_given_up,
           no_lease_is_given_that_does_not_end_in_time, commits_take_time_as_well,
           what_runs_at_the_deadline_is_killed, what_drains_at_the_deadline_is_killed,
           a_merge_that_would_not_end_is_not_begun, a_part_is_every_so_many_th,
           the_only_part_is_merged, points_with_failures_are_named, the_last_worker_ends_the_run,
           an_error_comes_before_what_is_flushed, the_signal_of_any_rank_drains,
           a_copy_that_fails_is_no_failure, a_message_that_does_not_fit_ends_the_run,
           a_lull_is_no_end, what_is_late_is_killed_at_last)
