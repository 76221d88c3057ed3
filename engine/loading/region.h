/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A part of a body: what lies within limits along x, y, z, and in a ball. */
#ifndef FRACAS_ENGINE_LOADING_REGION_H
#define FRACAS_ENGINE_LOADING_REGION_H

#include <stdbool.h>

typedef struct {
    double from[3], to[3]; /* m; NaN: no limit */
    double at[3], within;  /* m: the middle of a ball and its radius; not above 0: no ball */
} fracas_region;

/* How far x lies beside it [m], at least: 0 within it. */
double fracas_region_beside(const fracas_region *region, const double x[3]);

/* x lies within it, or beside it by rounding alone. */
bool fracas_region_has(const fracas_region *region, const double x[3]);

#endif
