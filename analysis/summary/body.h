/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The body of a point, as statistics need it. */
#ifndef FRACAS_ANALYSIS_SUMMARY_BODY_H
#define FRACAS_ANALYSIS_SUMMARY_BODY_H

#include "campaigns/points.h"

#include <stdbool.h>

typedef struct {
    bool surface;           /* a size is the square root of an area */
    double length;          /* m; of a ring its circumference; NaN of a surface */
    double radius;          /* m, of a ring; NaN of any other body */
    double lattice;         /* m, length of an element where all are equal: every size is a multiple
                               of it; 0: they are not */
    double fracture_energy; /* G_c [J/m2] at the mean strength */
} fracas_body;

/* Reads the parameters of the point. No other function of analysis knows models by their columns.
 */
fracas_body fracas_body_of(const fracas_point_table *table, size_t point);

#endif
