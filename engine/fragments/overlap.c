/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/fragments/overlap.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { CORNERS = 3, CUT = 2 * CORNERS }; /* a triangle cut by a triangle has six corners at most */

typedef struct {
    double corner[CORNERS][2]; /* m, anticlockwise; of a line the ends */
    double low[2], high[2];    /* m, bounds */
    int64_t fragment;
} piece;

/* ---- areas ---- */

static double area_of(const double (*corner)[2], int count)
{
    double twice = 0;
    for (int k = 2; k < count; k++)
        twice += (corner[k - 1][0] - corner[0][0]) * (corner[k][1] - corner[0][1]) -
                 (corner[k - 1][1] - corner[0][1]) * (corner[k][0] - corner[0][0]);
    return 0.5 * twice;
}

/* Distance of x to the left of the line from a to b, by its length [m2]. */
static double left_of(const double a[2], const double b[2], const double x[2])
{
    return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
}

/* Keeps the part to the left of the line from a to b: the number of its corners. */
static int cut(double (*corner)[2], int count, const double a[2], const double b[2])
{
    double left[CUT + 1][2];
    int kept = 0;
    for (int k = 0; k < count; k++) {
        const double *from = corner[k], *to = corner[(k + 1) % count];
        const double begin = left_of(a, b, from), end = left_of(a, b, to);
        if (begin >= 0) {
            left[kept][0] = from[0];
            left[kept++][1] = from[1];
        }
        if (begin * end < 0) {
            const double share = begin / (begin - end);
            for (int i = 0; i < 2; i++) left[kept][i] = from[i] + share * (to[i] - from[i]);
            kept++;
        }
    }
    for (int k = 0; k < kept; k++)
        for (int i = 0; i < 2; i++) corner[k][i] = left[k][i];
    return kept;
}

static double common_area(const piece *p, const piece *q)
{
    double corner[CUT + 1][2];
    int count = CORNERS;
    for (int k = 0; k < CORNERS; k++)
        for (int i = 0; i < 2; i++) corner[k][i] = p->corner[k][i];
    for (int k = 0; k < CORNERS && count > 0; k++)
        count = cut(corner, count, q->corner[k], q->corner[(k + 1) % CORNERS]);
    return fmax(0, area_of((const double(*)[2])corner, count));
}

static double common_length(const piece *p, const piece *q)
{
    return fmin(p->high[0], q->high[0]) - fmax(p->low[0], q->low[0]);
}

/* ---- elements ---- */

/* Whether all nodes have one value of the coordinate, to rounding of the largest. */
static bool is_constant(const fracas_fields *fields, int coordinate)
{
    double low = INFINITY, high = -INFINITY, size = 0;
    for (size_t k = 0; k < fields->elements * fields->corners; k++) {
        const double *x = fields->place[k];
        low = fmin(low, x[coordinate]);
        high = fmax(high, x[coordinate]);
        for (int i = 0; i < 3; i++) size = fmax(size, fabs(x[i]));
    }
    return high - low <= 1e-12 * size;
}

static void make_piece(const fracas_fields *fields, size_t e, int corners, piece *p)
{
    const double(*x)[3] = (const double(*)[3])fields->place + e * fields->corners;
    *p = (piece){.low = {INFINITY, INFINITY},
                 .high = {-INFINITY, -INFINITY},
                 .fragment = fields->fragment[e]};
    for (int k = 0; k < corners; k++)
        for (int i = 0; i < 2; i++) {
            p->corner[k][i] = x[k][i];
            p->low[i] = fmin(p->low[i], x[k][i]);
            p->high[i] = fmax(p->high[i], x[k][i]);
        }
    if (corners < CORNERS || area_of((const double(*)[2])p->corner, CORNERS) >= 0) return;
    for (int i = 0; i < 2; i++) { /* the other way round */
        const double kept = p->corner[1][i];
        p->corner[1][i] = p->corner[2][i];
        p->corner[2][i] = kept;
    }
}

static int by_low(const void *a, const void *b)
{
    const double x = ((const piece *)a)->low[0], y = ((const piece *)b)->low[0];
    return (x > y) - (x < y);
}

/* Common area of pieces of different fragments, in the order of `low`. */
static double sum_common(const piece *p, size_t count, int corners)
{
    double sum = 0;
    for (size_t a = 0; a < count; a++)
        for (size_t b = a + 1; b < count && p[b].low[0] < p[a].high[0]; b++) {
            if (p[a].fragment == p[b].fragment) continue;
            if (corners < CORNERS) sum += common_length(&p[a], &p[b]);
            else if (p[b].low[1] < p[a].high[1] && p[a].low[1] < p[b].high[1])
                sum += common_area(&p[a], &p[b]);
        }
    return sum;
}

/* (fragments.9) */
fracas_err fracas_fragments_overlap(const fracas_fields *fields, double *overlap)
{
    const int corners = fields->corners < CORNERS ? 2 : CORNERS;
    double whole = 0;
    *overlap = NAN;
    if (!is_constant(fields, 2) || (corners < CORNERS && !is_constant(fields, 1))) return FRACAS_OK;
    OWNED piece *p = malloc(fields->elements * sizeof *p);
    if (!p) return fracas_no_memory("the overlap of fragments");
    for (size_t e = 0; e < fields->elements; e++) {
        make_piece(fields, e, corners, &p[e]);
        whole += corners < CORNERS ? p[e].high[0] - p[e].low[0]
                                   : area_of((const double(*)[2])p[e].corner, CORNERS);
    }
    qsort(p, fields->elements, sizeof *p, by_low);
    *overlap = sum_common(p, fields->elements, corners) / whole;
    return FRACAS_OK;
}
