/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference membrane of the tests: a free rectangle of 2 triangles or more, at rest unless a
 * test says otherwise. */
#ifndef FRACAS_TESTS_SUPPORT_MEMBRANE_H
#define FRACAS_TESTS_SUPPORT_MEMBRANE_H

#include "tests/support/bar.h"

#include "engine/formulation/surface/membrane.h"
#include "engine/integrator/integrator.h"

/* 0.2 mm x 0.3 mm and 1 mm thick, E 70 GPa, nu 0.3, rho 2700; G_c 500 J/m2; law nitsche, beta 4,
 * half the critical step of central difference, masses lumped. */
static inline fracas_spec membrane_reference(int64_t divisions, int64_t order, double end)
{
    fracas_spec spec = {
        .formulation = &fracas_formulation_membrane.kind,
        .geometry = {.shape = &fracas_shape_plate,
                     .width = 2e-4,
                     .height = 3e-4,
                     .thickness = 1e-3},
        .mesh = {.spacing = &fracas_spacing_triangles, .divisions = divisions, .order = order},
        .material = {.young = 70e9, .density = 2700, .poisson = 0.3},
        .cohesive = {.law = &fracas_law_nitsche.kind,
                     .fracture_energy = 500,
                     .beta = 4,
                     .onset = &fracas_onset_mean,
                     .coupling = 1},
        .loading = {.type = &fracas_loading_expansion,
                    .rate = 0,
                    .ratio = 1,
                    .start = &fracas_start_moving},
        .time = {.stop = &fracas_stop_time,
                 .end = end,
                 .safety = 0.5,
                 .integrator = &fracas_integrator_central_difference,
                 .spectral_radius = 0.9,
                 .mass = &fracas_mass_lumped}};
    for (int i = 0; i < FRACAS_EDGES; i++) spec.geometry.edge[i] = &fracas_edge_free;
    return spec;
}

#endif
