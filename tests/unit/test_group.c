/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processes that meet to compute one body together. */
#include "campaigns/scheduler/worker/group.h"
#include "tests/support/test.h"

#include "campaigns/scheduler/types/clock.h"

#include <math.h>
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/* Sends its number and takes those of the others; false if they are wrong. */
static bool swap(const fracas_peers *peers)
{
    uint64_t own = 100 + peers->number, other[FRACAS_PEERS_MAX] = {0};
    fracas_parcel out[FRACAS_PEERS_MAX] = {{0}}, in[FRACAS_PEERS_MAX] = {{0}};
    for (size_t p = 0; p < peers->count; p++) {
        if (p == peers->number) continue;
        out[p] = (fracas_parcel){&own, sizeof own};
        in[p] = (fracas_parcel){&other[p], sizeof *other};
    }
    if (peers->exchange(peers->context, out, in)) return false;
    for (size_t p = 0; p < peers->count; p++)
        if (p != peers->number && other[p] != 100 + p) return false;
    return true;
}

/* A process that comes: 0 if all goes well, 1 if it cannot, 2 if it hears wrong things. */
static pid_t come(const fracas_meeting *meeting)
{
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid) return pid;
    for (int fd = STDERR_FILENO + 1; fd < 64; fd++) close(fd); /* the listener, too */
    FRACAS_CLEARED(fracas_group) group;
    size_t from = 0;
    fracas_group_init(&group);
    if (fracas_group_join(&group, meeting, &from)) _exit(1);
    _exit(from == 5 && swap(fracas_group_peers(&group)) ? 0 : 2);
}

static int status_of(pid_t pid)
{
    int status;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return WEXITSTATUS(status);
}

static void wait_for_all(fracas_group *group)
{
    for (int tries = 0; !fracas_group_has_come(group) && tries < 500; tries++) poll(NULL, 0, 10);
}

static void those_who_know_the_token_meet(void **unused)
{
    FRACAS_CLEARED(fracas_group) group;
    fracas_meeting meeting = {0};
    fracas_group_init(&group);
    assert_false(fracas_group_has_come(&group)); /* nobody can */
    OK(fracas_group_open(&group, FRACAS_PEERS_MAX, &meeting));
    fracas_meeting wrong = meeting;
    wrong.token[0]++;
    const pid_t stranger = come(&wrong);
    pid_t friend[3];
    for (int i = 0; i < 3; i++) friend[i] = come(&meeting);
    for (int tries = 0; group.count < 4 && tries < 500; tries++) wait_for_all(&group);
    wait_for_all(&group);
    assert_null(fracas_group_peers(&group));
    OK(fracas_group_start(&group, 5));
    assert_int_equal(fracas_group_peers(&group)->count, 4);
    assert_true(swap(fracas_group_peers(&group)));
    for (int i = 0; i < 3; i++) assert_int_equal(status_of(friend[i]), 0);
    assert_int_equal(status_of(stranger), 1);
    fracas_group_leave(&group);
    assert_null(fracas_group_peers(&group));
    assert_int_equal(status_of(come(&meeting)), 1); /* too late */
}

/* Those who have come are not needed. */
static void a_meeting_may_end_before_the_start(void **unused)
{
    FRACAS_CLEARED(fracas_group) group;
    fracas_meeting meeting = {0};
    fracas_group_init(&group);
    OK(fracas_group_open(&group, FRACAS_PEERS_MAX, &meeting));
    const pid_t one = come(&meeting);
    wait_for_all(&group);
    fracas_group_leave(&group);
    assert_int_equal(status_of(one), 1);
}

/* Connects to a meeting on this machine, and says nothing. */
static int connect_silently(const fracas_meeting *meeting)
{
    const struct sockaddr_in at = {.sin_family = AF_INET,
                                   .sin_port = htons((uint16_t)meeting->port),
                                   .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    assert_true(fd >= 0);
    assert_int_equal(connect(fd, (const struct sockaddr *)&at, sizeof at), 0);
    return fd;
}

/* They hold up those behind them a while, and the computation not at all. */
static void silent_strangers_hold_up_nobody(void **unused)
{
    FRACAS_CLEARED(fracas_group) group;
    fracas_meeting meeting = {0};
    fracas_group_init(&group);
    OK(fracas_group_open(&group, FRACAS_PEERS_MAX, &meeting));
    const int silent = connect_silently(&meeting), slow = connect_silently(&meeting);
    assert_int_equal(send(slow, "x", 1, 0), 1);
    const pid_t friend = come(&meeting);
    double longest = 0;
    for (int tries = 0; group.count < 2 && tries < 1000; tries++) {
        const double began = fracas_now();
        fracas_group_has_come(&group);
        longest = fmax(longest, fracas_now() - began);
        poll(NULL, 0, 10);
    }
    assert_int_equal(group.count, 2);
    assert_true(longest < 1);
    OK(fracas_group_start(&group, 5));
    assert_true(swap(fracas_group_peers(&group)));
    assert_int_equal(status_of(friend), 0);
    close(silent);
    close(slow);
}

/* A stranger has the port of a dead leading process, and makes helpers lead. */
static void a_stranger_does_not_lead(void **unused)
{
    FRACAS_CLEARED(fracas_group) group;
    fracas_meeting meeting = {0};
    fracas_group_init(&group);
    OK(fracas_group_open(&group, FRACAS_PEERS_MAX, &meeting));
    const pid_t one = come(&meeting);
    for (int tries = 0; group.count < 2 && tries < 500; tries++) wait_for_all(&group);
    group.token[1]++;
    OK(fracas_group_start(&group, 5));
    fracas_group_leave(&group);
    assert_int_equal(status_of(one), 1);
}

static void no_more_come_than_are_of_use(void **unused)
{
    FRACAS_CLEARED(fracas_group) group;
    fracas_meeting meeting = {0};
    fracas_group_init(&group);
    OK(fracas_group_open(&group, 2, &meeting));
    const pid_t one = come(&meeting), other = come(&meeting);
    for (int tries = 0; group.count < 2 && tries < 500; tries++) wait_for_all(&group);
    poll(NULL, 0, 50);
    wait_for_all(&group);
    OK(fracas_group_start(&group, 5));
    assert_int_equal(fracas_group_peers(&group)->count, 2);
    assert_true(swap(fracas_group_peers(&group)));
    assert_int_equal(status_of(one) + status_of(other), 1);
}

TESTS(those_who_know_the_token_meet, a_meeting_may_end_before_the_start,
      silent_strangers_hold_up_nobody, a_stranger_does_not_lead, no_more_come_than_are_of_use)
