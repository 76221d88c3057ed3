/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mailboxes of local ranks, each a process. */
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/transport.h"
#include "tests/support/test.h"

#include <sys/wait.h>
#include <unistd.h>

enum { RANKS = 4, MESSAGES = 40, LONG = 700000 /* bytes: more than a socket takes */ };

#define must(is)                                                                               \
    do {                                                                                       \
        if (!(is)) fprintf(stderr, "%d: %s: %s\n", __LINE__, #is, fracas_message()), _exit(1); \
    } while (0)

/* Each of the ranks does its work in a process. */
static void with_ranks(int size, void (*work)(fracas_mailbox *box))
{
    fracas_sockets *sockets;
    OK(fracas_sockets_create(size, &sockets));
    fflush(NULL);
    for (int r = 0; r < size; r++) {
        const pid_t pid = fork();
        assert_true(pid >= 0);
        if (pid > 0) continue;
        fracas_mailbox box;
        fracas_sockets_take(sockets, r, &box);
        fracas_mailbox_open(&box);
        work(&box);
        fracas_mailbox_close(&box);
        _exit(0);
    }
    fracas_sockets_destroy(sockets);
    for (int r = 0; r < size; r++) {
        int status;
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
    }
}

/* Bytes of the body of message n from one rank to another. */
static size_t size_of(int from, int to, int n)
{
    uint64_t state = (uint64_t)(1000 * from + 100 * to + n);
    const double share = random_share(&state);
    return n % 10 == 9 ? LONG : n % 3 == 0 ? 0 : (size_t)(40000 * share * share);
}

static void post(fracas_mailbox *box, int to, int n)
{
    OWNED fracas_packet *message = NULL;
    const size_t size = size_of(box->rank, to, n);
    must(!fracas_packet_create((fracas_packet_kind)(n + 1), NULL, size, &message));
    memset(message->body, box->rank + n, size);
    must(!fracas_mailbox_post(box, to, message));
}

static void check(const fracas_mailbox *box, int from, int n, const fracas_packet *message)
{
    must(message->kind == (uint32_t)n + 1);
    must(message->size == size_of(from, box->rank, n));
    for (size_t i = 0; i < message->size; i++) must(message->body[i] == (unsigned char)(from + n));
}

/* The next message, which comes within some seconds. */
static fracas_packet *next(fracas_mailbox *box, int *from)
{
    fracas_packet *message = NULL;
    for (int waits = 0; !message; waits++) {
        must(waits < 10000);
        must(!fracas_mailbox_clear(box));
        must(!fracas_mailbox_receive(box, from, &message));
        if (!message) fracas_mailbox_wait(box, -1, 1000);
    }
    return message;
}

static void send_all(fracas_mailbox *box)
{
    const double began = fracas_now();
    while (box->outbox) {
        must(fracas_now() - began < 30); /* a wait ends when more can be sent */
        fracas_mailbox_wait(box, -1, 1000);
        must(!fracas_mailbox_clear(box));
    }
}

static void all_to_all(fracas_mailbox *box)
{
    int come[RANKS] = {0};
    must(box->size == RANKS);
    for (int n = 0; n < MESSAGES; n++)
        for (int to = 0; to < RANKS; to++) post(box, to, n);
    for (int left = RANKS * MESSAGES; left > 0; left--) {
        int from;
        OWNED fracas_packet *message = next(box, &from);
        check(box, from, come[from]++, message);
    }
    send_all(box);
}

static void messages_of_all_ranks_come_whole_and_in_order(void **state)
{
    with_ranks(RANKS, all_to_all);
}

static int told[2]; /* a pipe */

/* Rank 1 reads nothing until rank 2 has a message of rank 0, posted later than all those to rank 1.
 */
static void one_hangs(fracas_mailbox *box)
{
    enum { MANY = 20 };
    int from;
    char byte;
    if (box->rank == 0) {
        for (int n = 0; n < MANY; n++) post(box, 1, 9);
        must(box->outbox);
        post(box, 2, 1);
        send_all(box);
    } else if (box->rank == 1) {
        must(read(told[0], &byte, 1) == 1);
        for (int n = 0; n < MANY; n++) free(next(box, &from));
    } else {
        OWNED fracas_packet *message = next(box, &from);
        check(box, 0, 1, message);
        must(write(told[1], "", 1) == 1);
    }
}

static void a_rank_that_hangs_does_not_hold_up_another(void **state)
{
    assert_int_equal(pipe(told), 0);
    with_ranks(3, one_hangs);
    close(told[0]);
    close(told[1]);
}

/* The starter ends a run whose rank has died: until then the others have nothing to report. */
static void one_ends(fracas_mailbox *box)
{
    if (box->rank == 1) return;
    for (int n = 0; n < 20; n++) post(box, 1, 9);
    send_all(box);
}

static void a_message_to_a_rank_that_has_ended_is_no_error(void **state)
{
    with_ranks(2, one_ends);
}

static void wait_for_what_comes(fracas_mailbox *box)
{
    const double began = fracas_now();
    fracas_mailbox_wait(box, -1, 20);
    must(fracas_now() - began > 0.019);
    must(write(told[1], "", 1) == 1);
    fracas_mailbox_wait(box, told[0], 1000000);
    post(box, 0, 1);
    fracas_mailbox_wait(box, -1, 1000000);
    int from;
    OWNED fracas_packet *message = next(box, &from);
    check(box, 0, 1, message);
}

static void a_wait_ends_with_whatever_comes_first(void **state)
{
    assert_int_equal(pipe(told), 0);
    with_ranks(1, wait_for_what_comes);
    close(told[0]);
    close(told[1]);
}

TESTS(messages_of_all_ranks_come_whole_and_in_order, a_rank_that_hangs_does_not_hold_up_another,
      a_message_to_a_rank_that_has_ended_is_no_error, a_wait_ends_with_whatever_comes_first)
