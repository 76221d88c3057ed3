/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The index of a study: SQLite. */
#ifndef FRACAS_CAMPAIGNS_STORE_INDEX_H
#define FRACAS_CAMPAIGNS_STORE_INDEX_H

#include "base/own.h"
#include "campaigns/points.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/summary.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct fracas_index fracas_index;

typedef enum {
    FRACAS_PLANNED,
    FRACAS_LEASED,
    FRACAS_DONE,
    FRACAS_FAILED_ROW,
    FRACAS_QUARANTINED
} fracas_row_status;

typedef struct {
    size_t point; /* index in the table given to fracas_index_plan */
    int64_t replica;
    fracas_row_status status;
    int64_t attempts;
} fracas_index_row;

/* A row of a segment as it goes into the index. */
typedef struct {
    fracas_hash point;
    int64_t replica;
    int64_t row; /* in the segment */
    fracas_summary summary;
} fracas_segment_row;

/* Opens (with `create`: creates) STUDY/index.sqlite. Journal: WAL with synchronous FULL on local
 * filesystems, TRUNCATE with FULL and exclusive locking on network ones; the mode is read back.
 * Without `create` it is opened to read, and no statement can change it. A file without a table
 * counts as none. FRACAS_DAMAGED says how to go on. */
FRACAS_MUST_USE fracas_err fracas_index_open(const char *study, bool create, fracas_index **index);
void fracas_index_close(fracas_index *index); /* NULL is allowed */
FRACAS_OWNER(fracas_index, fracas_index_close)

/* True if STUDY/index.sqlite has tables of ours; a run killed at its start leaves one without. */
bool fracas_index_exists(const char *study);
/* True if STUDY/index.sqlite is there, has bytes, and is neither an index nor one begun. */
bool fracas_index_is_foreign(const char *study);

/* Claims the study for the header's program version, seed, history and interfaces, before anything
 * is computed. FRACAS_DAMAGED names the first value in which the study's beginning differs:
 * study.h5 has one of each. */
FRACAS_MUST_USE fracas_err fracas_index_claim(fracas_index *index,
                                              const fracas_file_header *header);

/* Part K of N of the campaign, computed in this study (`fracas run --part`), durable on return. 1
 * of 1, also the default, is all of it. */
FRACAS_MUST_USE fracas_err fracas_index_set_part(fracas_index *index, int part, int parts);
FRACAS_MUST_USE fracas_err fracas_index_part(fracas_index *index, int *part, int *parts);

/* Adds the missing points and realizations of the table (status planned). Turns leased rows back to
 * planned: the caller has the lock, so their holder is gone. */
FRACAS_MUST_USE fracas_err fracas_index_plan(fracas_index *index, const fracas_point_table *table);
/* Every realization of the table in plan order; *row freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_index_rows(fracas_index *index, const fracas_point_table *table,
                                             fracas_index_row **row, size_t *count);
/* One transaction, durable on return: the segment and its rows, which become done (or failed for
 * outcome FAILED). A row that is done already keeps its first segment; the same commit twice
 * changes nothing. `segment`: file name in STUDY/segments, with its .h5. `provenance`: one JSON
 * object (host, pid, versions, CPU, instruction set, lanes, wall times); never in study.h5. */
FRACAS_MUST_USE fracas_err fracas_index_commit(fracas_index *index, const char *segment,
                                               const fracas_file_seal *seal,
                                               const fracas_segment_row *row, size_t count,
                                               const char *provenance);
/* Calls `say` with each realization of the table with status failed or quarantined, in plan order,
 * and the reason ("" if none was given). */
FRACAS_MUST_USE fracas_err fracas_index_failures(
    fracas_index *index, const fracas_point_table *table,
    void (*say)(void *context, const fracas_index_row *row, const char *reason), void *context);
/* Marks the planned ones among `count` replicas from `replica` on as leased. Not durable: the next
 * plan undoes it. */
FRACAS_MUST_USE fracas_err fracas_index_lease(fracas_index *index, const fracas_hash *point,
                                              int64_t replica, int64_t count);
/* Counts an attempt of one realization without a record, and keeps the reason. With `final` the
 * realization becomes failed (in study.h5 outcome FAILED, values NaN), else planned. */
FRACAS_MUST_USE fracas_err fracas_index_fail(fracas_index *index, const fracas_hash *point,
                                             int64_t replica, const char *reason, bool final);
/* Appends to the table `event` (time of day, kind, text). */
FRACAS_MUST_USE fracas_err fracas_index_event(fracas_index *index, const char *kind,
                                              const char *text);
/* FRACAS_DAMAGED, with the remedy, if it has points that are not in the campaign's table: one of
 * the two is damaged, or campaign.yaml was edited. */
FRACAS_MUST_USE fracas_err fracas_index_check_points(fracas_index *index,
                                                     const fracas_point_table *table);
/* The text of the latest event of a kind, NULL if there is none; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_index_last_event(fracas_index *index, const char *kind,
                                                   char **text);

/* Calls `say` with the time of day (UTC), kind and text of every event, oldest first. */
FRACAS_MUST_USE fracas_err fracas_index_events(fracas_index *index,
                                               void (*say)(void *context, const char *time,
                                                           const char *kind, const char *text),
                                               void *context);

/* ---- decisions in the index ---- */

/* Status of a realization, place of its bytes, and its summary (0 and NaN before it is done). */
typedef struct {
    fracas_row_status status;
    int64_t segment; /* id, 0 if it has none */
    int64_t row;
    fracas_summary summary;
} fracas_row_place;

/* row[r] of the replicas 0 to count - 1 of a point. FRACAS_DAMAGED if one was never planned. */
FRACAS_MUST_USE fracas_err fracas_index_summaries(fracas_index *index, const fracas_hash *point,
                                                  size_t count, fracas_row_place *row);

/* row[r - first] = replica r of the point, r from `first` to point->replicas - 1; `p`: number of
 * the point in the table. */
FRACAS_MUST_USE fracas_err fracas_index_rows_from(fracas_index *index,
                                                  const fracas_point_row *point, size_t p,
                                                  int64_t first, fracas_index_row *row);

/* The recorded decisions of a point by round, `point` left 0; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_index_decisions(fracas_index *index, const fracas_hash *point,
                                                  fracas_decision **decision, size_t *count);

/* Begins and ends a transaction, which waits for the disk once. The end commits if `err` is
 * FRACAS_OK, else it takes all back and returns `err`. */
FRACAS_MUST_USE fracas_err fracas_index_begin(fracas_index *index);
FRACAS_MUST_USE fracas_err fracas_index_end(fracas_index *index, fracas_err err);

/* Within a transaction: records the decision, in place of this and any later round of the point,
 * with the reason in words. Plans point->replicas of it; a decision to stop deletes the rows
 * beyond. */
FRACAS_MUST_USE fracas_err fracas_index_decide(fracas_index *index, const fracas_point_row *point,
                                               const fracas_decision *decision, const char *reason);

typedef struct {
    int64_t points, realizations, done, failed, planned, leased; /* realizations by status */
    int64_t outcome[FRACAS_NOUTCOMES];
    int64_t segments, bytes; /* segments, and their bytes */
} fracas_index_counts;

/* Counts a realization with this outcome, -1: none yet. */
void fracas_index_counts_add(fracas_index_counts *counts, fracas_row_status status,
                             int64_t outcome);
/* Realizations to be computed. */
static inline int64_t fracas_index_missing(const fracas_index_counts *counts)
{
    return counts->planned + counts->leased;
}

FRACAS_MUST_USE fracas_err fracas_index_count(fracas_index *index, fracas_index_counts *counts);
FRACAS_MUST_USE fracas_err fracas_index_count_segments(fracas_index *index, int64_t *segments,
                                                       int64_t *bytes);
/* The same, and of each point of the table (table->npoints of them; segments and bytes 0), by one
 * look at every realization. */
FRACAS_MUST_USE fracas_err fracas_index_count_points(fracas_index *index,
                                                     const fracas_point_table *table,
                                                     fracas_index_counts *counts,
                                                     fracas_index_counts *point);

/* Visits every realization of the table's points in the index, all at one moment: replicas of a
 * point one after the other, from 0. */
typedef fracas_err fracas_index_visit(void *context, size_t point, int64_t replica,
                                      const fracas_row_place *place);
FRACAS_MUST_USE fracas_err fracas_index_each(fracas_index *index, const fracas_point_table *table,
                                             fracas_index_visit *visit, void *context);

/* The latest run on the study, by the clocks of its hosts. */
typedef struct {
    double began;    /* s since 1970, when it began to compute; NaN: no run did */
    double latest;   /* end of its latest segment; NaN: it has none yet */
    int64_t segment; /* its first; the ids of the others are above */
} fracas_latest_run;
FRACAS_MUST_USE fracas_err fracas_index_latest_run(fracas_index *index, fracas_latest_run *run);

#endif
