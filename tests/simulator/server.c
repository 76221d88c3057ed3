/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Supervisors and the processes of leases. */
#include "tests/simulator/calls.h"
#include "tests/simulator/descriptors.h"
#include "tests/simulator/farm.h"
#include "tests/simulator/machine.h"

#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/worker/child.h"
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
    keeper->run->living += !farm_host(keeper);
    descriptor_give(pair[1], server);
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
    r->living += !farm_host(keeper);
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

static void child_main(void *argument)
{
    work *w = argument;
    fracas_models models = {.clock = 1}; /* those of the server */
    if (!fracas_child_live(&w->computation, &models, w->fd))
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
    p->run->living += !farm_host(p);
    descriptor_give(fd[1], p);
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
