/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run costs rank 0: how busy it is, with what, and how long the parts of a run take. The
 * index keeps it as the event `measured`. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TALLY_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TALLY_H

#include "campaigns/store/store.h"

typedef struct {
    double workers;
    double seconds;    /* s of rank 0 with the study */
    double planned;    /* s of those until leases could be given out */
    double computed;   /* s until every worker had ended */
    double merging;    /* s to write study.h5 */
    double giving;     /* s to choose leases, to note them in the index and to send them */
    double committing; /* s to commit segments */
    double cpu;        /* s of CPU time in all of this */
    double memory;     /* bytes, most of rank 0 */
    double messages, leases, commits, rows; /* heard; given out; of segments; in these */
} fracas_tally;

/* Begins with `seconds` and `cpu` as fracas_tally_end needs them. */
void fracas_tally_begin(fracas_tally *tally);
/* s since fracas_tally_begin. */
double fracas_tally_time(const fracas_tally *tally);
/* Fills seconds, cpu and memory; once. */
void fracas_tally_end(fracas_tally *tally);

/* As an event: `workers 4, seconds 12.5, ...`. */
FRACAS_MUST_USE fracas_err fracas_tally_note(const fracas_tally *tally, fracas_index *index);
/* The latest of a study; *found is false, and all of it 0, if there is none. */
FRACAS_MUST_USE fracas_err fracas_tally_read(fracas_index *index, bool *found, fracas_tally *tally);

#endif
