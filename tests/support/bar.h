/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference bar of the tests (docs/results/bar.md): E 275 GPa, rho 2750, sigma_c 300 MPa, G_c
 * 100 N/m, L 50 mm. */
#ifndef FRACAS_TESTS_SUPPORT_BAR_H
#define FRACAS_TESTS_SUPPORT_BAR_H

#include "engine/cohesive/law.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "tests/support/batch.h"

#define BAR_WAVE_SPEED 1e4                           /* m/s */
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

#endif
