/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which headline numbers of a study a refined one moves, beyond what chance does. */
#ifndef FRACAS_ANALYSIS_CONVERGE_CONVERGE_H
#define FRACAS_ANALYSIS_CONVERGE_CONVERGE_H

#include "base/err.h"
#include "base/hash.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct fracas_convergence fracas_convergence;

/* Reads the study as it is. `tolerance` > 0: the part of a number within which it may change. */
FRACAS_MUST_USE fracas_err fracas_convergence_create(const char *study, double tolerance,
                                                     fracas_convergence **convergence);
void fracas_convergence_destroy(fracas_convergence *convergence); /* NULL is allowed */

typedef struct {
    const char *name, *doc; /* "mesh", "half the element size"; they outlive the convergence */
    bool paired;            /* replica r has the same strengths in both */
    size_t npoints;
    const fracas_hash *before; /* of each point, in the study as it is, and ... */
    const fracas_hash *after;  /* ... in the refined one */
} fracas_refinement_map;

/* Compares the refined study, point by point and number by number (count, count without dust where
 * there is dust, mean size, dissipated energy, its part of bending where there is one, time of
 * first onset): the difference of means with its 95 % interval, of pairs (compare.4) or by Welch
 * (compare.1), (compare.2), both in parts of the number as it is (convergence.1), and its p
 * (convergence.3); what is but rounding is no change (convergence.2). FRACAS_DAMAGED where a study
 * lacks a point. Points of which a study has no usable realization have rows without a change. */
FRACAS_MUST_USE fracas_err fracas_convergence_add(fracas_convergence *convergence,
                                                  const char *study,
                                                  const fracas_refinement_map *map);

/* Notes that a refinement could not be made of so many points, and why; the texts outlive the
 * convergence. Three times at most. */
void fracas_convergence_leave(fracas_convergence *convergence, const char *refinement,
                              size_t points, const char *why);

/* Says of every number, with p-values corrected by Holm over all of them (compare.10), whether it
 *   moved:   it differs, p below 0.05, and not surely within the tolerance
 *   shifted: it differs, but the interval of the difference is within the tolerance
 *   holds:   it does not differ, and that interval is within the tolerance
 *   unclear: it does not differ, but that interval is wider; more replicas would tell
 *   unknown: there is no interval, for want of realizations
 * Called once, after the last fracas_convergence_add, before what follows. */
FRACAS_MUST_USE fracas_err fracas_convergence_judge(fracas_convergence *convergence);

/* A line a number, and what it comes to; the same as JSON; and as FOLDER/converge.csv. */
FRACAS_MUST_USE fracas_err fracas_convergence_print(const fracas_convergence *convergence,
                                                    FILE *out);
void fracas_convergence_write_json(const fracas_convergence *convergence, FILE *out);
FRACAS_MUST_USE fracas_err fracas_convergence_write_csv(const fracas_convergence *convergence,
                                                        const char *folder);

/* FOLDER/report/: index.html, with a figure a headline number, each also as SVG, PDF and CSV, and
 * the table. `title` heads the page, and its figures and tables name it as what they are from. */
FRACAS_MUST_USE fracas_err fracas_convergence_write_page(const fracas_convergence *convergence,
                                                         const char *folder, const char *title);

#endif
