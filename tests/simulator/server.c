/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Supervisors, the processes of leases, and realizations that only wait and count. */
#include "tests/simulator/calls.h"
#include "tests/simulator/farm.h"
#include "tests/simulator/machine.h"

#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/worker/child.h"
#include "campaigns/scheduler/worker/connections.h"
#include "campaigns/scheduler/types/process.h"
#include "campaigns/scheduler/worker/server.h"
#include "campaigns/scheduler/worker/supervisor.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SOCKET_BYTES = 208 << 10, PIPE_BYTES = 64 << 10 };

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

/* ---- supervisors ---- */

typedef struct {
    const fracas_campaign *campaign;
    const fracas_run_options *options;
    const char *study;
    int fd; /* of a server: to its rank */
} service;

static void server_main(void *argument)
{
    const service *s = argument;
    fracas_server_run(s->campaign, s->options, s->study, s->fd);
}

static struct servers *servers_of(const process *keeper)
{
    return &keeper->run->servers[keeper->number];
}

static process *last_of(const process *keeper)
{
    const struct servers *s = servers_of(keeper);
    return s->started[s->count - 1];
}

/* *fd: the rank's side. */
static void start_server(process *keeper, int *fd)
{
    int pair[2];
    service *s = need(malloc(sizeof *s));
    struct servers *servers = servers_of(keeper);
    *s = *(service *)keeper->argument;
    calls_pair(pair, SOCKET_BYTES);
    s->fd = pair[1];
    process *server = process_start(SERVER, keeper->number, keeper->run, server_main, s);
    server->parent = keeper->pid;
    keeper->run->living += !(farm.hosts > 1 && keeper->number % 2);
    calls_give(pair[1], server);
    if (fracas_grow(&servers->started, sizeof(process *), servers->count, &servers->room,
                    "servers"))
        abort();
    servers->started[servers->count++] = server;
    *fd = pair[0];
}

fracas_err __wrap_fracas_supervisor_start(const fracas_campaign *campaign,
                                          const fracas_run_options *options, const char *study,
                                          fracas_supervisor *supervisor)
{
    run *r = world.current->run;
    service *s = need(malloc(sizeof *s));
    *s = (service){campaign, options, study, -1};
    process *keeper = process_start(KEEPER, world.current->number, r, NULL, s);
    r->living += !(farm.hosts > 1 && keeper->number % 2);
    r->keeper[keeper->number] = keeper;
    *supervisor = (fracas_supervisor){.pid = keeper->pid, .control = -1};
    start_server(keeper, &supervisor->server);
    return FRACAS_OK;
}

static fracas_err gone(fracas_supervisor *supervisor)
{
    if (supervisor->server >= 0) close(supervisor->server);
    *supervisor = (fracas_supervisor){.control = -1, .server = -1};
    return fracas_fail(FRACAS_ENVIRONMENT, "went with its supervisor, which died of signal 9");
}

fracas_err __wrap_fracas_supervisor_reap(fracas_supervisor *supervisor, char *how, size_t size)
{
    const process *keeper = process_of(supervisor->pid);
    call("reap");
    if (!keeper->alive) return gone(supervisor);
    close(supervisor->server);
    supervisor->server = -1;
    for (const process *server = last_of(keeper); server->alive;) process_wait(world.now + 0.01);
    fracas_process_end_text(last_of(keeper)->status, how, size);
    return FRACAS_OK;
}

fracas_err __wrap_fracas_supervisor_restart(fracas_supervisor *supervisor)
{
    process *keeper = process_of(supervisor->pid);
    call("restart");
    if (!keeper->alive) return gone(supervisor);
    start_server(keeper, &supervisor->server);
    return FRACAS_OK;
}

void __wrap_fracas_supervisor_end(fracas_supervisor *supervisor)
{
    process *keeper = process_of(supervisor->pid);
    if (supervisor->server >= 0) close(supervisor->server);
    *supervisor = (fracas_supervisor){.control = -1, .server = -1};
    if (!keeper) return;
    process *server = last_of(keeper);
    for (const double began = world.now; server->alive && world.now < began + 2;)
        process_wait(world.now + 0.05);
    if (server->alive) process_end(server, SIGKILL);
    if (keeper->alive) process_end(keeper, 0);
}

/* ---- the process of a lease ---- */

typedef struct {
    fracas_computation computation;
    int fd;
    fracas_lease lease; /* its first bytes */
} work;

static fracas_err send_all(int fd, fracas_packet **record, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        TRY(fracas_packet_write(fd, record[i]));
        free(record[i]);
    }
    return FRACAS_OK;
}

/* Others may come, whatever the body. */
static fracas_err invite(const work *w)
{
    const fracas_meeting meeting = {.lease = w->lease.id, .port = (uint64_t)world.current->pid};
    if (w->lease.role != FRACAS_LEASE_LEADS) return FRACAS_OK;
    return fracas_packet_send(w->fd, FRACAS_PACKET_MEETING, &meeting, sizeof meeting);
}

static fracas_err compute(const work *w)
{
    TRY(invite(w));
    for (size_t from = 0, count; from < w->lease.count; from += count) {
        fracas_packet *record[FRACAS_LANES_MAX];
        TRY(fracas_compute_batch(&w->computation, from, record, &count));
        TRY(send_all(w->fd, record, count));
    }
    return FRACAS_OK;
}

/* Computes along with a leading process, until that is gone. */
static void help(const work *w)
{
    const process *leader = process_of((int)w->lease.meeting.port);
    for (double rest = 0.01; leader && leader->alive; rest *= 1.3) {
        call("helps");
        process_sleep(world.now + rest * roll(DICE_DELAY));
    }
}

static void child_main(void *argument)
{
    work *w = argument;
    if (w->lease.role == FRACAS_LEASE_HELPS) help(w);
    fracas_err err = w->lease.role == FRACAS_LEASE_HELPS ? FRACAS_OK : compute(w);
    fracas_trouble fault;
    if (err) fracas_trouble_take(err, &fault);
    if (err && fracas_packet_send(w->fd, FRACAS_PACKET_FAULT, &fault, sizeof fault))
        process_end(world.current, FRACAS_ENVIRONMENT << 8);
}

fracas_err __wrap_fracas_child_start(fracas_child *child, const fracas_computation *computation,
                                     fracas_models *models, int server_fd)
{
    (void)models, (void)server_fd;
    const fracas_lease *lease = computation->lease;
    const size_t bytes = fracas_lease_bytes(lease);
    work *w = need(malloc(offsetof(work, lease) + bytes));
    int fd[2];
    calls_pair(fd, PIPE_BYTES);
    memcpy(&w->lease, lease, bytes);
    w->computation = *computation;
    w->computation.lease = &w->lease;
    w->fd = fd[1];
    process *p = process_start(LEASE_CHILD, world.current->number, world.current->run, child_main,
                               w);
    p->run->living += !(farm.hosts > 1 && p->number % 2);
    calls_give(fd[1], p);
    const double now = fracas_now();
    *child = (fracas_child){.pid = p->pid,
                            .fd = fd[0],
                            .errors = -1,
                            .width = fracas_run_width(computation->options),
                            .began = now,
                            .deadline = lease->limit > 0 ? now + lease->limit : INFINITY,
                            .record = need(calloc(lease->count, sizeof(fracas_packet *)))};
    memcpy(&child->lease, lease, bytes);
    return FRACAS_OK;
}

/* ---- realizations ---- */

fracas_err __wrap_fracas_models_get(fracas_models *models, fracas_computation *computation)
{
    (void)computation;
    if (!models->clock++) process_sleep(world.now + 0.2 * roll(DICE_DELAY));
    return FRACAS_OK;
}

static double share(uint64_t point, int64_t replica, uint64_t of)
{
    return (double)(farm_hash(point, replica, of) >> 11) * 0x1p-53;
}

/* Its bytes are a function of point and replica. */
static void fill(uint64_t point, int64_t replica, fracas_record *record)
{
    record->outcome = FRACAS_FRAGMENTED;
    record->fragments = 3 + (int64_t)(farm_hash(point, replica, 1) % 6);
    record->fragments_dust = 1;
    record->steps = 100 + (int64_t)(farm_hash(point, replica, 2) % 100);
    record->dissipated = share(point, replica, 3);
    record->residual = 1e-9 * share(point, replica, 4);
    record->nfragment = (uint64_t)record->fragments;
    record->fragment = need(calloc(record->nfragment, sizeof *record->fragment));
    for (uint64_t f = 0; f < record->nfragment; f++)
        record->fragment[f].size = share(point, replica, 5 + f);
}

/* Seconds that a leading process loses by helpers: dead ones' part is computed again, hung ones are
 * waited for. */
static double lost_by_helpers(double seconds)
{
    double lost = 0;
    for (size_t i = 0; i < world.nprocesses; i++) {
        const process *p = world.process[i];
        const work *w = p->argument;
        if (p->role != LEASE_CHILD || w->lease.role != FRACAS_LEASE_HELPS ||
            (int)w->lease.meeting.port != world.current->pid)
            continue;
        if (!p->alive) lost = fmax(lost, seconds);
        else if (p->frozen_until > world.now)
            lost = fmax(lost, fmin(p->frozen_until, world.now + FRACAS_PEERS_PATIENCE) - world.now +
                                  seconds);
    }
    return lost;
}

fracas_err __wrap_fracas_solve(const fracas_computation *computation, const int64_t *replica,
                               size_t count, fracas_record *record)
{
    const uint64_t point = computation->lease->point;
    double seconds = 0;
    for (size_t i = 0; i < count; i++)
        seconds = fmax(seconds, farm.seconds * (0.5 + share(point, replica[i], 20)));
    process_sleep(world.now + seconds * (0.8 + 0.4 * roll(DICE_DELAY)));
    if (computation->lease->role == FRACAS_LEASE_LEADS)
        process_sleep(world.now + lost_by_helpers(seconds));
    for (size_t i = 0; i < count; i++) {
        switch (farm_curse(point, replica[i])) {
        case SOUND: break;
        case CRASHES: process_end(world.current, SIGSEGV); break;
        case LACKS_MEMORY: return fracas_no_memory("a realization");
        case NEVER_ENDS: process_sleep(INFINITY);
        }
        fill(point, replica[i], &record[i]);
    }
    call("solved");
    return FRACAS_OK;
}
