/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What rank 0 knows of a run, for its two halves: director.c, which hears the workers, and
 * director_time.c, which minds the time. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_STATE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_STATE_H

#include "campaigns/scheduler/director.h"
#include "campaigns/scheduler/lease/scheduler.h"
#include "campaigns/scheduler/study/rounds.h"
#include "campaigns/scheduler/tally.h"

typedef enum { STARTING, WORKING, STOPPING, ENDED } worker_phase;

struct fracas_director {
    fracas_director_setup setup;
    int lock;
    fracas_index *index;
    double *cost; /* of a realization of each point */
    bool *ruled;  /* a rule decides the replicas of each point: of these the next round is asked for
                     soonest */
    fracas_rounds rounds;
    fracas_scheduler *scheduler;
    worker_phase *phase; /* of each worker */
    bool *flushing;      /* each worker was asked to write its segment */
    int64_t *given;      /* replicas of each point that the scheduler knows */
    size_t nended;
    bool stopping;          /* STOP was sent to all that work */
    bool needless;          /* everything is durable: what still runs is a duplicate */
    bool drained;           /* because of a signal or the deadline */
    bool late;              /* because of the deadline */
    bool overtime;          /* it is so near that what runs is killed */
    bool resumed_whole;     /* everything was computed before this run */
    double told;            /* when everybody was told to stop */
    double ticked;          /* when the time was looked at last */
    fracas_trouble trouble; /* the first; code FRACAS_OK: none */
    fracas_tally tally;
};

/* ---- director.c ---- */

/* Keeps what went wrong, if anything, and drains. */
void fracas_director_check(fracas_director *director, fracas_err err);
/* Sends one message to a worker. */
FRACAS_MUST_USE fracas_err fracas_director_tell(fracas_director *director, size_t worker,
                                                fracas_packet_kind kind, const void *body,
                                                size_t size);
/* Tells a worker to stop, at once if what it computes is not needed or out of time. */
void fracas_director_stop_worker(fracas_director *director, size_t worker);
/* Nothing comes from it any more: what it had not made durable waits again. */
void fracas_director_end_worker(fracas_director *director, size_t worker);
/* Nothing is left to compute, nor will be. */
bool fracas_director_computed(const fracas_director *director);
/* And everything is on disk. */
bool fracas_director_durable(const fracas_director *director);

/* ---- director_time.c ---- */

/* The worker would not end its next lease before the deadline, with time to make it durable. */
bool fracas_director_too_late(const fracas_director *director, size_t worker, double time);

#endif
