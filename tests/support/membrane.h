/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference membrane of the tests: a free rectangle of 2 triangles or more, at rest unless a
 * test says otherwise. */
#ifndef FRACAS_TESTS_SUPPORT_MEMBRANE_H
#define FRACAS_TESTS_SUPPORT_MEMBRANE_H

#include "tests/support/distorted_model.h"

#include "engine/formulation/surface/membrane.h"
#include "engine/integrator/integrator.h"

/* 0.2 mm x 0.3 mm and 1 mm thick, E 70 GPa, nu 0.3, rho 2700; G_c 500 J/m2; law nitsche, beta 4,
 * half the critical step of central difference, masses lumped. */
static inline fracas_spec membrane_reference(int64_t divisions, int64_t order, double end)
{
    fracas_spec spec = surface_spec(&fracas_formulation_membrane, &fracas_shape_plate);
    spec.geometry.width = 2e-4;
    spec.geometry.height = 3e-4;
    spec.geometry.thickness = 1e-3;
    spec.mesh.divisions = divisions;
    spec.mesh.order = order;
    spec.material = (fracas_material){.young = 70e9, .density = 2700, .poisson = 0.3};
    spec.cohesive.fracture_energy = 500;
    spec.cohesive.beta = 4;
    spec.time.end = end;
    spec.time.spectral_radius = 0.9;
    return spec;
}

#endif
