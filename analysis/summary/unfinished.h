/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study while it is computed, from the summaries in its index: how far each point is, and the
 * means of the report without the records. */
#ifndef FRACAS_ANALYSIS_SUMMARY_UNFINISHED_H
#define FRACAS_ANALYSIS_SUMMARY_UNFINISHED_H

#include "analysis/data/estimate.h"
#include "campaigns/points.h"
#include "campaigns/store/index.h"

typedef struct {
    fracas_index_counts counts;  /* segments and bytes 0 */
    int64_t computed;            /* by the latest run */
    fracas_estimate count, size; /* the numbers of fracas_point_statistics */
    size_t first;                /* its replica 0 among the states */
} fracas_unfinished_point;

typedef struct {
    fracas_index_counts all;
    fracas_latest_run run;
    size_t npoints, nstates, room;
    fracas_unfinished_point *point;
    fracas_row_status *state; /* by realization, replicas of a point side by side */
} fracas_unfinished;

/* Reads the index once. `going`: a run has the study, else its leases are to be computed again.
 * Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_unfinished_read(fracas_index *index,
                                                  const fracas_point_table *table, bool going,
                                                  fracas_unfinished *running);
void fracas_unfinished_clear(fracas_unfinished *running);

#endif
