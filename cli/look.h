/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A look at a study, which a run may be computing: for `status` and for those who wait for its end.
 */
#ifndef FRACAS_CLI_LOOK_H
#define FRACAS_CLI_LOOK_H

#include "analysis/summary/unfinished.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/lease.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/lock.h"

/* A realization that computes for long, by its checkpoint. */
typedef struct {
    size_t point;
    double age; /* the checkpoint is so old [s] */
    fracas_checkpoint_head head;
} fracas_long_one;

typedef struct {
    const char *study;
    const fracas_campaign *campaign;
    fracas_index *index;
    bool complete;          /* study.h5 is of this campaign and nothing is left to compute */
    fracas_lock_state lock; /* held: a run computes it now */
    char holder[FRACAS_HOLDER_TEXT]; /* the lock's */
    int part, parts;                 /* its part of the campaign */
    int64_t part_all, part_left;     /* realizations of the part, and its uncomputed ones */
    fracas_unfinished running;
    size_t nlong, room;
    fracas_long_one *long_one;
    double rate, left; /* 1/s; s; NaN: no run computes it, or nothing is done by that yet */
} fracas_look;

/* `campaign` is that of the study; `cost` that of a realization of each point, in any unit; NULL:
 * all are alike. Nothing is changed. Cleared by the caller, after an error too. FRACAS_IN_USE if
 * the index cannot be read while a run has it (network filesystems). */
FRACAS_MUST_USE fracas_err fracas_look_take(const char *study, const fracas_campaign *campaign,
                                            const double *cost, fracas_look *look);
void fracas_look_clear(fracas_look *look);

/* Sets rate and left of such a look anew, by costs. */
void fracas_look_pace(fracas_look *look, const double *cost);

/* The cost for that, freed by the caller; NULL where it takes longer than so many seconds. */
FRACAS_MUST_USE fracas_err fracas_look_costs(const fracas_campaign *campaign, double seconds,
                                             double **cost);

/* A run computes it, as far as anybody knows. */
bool fracas_look_going(const fracas_look *look);
/* Everything is computed (of its part), and no run has it any more. */
bool fracas_look_over(const fracas_look *look);
/* "being computed", "complete", "interrupted: `fracas run ...` resumes it" */
enum { FRACAS_STATE_TEXT = 5000 };
const char *fracas_look_state(const fracas_look *look, char text[FRACAS_STATE_TEXT]);
/* Its realizations, for fracas_counts_describe. */
fracas_counts fracas_look_counts(const fracas_look *look);

/* ---- looks at intervals ---- */

/* Shows one look. `last`: none will follow. */
typedef fracas_err fracas_look_show(void *context, const fracas_look *look, bool last);

/* Looks every `interval` seconds, and once at the end: when the study is computed (FRACAS_OK, or
 * FRACAS_SOME_FAILED), or no run has had it for five looks (FRACAS_INTERRUPTED). A campaign that is
 * extended meanwhile is read again. */
FRACAS_MUST_USE fracas_err fracas_watch(const char *study, double interval, fracas_look_show *show,
                                        void *context);

/* Options of commands that watch; `every`: the interval where none is given. */
#define FRACAS_INTERVAL_OPTION(every)                                       \
    {                                                                       \
        "interval", "TIME", "time between two looks, as 5s, 1m (" every ")" \
    }
/* *seconds: --interval. FRACAS_USAGE for one without the option `watch` of the command. */
struct fracas_arguments;
FRACAS_MUST_USE fracas_err fracas_watch_interval(const struct fracas_arguments *arguments,
                                                 const char *watch, double *seconds);

/* ---- the views of status ---- */

/* JSON on `out`; `line`: in one line. */
FRACAS_MUST_USE fracas_err fracas_look_write_json(const fracas_look *look, bool line, FILE *out);
/* The text format of Prometheus, whole or not at all (docs/formats/status.md). */
FRACAS_MUST_USE fracas_err fracas_look_write_prometheus(const fracas_look *look, const char *path);

/* On a terminal a map, drawn in place; elsewhere a line each. A fracas_look_show. */
typedef struct {
    int lines, columns, rows; /* drawn so far, and the terminal's size then */
    bool json;
    const char *prometheus; /* file, NULL: none */
} fracas_watch_view;
FRACAS_MUST_USE fracas_err fracas_watch_show(void *view, const fracas_look *look, bool last);

#endif
