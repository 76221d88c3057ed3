/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rank 0 without MPI, with a clock of the test's own: workers whose messages a test makes up. */
#ifndef FRACAS_TESTS_SUPPORT_DIRECTOR_H
#define FRACAS_TESTS_SUPPORT_DIRECTOR_H

#include "tests/support/campaign_text.h"
#include "tests/support/study_fixture.h"

#include "campaigns/scheduler/director/director.h"
#include "campaigns/scheduler/session/failures.h"

enum { WORKERS = 2 };

static double time_; /* s */
static double step;  /* s that pass whenever somebody asks */
static inline double now(void)
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

static inline fracas_err note(void *context, size_t to, const fracas_packet *message)
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
static inline int end(void **state)
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
static inline void prepare(const char *replicas, const char *sweep)
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

static inline void begin(double deadline)
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

static inline void hear(size_t from, fracas_packet_kind kind, const void *body, size_t size)
{
    OWNED fracas_packet *message;
    OK(fracas_packet_create(kind, body, size, &message));
    fracas_director_receive(director, from, message);
}

static inline void ready(void)
{
    for (size_t w = 0; w < WORKERS; w++)
        hear(w, FRACAS_PACKET_READY, &campaign->hash, sizeof campaign->hash);
}

static inline void begin_ready(double deadline)
{
    begin(deadline);
    ready();
}

/* The worker has computed its lease number `i`. */
static inline void computed(size_t from, size_t i, double seconds)
{
    const fracas_lease_report report = {.lease = worker[from].lease[i].id, .seconds = seconds};
    hear(from, FRACAS_PACKET_COMPUTED, &report, sizeof report);
}

/* The leases `first` to `last` of a worker are in a segment of so many bytes. */
static inline void segment(size_t from, size_t first, size_t last, uint64_t bytes)
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

static inline void pass(double seconds)
{
    time_ += seconds;
    fracas_director_tick(director);
}

/* How the run ends. */
static inline void assert_result(fracas_err code, const char *part)
{
    assert_true(fracas_director_over(director));
    FAILS(fracas_director_finish(director), code, part);
}

/* study.h5 is begun, and lacks the segments that this test did not write. */
static inline void assert_merged(void)
{
    assert_true(fracas_director_over(director));
    assert_int_not_equal(fracas_director_finish(director), FRACAS_OK);
    assert_has(fracas_message(), ".h5 is missing");
}

static inline void say_ended(size_t from)
{
    hear(from, FRACAS_PACKET_ENDED, NULL, 0);
}

static inline void assert_leases(size_t first, size_t second)
{
    assert_int_equal(worker[0].nleases, first);
    assert_int_equal(worker[1].nleases, second);
}

/* Worker 0 was told to stop so often, the last time at once (`kill`). */
static inline void assert_stops(size_t stops, int kill)
{
    assert_int_equal(worker[0].stops, stops);
    assert_int_equal(worker[0].kill, kill);
}

/* 16 realizations, 8 for each worker; the second worker is done with its own. */
static inline void half_done(double deadline)
{
    prepare("replicas: 16", "");
    begin_ready(deadline);
    assert_leases(1, 1);
    computed(1, 0, 1);
    segment(1, 0, 0, 1000);
}

#endif
