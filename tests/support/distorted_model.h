/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models of surfaces, on meshes that are not regular, and batches of them. */
#ifndef FRACAS_TESTS_SUPPORT_DISTORTED_MODEL_H
#define FRACAS_TESTS_SUPPORT_DISTORTED_MODEL_H

#include "engine/integrator/integrator.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"
#include "sampler/api/sampler.h"
#include "tests/support/bar.h"
#include "tests/support/test.h"

enum { PLATE_SIDES = 4 }; /* of a plate, or of a grid of a mesh file: tags 1 to 4 */

/* A body that stretches alike all over, with free edges: E 320 GPa, nu 0.3, rho 3300; law nitsche,
 * G_c 200 J/m2, beta 5; order 2, half the critical step of central difference, masses lumped. Its
 * sizes, rate and end are the caller's. */
static inline fracas_spec surface_spec(const fracas_formulation *formulation,
                                       const fracas_kind *shape)
{
    fracas_spec spec = {.formulation = &formulation->kind,
                        .geometry = {.shape = shape, .part = &fracas_part_whole},
                        .mesh = {.spacing = &fracas_spacing_triangles, .order = 2},
                        .material = {.young = 320e9, .density = 3300, .poisson = 0.3},
                        .cohesive = {.law = &fracas_law_nitsche.kind,
                                     .fracture_energy = 200,
                                     .beta = 5,
                                     .beta_shear = 1,
                                     .onset = &fracas_onset_mean,
                                     .coupling = 1},
                        .loading = {.type = &fracas_loading_expansion,
                                    .ratio = 1,
                                    .ratio_z = NAN,
                                    .start = &fracas_start_moving},
                        .time = {.stop = &fracas_stop_time,
                                 .end = 1,
                                 .safety = 0.5,
                                 .integrator = &fracas_integrator_central_difference,
                                 .spectral_radius = 0.8,
                                 .mass = &fracas_mass_lumped}};
    for (int i = 0; i < FRACAS_EDGES; i++) spec.geometry.edge[i] = &fracas_edge_free;
    return spec;
}

/* The model of a spec; `distortion` moves inner vertices by up to that share of the local edge, by
 * random numbers of this seed. A mesh from a file stays as it is. No energy guard: these are for
 * tests of forces, events and whole ledgers, good or bad ones. */
static inline fracas_model *distorted_model(fracas_spec spec, double distortion, uint64_t seed)
{
    const fracas_stream stream = {.seed = seed, .purpose = FRACAS_PURPOSE_MESH};
    fracas_model *model = NULL;
    size_t count = 0;
    spec.mesh.amplitude = distortion;
    if (spec.mesh.spacing == &fracas_spacing_triangles) OK(fracas_mesh_noise_count(&spec, &count));
    OWNED double *noise = taken((count + 1) * sizeof *noise);
    for (size_t i = 0; i < count; i++) noise[i] = 2 * fracas_stream_uniform(&stream, i) - 1;
    spec.mesh.noise = count ? noise : NULL;
    spec.mesh.nnoise = count;
    OK(fracas_model_create(&spec, &model));
    model->tolerance = 1e300;
    return model;
}

#endif
