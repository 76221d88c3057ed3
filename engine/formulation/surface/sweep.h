/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the sweeps of membranes and shells share: fields of their states, and how nodes move. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_SWEEP_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_SWEEP_H

#include "engine/spec.h"

/* Fields of an element, each as wide as it has unknowns: displacement at t_n; velocity, half a step
 * behind before the sweep and ahead after (Hulbert-Chung: at t_n); Hulbert-Chung: acceleration a_n
 * and a_{n+1}. */
enum {
    SURFACE_U,
    SURFACE_V,
    SURFACE_FIELDS,
    SURFACE_A = SURFACE_FIELDS,
    SURFACE_A_NEXT,
    SURFACE_FIELDS_ALPHA
};

/* Fields of a point at which a law is evaluated: D, p of every law; the rest of nitsche with
 * friction. */
enum { SURFACE_DAMAGE, SURFACE_PEAK, SURFACE_POINT_FIELDS };
enum { SURFACE_SLIP = SURFACE_POINT_FIELDS, SURFACE_RUB, SURFACE_POINT_FIELDS_FRICTION };

typedef struct {
    int alpha;            /* Hulbert-Chung, with its parameters; else central difference */
    double alpha_m, b, g; /* 1 */
} fracas_surface_motion;

fracas_surface_motion fracas_surface_motion_of(const fracas_time *time);

#endif
