/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rank 0 with failing realizations, lost workers, and messages too long. */
#include "tests/support/director.h"

/* The worker cannot compute its realization number `i`. */
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

/* ---- lost workers, and messages too long ---- */

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

TESTS_EACH(NULL, end, points_with_failures_are_named, the_last_worker_ends_the_run,
           an_error_comes_before_what_is_flushed, the_signal_of_any_rank_drains,
           a_copy_that_fails_is_no_failure, a_message_that_does_not_fit_ends_the_run)
