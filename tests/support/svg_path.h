/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Paths of our drawings, of M, l, q and z, read edge by edge. */
#ifndef FRACAS_TESTS_SUPPORT_SVG_PATH_H
#define FRACAS_TESTS_SUPPORT_SVG_PATH_H

#include "tests/support/test.h"

/* From where to where, in units of the drawing; `control` is of a parabola. */
typedef struct {
    double from[2], to[2], control[2];
    bool curved, closes; /* by z, back to where its line begins */
} svg_edge;

typedef struct {
    const char *data;
    double at[2], first[2];
    char command;
    size_t lines; /* begun */
} svg_pen;

/* The pen at the begin of the path element `path`. */
static inline svg_pen svg_begin(const char *path)
{
    return (svg_pen){.data = strstr(path, " d=\"") + 4};
}

/* The next edge; false at the end of the path. */
static inline bool svg_next(svg_pen *pen, svg_edge *edge)
{
    for (; *pen->data && *pen->data != '"';) {
        double number[4] = {0};
        if (strchr("Mlqz ", *pen->data)) {
            if (*pen->data++ == ' ') continue;
            pen->command = pen->data[-1];
            if (pen->command != 'z') continue;
        } else {
            for (int i = 0; i < (pen->command == 'q' ? 4 : 2); i++)
                number[i] = strtod(pen->data, (char **)&pen->data);
        }
        *edge = (svg_edge){.curved = pen->command == 'q', .closes = pen->command == 'z'};
        for (int i = 0; i < 2; i++) {
            edge->from[i] = pen->at[i];
            edge->control[i] = pen->at[i] + number[i];
            edge->to[i] = pen->at[i] + number[edge->curved ? 2 + i : i];
            if (edge->closes) edge->to[i] = pen->first[i];
            if (pen->command == 'M') edge->to[i] = pen->first[i] = number[i];
            pen->at[i] = edge->to[i];
        }
        if (pen->command != 'M') return true;
        pen->lines++;
    }
    return false;
}

/* The area between the edge and the origin, counted positive clockwise on paper. A parabola has 2/3
 * of its triangle beside its chord. */
static inline double svg_area(const svg_edge *edge)
{
    const double *a = edge->from, *b = edge->to, *c = edge->control;
    const double beside = (c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0]);
    return (a[0] * b[1] - b[0] * a[1]) / 2 + (edge->curved ? beside / 3 : 0);
}

/* How often a text has the part. */
static inline size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, part)); at += strlen(part)) count++;
    return count;
}

#endif
