/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates from the parameters alone: limits of stresses and openings until time.end, fragments.
 */
#ifndef FRACAS_CAMPAIGNS_PLAN_BOUNDS_H
#define FRACAS_CAMPAIGNS_PLAN_BOUNDS_H

#include "engine/spec.h"

/* Sizes of a body [m]. */
typedef struct {
    double extent;  /* diagonal of the box around all interfaces */
    double reach;   /* their largest distance from the z axis */
    double element; /* mean element size */
} fracas_body_size;

/* Upper bound of the stress in the uncracked body until time.end [Pa]. A surface's is that of its
 * largest stress in any direction, shear by beta_c; where holes, notches, corners or curvature
 * concentrate stress, by a factor that is larger than theirs. */
double fracas_stress_bound(const fracas_spec *spec, const fracas_body_size *size);

/* Largest opening of an interface until time.end [m]; `stress`: the bound above, of chains. A crack
 * unloads the body at the wave speed c: under a strain e = rate t its faces part at 2 c e, by c e t
 * altogether, and at most by the body's extension, e times its size. */
double fracas_opening_bound(const fracas_spec *spec, double stress, double extent);

/* Size of fragments at a strength [m], (24 G_c/(rho rate^2))^(1/3): D. E. Grady, J. Appl. Phys. 53,
 * 322 (1982). NaN without a strain rate, as the next one. */
double fracas_grady_size(const fracas_spec *spec, double strength);

/* k = (t - t_onset) c/L at time.end of fragments of that size  (settled.1), t_onset = strength/(E
 * rate). */
double fracas_expected_transits(const fracas_spec *spec, double strength);

#endif
