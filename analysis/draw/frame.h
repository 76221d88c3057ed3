/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A panel of a chart while it is drawn: frame.c draws its series, draw.c all else. */
#ifndef FRACAS_ANALYSIS_DRAW_FRAME_H
#define FRACAS_ANALYSIS_DRAW_FRAME_H

#include "analysis/draw/chart.h"
#include "analysis/draw/scale.h"

#define FRACAS_LINE_START "<path class=\"line\" stroke-dasharray=\"%s\" d=\""

typedef struct {
    fracas_panel panel; /* with the axes of this drawing; its series are the chart's */
    size_t number;
    bool page; /* on a page, for its script */
    FILE *out;
    fracas_scale x, y;
    double pad;                 /* from the ends of the scales to the frame */
    double top;                 /* width of the legend */
    double width;               /* for the chart */
    const fracas_panel *legend; /* series with entries, shared by small multiples; NULL: its own */
    bool inner_x, inner_y;      /* has no numbers there: others have them */
    fracas_tick xtick[FRACAS_MAX_TICKS], ytick[FRACAS_MAX_TICKS];
    size_t nxtick, nytick;
} fracas_frame;

/* The marks, bars, lines and areas of a series. */
void fracas_frame_draw(const fracas_frame *f, const fracas_series *series);

/* The path of a mark about (x, y), and the dashes of a line, by their look. */
void fracas_frame_mark(unsigned look, double x, double y, FILE *out);
const char *fracas_frame_dash(unsigned look);

#endif
