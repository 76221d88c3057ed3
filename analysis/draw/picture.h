/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the fragments of a ring are: a picture of one realization. */
#ifndef FRACAS_ANALYSIS_DRAW_PICTURE_H
#define FRACAS_ANALYSIS_DRAW_PICTURE_H

#include "analysis/data/ring.h"
#include "analysis/summary/study.h"

#include <stdbool.h>
#include <stdio.h>

enum { FRACAS_MAX_PICTURES = 6 };

typedef struct {
    char file[64]; /* name of the SVG and CSV files without their endings */
    char title[256];
    char caption[1024];
    double exaggeration; /* drawn displacement / displacement, 1 or more */
    bool arrows;         /* few enough fragments for an arrow each */
    double fastest;      /* m/s, greatest relative speed, of the longest arrow */
    fracas_ring_pattern pattern;
} fracas_picture;

/* Points with a picture: all rings with a FRAGMENTED realization, or FRACAS_MAX_PICTURES evenly
 * spread over them, the first and the last among them. Returns their number. */
size_t fracas_picture_points(const fracas_analysis *analysis, size_t point[FRACAS_MAX_PICTURES]);

/* The first FRAGMENTED realization of such a point, read again from the study. Cleared by the
 * caller. */
FRACAS_MUST_USE fracas_err fracas_picture_create(const fracas_analysis *analysis, size_t point,
                                                 fracas_picture *picture);
void fracas_picture_clear(fracas_picture *picture);

/* 1, 2 or 5 times a power of ten, 1 or more: the greatest with a mean displacement, weighed by
 * size, of at most 0.4 radii and a largest of at most 0.8 radii; 1 where displacements outward are
 * rounding. */
double fracas_picture_exaggeration(const fracas_ring_pattern *pattern);

/* The <svg> element, as fracas_chart_write has it. */
void fracas_picture_write(const fracas_picture *picture, bool standalone, FILE *out);

/* A line a fragment, counter-clockwise. */
void fracas_picture_csv(const fracas_picture *picture, FILE *out);

#endif
