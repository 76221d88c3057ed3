/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study as the rest of the room sees it: every point with its statistics. */
#ifndef FRACAS_ANALYSIS_SUMMARY_STUDY_H
#define FRACAS_ANALYSIS_SUMMARY_STUDY_H

#include "analysis/analysis.h"
#include "analysis/data/columns.h"
#include "analysis/data/text.h"
#include "analysis/summary/axes.h"
#include "analysis/summary/ordinates.h"
#include "analysis/summary/statistics.h"
#include "campaigns/store/results.h"

/* Results that several parts of a report need and that take long. */
typedef struct {
    void *crossovers; /* an array of fracas_size_crossover; NULL: not yet fitted */
    size_t ncrossovers;
} fracas_kept;

struct fracas_analysis {
    fracas_kept *kept; /* NULL: each part computes them */
    char *name;        /* for the study's folder */
    fracas_file_header header;
    const fracas_point_table *table;
    fracas_columns shown;   /* columns by which the points differ */
    fracas_means_axes axes; /* for the figures of means */
    bool asked;             /* for the ordinates, by a user */
    bool common;            /* points have common random numbers, as far as is known */
    size_t nordinates;      /* statistics drawn against them, beside size and count */
    fracas_ordinate ordinate[FRACAS_MOST_ORDINATES];
    bool *drawn;                    /* points with figures of their own; NULL: all */
    fracas_point_statistics *point; /* table->npoints of them */
    fracas_decision *decision; /* last of each point; replicas 0: they were given, NULL: all were */
    fracas_results *results;   /* open as long as the analysis: it owns the table */
};

/* More points than this do not all have figures of their own: so many have. */
enum { FRACAS_ALL_DRAWN = 16, FRACAS_FEW_DRAWN = 6 };

/* Chooses FRACAS_FEW_DRAWN points, whose mean counts are evenly ranked from the least to the
 * greatest, of more than FRACAS_ALL_DRAWN. */
FRACAS_MUST_USE fracas_err fracas_analysis_choose_points(fracas_analysis *analysis);
/* Points of a list, "3,17,20-25", in its order. FRACAS_USAGE, with the part that is wrong, for
 * anything else. *point freed by the caller with free(), after an error too. */
FRACAS_MUST_USE fracas_err fracas_points_listed(const char *list, size_t npoints, size_t **point,
                                                size_t *count);
/* Whether the point has figures of its own, and how many have. */
bool fracas_analysis_draws(const fracas_analysis *analysis, size_t point);
size_t fracas_analysis_ndrawn(const fracas_analysis *analysis);

/* How far the study, or a point of it, is. */
typedef struct {
    int64_t planned; /* realizations; where a rule decides their number, those asked for by now */
    int64_t done;    /* present, whatever their outcome */
    int64_t failed;  /* FAILED ones; they are present, too, as rows of NaN */
    int64_t missing; /* done, but their segment is missing or damaged */
    bool ended;      /* all are done or FAILED, and the rule, if there is one, asks for no more */
    bool complete;   /* ended, and none FAILED */
} fracas_progress;

extern const fracas_fields fracas_progress_fields; /* planned, done, failed, missing, complete */

fracas_progress fracas_analysis_progress_of(const fracas_analysis *analysis, size_t point);
fracas_progress fracas_analysis_progress(const fracas_analysis *analysis); /* all points together */

/* "partial: 120 of 256 realizations done, 2 FAILED, 8 missing"; false, and no text, of a study
 * whose study.h5 is of everything. */
bool fracas_analysis_partial(const fracas_analysis *analysis, char *text, size_t size);

/* The last decision on the replicas of a point, NULL if they were given; and its quantity,
 * "mean-count". */
const fracas_decision *fracas_analysis_decision(const fracas_analysis *analysis, size_t point);
const char *fracas_analysis_quantity(const fracas_decision *decision);

/* "24 replicas in 3 rounds, ...": how the replicas of a point were decided; false, and no text, if
 * they were given. */
bool fracas_analysis_decided(const fracas_analysis *analysis, size_t point, char *text,
                             size_t size);

/* Something a reader must know before trusting a number. */
typedef struct {
    size_t point;     /* SIZE_MAX: the study as a whole */
    const char *kind; /* one word */
    double badness;   /* the larger of two of a kind is the worse */
    char text[480];
} fracas_warning;

extern const fracas_fields fracas_warning_fields; /* point, kind, text */

/* Every warning of the study in the order of its points; *warning freed by the caller with free().
 */
FRACAS_MUST_USE fracas_err fracas_analysis_warnings(const fracas_analysis *analysis,
                                                    fracas_warning **warning, size_t *count);

/* For a reader: a line a kind, with the number of its points, and the label and text of the worst.
 */
typedef struct {
    char text[sizeof(fracas_label) + sizeof((fracas_warning){0}.text) + 80];
} fracas_warning_line;

/* *line freed by the caller with free(). */
FRACAS_MUST_USE fracas_err fracas_analysis_warning_lines(const fracas_analysis *analysis,
                                                         fracas_warning_line **line, size_t *count);

/* True if some point, or every one, is a surface. */
bool fracas_analysis_any_surface(const fracas_analysis *analysis);
bool fracas_analysis_all_surfaces(const fracas_analysis *analysis);
/* True if some point is warned of its dust. */
bool fracas_analysis_much_dust(const fracas_analysis *analysis);

/* "rate 1e4 1/s": the point by its varying parameters; "" of the study as a whole, SIZE_MAX. */
fracas_label fracas_analysis_label(const fracas_analysis *analysis, size_t point);

#endif
