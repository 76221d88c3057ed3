/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums and extremes over a whole surface. */
#ifndef FRACAS_TESTS_SUPPORT_SURFACE_MEASURES_H
#define FRACAS_TESTS_SUPPORT_SURFACE_MEASURES_H

#include "engine/mesh/surface/surface.h"

#include <math.h>

typedef struct {
    double area, border;             /* of the whole [m2, m] */
    double least_area, largest_area; /* of an element */
    double least_edge, largest_edge;
    double mean_distance; /* between the numbers of the two elements of an interface */
    size_t largest_distance;
} fracas_surface_measures;

static inline void fracas_surface_measure(const fracas_surface *surface,
                                          fracas_surface_measures *measures)
{
    fracas_surface_measures all = {.least_area = INFINITY, .least_edge = INFINITY};
    for (size_t e = 0; e < surface->nelements; e++) {
        const double area = surface->area[e];
        all.area += area;
        all.least_area = fmin(all.least_area, area);
        all.largest_area = fmax(all.largest_area, area);
        for (size_t k = 0; k < 3; k++) {
            const double length = fracas_surface_length(surface, e, k);
            all.least_edge = fmin(all.least_edge, length);
            all.largest_edge = fmax(all.largest_edge, length);
        }
    }
    for (size_t b = 0; b < surface->nborders; b++)
        all.border += fracas_surface_length(surface, surface->border[b].element,
                                            surface->border[b].edge);
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        const size_t distance = surface->interface[i].element[1] - surface->interface[i].element[0];
        all.mean_distance += (double)distance / (double)surface->ninterfaces;
        if (distance > all.largest_distance) all.largest_distance = distance;
    }
    *measures = all;
}

#endif
