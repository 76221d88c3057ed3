/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the sweeps of membranes and shells share: fields of their states, and how nodes move. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_SWEEP_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_SWEEP_H

#include "engine/cohesive/law.h"

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

typedef struct {
    int alpha;            /* Hulbert-Chung, with its parameters; else central difference */
    double alpha_m, b, g; /* 1 */
} fracas_surface_motion;

fracas_surface_motion fracas_surface_motion_of(const fracas_time *time);

/* Number of the sweep that applies the linear operator, after those of the laws. */
enum { SURFACE_OPERATOR = FRACAS_LAWS, SURFACE_SWEEPS };

#endif
