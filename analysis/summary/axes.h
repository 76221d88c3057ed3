/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the figures of means put a point: abscissa, series, drawing. */
#ifndef FRACAS_ANALYSIS_SUMMARY_AXES_H
#define FRACAS_ANALYSIS_SUMMARY_AXES_H

#include "analysis/data/columns.h"
#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>

struct fracas_analysis;

enum { FRACAS_MEANS_SERIES = 6, FRACAS_MEANS_PANELS = 12 }; /* most in a panel, in a drawing */

typedef struct {
    char key[64];   /* path of a parameter, key of a statistic; "": nothing to draw against */
    bool rate;      /* the strain rate: scaling laws and powers go with it */
    char words[96]; /* "Weibull modulus" */
    char label[96]; /* the same with its unit, of the axis */
    bool log;
    double *value;           /* one a point, in the unit of the axis; NaN: none */
    size_t nnames;           /* for a text: its values are 1, 2, ... nnames ... */
    const char **name;       /* ... with these names, which are the table's */
    fracas_columns series;   /* columns whose values make the series of a panel */
    fracas_columns panels;   /* columns whose values make the panels of a drawing */
    fracas_columns drawings; /* columns whose values make drawings of their own */
    fracas_columns all;      /* the columns of all three */
} fracas_means_axes;

/* Axes by keys; NULL: chosen. x is the strain rate if that varies, else the first varying parameter
 * of those that name the points, a number before a text. The others in which points of one x differ
 * are parted:
 * - One with at most FRACAS_MEANS_SERIES values makes series, with more values panels.
 * - Of several that are not combined with each other, as of cases, all together make the series,
 *   if these are few enough.
 * - Else the first with few enough values makes series, the next with at most FRACAS_MEANS_PANELS
 *   values panels, and the rest drawings.
 * FRACAS_USAGE for an unknown key, for one in which no points differ, with those that do, and for
 * one given twice. Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_means_axes_create(const struct fracas_analysis *analysis,
                                                    const char *x, const char *series,
                                                    const char *panels, fracas_means_axes *axes);
void fracas_means_axes_clear(fracas_means_axes *axes);

#endif
