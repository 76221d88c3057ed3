/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference bar of the tests (docs/results/bar.md): E 275 GPa, rho 2750, sigma_c 300 MPa, G_c
 * 100 N/m, L 50 mm. */
#ifndef FRACAS_TESTS_SUPPORT_BAR_H
#define FRACAS_TESTS_SUPPORT_BAR_H

#include "engine/cohesive/law.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/solver/batch.h"
#include "sampler/api/sampler.h"
#include "tests/support/test.h"

#define BAR_WAVE_SPEED 1e4                           /* m/s */
#define BAR_STRENGTH_MEAN 300e6                      /* Pa */
#define BAR_T0 (275e9 * 100 / (300e6 * 300e6 * 1e4)) /* s: E G_c/(sigma_c^2 c) = 30.556 ns */
#define BAR_S0 (275e9 * 100 / (300e6 * 300e6))       /* m: 0.30556 mm */

/* Periodic, law nitsche, beta 4, a quarter of the critical step, area 1 mm2. */
static inline fracas_spec bar_reference(int64_t elements, double rate, double end)
{
    return (fracas_spec){
        .formulation = &fracas_formulation_bar.kind,
        .geometry = {.shape = &fracas_shape_bar,
                     .ends = &fracas_ends_periodic,
                     .length = 0.05,
                     .area = 1e-6},
        .mesh = {.spacing = &fracas_spacing_uniform, .elements = elements},
        .material = {275e9, 2750},
        .cohesive = {.law = &fracas_law_nitsche.kind, .fracture_energy = 100, .beta = 4},
        .loading = {.type = &fracas_loading_imposed_rate, .rate = rate},
        .time = {.stop = &fracas_stop_time, .end = end, .safety = 0.25}};
}

/* Number of strengths of a realization. */
static inline size_t strengths_of(const fracas_model *model)
{
    return model->interfaces * model->strengths;
}

/* The strength that holds at Gauss point g of an interface. */
static inline double strength_at(const fracas_batch *batch, size_t lane, size_t interface, size_t g)
{
    const size_t strengths = batch->model->strengths;
    size_t stride;
    const double *strength = fracas_batch_strength((fracas_batch *)batch, lane, &stride);
    return strength[(interface * strengths + (strengths > 1 ? g : 0)) * stride];
}

/* Strengths uniform in 300 MPa (1 +- scatter) for replica `replica`, in lane `lane`. */
static inline void bar_draw(fracas_batch *batch, size_t lane, double scatter, uint64_t replica)
{
    const fracas_stream stream = {
        .seed = 1, .purpose = FRACAS_PURPOSE_STRENGTH, .point = {2, 3}, .replica = replica};
    size_t stride;
    double *strength = fracas_batch_strength(batch, lane, &stride);
    for (size_t k = 0; k < strengths_of(batch->model); k++)
        strength[k * stride] = BAR_STRENGTH_MEAN *
                               (1 + scatter * (2 * fracas_stream_uniform(&stream, k) - 1));
}

/* Lengths in geometric progression, the last one `ratio` times the first. */
static inline void bar_grade(fracas_spec *spec, double ratio)
{
    spec->mesh.spacing = &fracas_spacing_graded;
    spec->mesh.ratio = ratio;
}

/* Nodes moved at random, by `amplitude` h at most: mesh number `which`. `noise` takes [elements +
 * 1] and must last until the model is made. */
static inline void bar_perturb(fracas_spec *spec, double amplitude, uint64_t which, double *noise)
{
    const fracas_stream stream = {.seed = which, .purpose = FRACAS_PURPOSE_MESH};
    for (uint64_t i = 0; i <= (uint64_t)spec->mesh.elements; i++)
        noise[i] = 2 * fracas_stream_uniform(&stream, i) - 1;
    spec->mesh.spacing = &fracas_spacing_perturbed;
    spec->mesh.amplitude = amplitude;
    spec->mesh.noise = noise;
}

/* Strength number k, which is interface k where each has one. */
static inline void bar_set_strength(fracas_batch *batch, size_t lane, size_t k, double sigma_c)
{
    size_t stride;
    double *strength = fracas_batch_strength(batch, lane, &stride);
    strength[k * stride] = sigma_c;
}

#endif
