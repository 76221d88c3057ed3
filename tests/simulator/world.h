/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The world of a simulated farm: processes as fibers of this one, virtual time, and dice. All that
 * happens follows from the seed. */
#ifndef FRACAS_TESTS_SIMULATOR_WORLD_H
#define FRACAS_TESTS_SIMULATOR_WORLD_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <ucontext.h>

/* Dice of different purposes, so that a change to one leaves the others as they were. */
typedef enum { DICE_FARM, DICE_FAULT, DICE_DELAY, DICE_DISK, DICE_SQLITE, NDICE } dice;

enum { MESSAGE = 1024, FIRST_PID = 1000, NENV = 6 };

typedef struct run run;       /* one start of mpirun: machine.c */
typedef struct letter letter; /* a message between ranks: machine.c */

typedef enum { USER_RUN, MPIRUN, RANK, KEEPER, SERVER, LEASE_CHILD, NROLES } role;

/* The checkpoint that a process writes. */
typedef struct {
    uint64_t point;
    int64_t replica;
    uint64_t steps;
} saving;

typedef struct process {
    int pid, parent;
    role role;
    int number; /* of a rank, of the rank of a keeper, server or child */
    run *run;
    bool alive, reaped;
    int status; /* as waitpid gives it */
    void (*main)(void *argument);
    void *argument;
    ucontext_t context;
    void *stack;
    uint64_t turn;       /* counts its resumptions: an older one is void */
    double frozen_until; /* it does nothing before */
    int idle_calls;      /* since it slept last */
    bool hurt;           /* by a fault */
    saving saves;
    char writes[256]; /* the segment */
    int doom;         /* calls until it dies; 0: none */
    int alarm;        /* number of its last timer */
    bool drain;       /* signals received */
    int asked;
    int error; /* its errno and its last message while others run */
    char message[MESSAGE];
    struct {
        char name[32], value[256];
    } env[NENV];
    int out;            /* its stdout: a descriptor, or -1 */
    size_t descriptors; /* the first of its own: calls.c */
    letter *inbox, **inbox_end;
    double last_out, last_in; /* when the last message to, and from, rank 0 comes */
    bool gave_up;             /* a server: it has announced its end */
} process;

typedef struct {
    double time;
    uint64_t order;
    void (*act)(void *what, uint64_t number);
    void *what;
    uint64_t number;
} event;

extern struct world {
    uint64_t seed, drawn[NDICE];
    double now;  /* s */
    double skew; /* by which the monotonic clock has jumped [s] */
    double day;  /* time of day at 0 [s since 1970] */
    process *current;
    process **process;
    size_t nprocesses, room;
    event *heap;
    size_t nheap, heap_room;
    uint64_t order, events;
    bool tracing, quiet;
    double delay; /* factor of the delays of messages */
    int blackout; /* calls of any process until the power fails; 0: it does not */
    bool dark;    /* it has failed: the loop is about to act on that */
    int boots;
} world;

void world_begin(uint64_t seed, bool tracing);

/* ---- dice ---- */
double roll(dice of);                         /* 0 to 1, both excluded */
uint64_t roll_below(dice of, uint64_t bound); /* 0 to bound - 1 */
bool chance(dice of, double probability);
double roll_between(dice of, double least, double most); /* by its logarithm */

/* ---- messages and traces ---- */
void trace(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* An invariant does not hold: says so and ends this process. */
_Noreturn void broken(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* ---- events ---- */
void world_at(double time, void (*act)(void *what, uint64_t number), void *what, uint64_t number);
/* Acts on the next event; false without any. */
bool world_step(void);
/* All processes die; unsynced changes are lost. */
void world_blackout(void);

/* ---- processes ---- */
process *process_start(role role, int number, run *run, void (*main)(void *), void *argument);
process *process_of(int pid);
const char *process_name(const process *p);
/* Of the present process: until it is woken, or until `time`. */
void process_wait(double until);
/* The same, however often it is woken. */
void process_sleep(double until);
void process_wake(process *p, double delay);
/* Ends a process, the present one too, as waitpid tells it. */
void process_end(process *p, int status);
/* At every call visible to another system: it may be the last of this process. */
void call(const char *name);

#endif
