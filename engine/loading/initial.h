/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a surface starts, beside its load: the section `initial` (docs/theory/initial.md). */
#ifndef FRACAS_ENGINE_LOADING_INITIAL_H
#define FRACAS_ENGINE_LOADING_INITIAL_H

#include "engine/spec.h"

extern const fracas_section fracas_initial_section;

/* True if some node may start with a velocity. */
bool fracas_initial_moves(const fracas_initial *initial);

/* True if such velocities strain a free body: only a part of it has them, or they part. */
bool fracas_initial_parts(const fracas_initial *initial);

/* True if stresses along x and y are given: the body must be flat. */
bool fracas_initial_has_stress(const fracas_initial *initial);

/* Velocity at a place x before any strain [m/s]: (velocity + radial e_r + spin e_axis x (x - at))
 * s(x) where the region has x, else 0  (initial.1) */
void fracas_initial_velocity(const fracas_initial *initial, const double x[3], double velocity[3]);

/* A uniform strain: tensor components [1]. */
typedef struct {
    double x, y, z, xy;
} fracas_initial_strain;

/* eps_0 of strains, stresses and temperature together, 0 where none is given  (initial.3) */
fracas_initial_strain fracas_initial_strain_of(const fracas_spec *spec);

bool fracas_initial_is_strained(const fracas_spec *spec);

/* u_0 = eps_0 x at a place x [m]  (initial.4) */
void fracas_initial_displacement(const fracas_initial_strain *strain, const double x[3],
                                 double displacement[3]);

/* Largest |stress| of the initial strain along any direction of a surface [Pa]. */
double fracas_initial_stress(const fracas_spec *spec);
/* Largest tension of it, or shear over the coupling of the law, at an interface of any direction
 * [Pa]; 0 under equal pressure. */
double fracas_initial_effective(const fracas_spec *spec);

/* Largest |principal strain| of it, within the body's plane where it is flat. */
double fracas_initial_largest_strain(const fracas_spec *spec);

#endif
