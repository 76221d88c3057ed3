/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/transport.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* A message travels in parts, each a datagram of its own: inboxes keep the order of each sender,
 * while parts of several senders come in between. */
enum { PART = 16384 }; /* bytes, of which a socket takes several */

typedef struct {
    uint32_t from; /* rank */
    uint32_t size; /* bytes of the whole message */
} heading;

struct fracas_letter {
    fracas_letter *next;
    int to;
    size_t size, sent; /* bytes */
    unsigned char bytes[];
};

struct fracas_sockets {
    int size;
    struct {
        int inbox, into; /* its two ends; -1: closed */
        bool full;       /* takes no more at present */
        fracas_packet *message;
        size_t received; /* bytes of `message`, which comes from this rank */
    } rank[];
};

/* ---- where the ranks are forked ---- */

fracas_err fracas_sockets_create(int size, fracas_sockets **sockets)
{
    OWN(fracas_sockets) s = calloc(1, sizeof *s + (size_t)size * sizeof s->rank[0]);
    if (!s) return fracas_no_memory("the sockets of the ranks");
    for (; s->size < size; s->size++) {
        int pair[2];
        if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, pair))
            return fracas_fail_system(errno, "no sockets for the ranks");
        s->rank[s->size].inbox = pair[0];
        s->rank[s->size].into = pair[1];
    }
    *sockets = s;
    s = NULL;
    return FRACAS_OK;
}

void fracas_sockets_destroy(fracas_sockets *sockets)
{
    for (int r = 0; sockets && r < sockets->size; r++) {
        if (sockets->rank[r].inbox >= 0) close(sockets->rank[r].inbox);
        close(sockets->rank[r].into);
        free(sockets->rank[r].message);
    }
    free(sockets);
}

/* ---- the transport ---- */

static void open_box(fracas_mailbox *box)
{
    (void)box; /* the other ranks are there, or their inboxes */
}

static int stranger(fracas_mailbox *box, const fracas_whereabouts *mine)
{
    (void)box, (void)mine;
    return -1; /* all are copies of one process */
}

static void close_box(fracas_mailbox *box)
{
    while (box->outbox) {
        fracas_letter *letter = box->outbox;
        box->outbox = letter->next;
        free(letter);
    }
    fracas_sockets_destroy(box->sockets);
}

/* The starter ends the others. */
static void abort_all(const fracas_mailbox *box)
{
    fprintf(stderr, "fracas: rank %d: %s\n", box->rank, fracas_message());
    _exit(FRACAS_ENVIRONMENT);
}

/* As much of the letter as its inbox takes now. */
static fracas_err send_parts(fracas_mailbox *box, fracas_letter *letter)
{
    const int into = box->sockets->rank[letter->to].into;
    bool *full = &box->sockets->rank[letter->to].full;
    while (!*full && letter->sent < letter->size) {
        heading head = {(uint32_t)box->rank, (uint32_t)letter->size};
        const size_t left = letter->size - letter->sent, part = left < PART ? left : PART;
        struct iovec body[] = {{&head, sizeof head}, {letter->bytes + letter->sent, part}};
        const struct msghdr message = {.msg_iov = body, .msg_iovlen = 2};
        if (sendmsg(into, &message, MSG_NOSIGNAL) >= 0) letter->sent += part;
        else if (errno == EAGAIN) *full = true;
        else if (errno == EPIPE || errno == ECONNRESET)
            letter->sent = letter->size; /* it has ended: the starter knows if the run has, too */
        else if (errno != EINTR)
            return fracas_fail(FRACAS_ENVIRONMENT,
                               "this process cannot send a message to rank %d: %s", letter->to,
                               strerror(errno));
    }
    return FRACAS_OK;
}

static fracas_err clear(fracas_mailbox *box)
{
    for (int r = 0; r < box->size; r++) box->sockets->rank[r].full = false;
    for (fracas_letter **at = &box->outbox; *at;) {
        fracas_letter *letter = *at;
        TRY(send_parts(box, letter));
        if (letter->sent < letter->size) {
            at = &letter->next;
            continue;
        }
        *at = letter->next;
        free(letter);
    }
    return FRACAS_OK;
}

static fracas_err post(fracas_mailbox *box, int to, const fracas_packet *message)
{
    const size_t size = fracas_packet_bytes(message);
    fracas_letter *letter = malloc(sizeof *letter + size), **last = &box->outbox;
    if (!letter) return fracas_no_memory("a message");
    *letter = (fracas_letter){.to = to, .size = size};
    memcpy(letter->bytes, message, size);
    while (*last) last = &(*last)->next;
    *last = letter;
    return clear(box);
}

static fracas_err receive(fracas_mailbox *box, int *from, fracas_packet **message)
{
    fracas_sockets *s = box->sockets;
    unsigned char part[PART];
    *message = NULL;
    for (;;) {
        heading head;
        struct iovec body[] = {{&head, sizeof head}, {part, sizeof part}};
        struct msghdr come = {.msg_iov = body, .msg_iovlen = 2};
        const ssize_t n = recvmsg(s->rank[box->rank].inbox, &come, 0);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && errno == EAGAIN) return FRACAS_OK;
        if (n < (ssize_t)sizeof head)
            return fracas_fail(FRACAS_ENVIRONMENT,
                               "this process cannot receive a message of another rank: %s",
                               strerror(errno));
        const size_t size = (size_t)n - sizeof head;
        fracas_packet **whole = &s->rank[head.from].message;
        size_t *received = &s->rank[head.from].received;
        if (!*whole) *whole = malloc(head.size);
        if (!*whole) return fracas_no_memory("a message");
        memcpy((unsigned char *)*whole + *received, part, size);
        *received += size;
        if (*received < head.size) continue;
        *from = (int)head.from;
        *message = *whole;
        *whole = NULL;
        *received = 0;
        return FRACAS_OK;
    }
}

static void wait_for_any(fracas_mailbox *box, int fd, int most)
{
    const fracas_sockets *s = box->sockets;
    struct pollfd from[] = {{.fd = s->rank[box->rank].inbox, .events = POLLIN},
                            {.fd = fd, .events = POLLIN},
                            {.fd = -1, .events = POLLOUT}};
    if (box->outbox) from[2].fd = s->rank[box->outbox->to].into;
    poll(from, 3, most);
}

static const fracas_transport fracas_transport_local = {
    open_box, stranger, close_box, abort_all, post, clear, receive, wait_for_any,
};

void fracas_sockets_take(fracas_sockets *sockets, int rank, fracas_mailbox *box)
{
    for (int r = 0; r < sockets->size; r++) {
        if (r == rank) continue;
        close(sockets->rank[r].inbox);
        sockets->rank[r].inbox = -1;
    }
    *box = (fracas_mailbox){.transport = &fracas_transport_local,
                            .rank = rank,
                            .size = sockets->size,
                            .sockets = sockets};
}
