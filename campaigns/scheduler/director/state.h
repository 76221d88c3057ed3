/* SPDX-License-Identifier: GPL-3.0-or-later */
/* State of a director, and its changes common to several files. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_STATE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_STATE_H

#include "campaigns/scheduler/director/director.h"
#include "campaigns/scheduler/director/timings.h"
#include "campaigns/scheduler/lease/scheduler.h"
#include "campaigns/scheduler/session/rounds.h"

typedef enum { STARTING, WORKING, STOPPING, ENDED } worker_phase;

struct fracas_director {
    fracas_director_setup setup;
    int lock;
    fracas_index *index;
    double *cost; /* predicted for a realization of each point */
    bool *ruled;  /* a rule decides the replicas of each point; these points go first */
    fracas_rounds rounds;
    fracas_scheduler *scheduler;
    worker_phase *phase; /* one a worker */
    bool *flushing;      /* each worker was asked to write its segment */
    int64_t *given;      /* replicas of each point known to the scheduler */
    size_t nended;
    bool stopping;          /* STOP was sent to all working */
    bool needless;          /* everything is durable: only duplicates still run */
    bool drained;           /* because of a signal or the deadline */
    bool late;              /* because of the deadline */
    bool overtime;          /* too near to the deadline: leases are killed */
    bool resumed_whole;     /* everything was computed before this run */
    double stopped_at;      /* time of STOP */
    double ticked;          /* time of the last tick */
    fracas_trouble trouble; /* the first; code FRACAS_OK: none */
    fracas_timings timings;
};

/* Keeps the first error, if it is one, and drains. */
void fracas_director_check(fracas_director *director, fracas_err err);
void fracas_director_fail(fracas_director *director, const fracas_trouble *trouble);
/* Stops all workers. */
void fracas_director_stop(fracas_director *director);
/* Sends one message to a worker. */
FRACAS_MUST_USE fracas_err fracas_director_post(fracas_director *director, size_t worker,
                                                fracas_packet_kind kind, const void *body,
                                                size_t size);
/* Sends STOP, which kills the running lease if it is not needed or out of time. */
void fracas_director_stop_worker(fracas_director *director, size_t worker);
/* Counts the worker as ended, once: its leases wait again, unless durable. */
void fracas_director_end_worker(fracas_director *director, size_t worker);
/* Shows a message on the status channel and notes it as an event. */
FRACAS_MUST_USE fracas_err fracas_director_announce(fracas_director *director, const char *kind,
                                                    const char *text);

/* Nothing is left to compute, nor will be. */
bool fracas_director_computed(const fracas_director *director);
/* And everything is on disk. */
bool fracas_director_durable(const fracas_director *director);
/* The worker is predicted not to end its next lease before the deadline with time to write it. */
bool fracas_director_too_late(const fracas_director *director, size_t worker, double time);

#endif
