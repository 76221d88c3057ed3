/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rank 0's part of a run: gives out leases, commits segments, decides when the run is over and how
 * it ended. It talks to workers (a worker = a rank with its compute server) through a function, and
 * knows nothing of MPI. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_H
#define FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/launch/voice.h"
#include "campaigns/scheduler/packet.h"
#include "campaigns/scheduler/run.h"

#include <stdbool.h>

/* Sends a message to a worker; one whose server is gone is no error, its LOST or TROUBLE comes. */
typedef fracas_err fracas_director_send(void *context, size_t worker, const fracas_packet *message);

typedef struct {
    const fracas_campaign *campaign;
    const fracas_run_options *options;
    const char *study;
    size_t workers;
    fracas_director_send *send;
    void *context;
    fracas_voice *voice;
    double (*now)(void); /* s, of a clock that only grows: fracas_now */
    double deadline;     /* by that clock: when the run must have ended; 0: any time */
} fracas_director_setup;

typedef struct fracas_director fracas_director;

/* Prepares the study (fracas_study_prepare) and the leases. `setup` is copied, what it points to
 * must live on. *director is NULL when there is nothing to do: the study is settled, and *verdict
 * says how. */
FRACAS_MUST_USE fracas_err fracas_director_create(const fracas_director_setup *setup,
                                                  fracas_director **director, fracas_err *verdict);
/* Releases the study. NULL is allowed. */
void fracas_director_destroy(fracas_director *director);

/* Acts on a message of a worker. Whatever goes wrong here drains the run and becomes its verdict.
 */
void fracas_director_hear(fracas_director *director, size_t worker, const fracas_packet *message);

/* What time brings, cheap enough to be called after every wait:
 *   leases that are overdue are given to workers that have nothing to do as well;
 *   no lease is given that is not predicted to end by the deadline, with time to write what is in
 * memory; when nobody has one any more, the run drains; what runs 2 s before the deadline (and as
 * long as workers take to be committed) is killed; a worker that has not ended 10 s after it was
 * told to stop counts as ended when everything is durable, or at the deadline. */
void fracas_director_tick(fracas_director *director);

/* Gives out no more leases and has every worker finish; once is enough. */
void fracas_director_drain(fracas_director *director);

/* Notes something in the index. */
void fracas_director_note(fracas_director *director, const char *kind, const char *text);

/* True when every worker has ended. */
bool fracas_director_over(const fracas_director *director);

/* Then: writes study.h5 if the plan is complete (and there is time for it), and tells how the run
 * ended: FRACAS_OK, FRACAS_SOME_FAILED, FRACAS_INTERRUPTED (also of a part that is complete, where
 * the study is not) or what went wrong. */
FRACAS_MUST_USE fracas_err fracas_director_finish(fracas_director *director);

#endif
