/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Headline numbers of a study that refinement moves beyond chance. */
#ifndef FRACAS_ANALYSIS_CONVERGE_CONVERGE_H
#define FRACAS_ANALYSIS_CONVERGE_CONVERGE_H

#include "base/err.h"
#include "base/own.h"
#include "base/hash.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct fracas_convergence fracas_convergence;

/* Reads the study as it is. `tolerance` > 0: the part of a number within which it may change. */
FRACAS_MUST_USE fracas_err fracas_convergence_create(const char *study, double tolerance,
                                                     fracas_convergence **convergence);
void fracas_convergence_destroy(fracas_convergence *convergence); /* NULL is allowed */
FRACAS_OWNER(fracas_convergence, fracas_convergence_destroy)

typedef struct {
    const char *name, *doc; /* "mesh", "half the element size"; they outlive the convergence */
    bool paired;            /* replica r has the same strengths in both */
    size_t npoints;
    const fracas_hash *before; /* for each point, in the study as it is, and ... */
    const fracas_hash *after;  /* ... in the refined one */
} fracas_refinement_map;

/* Compares the refined study, point by point and number by number: count, count without dust, mean
 * size, dissipated energy, its part of bending, time of first onset. Computes the difference of
 * means with its 95 % interval, of pairs (compare.4) or by Welch (compare.1), (compare.2), both
 * relative to the base (convergence.1), and its p (convergence.3). Rounding is no change
 * (convergence.2). FRACAS_DAMAGED where a study lacks a point. A point without usable realizations
 * in one study has rows without a change. */
FRACAS_MUST_USE fracas_err fracas_convergence_add(fracas_convergence *convergence,
                                                  const char *study,
                                                  const fracas_refinement_map *map);

/* Notes why a refinement was not made of so many points; the texts outlive the convergence. Four
 * times at most. */
void fracas_convergence_leave(fracas_convergence *convergence, const char *refinement,
                              size_t points, const char *why);

/* Judges every number, with p-values corrected by Holm over all of them (compare.10):
 *   moved:   it differs, p below 0.05, and not surely within the tolerance
 *   shifted: it differs, but the interval of the difference is within the tolerance
 *   holds:   it does not differ, and the interval is within the tolerance
 *   unclear: it does not differ, but the interval is wider; more replicas would tell
 *   unknown: there is no interval, for want of realizations
 * Called once, after the last fracas_convergence_add and before the functions below. */
FRACAS_MUST_USE fracas_err fracas_convergence_judge(fracas_convergence *convergence);

/* A line a number and the conclusions, for a terminal of so many columns (0: any); the same as
 * JSON; and as FOLDER/converge.csv. */
FRACAS_MUST_USE fracas_err fracas_convergence_print(const fracas_convergence *convergence,
                                                    int columns, FILE *out);
void fracas_convergence_write_json(const fracas_convergence *convergence, FILE *out);
FRACAS_MUST_USE fracas_err fracas_convergence_write_csv(const fracas_convergence *convergence,
                                                        const char *folder);
/* FRACAS_USAGE if FOLDER has a converge.csv or files in report/ of another origin. */
FRACAS_MUST_USE fracas_err fracas_convergence_keeps(const char *folder);

/* FOLDER/report/: index.html, with a figure a headline number, each also as SVG, PDF and CSV, and
 * the table. `title` heads the page and is the source named by its figures and tables. */
FRACAS_MUST_USE fracas_err fracas_convergence_write_page(const fracas_convergence *convergence,
                                                         const char *folder, const char *title);

#endif
