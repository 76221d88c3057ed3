/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bars on elements of different lengths, for tests that look at their state. */
#ifndef FRACAS_TESTS_SUPPORT_BAR_SPACING_H
#define FRACAS_TESTS_SUPPORT_BAR_SPACING_H

#include "tests/support/bar.h"

enum {
    W_LEFT,
    W_RIGHT,
    V_LEFT,
    V_RIGHT,
    DAMAGE,
    STRENGTH,
    LAW,
    FIELDS
};                    /* as in engine/formulation/chain/bar_sweep.h */
enum { MOST = 2000 }; /* elements */

static const fracas_kind *const laws[] = {&fracas_law_nitsche.kind, &fracas_law_rigid_link.kind};
static const fracas_kind *const ends[] = {&fracas_ends_periodic, &fracas_ends_held};

/* The meshes of most tests: graded either way, moved by the most that is allowed. */
enum { MESHES = 3 };
static inline void lay_mesh(fracas_spec *spec, int mesh, double *noise)
{
    if (mesh == 0) bar_grade(spec, 100);
    if (mesh == 1) bar_grade(spec, 0.01);
    if (mesh == 2) bar_perturb(spec, 0.45, 1, noise);
}

static inline fracas_model *model_on(fracas_spec *spec, int mesh)
{
    double noise[MOST + 1];
    fracas_model *model;
    lay_mesh(spec, mesh, noise);
    OK(fracas_model_create(spec, &model));
    return model;
}

static inline fracas_batch *batch_of(const fracas_model *model, double sigma_c)
{
    fracas_batch *batch;
    const fracas_batch_options options = {.width = 1, .isa = FRACAS_ISA_BEST};
    OK(fracas_batch_create(model, 1, &options, &batch));
    for (size_t i = 0; i < fracas_model_interfaces(model); i++)
        bar_set_strength(batch, 0, i, sigma_c);
    OK(fracas_batch_begin(batch));
    return batch;
}

static inline double *field(fracas_batch *batch, size_t element, int which)
{
    return batch->step.state + element * FIELDS + (size_t)which;
}

static inline void step(fracas_batch *batch, fracas_record *record)
{
    size_t running;
    OK(fracas_batch_step(batch, record, &running));
}

#endif
