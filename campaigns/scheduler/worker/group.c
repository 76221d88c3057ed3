/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/group.h"

#include "base/param.h"
#include "campaigns/scheduler/types/clock.h"

#include <errno.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/time.h>

/* Time for others from the opening to the start: the first one's, and as much of it again; for one
 * who has connected to tell the token; for the others to meet; s. */
static const double AGAIN = 1, LEAST = 0.3, GUEST = 1, MEETING = 5;

/* The first message of a connection: who comes. */
typedef struct {
    uint64_t token, number; /* the first token; 0: not known yet */
    fracas_address address;
} hello;

/* The answer, at the start: everyone's place. */
typedef struct {
    uint64_t token, count, number, from; /* the second token: no stranger leads */
    fracas_address address[FRACAS_PEERS_MAX];
} roster;

void fracas_group_init(fracas_group *group)
{
    *group = (fracas_group){.listener = -1, .guest = -1};
}

/* ---- sockets ---- */

static fracas_err failed(const char *what)
{
    return fracas_fail_system(errno, "a process for one body cannot %s", what);
}

/* Steps exchange short messages: none waits for the next. A host that is gone is noticed. */
static void set_up(int fd)
{
    const int on = 1, idle = 30, apart = 10, probes = 3;
    const struct timeval patience = {.tv_sec = 5};
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    setsockopt(fd, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPIDLE, &idle, sizeof idle);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPINTVL, &apart, sizeof apart);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPCNT, &probes, sizeof probes);
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
}

static void own_host(char host[FRACAS_MEETING_HOST])
{
    if (gethostname(host, FRACAS_MEETING_HOST - 1)) strcpy(host, "localhost");
    host[FRACAS_MEETING_HOST - 1] = '\0';
}

static fracas_err listen_anywhere(fracas_group *group, fracas_address *address)
{
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_ANY)};
    socklen_t size = sizeof at;
    group->listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (group->listener < 0 || bind(group->listener, (struct sockaddr *)&at, sizeof at) ||
        listen(group->listener, FRACAS_PEERS_MAX) ||
        getsockname(group->listener, (struct sockaddr *)&at, &size))
        return failed("listen");
    address->port = ntohs(at.sin_port);
    own_host(address->host);
    return FRACAS_OK;
}

static fracas_err connect_to(const fracas_address *address, int *fd)
{
    char own[FRACAS_MEETING_HOST], port[24];
    struct addrinfo *found, kind = {.ai_family = AF_INET, .ai_socktype = SOCK_STREAM};
    own_host(own);
    snprintf(port, sizeof port, "%d", (int)address->port);
    const char *host = strcmp(own, address->host) ? address->host : "127.0.0.1";
    const int status = getaddrinfo(host, port, &kind, &found);
    if (status)
        return fracas_fail(FRACAS_ENVIRONMENT, "a process for one body cannot find host %s: %s",
                           host, gai_strerror(status));
    *fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool good = *fd >= 0 && !connect(*fd, found->ai_addr, found->ai_addrlen);
    freeaddrinfo(found);
    if (!good) return failed("reach another");
    set_up(*fd);
    return FRACAS_OK;
}

static bool say(int fd, const void *bytes, size_t size)
{
    return send(fd, bytes, size, MSG_NOSIGNAL) == (ssize_t)size;
}

static bool hear(int fd, void *bytes, size_t size)
{
    return recv(fd, bytes, size, MSG_WAITALL) == (ssize_t)size;
}

/* The guest's message; *wait: it may still come. */
static bool hear_guest(const fracas_group *group, hello *who, bool *wait)
{
    const ssize_t n = recv(group->guest, who, sizeof *who, MSG_PEEK | MSG_DONTWAIT);
    const bool begun = n > 0 && n < (ssize_t)sizeof *who,
               silent = n < 0 && (errno == EAGAIN || errno == EINTR);
    *wait = (begun || silent) && fracas_now() < group->guest_came + GUEST;
    return n == (ssize_t)sizeof *who && who->token == group->token[0] &&
           hear(group->guest, who, sizeof *who);
}

/* The next who knows the token; -1: there is none now. Strangers are many, or silent, at no one's
 * cost but that of others who come. */
static int accept_one(fracas_group *group, hello *who)
{
    for (int tries = 0; tries < FRACAS_PEERS_MAX; tries++) {
        bool wait;
        if (group->guest < 0) {
            group->guest = accept4(group->listener, NULL, NULL, SOCK_CLOEXEC);
            group->guest_came = fracas_now();
        }
        if (group->guest < 0) return -1;
        const bool known = hear_guest(group, who, &wait);
        if (wait) return -1;
        const int fd = group->guest;
        group->guest = -1;
        if (known) set_up(fd);
        if (known) return fd;
        close(fd);
    }
    return -1;
}

static void stop_listening(fracas_group *group)
{
    int *const fd[] = {&group->listener, &group->guest};
    for (size_t i = 0; i < FRACAS_COUNT(fd); i++) {
        if (*fd[i] >= 0) close(*fd[i]);
        *fd[i] = -1;
    }
}

/* ---- the leading process ---- */

fracas_err fracas_group_open(fracas_group *group, size_t most, fracas_meeting *meeting)
{
    fracas_address address;
    if (getrandom(group->token, sizeof group->token, 0) != sizeof group->token)
        return failed("draw random numbers");
    TRY(listen_anywhere(group, &address));
    group->count = 1;
    group->most = most < FRACAS_PEERS_MAX ? most : FRACAS_PEERS_MAX;
    group->opened = fracas_now();
    memcpy(meeting->token, group->token, sizeof meeting->token);
    meeting->port = address.port;
    memcpy(meeting->host, address.host, sizeof meeting->host);
    return FRACAS_OK;
}

bool fracas_group_has_come(fracas_group *group)
{
    hello who;
    for (int fd; group->listener >= 0 && group->count < group->most &&
                 (fd = accept_one(group, &who)) >= 0;) {
        if (group->count == 1) group->first = fracas_now();
        group->waiting[group->count] = fd;
        group->address[group->count++] = who.address;
    }
    return group->count > 1 &&
           fracas_now() >= group->first + LEAST + AGAIN * (group->first - group->opened);
}

static void set_peers(fracas_group *group, size_t count, size_t number)
{
    group->connections.count = count;
    group->connections.number = number;
    group->peers = (fracas_peers){count, number, fracas_connections_exchange, &group->connections};
}

fracas_err fracas_group_start(fracas_group *group, size_t from)
{
    roster all = {.token = group->token[1], .count = group->count, .from = from};
    memcpy(all.address, group->address, sizeof all.address);
    stop_listening(group);
    memcpy(group->connections.fd, group->waiting, sizeof group->waiting);
    group->connections.fd[0] = -1;
    set_peers(group, group->count, 0);
    group->count = 0;
    for (all.number = 1; all.number < all.count; all.number++)
        if (!say(group->connections.fd[all.number], &all, sizeof all)) {
            fracas_group_leave(group);
            return failed("start with the others");
        }
    return FRACAS_OK;
}

/* ---- the others ---- */

/* The start may be long in coming. */
static fracas_err wait_for_start(fracas_group *group, roster *all)
{
    struct pollfd from = {.fd = group->connections.fd[0], .events = POLLIN};
    while (poll(&from, 1, -1) < 0 && errno == EINTR)
        ;
    if (!hear(from.fd, all, sizeof *all) || all->token != group->token[1] || all->number < 1 ||
        all->number >= all->count || all->count > FRACAS_PEERS_MAX)
        return fracas_fail(FRACAS_ENVIRONMENT, "a process for one body was not needed");
    return FRACAS_OK;
}

/* Connections to the others: to lower numbers from here, to higher ones from there. */
static fracas_err meet_others(fracas_group *group, const roster *all)
{
    const double until = fracas_now() + MEETING;
    hello own = {.token = group->token[0], .number = all->number}, who;
    for (size_t p = 1; p < all->number; p++) {
        TRY(connect_to(&all->address[p], &group->connections.fd[p]));
        if (!say(group->connections.fd[p], &own, sizeof own)) return failed("greet another");
    }
    for (size_t left = all->count - 1 - all->number; left > 0; left--) {
        int fd;
        while ((fd = accept_one(group, &who)) < 0 && fracas_now() < until) poll(NULL, 0, 5);
        if (fd < 0) return failed("meet another");
        const bool known = who.number > all->number && who.number < all->count &&
                           group->connections.fd[who.number] < 0;
        if (!known) close(fd);
        if (!known) return failed("meet another");
        group->connections.fd[who.number] = fd;
    }
    return FRACAS_OK;
}

static fracas_err join(fracas_group *group, const fracas_meeting *meeting, size_t *from)
{
    hello own = {.number = 0};
    roster all;
    fracas_address there = {.port = meeting->port};
    memcpy(group->token, meeting->token, sizeof group->token);
    own.token = group->token[0];
    memcpy(there.host, meeting->host, sizeof there.host);
    there.host[sizeof there.host - 1] = '\0';
    TRY(listen_anywhere(group, &own.address));
    TRY(connect_to(&there, &group->connections.fd[0]));
    if (!say(group->connections.fd[0], &own, sizeof own)) return failed("greet the first");
    TRY(wait_for_start(group, &all));
    *from = (size_t)all.from;
    set_peers(group, all.count, all.number);
    return meet_others(group, &all);
}

fracas_err fracas_group_join(fracas_group *group, const fracas_meeting *meeting, size_t *from)
{
    for (size_t p = 0; p < FRACAS_PEERS_MAX; p++) group->connections.fd[p] = -1;
    group->connections.count = 1;
    fracas_err err = join(group, meeting, from);
    stop_listening(group);
    if (err) fracas_group_leave(group);
    return err;
}

/* ---- all ---- */

const fracas_peers *fracas_group_peers(const fracas_group *group)
{
    return group->connections.count ? &group->peers : NULL;
}

void fracas_group_leave(fracas_group *group)
{
    stop_listening(group);
    for (size_t p = 1; p < group->count; p++) close(group->waiting[p]);
    group->count = 0;
    fracas_connections_close(&group->connections);
}
