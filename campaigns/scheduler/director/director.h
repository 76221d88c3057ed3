/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The director of a run: gives out leases, commits segments, and decides when and how the run ends.
 * It reaches its workers (a worker is a rank with its compute server) through a function, and does
 * not know MPI. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_DIRECTOR_H
#define FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_DIRECTOR_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/status/channel.h"
#include "campaigns/scheduler/types/options.h"
#include "campaigns/scheduler/types/packet.h"

/* Sends a message to a worker. A lost server is no error, since its LOST or TROUBLE follows. */
typedef fracas_err fracas_director_send(void *context, size_t worker, const fracas_packet *message);

/* Nothing is owned. */
typedef struct {
    const fracas_campaign *campaign;
    const fracas_run_options *options;
    const char *study;
    const double *cost; /* a realization takes at each point; NULL: not known yet */
    size_t workers;
    fracas_director_send *send;
    void *context;
    fracas_channel *channel;
    double (*now)(void); /* monotonic clock [s]: fracas_now */
    double deadline;     /* by this clock; 0: none */
} fracas_director_setup;

typedef struct fracas_director fracas_director;

/* Prepares the study (fracas_study_prepare) and the leases. *director is NULL if the study is
 * complete and nothing is to be done; then *result is its state. */
FRACAS_MUST_USE fracas_err fracas_director_create(const fracas_director_setup *setup,
                                                  fracas_director **director, fracas_err *result);
/* Releases the study. NULL is allowed. */
void fracas_director_destroy(fracas_director *director);

/* Acts on a message of a worker. An error drains the run and becomes its result. */
void fracas_director_receive(fracas_director *director, size_t worker,
                             const fracas_packet *message);

/* Acts on the time; cheap enough to be called after every wait.
 *   Idle workers get copies of overdue leases.
 *   The run drains when no lease is predicted to end before the deadline with time to write it.
 *   Leases are killed 2 s (and the time of all commits) before the deadline.
 *   A worker silent for 10 s after STOP counts as ended when everything is durable, or at the
 *   deadline. */
void fracas_director_tick(fracas_director *director);

/* Gives out no more leases and lets every worker finish. */
void fracas_director_drain(fracas_director *director);

/* Notes an event in the index. */
void fracas_director_note(fracas_director *director, const char *kind, const char *text);

/* True when every worker has ended. */
bool fracas_director_over(const fracas_director *director);

/* Then: writes study.h5 if the plan is complete (and there is time for it). FRACAS_OK,
 * FRACAS_SOME_FAILED, FRACAS_INTERRUPTED (also for a complete part of an incomplete study), or the
 * first error of the run. */
FRACAS_MUST_USE fracas_err fracas_director_finish(fracas_director *director);

#endif
