/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/machine.h"

#include "tests/simulator/calls.h"
#include "tests/simulator/descriptors.h"
#include "tests/simulator/farm.h"
#include "tests/simulator/oracle.h"
#include "tests/simulator/vfs.h"

#include "campaigns/scheduler/launch/reap.h"
#include "campaigns/scheduler/launch/starter.h"
#include "campaigns/scheduler/run.h"
#include "campaigns/scheduler/status/channel.h"
#include "campaigns/scheduler/types/mailbox.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

/* ---- ends ---- */

static void kill_later(void *what, uint64_t number)
{
    process *p = what;
    (void)number;
    if (p->alive) process_end(p, SIGKILL);
}

/* Other hosts hear later of what happens here. */
static double lag_of(const process *p)
{
    return (p->role == RANK && farm_host(p) ? 3 : 5e-3) * roll(DICE_DELAY);
}

/* A child dies with its parent. */
static void end_children(const process *p)
{
    if (p->role == LEASE_CHILD) return;
    for (size_t i = (size_t)(p->pid - FIRST_PID) + 1; i < world.nprocesses; i++) {
        process *child = world.process[i];
        if (child->alive && child->parent == p->pid)
            world_at(world.now + lag_of(child), kill_later, child, 0);
    }
}

static void end_mpirun(void *what, uint64_t status)
{
    run *r = what;
    static const char text[] = "mpirun noticed that process rank N exited on signal 9.\n";
    if (!r->mpirun->alive) return;
    if (status) calls_tell(r->mpirun->out, text, sizeof text - 1);
    process_end(r->mpirun, (int)status);
}

/* A rank has ended too early: mpirun ends the others. */
static void fail_run(run *r)
{
    if (r->failing || !r->mpirun->alive) return;
    r->failing = true;
    world_at(world.now + 0.3 * roll(DICE_DELAY), end_mpirun, r, 9 << 8);
}

void machine_ended(process *p)
{
    run *r = p->run;
    descriptors_end(p);
    vfs_ended(p);
    if (world.dark) return;
    if (!r) {
        end_children(p);
        farm_user_ended(p);
        return;
    }
    r->living -= !farm_host(p);
    end_children(p);
    process_wake(process_of(p->parent), 1e-4 * roll(DICE_DELAY));
    if (p->role == MPIRUN) process_wake(r->launcher, 0);
    if (p->role != RANK) return;
    r->nended++;
    if (p->status || r->nclosed < r->jobs) fail_run(r);
    else if (r->nended == r->jobs) world_at(world.now + 0.01, end_mpirun, r, 0);
}

void machine_power_failed(void)
{
    disk.full_until = disk.slow_until = 0;
    oracle_power_failed();
    farm_power_failed();
}

void machine_removes(const char *path, bool replaced)
{
    oracle_removes(path, replaced);
}

void machine_signal(process *p, int number)
{
    if (!p->alive) return;
    if (number == SIGKILL || (p->role != USER_RUN && p->role != MPIRUN && p->role != RANK)) {
        process_end(p, number);
    } else if (p->role == MPIRUN) {
        for (int i = 0; i < p->run->jobs; i++) machine_signal(p->run->rank[i], number);
    } else {
        if (number == SIGINT && p->role == USER_RUN) p->asked++;
        else p->drain = true;
        process_wake(p, 0);
    }
}

int __wrap_kill(pid_t pid, int number)
{
    process *p = process_of(pid < 0 ? -pid : pid);
    if (p) machine_signal(p, number);
    return 0;
}

pid_t __wrap_getpid(void)
{
    return world.current ? world.current->pid : 1;
}

void __real__exit(int status) __attribute__((noreturn));
void __wrap__exit(int status)
{
    if (!world.current) __real__exit(status);
    process_end(world.current, status << 8);
    abort();
}

pid_t __real_waitpid(pid_t pid, int *status, int options);
pid_t __wrap_waitpid(pid_t pid, int *status, int options)
{
    if (!world.current) return __real_waitpid(pid, status, options);
    process *p = process_of(pid);
    errno = ECHILD;
    if (!p) return -1;
    while (p->alive) process_wait(INFINITY);
    if (status) *status = p->status;
    return pid;
}

int __wrap_waitid(idtype_t type, id_t id, siginfo_t *info, int options)
{
    (void)type, (void)options;
    const process *p = process_of((int)id);
    if (p && !p->alive) info->si_pid = (pid_t)id;
    return 0;
}

static void ring(void *what, uint64_t number)
{
    process *p = what;
    if (p->alive && p->alarm == (int)number) process_end(p, SIGALRM);
}

int __wrap_setitimer(int which, const struct itimerval *timer, struct itimerval *before)
{
    (void)which, (void)before;
    process *p = world.current;
    const double seconds = (double)timer->it_value.tv_sec + 1e-6 * (double)timer->it_value.tv_usec;
    p->alarm++;
    if (seconds > 0) world_at(world.now + seconds, ring, p, (uint64_t)p->alarm);
    return 0;
}

int __wrap_prctl(int option, ...)
{
    (void)option;
    return 0;
}

/* ---- signals of this process ---- */

void __wrap_fracas_signals_catch(void) {}
void __wrap_fracas_signals_catch_rank(void) {}
void __wrap_fracas_signals_end(void) {}

bool __wrap_fracas_signals_ask(void)
{
    return world.current->drain || world.current->asked > 0;
}

bool __wrap_fracas_signals_insist(void)
{
    return world.current->asked > 1;
}

/* ---- mpirun ---- */

static void rank_main(void *argument)
{
    fracas_run_facts facts;
    (void)argument;
    const int status = fracas_run(&farm.options, 0, NULL, &facts) << 8;
    fracas_run_facts_clear(&facts);
    process_end(world.current, status);
}

static void start_rank(run *r, int number)
{
    char text[16];
    process *p = process_start(RANK, number, r, rank_main, NULL);
    snprintf(text, sizeof text, "%d", number);
    memcpy(p->env, r->launcher->env, sizeof p->env);
    calls_set_environment(p, "PMIX_RANK", text);
    calls_set_environment(p, FRACAS_LAUNCHER_MARK, "1");
    p->parent = r->mpirun->pid;
    p->out = r->mpirun->out;
    r->rank[number] = p;
}

void __wrap_fracas_scratch_remove(fracas_scratch *scratch)
{
    (void)scratch;
}

void __wrap_fracas_scratch_import(void) {}

static fracas_err check(int jobs)
{
    (void)jobs;
    return FRACAS_OK;
}

static fracas_err start(const fracas_ranks *ranks, fracas_scratch *scratch, fracas_starter *starter)
{
    (void)scratch;
    const int jobs = ranks->jobs;
    int out[2], errors[2];
    const size_t n = (size_t)jobs;
    run *r = need(calloc(1, sizeof *r));
    *r = (run){.launcher = world.current,
               .jobs = jobs,
               .rank = need(calloc(n, sizeof *r->rank)),
               .keeper = need(calloc(n, sizeof *r->keeper)),
               .servers = need(calloc(n, sizeof *r->servers))};
    r->mpirun = process_start(MPIRUN, 0, r, NULL, NULL);
    r->living++;
    calls_pair(out, 1 << 20);
    calls_pair(errors, 1 << 20);
    descriptor_give(out[1], r->mpirun);
    descriptor_give(errors[1], r->mpirun);
    r->mpirun->out = out[1];
    for (int i = 0; i < jobs; i++) {
        start_rank(r, i);
        r->living += !farm_host(r->rank[i]);
    }
    *starter = (fracas_starter){r->mpirun->pid, out[0], errors[0]};
    return FRACAS_OK;
}

const fracas_starter_kind *__wrap_fracas_starter_choose(void)
{
    static const fracas_starter_kind simulated = {"mpirun", check, start};
    return &simulated;
}

void __wrap_fracas_reap_begin(fracas_reap *reap)
{
    (void)reap;
}

bool __wrap_fracas_reap_wait(fracas_reap *reap, pid_t pid, int *status)
{
    process *p = process_of(pid);
    (void)reap;
    if (!p->alive && !p->reaped) {
        *status = p->status;
        p->reaped = true;
    }
    return p->run->living > 0;
}

void __wrap_fracas_reap_kill(fracas_reap *reap)
{
    (void)reap;
    for (size_t i = 0; i < world.nprocesses; i++) {
        process *p = world.process[i];
        if (p->alive && p->run && p->run->launcher == world.current) process_end(p, SIGKILL);
    }
}

/* ---- mailboxes ---- */

struct letter {
    letter *next;
    int from;
    process *to;
    fracas_letter *sent; /* to be marked as taken when it is received; NULL: it was at once */
    fracas_packet *message;
};

struct fracas_letter {
    fracas_letter *next;
    bool taken;
};

enum { EAGER = 4096 }; /* bytes of a message taken by MPI at once */

bool machine_mail(void)
{
    return world.current->role == RANK && world.current->inbox;
}

bool machine_is_heard(void)
{
    const run *r = world.current->run;
    return r && r->mpirun->alive;
}

static void wake_ranks(const run *r)
{
    for (int i = 0; i < r->jobs; i++) process_wake(r->rank[i], 1e-3 * roll(DICE_DELAY));
}

void __wrap_fracas_mailbox_open(fracas_mailbox *box)
{
    run *r = world.current->run;
    *box = (fracas_mailbox){.rank = world.current->number, .size = r->jobs};
    if (++r->nopen == r->jobs) wake_ranks(r);
    while (r->nopen < r->jobs) process_wait(INFINITY);
}

int __wrap_fracas_mailbox_stranger(fracas_mailbox *box, const fracas_whereabouts *mine)
{
    (void)box, (void)mine;
    return -1;
}

void __wrap_fracas_mailbox_close(fracas_mailbox *box)
{
    run *r = world.current->run;
    (void)box;
    if (++r->nclosed == r->jobs) wake_ranks(r);
    while (r->nclosed < r->jobs) process_wait(INFINITY);
}

void __wrap_fracas_mailbox_abort(const fracas_mailbox *box)
{
    (void)box;
    trace("MPI_Abort: %s", fracas_message());
    process_end(world.current, FRACAS_ENVIRONMENT << 8);
}

static void deliver(void *what, uint64_t number)
{
    letter *mail = what;
    (void)number;
    mail->next = NULL;
    if (!mail->to->alive) return;
    *mail->to->inbox_end = mail;
    mail->to->inbox_end = &mail->next;
    process_wake(mail->to, 8e-3 * roll(DICE_DELAY));
}

/* Late, but in the order of the sender. */
static double arrival(process *from, process *to)
{
    double *last = to->number == 0 ? &from->last_out : &to->last_in;
    const double most = chance(DICE_DELAY, 0.01) ? 1 : 0.01;
    *last = fmax(*last, world.now + most * world.delay * roll(DICE_DELAY));
    return *last;
}

fracas_err __wrap_fracas_mailbox_post(fracas_mailbox *box, int to, const fracas_packet *message)
{
    call("MPI_Isend");
    process *there = world.current->run->rank[to];
    const size_t size = fracas_packet_bytes(message);
    letter *mail = need(calloc(1, sizeof *mail));
    fracas_letter *sent = need(calloc(1, sizeof *sent));
    *mail = (letter){.from = box->rank, .to = there, .message = need(malloc(size))};
    memcpy(mail->message, message, size);
    *sent = (fracas_letter){.next = box->outbox, .taken = size <= EAGER};
    if (!sent->taken) mail->sent = sent;
    box->outbox = sent;
    world_at(arrival(world.current, there), deliver, mail, 0);
    return FRACAS_OK;
}

fracas_err __wrap_fracas_mailbox_clear(fracas_mailbox *box)
{
    for (fracas_letter **at = &box->outbox; *at;) {
        fracas_letter *sent = *at;
        if (!sent->taken) {
            at = &sent->next;
            continue;
        }
        *at = sent->next;
        free(sent);
    }
    return FRACAS_OK;
}

fracas_err __wrap_fracas_mailbox_receive(fracas_mailbox *box, int *from, fracas_packet **message)
{
    (void)box;
    call("MPI_Iprobe");
    process *p = world.current;
    letter *mail = p->inbox;
    *message = NULL;
    if (!mail) return FRACAS_OK;
    p->inbox = mail->next;
    if (!p->inbox) p->inbox_end = &p->inbox;
    *from = mail->from;
    *message = mail->message;
    if (mail->sent) mail->sent->taken = true; /* its sender lives, or nobody looks at it */
    process_wake(p->run->rank[mail->from], 1e-3 * roll(DICE_DELAY));
    free(mail);
    return FRACAS_OK;
}

void __wrap_fracas_mailbox_wait(fracas_mailbox *box, int fd, int most)
{
    (void)box;
    struct pollfd from = {.fd = fd, .events = POLLIN};
    poll(&from, 1, most);
}

void __wrap_fracas_mailbox_version(char *text, size_t size)
{
    snprintf(text, size, "simulated");
}
