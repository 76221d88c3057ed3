/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference ring of the tests (docs/results/ring.md): the material of tests/support/bar.h,
 * circumference 50 mm. */
#ifndef FRACAS_TESTS_SUPPORT_RING_H
#define FRACAS_TESTS_SUPPORT_RING_H

#include "tests/support/bar.h"
#include "tests/support/test.h"

#define RING_CIRCUMFERENCE 0.05 /* m */
#define RING_RADIUS (RING_CIRCUMFERENCE / (2 * 3.14159265358979323846))

/* Free, starting with the radial velocity that stretches at `rate`; law nitsche, beta 4, a quarter
 * of the critical step. */
static inline fracas_spec ring_reference(int64_t elements, double rate, double end)
{
    fracas_spec spec = bar_reference(elements, rate, end);
    spec.formulation = &fracas_formulation_ring.kind;
    spec.geometry = (fracas_geometry){.shape = &fracas_shape_ring,
                                      .direction = &fracas_direction_current,
                                      .radius = RING_RADIUS,
                                      .area = 1e-6};
    spec.loading = (fracas_loading){.type = &fracas_loading_initial_velocity,
                                    .radial = rate * RING_RADIUS};
    return spec;
}

/* The same with Stershic's algorithm: 0.8 h/c, refined by xi = 0.25 a zone. */
static inline fracas_spec ring_stershic(int64_t elements, double rate, double end)
{
    fracas_spec spec = ring_reference(elements, rate, end);
    spec.cohesive = (fracas_cohesive){
        .law = &fracas_law_stershic.kind, .fracture_energy = 100, .penalty = 1, .refinement = 0.25};
    spec.time.safety = 0.8;
    return spec;
}

/* One ring in one lane, step by step. */
typedef struct {
    fracas_model *model;
    fracas_batch *batch;
    fracas_record record;
    size_t n, running; /* elements; 1 until it is over */
    double h;          /* m */
} ring_run;

/* Strengths all `strength`, to be changed before begin(). */
static inline ring_run make(const fracas_spec *spec, double strength)
{
    ring_run run = {.running = 1};
    const fracas_batch_options options = {.width = 1, .isa = FRACAS_ISA_BEST, .interfaces = true};
    OK(fracas_model_create(spec, &run.model));
    OK(fracas_batch_create(run.model, 1, &options, &run.batch));
    run.n = run.model->elements;
    run.h = run.model->element_size;
    for (size_t i = 0; i < run.n; i++) bar_set_strength(run.batch, 0, i, strength);
    fracas_record_init(&run.record);
    return run;
}

static inline ring_run begin(const fracas_spec *spec, double strength)
{
    ring_run run = make(spec, strength);
    OK(fracas_batch_begin(run.batch));
    return run;
}

static inline void step(ring_run *run)
{
    OK(fracas_batch_step(run->batch, &run->record, &run->running));
}

static inline void finish(ring_run *run)
{
    while (run->running) step(run);
}

static inline void clear(ring_run *run)
{
    fracas_record_clear(&run->record);
    fracas_batch_destroy(run->batch);
    fracas_model_destroy(run->model);
}

#endif
