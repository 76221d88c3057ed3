/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rank 0 without MPI: what becomes of the leases of a server that died and was replaced. */
#include "tests/support/campaign_text.h"
#include "tests/support/study_fixture.h"

#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/director/director.h"
#include "campaigns/store/index/index.h"

static struct {
    size_t nleases, stops, fresh;
    uint64_t lease[8], isolated[8], count[8]; /* in the order given */
} worker[2];

static fracas_campaign *campaign;
static fracas_director *director;
static fracas_channel channel;
static fracas_run_options options;

static fracas_err note(void *context, size_t to, const fracas_packet *message)
{
    if (message->kind == FRACAS_PACKET_STOP) worker[to].stops++;
    if (message->kind == FRACAS_PACKET_FRESH) worker[to].fresh++;
    if (message->kind != FRACAS_PACKET_LEASE) return FRACAS_OK;
    fracas_lease lease;
    memcpy(&lease, message->body, message->size);
    const size_t i = worker[to].nleases++;
    worker[to].lease[i] = lease.id;
    worker[to].isolated[i] = lease.isolated;
    worker[to].count[i] = lease.count;
    return FRACAS_OK;
}

static void hear(size_t from, fracas_packet_kind kind, const void *body, size_t size)
{
    OWNED fracas_packet *message;
    OK(fracas_packet_create(kind, body, size, &message));
    fracas_director_receive(director, from, message);
}

static void ready(size_t from)
{
    hear(from, FRACAS_PACKET_READY, &campaign->hash, sizeof campaign->hash);
}

/* The `i`-th lease that it was given. */
static void computed(size_t from, size_t i)
{
    const fracas_lease_report report = {worker[from].lease[i], 1.0};
    hear(from, FRACAS_PACKET_COMPUTED, &report, sizeof report);
}

static void replaced(size_t from)
{
    const fracas_trouble trouble = {.code = FRACAS_ENVIRONMENT, .text = "a server died"};
    hear(from, FRACAS_PACKET_REPLACED, &trouble, sizeof trouble);
}

/* Three realizations, two for the first worker and one for the second. */
static int begin(void **state)
{
    memset(worker, 0, sizeof worker);
    campaign = read_text(plain_campaign);
    fracas_run_options_init(&options);
    fracas_channel_init(&channel);
    study = sample_folder();
    const fracas_director_setup setup = {.campaign = campaign,
                                         .options = &options,
                                         .study = study,
                                         .workers = 2,
                                         .send = note,
                                         .channel = &channel,
                                         .now = fracas_now};
    fracas_err result;
    OK(fracas_director_create(&setup, &director, &result));
    ready(0);
    ready(1);
    assert_int_equal(worker[0].nleases, 1);
    assert_int_equal(worker[1].nleases, 1);
    assert_int_equal(worker[0].count[0] + worker[1].count[0], 3);
    return 0;
}

static int end(void **state)
{
    fracas_director_destroy(director);
    fracas_campaign_destroy(campaign);
    sample_remove(study);
    return 0;
}

static void what_it_held_waits_and_is_isolated(void **state)
{
    replaced(1);
    assert_int_equal(worker[1].fresh, 1);
    assert_int_equal(worker[1].nleases, 1); /* nothing before it is ready */
    ready(1);
    assert_int_equal(worker[1].nleases, 2);
    assert_int_equal(worker[1].lease[1], worker[1].lease[0]);
    assert_int_equal(worker[1].isolated[0], 0);
    assert_int_not_equal(worker[1].isolated[1], 0);
    computed(1, 1);
    computed(0, 0);
    assert_int_equal(worker[0].stops + worker[1].stops, 0); /* not before everything is durable */
}

/* All is computed, nothing is durable; then one dies before it has written its segment. The other
 * one, which was not told to stop yet, computes that again. */
static void one_that_dies_at_the_end_costs_what_it_had(void **state)
{
    computed(0, 0);
    computed(1, 0);
    replaced(0);
    assert_int_equal(worker[1].nleases, 2);
    assert_int_equal(worker[1].count[1], worker[0].count[0]);
    ready(0);
    assert_int_equal(worker[0].nleases, 1);
    computed(1, 1);
    assert_int_equal(worker[0].stops + worker[1].stops, 0);
}

static void one_that_dies_while_a_run_drains_is_stopped(void **state)
{
    fracas_director_drain(director);
    assert_int_equal(worker[0].stops, 1);
    replaced(0);
    ready(0);
    assert_int_equal(worker[0].stops, 2);
    assert_int_equal(worker[0].nleases, 1);
}

/* The disk is full, and no event can be noted: the new server must hear all the same, for it is
 * about to be told to stop. */
static void one_that_dies_while_nothing_can_be_noted_is_stopped(void **state)
{
    fracas_index *index;
    OK(fracas_index_open(study, true, &index));
    OK(fracas_sql_script(index, "DROP TABLE event"));
    fracas_index_close(index);
    replaced(0);
    assert_int_equal(worker[0].fresh, 1);
    ready(0);
    assert_int_equal(worker[0].stops, 1);
}

/* A drained run whose last worker is lost has drained: the same command goes on, and nobody needs
 * to be told of trouble. */
static void one_that_is_lost_while_a_run_drains_is_no_trouble(void **state)
{
    const fracas_trouble trouble = {.code = FRACAS_ENVIRONMENT, .text = "a supervisor died"};
    fracas_director_drain(director);
    hear(0, FRACAS_PACKET_ENDED, NULL, 0);
    hear(1, FRACAS_PACKET_LOST, &trouble, sizeof trouble);
    assert_true(fracas_director_over(director));
    assert_int_equal(fracas_director_finish(director), FRACAS_INTERRUPTED);
}

/* A server asked for its segment has none where all that it told of was in one before: nobody waits
 * for another, and all are told to stop. */
static void a_server_without_a_segment_answers_too(void **state)
{
    computed(0, 0);
    computed(1, 0);
    assert_int_equal(worker[0].stops + worker[1].stops, 0);
    hear(0, FRACAS_PACKET_FLUSHED, NULL, 0);
    assert_int_equal(worker[0].stops + worker[1].stops, 0);
    hear(1, FRACAS_PACKET_FLUSHED, NULL, 0);
    assert_int_equal(worker[0].stops, 1);
    assert_int_equal(worker[1].stops, 1);
}

TESTS_EACH(begin, end, what_it_held_waits_and_is_isolated,
           one_that_dies_at_the_end_costs_what_it_had, one_that_dies_while_a_run_drains_is_stopped,
           one_that_dies_while_nothing_can_be_noted_is_stopped,
           one_that_is_lost_while_a_run_drains_is_no_trouble,
           a_server_without_a_segment_answers_too)
