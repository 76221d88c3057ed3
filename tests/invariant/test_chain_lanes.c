/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Bars and rings: a lane's record depends on its own strengths alone, though with Stershic's
 * algorithm each lane has a time step of its own and opens its links one by one. */
#include "engine/formulation/chain/bar_sweep.h"
#include "engine/formulation/chain/ring_sweep.h"
#include "tests/support/lanes.h"
#include "tests/support/ring.h"

static void until_quiet(fracas_spec *spec, double quiet, double fraction)
{
    spec->time.stop = &fracas_stop_quiet;
    spec->time.quiet = quiet;
    spec->time.quiet_fraction = fraction;
}

static const lane_kind bar_kind = {.scatter = 0.05, .back = BAR_STRENGTH - BAR_V_LEFT},
                       ring_kind = {.scatter = 0.05, .back = RING_STRENGTH - RING_V_LEFT},
                       stershic_kind = {.scatter = 0.1, .back = RING_STRENGTH - RING_V_LEFT};

/* The last two on elements of different lengths; the first, and those from the fifth on, which are
 * free, between walls, reach (balance.5). */
static fracas_spec bar_case(int k, double *noise)
{
    const bool is_long = k % 4 == 0 || k > 4;
    fracas_spec spec = bar_reference(is_long ? 200 : 600, 1e5, is_long ? 4.5e-7 : 1.5e-7);
    spec.geometry.length = 1e-5 * (double)spec.mesh.elements;
    spec.geometry.gap = k > 5 ? 1e-6 : NAN;
    if (k > 4) spec.geometry.ends = &fracas_ends_free;
    if (k % 3 == 1) spec.cohesive.law = &fracas_law_rigid_link.kind;
    if (k == 2) until_quiet(&spec, 1e-8, 0.05);
    if (k > 2 && k < 7) bar_perturb(&spec, 0.2, 1, noise);
    return spec;
}

/* Free, pulled, pushed outward; current, initial. The free ones reach (balance.5). */
static fracas_spec ring_case(int k, double *unused)
{
    fracas_spec spec = ring_reference(k < 2 ? 150 : 300, 1e5, k < 2 ? 4.5e-7 : 1.5e-7);
    spec.geometry.radius = 1e-5 * (double)spec.mesh.elements / (2 * M_PI);
    if (k % 2) spec.geometry.direction = &fracas_direction_initial;
    spec.loading.radial = 1e5 * spec.geometry.radius;
    spec.loading.circumferential = 10;
    if (k / 2 == 1)
        spec.loading = (fracas_loading){.type = &fracas_loading_imposed_rate, .rate = 1e5};
    if (k / 2 == 2) {
        spec.loading = (fracas_loading){
            .type = &fracas_loading_force, .direction = &fracas_axis_radial, .force = 1e7};
        until_quiet(&spec, 1e-8, 0.05);
    }
    return spec;
}

/* Free with a zone of 3.5 elements, driven with one of 2, free. */
static fracas_spec stershic_case(int k, double *unused)
{
    static const double zone[] = {3.5, 2, 0};
    fracas_spec spec = ring_stershic(200, 2e4, 4e-7);
    spec.geometry.radius = 6e-3 / (2 * M_PI);
    spec.loading.radial = 2e4 * spec.geometry.radius;
    spec.loading.circumferential = 20;
    spec.cohesive.own[REFINEMENT] = 0.3;
    spec.time.safety = 0.3;
    spec.cohesive.own[ZONE] = zone[k] * 6e-3 / 200;
    if (k == 1) {
        spec.loading = (fracas_loading){.type = &fracas_loading_imposed_rate, .rate = 2e4};
        until_quiet(&spec, 4e-8, 0.02);
    }
    return spec;
}

static void check_cases(fracas_spec (*spec_of)(int k, double *noise), int count,
                        const lane_kind *kind)
{
    for (int k = 0; k < count; k += CASE_STRIDE) {
        double noise[601];
        const fracas_spec spec = spec_of(k, noise);
        OWN(fracas_model) model = make_model(&spec);
        fracas_record alone[8];
        run_alone(model, kind, alone);
        print_message("[  figures ] %d: %ld and %ld fragments in %ld and %ld steps\n", k,
                      (long)alone[0].fragments, (long)alone[1].fragments, (long)alone[0].steps,
                      (long)alone[1].steps);
        assert_true(alone[0].broken > 5 && alone[0].dissipated != alone[1].dissipated);
        if (kind == &stershic_kind) assert_true(alone[0].steps != alone[1].steps);
        check_lanes(model, kind, alone);
    }
}

static void a_lane_of_a_bar_is_its_run_alone(void **unused)
{
    check_cases(bar_case, 8, &bar_kind);
}

static void a_lane_of_a_ring_is_its_run_alone(void **unused)
{
    check_cases(ring_case, 6, &ring_kind);
}

static void a_lane_with_a_step_of_its_own_is_its_run_alone(void **unused)
{
    check_cases(stershic_case, 3, &stershic_kind);
}

TESTS(a_lane_of_a_bar_is_its_run_alone, a_lane_of_a_ring_is_its_run_alone,
      a_lane_with_a_step_of_its_own_is_its_run_alone)
