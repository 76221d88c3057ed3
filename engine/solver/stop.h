/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stop rules: when a realization is over. */
#ifndef FRACAS_ENGINE_SOLVER_STOP_H
#define FRACAS_ENGINE_SOLVER_STOP_H

#include "engine/record.h"
#include "engine/spec.h"

#include <stdbool.h>

extern const fracas_section fracas_time_section;
extern const fracas_kind fracas_stop_time, fracas_stop_settled, fracas_stop_transits,
    fracas_stop_quiet, fracas_stop_peak_multiple;

/* Memory of a lane's rule: the last step at which it was not quiet. */
typedef struct {
    double time, dissipated; /* s, J */
    int64_t events;          /* onsets and breaks */
    double peak, peak_time;  /* J, s: largest elastic energy so far */
    bool peaked;             /* it has fallen since */
} fracas_stop;

/* Fragments whose share the rest is measured by, where there are fewer: 0.3 of a break at 2 %. */
#define FRACAS_REST_FEWEST 15.0

/* Input of a rule. */
typedef struct {
    double time, elastic, dissipated; /* s, J */
    int64_t cracked, broken;
    bool look;               /* the following are known at this step, else 0 */
    double transits, growth; /* k, Delta */
    double rest;             /* R over the count or FRACAS_REST_FEWEST; 0 where it is unknown */
} fracas_progress;

/* True if the rule asks for the breaks that are still to come. */
bool fracas_stop_needs_rest(const fracas_time *rule);

/* Shows one step to the rule. True when the realization is over, with its *outcome.
 * `time`: at the first step at or after `end`.
 * `settled`: at a look after a break with k >= transits, Delta <= growth, R <= rest max(N, 15)
 * (settled.7).
 * `transits`: at a look after a break with k >= transits (settled.9).
 * `quiet`: after an onset, when for `quiet` seconds no interface cracked or broke and the
 * dissipated energy D grew by at most quiet_fraction D.
 * `peak-multiple`: at `multiple` times the time of the first peak of the elastic energy, a maximum
 * followed by a fall by more than `drop` of it.
 * All at `end` at the latest, with TIME_LIMIT if something has cracked, else INTACT. */
bool fracas_stop_check(fracas_stop *stop, const fracas_time *rule, const fracas_progress *now,
                       fracas_outcome *outcome);

#endif
