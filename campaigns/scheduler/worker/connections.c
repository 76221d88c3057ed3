/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/connections.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* Moves as much as goes now; false if the other end is gone. */
static bool move(int fd, bool send_it, fracas_parcel *left)
{
    while (left->size > 0) {
        const ssize_t n = send_it ? send(fd, left->bytes, left->size, MSG_DONTWAIT | MSG_NOSIGNAL)
                                  : recv(fd, left->bytes, left->size, MSG_DONTWAIT);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
        if (n <= 0) return false;
        left->bytes = (char *)left->bytes + n;
        left->size -= (size_t)n;
    }
    return true;
}

/* Events to wait for; 0: all is done. */
static size_t fill_polls(const fracas_connections *c, const fracas_parcel *out,
                         const fracas_parcel *in, struct pollfd *from)
{
    size_t waits = 0;
    for (size_t p = 0; p < c->count; p++) {
        const bool busy = p != c->number && (out[p].size > 0 || in[p].size > 0);
        from[p] = (struct pollfd){
            .fd = busy || (p == 0 && c->number) ? c->fd[p] : -1,
            .events = (short)((out[p].size ? POLLOUT : 0) | (in[p].size ? POLLIN : 0) | POLLRDHUP)};
        waits += busy;
    }
    return waits;
}

static fracas_err gone(const fracas_connections *c, size_t peer)
{
    return fracas_fail(FRACAS_ENVIRONMENT, "process %zu of %zu for one body is gone", peer,
                       c->count);
}

/* A peer may leave when all of its bytes have been taken, but the leading one. */
static fracas_err check_end(const fracas_connections *c, const fracas_parcel *in, size_t peer,
                            short events)
{
    const bool ended = events & (POLLRDHUP | POLLHUP | POLLERR | POLLNVAL);
    return ended && !(events & POLLIN) && (in[peer].size > 0 || peer == 0) ? gone(c, peer)
                                                                           : FRACAS_OK;
}

fracas_err fracas_connections_exchange(void *context, const fracas_parcel *out,
                                       const fracas_parcel *in)
{
    const fracas_connections *c = context;
    fracas_parcel send_left[FRACAS_PEERS_MAX], receive_left[FRACAS_PEERS_MAX];
    struct pollfd from[FRACAS_PEERS_MAX] = {{0}};
    memcpy(send_left, out, c->count * sizeof *out);
    memcpy(receive_left, in, c->count * sizeof *in);
    for (;;) {
        for (size_t p = 0; p < c->count; p++)
            if (p != c->number &&
                (!move(c->fd[p], true, &send_left[p]) || !move(c->fd[p], false, &receive_left[p])))
                return gone(c, p);
        if (!fill_polls(c, send_left, receive_left, from)) return FRACAS_OK;
        const int ready = poll(from, c->count, c->number ? -1 : FRACAS_PEERS_PATIENCE * 1000);
        if (ready < 0 && errno != EINTR)
            return fracas_fail_system(errno, "processes for one body cannot wait");
        if (ready == 0)
            return fracas_fail(FRACAS_ENVIRONMENT,
                               "the other processes for one body have been silent for %d s",
                               FRACAS_PEERS_PATIENCE);
        for (size_t p = 0; p < c->count && ready > 0; p++)
            TRY(check_end(c, receive_left, p, from[p].revents));
    }
}

void fracas_connections_close(fracas_connections *c)
{
    for (size_t p = 0; p < c->count; p++)
        if (c->fd[p] >= 0) close(c->fd[p]);
    c->count = 0;
}
