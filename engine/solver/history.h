/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The history of one lane: rows at equal intervals of time.end, at first onset, energy peak and
 * end. */
#ifndef FRACAS_ENGINE_SOLVER_HISTORY_H
#define FRACAS_ENGINE_SOLVER_HISTORY_H

#include "engine/record.h"

#include "base/err.h"

#include <stdbool.h>

typedef struct {
    int64_t step;
    fracas_history_row row;
    size_t slot; /* where its values are */
} fracas_history_entry;

typedef struct {
    int64_t intervals;           /* equal ones of time.end; 0: events only */
    double end;                  /* s */
    int64_t next;                /* interval whose end is waited for */
    fracas_history_entry *entry; /* at equal intervals, in order */
    size_t count;
    bool cracked;
    double peak; /* J, largest elastic + cohesive so far */
    fracas_history_entry onset, highest, last;
    size_t width;  /* values kept with a row */
    double *value; /* [slot][width]: entries, then those of onset, highest, last */
} fracas_history;

FRACAS_MUST_USE fracas_err fracas_history_init(fracas_history *history, int64_t intervals,
                                               double end, size_t width);
void fracas_history_clear(fracas_history *history);

/* Empties it for a run from the start. */
void fracas_history_begin(fracas_history *history);

/* True if observing this row would keep it for more than the last one. */
bool fracas_history_keeps(const fracas_history *history, const fracas_history_row *row,
                          bool cracked);

/* Shows one step to the history: it is kept if it is the first at or after an interval's end, the
 * first with a crack, or the highest in potential energy so far. `cracked`: some interface has
 * cracked. `value`: what is kept beside the row, [width]; not read unless it is kept or the last.
 */
void fracas_history_observe(fracas_history *history, int64_t step, const fracas_history_row *row,
                            bool cracked, const double *value);

/* Rows in order of time, each step once, into the record, which owns them. *value, the caller's:
 * [row][width]; NULL without values. */
FRACAS_MUST_USE fracas_err fracas_history_harvest(const fracas_history *history,
                                                  fracas_record *record, double **value);
/* Doubles of history->value. */
static inline size_t fracas_history_values(const fracas_history *history)
{
    return ((size_t)history->intervals + 4) * history->width;
}

#endif
