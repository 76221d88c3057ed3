/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between a rank, its compute server and the process of a lease: those that do not fit,
 * and those that are cut off. */
#include "base/param.h"
#include "campaigns/scheduler/types/packet.h"
#include "campaigns/scheduler/worker/child.h"
#include "campaigns/scheduler/worker/server.h"
#include "tests/support/test.h"

#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>

static void a_message_is_whole_or_none(void **state)
{
    static const char body[] = "a body";
    OWNED fracas_packet *sent = NULL;
    FAILS(fracas_packet_create(FRACAS_PACKET_RECORD, NULL, INT32_MAX, &sent), FRACAS_ENVIRONMENT,
          "a message of 2147483647 bytes", "--segment-size");
    OK(fracas_packet_create(FRACAS_PACKET_RECORD, body, sizeof body, &sent));
    for (size_t cut = 0; cut <= fracas_packet_bytes(sent); cut++) {
        OWNED fracas_packet *got = NULL;
        int fd[2];
        assert_int_equal(pipe(fd), 0);
        assert_int_equal(write(fd[1], sent, cut), (ssize_t)cut);
        close(fd[1]);
        OK(fracas_packet_read(fd[0], &got));
        assert_int_equal(got != NULL, cut == fracas_packet_bytes(sent));
        if (got) assert_memory_equal(got, sent, cut);
        close(fd[0]);
    }
}

/* ---- the process of a lease ---- */

/* A lease of `count` realizations whose process sleeps. */
static int begin_child(fracas_child *child, uint64_t count)
{
    int fd[2];
    assert_int_equal(pipe(fd), 0);
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0)
        for (;;) pause();
    *child = (fracas_child){.pid = pid,
                            .fd = fd[0],
                            .errors = -1,
                            .width = 8,
                            .record = zeroed(count, sizeof(fracas_packet *)),
                            .lease.count = count};
    return fd[1];
}

/* A process that sends them is killed, and its lease fails. */
static void wrong_messages_end_the_process_of_a_lease(void **state)
{
    static const struct {
        fracas_packet_kind kind;
        size_t size, records; /* sent before it */
        const char *reason;
    } wrong[] = {
        {FRACAS_PACKET_FAULT, 4, 0, "sent a message of kind"},
        {FRACAS_PACKET_FAULT, 4, 1, "sent a message of kind"},
        {FRACAS_PACKET_FLUSH, 0, 0, "sent a message of kind"},
        {FRACAS_PACKET_RECORD, 4, 2, "sent a message of kind"}, /* one too many */
    };
    for (size_t i = 0; i < FRACAS_COUNT(wrong); i++) {
        fracas_child child;
        fracas_lease_failure failure;
        bool ended, good;
        const int fd = begin_child(&child, 2);
        for (size_t r = 0; r < wrong[i].records; r++)
            OK(fracas_packet_send(fd, FRACAS_PACKET_RECORD, "any", 4));
        OK(fracas_packet_send(fd, wrong[i].kind, "any", wrong[i].size));
        OK(fracas_child_receive(&child, &ended));
        assert_false(ended);
        close(fd);
        OK(fracas_child_receive(&child, &ended));
        assert_true(ended);
        OK(fracas_child_collect(&child, &good, &failure));
        assert_false(good);
        assert_has(failure.reason, wrong[i].reason);
        assert_int_equal(failure.kept, wrong[i].records == 2 ? 1 : wrong[i].records);
        assert_int_equal(failure.kept + failure.count, 2);
        fracas_child_clear(&child);
    }
}

/* One that is killed after its last record, and one that is not waited for. */
static void a_process_that_ends_badly_is_doubted(void **state)
{
    fracas_child child;
    fracas_lease_failure failure;
    bool ended, good;
    int fd = begin_child(&child, 1);
    OK(fracas_packet_send(fd, FRACAS_PACKET_RECORD, "any", 4));
    OK(fracas_child_receive(&child, &ended));
    kill(child.pid, SIGKILL);
    OK(fracas_child_collect(&child, &good, &failure));
    assert_false(good);
    assert_int_equal(failure.kept, 0);
    assert_int_equal(failure.count, 1);
    assert_has(failure.reason, "died of signal 9");
    close(fd);
    fracas_child_clear(&child);
    fd = begin_child(&child, 1);
    const pid_t pid = child.pid;
    fracas_child_clear(&child);
    assert_int_equal(kill(pid, 0), -1);
    close(fd);
}

/* ---- the server ---- */

static fracas_campaign campaign;
static fracas_run_options options;

/* Sends one message after READY; the answer, freed by the caller. */
static fracas_packet *answer_of_server(fracas_packet_kind kind, const void *body, size_t size)
{
    int pair[2], status;
    fracas_packet *ready, *answer;
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) {
        close(pair[0]);
        fracas_server_run(&campaign, &options, "none", pair[1]);
    }
    close(pair[1]);
    OK(fracas_packet_read(pair[0], &ready));
    assert_int_equal(ready->kind, FRACAS_PACKET_READY);
    free(ready);
    OK(fracas_packet_send(pair[0], kind, body, size));
    OK(fracas_packet_read(pair[0], &answer));
    close(pair[0]);
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_int_equal(status, 0);
    return answer;
}

static void a_server_ends_at_a_message_that_does_not_fit(void **state)
{
    static const fracas_lease none = {.count = 0}, two = {.count = 2}, many = {.count = 1u << 30};
    const size_t head = offsetof(fracas_lease, replica);
    OWNED void *long_one = zeroed(1, sizeof many + 8);
    const struct {
        fracas_packet_kind kind;
        const void *body;
        size_t size;
        const char *said;
    } wrong[] = {
        {99, NULL, 0, "a compute server got a message of kind 99"},
        {FRACAS_PACKET_STOP, &none, 2, "has 2 bytes, it must have 4"},
        {FRACAS_PACKET_LEASE, &two, head, "a lease of 48 bytes"},
        {FRACAS_PACKET_LEASE, &two, head + 8, "a lease of 56 bytes"},
        {FRACAS_PACKET_LEASE, &none, head + 8, "a lease of 56 bytes"},
        {FRACAS_PACKET_LEASE, &many, sizeof many, "a lease of 32816 bytes"},
        {FRACAS_PACKET_LEASE, long_one, sizeof many + 8, "a lease of 32824 bytes"},
    };
    fracas_run_options_init(&options);
    for (size_t i = 0; i < FRACAS_COUNT(wrong); i++) {
        OWNED fracas_packet *answer = answer_of_server(wrong[i].kind, wrong[i].body, wrong[i].size);
        assert_int_equal(answer->kind, FRACAS_PACKET_TROUBLE);
        fracas_trouble trouble;
        OK(fracas_packet_body(answer, &trouble, sizeof trouble));
        assert_int_equal(trouble.code, FRACAS_BUG);
        assert_has(trouble.text, wrong[i].said);
    }
    OWNED fracas_packet *answer = answer_of_server(FRACAS_PACKET_FLUSH, NULL, 0);
    assert_int_equal(answer->kind, FRACAS_PACKET_FLUSHED); /* nothing is in its memory */
}

TESTS(a_message_is_whole_or_none, wrong_messages_end_the_process_of_a_lease,
      a_process_that_ends_badly_is_doubted, a_server_ends_at_a_message_that_does_not_fit)
