/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference ring of the tests (docs/results/ring.md): the material of tests/support/bar.h,
 * circumference 50 mm. */
#ifndef FRACAS_TESTS_SUPPORT_RING_H
#define FRACAS_TESTS_SUPPORT_RING_H

#include "tests/support/bar.h"

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

/* Places of that algorithm's own numbers (engine/cohesive/stershic.h). */
enum { PENALTY, REFINEMENT, ZONE };

/* The same with Stershic's algorithm: 0.8 h/c, refined by xi = 0.25 a zone. */
static inline fracas_spec ring_stershic(int64_t elements, double rate, double end)
{
    fracas_spec spec = ring_reference(elements, rate, end);
    spec.cohesive = (fracas_cohesive){
        .law = &fracas_law_stershic.kind, .fracture_energy = 100, .own = {1, 0.25}};
    spec.time.safety = 0.8;
    return spec;
}

/* One ring in one lane; strengths all `strength`, to be changed before it begins. */
static inline one_run make(const fracas_spec *spec, double strength)
{
    return make_run(make_model(spec), 1, strength);
}

static inline one_run begin(const fracas_spec *spec, double strength)
{
    return begin_run(make_model(spec), 1, strength);
}

#endif
