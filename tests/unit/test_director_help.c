/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rank 0 sends idle workers of other hosts to help with the last leases. */
#include "tests/support/director.h"
#include "tests/support/test.h"

static void say_ready(size_t w, const char *host)
{
    const fracas_ready ready = {campaign->hash, fracas_hash_of(host, strlen(host))};
    hear(w, FRACAS_PACKET_READY, &ready, sizeof ready);
}

/* Worker 0 has the one realization, which leads; worker 1 is ready on a host. */
static void lead(const char *host)
{
    prepare("replicas: 1", "");
    begin(0);
    say_ready(0, "a");
    say_ready(1, host);
    assert_leases(1, 0);
    assert_int_equal(worker[0].lease[0].role, FRACAS_LEASE_LEADS);
}

static void meet(uint64_t lease)
{
    const fracas_meeting meeting = {.lease = lease, .port = 77};
    hear(0, FRACAS_PACKET_MEETING, &meeting, sizeof meeting);
}

static void say_helped(void)
{
    const fracas_trouble why = {.text = "to the end"};
    hear(1, FRACAS_PACKET_HELPED, &why, sizeof why);
}

static void an_idle_worker_of_another_host_helps_once(void **state)
{
    lead("b");
    meet(worker[0].lease[0].id + 1);
    assert_leases(1, 0);
    meet(worker[0].lease[0].id);
    assert_leases(1, 1);
    assert_int_equal(worker[1].lease[0].role, FRACAS_LEASE_HELPS);
    assert_int_equal(worker[1].lease[0].id, worker[0].lease[0].id);
    say_helped();
    assert_leases(1, 1);
    computed(0, 0, 1);
    segment(0, 0, 0, 1000);
    assert_stops(1, 1);
    for (size_t w = 0; w < WORKERS; w++) say_ended(w);
    assert_merged();
}

static void a_worker_of_the_same_host_does_not_help(void **state)
{
    lead("a");
    meet(worker[0].lease[0].id);
    assert_leases(1, 0);
}

/* Nobody listens on a machine that has all workers. */
static void nobody_leads_where_no_other_host_is(void **state)
{
    one_host = true;
    prepare("replicas: 1", "");
    begin(0);
    say_ready(0, "a");
    assert_int_equal(worker[0].lease[0].role, FRACAS_LEASE_ALONE);
    one_host = false;
}

static void nobody_leads_where_all_hosts_are_one(void **state)
{
    const fracas_trouble trouble = {.code = FRACAS_ENVIRONMENT, .text = "gone"};
    lead("a");
    hear(0, FRACAS_PACKET_REPLACED, &trouble, sizeof trouble);
    assert_int_equal(worker[1].lease[0].role, FRACAS_LEASE_ALONE);
}

/* The lease of a dead leader is the helper's own now; nobody helps any more. */
static void a_helper_takes_the_lease_of_a_leader_that_is_gone(void **state)
{
    const fracas_trouble trouble = {.code = FRACAS_ENVIRONMENT, .text = "gone"};
    lead("b");
    meet(worker[0].lease[0].id);
    hear(0, FRACAS_PACKET_LOST, &trouble, sizeof trouble);
    assert_leases(1, 2);
    assert_int_not_equal(worker[1].lease[1].role, FRACAS_LEASE_HELPS);
    say_helped();
    meet(worker[0].lease[0].id);
    assert_leases(1, 2);
}

TESTS_EACH(NULL, end, an_idle_worker_of_another_host_helps_once,
           a_worker_of_the_same_host_does_not_help, nobody_leads_where_no_other_host_is,
           nobody_leads_where_all_hosts_are_one, a_helper_takes_the_lease_of_a_leader_that_is_gone)
