/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Timings of rank 0: its load, and the duration of the parts of a run. The index keeps them as the
 * event `measured`. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_TIMINGS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_TIMINGS_H

#include "campaigns/store/index.h"

typedef struct {
    double workers;
    double seconds;                         /* wall time of rank 0 with the study [s] */
    double planned;                         /* part before the first lease [s] */
    double computed;                        /* part before the end of the last worker [s] */
    double merging;                         /* spent on writing study.h5 [s] */
    double giving;                          /* spent on choosing, noting and sending leases [s] */
    double committing;                      /* spent on committing segments [s] */
    double cpu;                             /* processor time in all of this [s] */
    double memory;                          /* maximum of rank 0 [bytes] */
    double messages, leases, commits, rows; /* received; given out; of segments; in these */
} fracas_timings;

/* Sets `seconds` and `cpu` as fracas_timings_end needs them. */
void fracas_timings_begin(fracas_timings *timings);
/* Seconds since fracas_timings_begin. */
double fracas_timings_time(const fracas_timings *timings);
/* Sets seconds, cpu and memory; once. */
void fracas_timings_end(fracas_timings *timings);

/* Notes the event `workers 4, seconds 12.5, ...`. */
FRACAS_MUST_USE fracas_err fracas_timings_note(const fracas_timings *timings, fracas_index *index);

#endif
