/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of a surface: a unit for each width and instruction set. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_SWEEP_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_SWEEP_H

#include "base/isa.h"
#include "engine/cohesive/law.h"
#include "engine/element/triangle.h"
#include "engine/formulation/surface/tables.h"

/* One lane's view of an interface. */
typedef struct {
    double u[2][SURFACE_UNKNOWNS_MOST]; /* displacements of its two elements [m] */
    double fields[SURFACE_POINTS_MOST * SURFACE_POINT_FIELDS_MOST]; /* [point][field] of the law */
    double strength[SURFACE_EDGE(2)];                               /* at its Gauss points [Pa] */
    /* At each point: traction held against the strength, opening over that of the break; 1 at the
     * onset, at the break. */
    double onset[SURFACE_POINTS_MOST], opening[SURFACE_POINTS_MOST];
} fracas_surface_view;
/* Fills the last two from the rest. */
typedef void fracas_surface_inspect(const fracas_surface_constants *constants, size_t interface,
                                    fracas_surface_view *view);

/* Strain energy of an element with displacements u [J], and its stresses at the bulk points,
 * [point][body->stresses]; NULL: they are not wanted. */
typedef double fracas_surface_strain(const fracas_surface_constants *constants, size_t element,
                                     double *u, double *stress);

/* Number of the linear operator's sweep, after those of the laws. */
enum { SURFACE_OPERATOR = FRACAS_LAWS, SURFACE_SWEEPS };

/* Advances the lanes first .. first + lanes - 1 of a part. */
typedef void fracas_surface_sweep(const fracas_surface_constants *constants, fracas_step *step,
                                  int first, size_t part);

/* A unit: [law][order - 1]. Units of one lane alone have the operator's sweep, which leaves
 * M^-1 (-f)(u) where velocities are, views and strain energies. */
typedef struct {
    fracas_surface_sweep *sweep[SURFACE_SWEEPS][2];
    fracas_surface_inspect *look[2];
    fracas_surface_strain *strain[2];
} fracas_surface_kernel;
typedef const fracas_surface_kernel
    *const fracas_surface_kernels[FRACAS_NISAS][FRACAS_LANES_MAX + 1];

#endif
