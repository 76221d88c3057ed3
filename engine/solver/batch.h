/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A batch step by step, for verification tests and benchmarks, which look at the state between
 * steps; fracas_batch_run does the same to the end. */
#ifndef FRACAS_ENGINE_SOLVER_BATCH_H
#define FRACAS_ENGINE_SOLVER_BATCH_H

#include "engine/formulation/formulation.h"
#include "engine/solver/guard.h"
#include "engine/solver/history.h"
#include "engine/solver/ledger.h"
#include "engine/solver/probes.h"
#include "engine/solver/settling.h"
#include "engine/solver/stop.h"

typedef struct {
    fracas_ledger ledger;
    fracas_history history;
    fracas_stop stop;
    fracas_settling settling;
    fracas_guard guard;
    int64_t stop_at; /* above 0: it ends at this step, the last with a sound balance (run_again) */
    int64_t steps;   /* done */
    double pace;     /* s, time step of the last steps ... */
    double since;    /* s, ... since this time ... */
    int64_t paces; /* ... and how many: time = since + paces pace, without the round-off of a sum */
    double first_break; /* s, seen at this time; 0: none yet */
    double notched;     /* J: dissipated, by the law, at a notch, before the start */
    int64_t counted;    /* breaks when the census was taken; -1: never */
    fracas_census census;
    bool running;
} fracas_lane;

struct fracas_batch {
    fracas_step step; /* first: it is aligned */
    const fracas_model *model;
    size_t count; /* realizations; lanes beyond them repeat lane 0 */
    const fracas_batch_watch *watch;
    fracas_spots spots; /* where its probes are */
    fracas_lane lane[FRACAS_LANES_MAX];
};

/* Checks the strengths and prepares every lane; then the state may be changed. */
FRACAS_MUST_USE fracas_err fracas_batch_begin(fracas_batch *batch);

/* Advances all lanes, their ledgers, histories and stop rules by one step. A finished lane leaves
 * its record and stops. *running: lanes left. */
FRACAS_MUST_USE fracas_err fracas_batch_step(fracas_batch *batch, fracas_record *record,
                                             size_t *running);

#endif
