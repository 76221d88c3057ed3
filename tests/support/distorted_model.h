/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models of surfaces on meshes that are not regular. */
#ifndef FRACAS_TESTS_SUPPORT_DISTORTED_MODEL_H
#define FRACAS_TESTS_SUPPORT_DISTORTED_MODEL_H

#include "engine/mesh/body.h"
#include "engine/mesh/make.h"
#include "sampler/api/sampler.h"
#include "tests/support/bar.h"
#include "tests/support/test.h"

/* The model of a spec; `distortion` moves inner vertices by up to that share of the local edge, by
 * random numbers of this seed. A mesh from a file stays as it is. */
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
    return model;
}

#endif
