/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order in which a sweep in one pass visits elements and interfaces: an element is looked at
 * when its turn comes, then the interfaces with elements before it, then the elements that have all
 * their interfaces by then are finished. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_VISITS_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_VISITS_H

#include "engine/mesh/surface/surface.h"

typedef struct {
    /* Element by element: the interfaces whose second element e is, join[join_from[e]] to
     * join[join_from[e + 1] - 1]; then the elements that are finished then, finish[...] likewise.
     */
    uint32_t *join_from, *join, *finish_from, *finish;
    size_t window; /* 2^k - 1: elements under way at one time differ in (number & window) */
} fracas_surface_visits;

/* FRACAS_ENVIRONMENT without memory; the caller clears in any case. */
FRACAS_MUST_USE fracas_err fracas_surface_visits_init(fracas_surface_visits *visits,
                                                      const fracas_surface *surface);
void fracas_surface_visits_clear(fracas_surface_visits *visits);

#endif
