/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mass of an element of a surface (docs/theory/membrane.md). */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_NODAL_MASS_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_NODAL_MASS_H

#include "engine/mesh/surface/surface.h"

/* consistent[k n + l] = int density N_k N_l dA, n = surface->corners, and lumped[k] by the rule of
 * Hinton, Rock and Zienkiewicz: its diagonal, scaled to the element's mass  (membrane.13).
 * `density` per area [kg/m2]; masses in kg. */
void fracas_nodal_mass(const fracas_surface *surface, size_t element, double density,
                       double *consistent, double *lumped);

#endif
