/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/world.h"

#include "sampler/stream.h"
#include "tests/simulator/disk.h"
#include "tests/simulator/machine.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

struct world world;

enum { STACK = 640 << 10, MOST_EVENTS = 20000000, MOST_CALLS = 10000000 };

static ucontext_t loop; /* of world_step */
static void *corpse;    /* stack of a process after its own end */
static void *spare[4096];
static size_t nspare;

void world_begin(uint64_t seed, bool tracing)
{
    world = (struct world){.seed = seed, .tracing = tracing, .delay = 1, .day = 1.9e9};
}

/* ---- dice ---- */

double roll(dice of)
{
    const fracas_stream stream = {.seed = world.seed, .purpose = 1000u + (uint64_t)of};
    return fracas_stream_uniform(&stream, world.drawn[of]++);
}

uint64_t roll_below(dice of, uint64_t bound)
{
    return (uint64_t)(roll(of) * (double)bound);
}

bool chance(dice of, double probability)
{
    return roll(of) < probability;
}

double roll_between(dice of, double least, double most)
{
    return least * exp(roll(of) * log(most / least));
}

/* ---- messages and traces ---- */

static void say(const char *format, va_list arguments)
{
    fprintf(stdout, "%12.6f %-16s ", world.now, world.current ? process_name(world.current) : "-");
    vfprintf(stdout, format, arguments);
    fputc('\n', stdout);
}

void trace(const char *format, ...)
{
    va_list arguments;
    if (!world.tracing) return;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
}

void broken(const char *format, ...)
{
    va_list arguments;
    fprintf(stdout, "BROKEN seed %llu, event %llu: ", (unsigned long long)world.seed,
            (unsigned long long)world.events);
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
    fflush(stdout);
    _Exit(1);
}

/* ---- events ---- */

static bool earlier(const event *a, const event *b)
{
    return a->time < b->time || (a->time == b->time && a->order < b->order);
}

void world_at(double time, void (*act)(void *what, uint64_t number), void *what, uint64_t number)
{
    if (isinf(time)) return;
    if (fracas_grow(&world.heap, sizeof *world.heap, world.nheap, &world.heap_room, "events"))
        abort();
    const event e = {fmax(time, world.now), world.order++, act, what, number};
    size_t i = world.nheap++;
    for (; i && earlier(&e, &world.heap[(i - 1) / 2]); i = (i - 1) / 2)
        world.heap[i] = world.heap[(i - 1) / 2];
    world.heap[i] = e;
}

static event take_first(void)
{
    const event first = world.heap[0], e = world.heap[--world.nheap];
    size_t i = 0, child;
    for (; (child = 2 * i + 1) < world.nheap; i = child) {
        if (child + 1 < world.nheap && earlier(&world.heap[child + 1], &world.heap[child])) child++;
        if (!earlier(&world.heap[child], &e)) break;
        world.heap[i] = world.heap[child];
    }
    world.heap[i] = e;
    return first;
}

bool world_step(void)
{
    if (!world.nheap) return false;
    const event e = take_first();
    world.now = e.time;
    if (++world.events > MOST_EVENTS) broken("%d events and no end", MOST_EVENTS);
    e.act(e.what, e.number);
    if (!world.dark) return true;
    world_blackout();
    world.dark = false;
    return true;
}

void world_blackout(void)
{
    trace("THE POWER FAILS");
    world.blackout = 0;
    world.boots++;
    for (size_t i = 0; i < world.nprocesses; i++)
        if (world.process[i]->alive) process_end(world.process[i], SIGKILL);
    disk_crash();
    machine_power_failed();
}

/* ---- fibers ---- */

/* The message of base/err.c is one of this thread; each process has its own. */
static void swap_message(process *p, bool in)
{
    char *message = (char *)(uintptr_t)fracas_message();
    if (in) {
        memcpy(message, p->message, MESSAGE);
        errno = p->error;
    } else {
        p->error = errno;
        memcpy(p->message, message, MESSAGE);
    }
}

static void leave(void)
{
    process *p = world.current;
    swap_message(p, false);
    world.current = NULL;
    swapcontext(&p->context, &loop);
    swap_message(p, true);
}

static void enter(void)
{
    process *p = world.current;
    p->main(p->argument);
    process_end(p, 0);
    abort();
}

static void give_stack(void *stack)
{
    if (!stack) return;
    if (nspare == sizeof spare / sizeof *spare) munmap(stack, STACK);
    else spare[nspare++] = stack;
}

static void resume(void *what, uint64_t turn)
{
    process *p = what;
    if (!p->alive || p->turn != turn) return;
    if (p->frozen_until > world.now) {
        world_at(p->frozen_until, resume, p, turn);
        return;
    }
    p->turn++;
    p->idle_calls = 0;
    world.current = p;
    swapcontext(&loop, &p->context);
    world.current = NULL;
    give_stack(corpse);
    corpse = NULL;
}

static void *new_stack(void)
{
    if (nspare) return spare[--nspare];
    void *stack = mmap(NULL, STACK, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (stack == MAP_FAILED) abort();
    return stack;
}

process *process_start(role as, int number, run *of, void (*main)(void *), void *argument)
{
    if (fracas_grow(&world.process, sizeof *world.process, world.nprocesses, &world.room,
                    "processes"))
        abort();
    process *p = calloc(1, sizeof *p);
    if (!p) abort();
    world.process[world.nprocesses] = p;
    *p = (process){.pid = FIRST_PID + (int)world.nprocesses++,
                   .parent = world.current ? world.current->pid : 0,
                   .role = as,
                   .number = number,
                   .run = of,
                   .alive = true,
                   .main = main,
                   .argument = argument,
                   .out = -1};
    p->inbox_end = &p->inbox;
    if (!main) return p;
    p->stack = new_stack();
    getcontext(&p->context);
    p->context.uc_stack.ss_sp = p->stack;
    p->context.uc_stack.ss_size = STACK;
    p->context.uc_link = NULL;
    makecontext(&p->context, enter, 0);
    world_at(world.now + 1e-3 * roll(DICE_DELAY), resume, p, p->turn);
    return p;
}

process *process_of(int pid)
{
    const size_t i = (size_t)(pid - FIRST_PID);
    return pid >= FIRST_PID && i < world.nprocesses ? world.process[i] : NULL;
}

const char *process_name(const process *p)
{
    static char texts[4][64];
    static int next;
    char *text = texts[next++ % 4];
    static const char *const name[NROLES] = {"run", "mpirun", "rank", "keeper", "server", "lease"};
    if (p->role <= MPIRUN) snprintf(text, sizeof *texts, "%s %d", name[p->role], p->pid);
    else snprintf(text, sizeof *texts, "%s %d (%d)", name[p->role], p->number, p->pid);
    return text;
}

void process_wait(double until)
{
    process *p = world.current;
    world_at(until, resume, p, p->turn);
    leave();
}

void process_sleep(double until)
{
    while (world.now < until) process_wait(until);
}

void process_wake(process *p, double delay)
{
    if (p && p->alive && p->main && p != world.current)
        world_at(world.now + delay, resume, p, p->turn);
}

void process_end(process *p, int status)
{
    p->alive = false;
    p->status = status;
    if (status && !world.dark) trace("%s ends with %x", process_name(p), (unsigned)status);
    machine_ended(p);
    if (p != world.current) {
        give_stack(p->stack);
        p->stack = NULL;
        return;
    }
    corpse = p->stack;
    p->stack = NULL;
    world.current = NULL;
    setcontext(&loop);
    abort();
}

void call(const char *name)
{
    process *p = world.current;
    if (!p) return;
    if (++p->idle_calls > MOST_CALLS) broken("calls %s and others without end", name);
    if (world.blackout && !--world.blackout) {
        trace("the power fails at %s", name);
        world.dark = true;
        leave();
    }
    if (p->doom && !--p->doom) {
        trace("is killed at %s", name);
        process_end(p, SIGKILL);
    }
}
