/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From values to places on a page, and the ticks of an axis. */
#ifndef FRACAS_ANALYSIS_DRAW_SCALE_H
#define FRACAS_ANALYSIS_DRAW_SCALE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    bool log;
    double low, high; /* values at the ends; low > 0 if log */
    double from, to;  /* places of low and high, in pixels */
} fracas_scale;

enum { FRACAS_MAX_TICKS = 96 };

typedef struct {
    double value;
    char label[32]; /* "": a minor tick */
} fracas_tick;

/* Among 1, 2, 5 times a power of ten the smallest at or above `value` > 0 (up), or the greatest at
 * or below it (down); a hair's breadth beyond counts as on it. */
double fracas_scale_nice(double value, bool up);

/* Ends around [least, greatest] but for a fiftieth of a step: multiples of a step of about a fifth
 * of the range, 1, 2 or 5 times a power of ten, or, for a log axis, members of the 1-2-5 series.
 * Equal ends are put apart. */
void fracas_scale_fit(fracas_scale *scale, bool log, double least, double greatest);

/* True of a power of ten. */
bool fracas_scale_decade(double value);

/* Pixels of a value. */
double fracas_scale_place(const fracas_scale *scale, double value);

/* The ticks, at most FRACAS_MAX_TICKS; returns how many. Log axes: a label each decade (each few
 * where there would be more than seven, or less than 26 pixels for each), 1-2-5 where there are
 * fewer than two. */
size_t fracas_scale_ticks(const fracas_scale *scale, fracas_tick *tick);

#endif
