/* Rank 0 without MPI: what it sends to workers while rounds wait to be decided. */
#include "tests/support/campaign_text.h"
#include "tests/support/study_fixture.h"

#include "campaigns/scheduler/director.h"

static struct {
    size_t nleases, flushes;
    uint64_t lease[16]; /* held, in the order given */
} worker[2];

static fracas_err note(void *context, size_t to, const fracas_packet *message)
{
    (void)context;
    if (message->kind == FRACAS_PACKET_FLUSH) worker[to].flushes++;
    if (message->kind != FRACAS_PACKET_LEASE) return FRACAS_OK;
    fracas_lease lease;
    memcpy(&lease, message->body, message->size);
    worker[to].lease[worker[to].nleases++] = lease.id;
    return FRACAS_OK;
}

static void hear(fracas_director *director, size_t from, fracas_packet_kind kind, const void *body, size_t size)
{
    fracas_packet *message;
    OK(fracas_packet_create(kind, body, size, &message));
    fracas_director_hear(director, from, message);
    free(message);
}

/* The worker has computed the lease that it was given as number `i`, so slowly that leases are one batch at most. */
static void computed(fracas_director *director, size_t from, size_t i)
{
    const fracas_lease_report report = {.lease = worker[from].lease[i], .seconds = 1e3};
    hear(director, from, FRACAS_PACKET_COMPUTED, &report, sizeof report);
}

static fracas_campaign *two_points(void)
{
    char *rule = replace(plain_campaign, "replicas: 3", "replicas: {minimum: 16, maximum: 64, until: {quantity: dissipated, "
                                                        "relative-half-width: 0.1}}");
    char *text = replace(rule, "", "sweep:\n  - loading.rate: [1e3, 1e4]\n");
    fracas_campaign *campaign = read_text(text);
    free(text);
    free(rule);
    return campaign;
}

/* Two points of 16 realizations each. When the second worker has nothing left to do, both are asked for what they have in memory, though
 * the first still computes: the round of the other point may be complete with it. */
static void nobody_waits_for_records_of_one_that_computes(void **state)
{
    (void)state;
    fracas_campaign *campaign = two_points();
    fracas_run_options options;
    fracas_run_options_init(&options);
    fracas_voice voice;
    fracas_voice_init(&voice);
    study = sample_folder();
    const fracas_director_setup setup = {.campaign = campaign, .options = &options, .study = study, .workers = 2, .send = note,
                                         .voice = &voice};
    fracas_director *director;
    fracas_err verdict;
    OK(fracas_director_create(&setup, &director, &verdict));
    for (size_t w = 0; w < 2; w++) hear(director, w, FRACAS_PACKET_READY, &campaign->hash, sizeof campaign->hash);
    assert_int_equal(worker[0].nleases, 2); /* the first took one ahead */
    assert_int_equal(worker[1].nleases, 1);
    computed(director, 0, 0);
    for (size_t i = 0; i < worker[1].nleases; i++) { /* the last ones are shared out: 8, 4, 2, 1, 1 */
        assert_int_equal(worker[0].flushes + worker[1].flushes, 0); /* everyone has something to do */
        computed(director, 1, i);
    }
    assert_int_equal(worker[1].nleases, 5);
    assert_int_equal(worker[0].nleases, 2); /* which is not computed yet */
    assert_int_equal(worker[0].flushes, 1);
    assert_int_equal(worker[1].flushes, 1);
    computed(director, 0, 1);
    assert_int_equal(worker[0].flushes, 1); /* once until its segment comes */
    fracas_director_destroy(director);
    fracas_campaign_destroy(campaign);
    sample_remove(study);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nobody_waits_for_records_of_one_that_computes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
