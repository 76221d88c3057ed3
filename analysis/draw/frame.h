/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How large a surface is drawn, and where. */
#ifndef FRACAS_ANALYSIS_DRAW_FRAME_H
#define FRACAS_ANALYSIS_DRAW_FRAME_H

#include "analysis/draw/trail.h"

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
