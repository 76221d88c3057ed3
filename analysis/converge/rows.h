/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of a convergence, a row each. */
#ifndef FRACAS_ANALYSIS_CONVERGE_ROWS_H
#define FRACAS_ANALYSIS_CONVERGE_ROWS_H

#include "analysis/compare/compare.h"
#include "analysis/converge/converge.h"
#include "analysis/summary/study.h"
#include "analysis/export/tables.h"

typedef enum {
    FRACAS_NUMBER_MOVED,
    FRACAS_NUMBER_SHIFTED,
    FRACAS_NUMBER_HOLDS,
    FRACAS_NUMBER_UNCLEAR,
    FRACAS_NUMBER_UNKNOWN,
    FRACAS_NUMBER_VERDICTS
} fracas_number_verdict;
extern const char *const fracas_number_verdict_name[FRACAS_NUMBER_VERDICTS]; /* "moved", ... */

typedef struct {
    const char *refinement;
    size_t point; /* for the study as it is */
    const fracas_number *number;
    bool paired;
    fracas_compared_value value; /* its p: Student's, of the difference */
    fracas_number_verdict verdict;
} fracas_convergence_row;

#define FRACAS_CONVERGENCE_ROUND_OFF 1e-9 /* relative: smaller changes and scatter are rounding */

enum { FRACAS_MOST_LEFT = 4 }; /* refinements */

/* A remark on the realizations of a study, or of one point, to know before trusting its verdicts.
 */
typedef struct {
    const char *refinement; /* "base" of the study as it is */
    size_t point;           /* for the study as it is; SIZE_MAX: the study as a whole */
    char text[480];         /* "7 of 10 realizations ended ENERGY_DRIFT: judged from 3" */
} fracas_convergence_note;

struct fracas_convergence {
    fracas_analysis *study; /* as it is */
    double tolerance;
    size_t nrows, room;
    fracas_convergence_row *row;
    size_t nlevels; /* refinements with rows, in their order, found by fracas_convergence_judge */
    const char *level[FRACAS_MOST_LEFT];
    size_t nnotes, note_room;
    fracas_convergence_note *note;
    size_t nleft;
    struct {
        const char *refinement, *why;
        size_t points;
    } left[FRACAS_MOST_LEFT];
};

/* Adds the rows of one point, `before` in the study as it is, from the realizations of its refined
 * self. */
FRACAS_MUST_USE fracas_err fracas_convergence_compare(fracas_convergence *convergence,
                                                      size_t before, const fracas_ensemble *after,
                                                      const fracas_refinement_map *map);

/* Replicas n (h/(tolerance/2))^2 of every point, with h the half width of the row's relative change
 * from n replicas. With so many the half width would be half of the tolerance, and an unchanged
 * number holds in 19 of 20 cases (convergence.4). NaN without an interval. */
double fracas_convergence_replicas(const fracas_convergence *convergence,
                                   const fracas_convergence_row *row);

/* A line a row: refinement, point, number, its mean as it is and refined, change in per cent, in
 * half widths, verdict. */
FRACAS_MUST_USE fracas_err fracas_convergence_table_create(const fracas_convergence *convergence,
                                                           bool unicode,
                                                           fracas_result_table *table);

/* Takes the conclusions line by line: numbers moved by each refinement, points left out, notes,
 * replicas needed. */
typedef void fracas_convergence_line(void *context, const char *text);
void fracas_convergence_conclude(const fracas_convergence *convergence,
                                 fracas_convergence_line *line, void *context);

#endif
