/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The network between the processes of leases: TCP as they use it. It can be cut for a while or for
 * ever, and strangers come to whoever listens. */
#include "tests/simulator/calls.h"
#include "tests/simulator/descriptors.h"
#include "tests/simulator/farm.h"

#include <arpa/inet.h>
#include <errno.h>
#include <math.h>
#include <netdb.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/time.h>

enum { MOST_WAITING = 64, FIRST_PORT = 2000, NPORTS = 60000, TCP_BYTES = 128 << 10 };

struct listener {
    listener *next;
    int port;
    process *owner;
    channel *waiting[MOST_WAITING];
    size_t count;
};

static listener *listening;
static int ports;

static bool is_cut(const process *p)
{
    return p && world.now < p->cut_until;
}

bool network_is_cut(const channel *side)
{
    return is_cut(side->end) || is_cut(side->peer->end);
}

static listener *find(uint64_t port)
{
    listener *l = listening;
    while (l && l->port != (int)port) l = l->next;
    return l;
}

const process *network_listener(uint64_t port)
{
    const listener *l = find(port);
    return l ? l->owner : NULL;
}

void network_shut(listener *at)
{
    listener **l = &listening;
    while (*l != at) l = &(*l)->next;
    *l = at->next;
    for (size_t i = 0; i < at->count; i++) channel_close(at->waiting[i]);
    free(at);
}

/* ---- cuts ---- */

static bool found;

static void note_connection(channel *side)
{
    found |= side->end != NULL;
}

bool network_has(const process *p)
{
    found = false;
    descriptor_each(p, note_connection);
    return found;
}

static void wake_both(channel *side)
{
    if (!side->end) return;
    channel_wake(side);
    channel_wake(side->peer);
}

static void heal(void *what, uint64_t number)
{
    (void)number;
    descriptor_each(what, wake_both);
}

static void break_both(channel *side)
{
    if (!side->end) return;
    side->broken = side->peer->broken = true;
    wake_both(side);
}

/* Nothing was heard for too long. */
static void give_up(void *what, uint64_t number)
{
    const process *p = what;
    (void)number;
    if (p->alive && is_cut(p)) descriptor_each(p, break_both);
}

void network_cut(process *p, double until)
{
    p->cut_until = until;
    world_at(until, heal, p, 0);
    /* Keepalive notices what is idle; messages are sent again for a quarter of an hour. */
    world_at(world.now + (chance(DICE_NET, 0.5) ? 60 + 10 * roll(DICE_NET) : 900), give_up, p, 0);
}

/* ---- listening ---- */

int __wrap_socket(int domain, int type, int protocol)
{
    (void)domain, (void)type, (void)protocol;
    call("socket");
    return descriptor_new((descriptor){.socket = true});
}

int __wrap_bind(int fd, const struct sockaddr *address, socklen_t size)
{
    (void)fd, (void)address, (void)size;
    return 0;
}

static void add_waiting(listener *l, channel *side)
{
    if (l->count < MOST_WAITING) l->waiting[l->count++] = side;
    else channel_close(side);
}

/* Says nothing, too little or nonsense, and stays or goes. */
static void stranger_comes(void *what, uint64_t port)
{
    static const char nonsense[400] = "GET / HTTP/1.1\r\nHost: farm\r\n\r\n";
    static const size_t length[] = {0, 10, sizeof nonsense};
    listener *l = find(port);
    channel *side[2];
    (void)what;
    if (!l) return;
    channel_pair(side, TCP_BYTES);
    side[1]->stranger = true;
    side[0]->end = l->owner;
    channel_fill(side[0], nonsense, length[roll_below(DICE_NET, 3)]);
    if (chance(DICE_NET, 0.5)) channel_close(side[1]);
    add_waiting(l, side[0]);
}

int __wrap_listen(int fd, int backlog)
{
    descriptor *d = descriptor_of(fd);
    listener *l = calloc(1, sizeof *l);
    (void)backlog;
    if (!l) abort();
    do ports = (ports + 1) % NPORTS;
    while (find((uint64_t)(FIRST_PORT + ports)));
    *l = (listener){listening, FIRST_PORT + ports, world.current, {NULL}, 0};
    listening = l;
    *d = (descriptor){.owner = d->owner, .next = d->next, .listener = l};
    if (chance(DICE_NET, 0.05))
        for (uint64_t n = 1 + roll_below(DICE_NET, 4); n > 0; n--)
            world_at(world.now + 2 * roll(DICE_NET), stranger_comes, NULL, (uint64_t)l->port);
    return 0;
}

int __wrap_getsockname(int fd, struct sockaddr *address, socklen_t *size)
{
    struct sockaddr_in at = {.sin_family = AF_INET};
    at.sin_port = htons((uint16_t)descriptor_of(fd)->listener->port);
    memcpy(address, &at, *size);
    return 0;
}

int __wrap_accept4(int fd, struct sockaddr *address, socklen_t *size, int flags)
{
    listener *l = descriptor_of(fd)->listener;
    (void)address, (void)size, (void)flags;
    call("accept");
    errno = EAGAIN;
    if (!l->count) return -1;
    channel *side = l->waiting[0];
    memmove(l->waiting, l->waiting + 1, --l->count * sizeof(channel *));
    return descriptor_new((descriptor){.channel = side});
}

/* ---- connecting ---- */

int __wrap_getaddrinfo(const char *host, const char *port, const struct addrinfo *kind,
                       struct addrinfo **to)
{
    struct {
        struct addrinfo info;
        struct sockaddr_in at;
    } *made = calloc(1, sizeof *made);
    (void)kind;
    if (!made) abort();
    call("getaddrinfo");
    if (chance(DICE_NET, 0.01)) return EAI_AGAIN;
    int number = farm_host(world.current);
    if (strcmp(host, "127.0.0.1") && sscanf(host, "farm-%d", &number) != 1) return EAI_NONAME;
    made->at.sin_family = AF_INET;
    made->at.sin_addr.s_addr = (uint32_t)number;
    made->at.sin_port = htons((uint16_t)atoi(port));
    made->info.ai_addr = (struct sockaddr *)&made->at;
    made->info.ai_addrlen = sizeof made->at;
    *to = &made->info;
    return 0;
}

void __wrap_freeaddrinfo(struct addrinfo *info)
{
    free(info);
}

int __wrap_connect(int fd, const struct sockaddr *address, socklen_t size)
{
    struct sockaddr_in at;
    channel *side[2];
    memcpy(&at, address, size);
    call("connect");
    process_sleep(world.now + 1e-3 * roll(DICE_NET));
    process_sleep(fmin(world.current->cut_until, world.now + 130));
    errno = ETIMEDOUT;
    if (is_cut(world.current)) return -1;
    listener *l = find(ntohs(at.sin_port));
    errno = ECONNREFUSED;
    if (!l || farm_host(l->owner) != (int)at.sin_addr.s_addr) return -1;
    channel_pair(side, TCP_BYTES);
    side[0]->end = world.current;
    side[1]->end = l->owner;
    add_waiting(l, side[1]);
    descriptor *d = descriptor_of(fd);
    *d = (descriptor){.owner = d->owner, .next = d->next, .channel = side[0]};
    return 0;
}

/* ---- bytes ---- */

int __wrap_setsockopt(int fd, int level, int name, const void *value, socklen_t size)
{
    descriptor *d = descriptor_of(fd);
    struct timeval patience;
    if (level != SOL_SOCKET || name != SO_RCVTIMEO || size != sizeof patience) return 0;
    memcpy(&patience, value, sizeof patience);
    d->channel->patience = (double)patience.tv_sec;
    return 0;
}

ssize_t __wrap_send(int fd, const void *from, size_t size, int flags)
{
    call("send");
    channel *side = descriptor_of(fd)->channel;
    for (side->writer = world.current;; process_wait(INFINITY)) {
        const ssize_t sent = channel_send(side, from, size);
        if (sent >= 0 || errno != EAGAIN || flags & MSG_DONTWAIT) return sent;
    }
}

ssize_t __wrap_recv(int fd, void *to, size_t size, int flags)
{
    call("recv");
    channel *side = descriptor_of(fd)->channel;
    const double end = side->patience > 0 ? world.now + side->patience : INFINITY;
    const size_t least = flags & MSG_WAITALL ? size : 1;
    for (side->reader = world.current; channel_readable(side) < least; process_wait(end)) {
        if (channel_is_gone(side)) break;
        if (!(flags & MSG_DONTWAIT) && world.now < end) continue;
        errno = EAGAIN;
        if (!channel_readable(side)) return -1;
        break;
    }
    if (!(flags & MSG_PEEK)) return (ssize_t)channel_take(side, to, size);
    const size_t there = channel_readable(side);
    if (size > there) size = there;
    memcpy(to, side->bytes, size);
    return (ssize_t)size;
}

ssize_t __wrap_getrandom(void *to, size_t size, unsigned flags)
{
    unsigned char *byte = to;
    (void)flags;
    for (size_t i = 0; i < size; i++) byte[i] = (unsigned char)roll_below(DICE_NET, 256);
    return (ssize_t)size;
}
