/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rank's end of the connection to its compute server. */
#include "campaigns/scheduler/worker/link.h"
#include "tests/support/test.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

static bool has_come(int fd)
{
    struct pollfd from = {.fd = fd, .events = POLLIN};
    return poll(&from, 1, 0) == 1;
}

/* Two servers died before rank 0 heard of the first: its answer to that one lets nothing through
 * that is for the second. */
static void a_server_hears_nothing_that_is_for_one_before_it(void **state)
{
    const fracas_packet fresh = {.kind = FRACAS_PACKET_FRESH},
                        flush = {.kind = FRACAS_PACKET_FLUSH};
    int pair[2];
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
    fracas_link link = {.supervisor = {.control = -1, .server = pair[0]}, .unacknowledged = 2};
    fracas_link_send(&link, &flush);
    fracas_link_send(&link, &fresh);
    fracas_link_send(&link, &flush);
    assert_false(has_come(pair[1]));
    fracas_link_send(&link, &fresh);
    assert_false(has_come(pair[1])); /* FRESH itself is for the rank */
    fracas_link_send(&link, &flush);
    assert_true(has_come(pair[1]));
    close(pair[0]);
    close(pair[1]);
}

/* Half a message, or none, and a server that waits for it would be a run without end. */
static void a_server_ends_that_a_message_cannot_be_sent_to(void **state)
{
    const fracas_packet flush = {.kind = FRACAS_PACKET_FLUSH};
    char bytes[4096];
    int pair[2];
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, pair), 0);
    while (write(pair[0], bytes, sizeof bytes) > 0)
        ;
    fracas_link link = {.supervisor = {.control = -1, .server = pair[0]}};
    fracas_link_send(&link, &flush);
    fracas_link_send(&(fracas_link){.supervisor = {.control = -1, .server = -1}},
                     &flush); /* no server */
    ssize_t n;
    while ((n = read(pair[1], bytes, sizeof bytes)) > 0)
        ;
    assert_int_equal(n, 0); /* the end of the stream */
    close(pair[0]);
    close(pair[1]);
}

TESTS(a_server_hears_nothing_that_is_for_one_before_it,
      a_server_ends_that_a_message_cannot_be_sent_to)
