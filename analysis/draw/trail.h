/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places of a mesh in a drawing, and its edges as an SVG path of few long lines. */
#ifndef FRACAS_ANALYSIS_DRAW_TRAIL_H
#define FRACAS_ANALYSIS_DRAW_TRAIL_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Where the nodes of a mesh are in a drawing, in its whole units. */
typedef struct {
    int32_t x, y;
} fracas_spot;

typedef struct {
    uint32_t node[2];
    int32_t middle; /* node half way along a curved edge, -1: it is straight */
} fracas_trail_edge;

typedef struct {
    size_t count, capacity;
    fracas_trail_edge *edge;
} fracas_trail;

FRACAS_MUST_USE fracas_err fracas_trail_add(fracas_trail *trail, const int64_t node[3],
                                            bool backwards);
void fracas_trail_clear(fracas_trail *trail);

/* Writes `<path class=... d=.../>` through every edge once; nothing without an edge. `closed`:
 * edges have a direction, as many end in a node as start there, and their loops are filled by the
 * even-odd rule; else either way round will do. */
FRACAS_MUST_USE fracas_err fracas_trail_write(const fracas_trail *trail, const fracas_spot *spot,
                                              bool closed, const char *class, FILE *out);

enum { FRACAS_FRAME_MARGIN = 8, FRACAS_FRAME_UNITS = 10 }; /* pixels; units of a drawing a pixel */

typedef struct {
    double scale;         /* pixels a metre */
    double width, height; /* extent of the drawing, pixels */
    double left;          /* pixels */
    double corner[2];     /* m: its least coordinate to the right, its largest one upward */
} fracas_frame;

/* The range from least to largest [m, right and up] fills the width of the picture [pixels], or 1.3
 * times the width upward. */
void fracas_frame_fit(const double least[2], const double largest[2], int width,
                      fracas_frame *frame);

/* Where a point is: its first two coordinates. */
fracas_spot fracas_frame_place(const fracas_frame *frame, const double *at);

#endif
