/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Strips in motion, bent until they break: a crack through the thickness costs h G_c by
 * length, and the method puts next to nothing in (docs/theory/shell.md). */
#include "tests/support/shell.h"
#include "tests/support/test.h"

#define SIGMA 300e6 /* Pa, along the line across the middle; four times as much elsewhere */
#define G_C 200.0   /* J/m2 */
#define DEPTH 3e-4  /* m */
static const double SIZE[2] = {2e-3, 4e-4}; /* m */

typedef struct {
    size_t cells;   /* along the strip, a fourth of it across */
    double bending; /* 1/s: strain rate of the outer skin, by the curvature */
    double pull;    /* 1/s: of the middle surface */
    double safety;  /* time step by the critical one */
    const fracas_law *law;
} strip_case;

/* E 320 GPa, nu 0, rho 3300; beta 5. */
static fracas_model *strip_of(const strip_case *it)
{
    fracas_spec spec = surface_spec(&fracas_formulation_shell, &fracas_shape_file);
    spec.geometry.thickness = DEPTH;
    spec.material.poisson = 0;
    spec.cohesive.fracture_energy = G_C;
    spec.time.safety = it->safety;
    if (it->law) spec.cohesive.law = &it->law->kind;
    return grid_model(
        &spec, &(shell_grid){.nx = it->cells, .ny = it->cells / 4, .map = flat_map, .how = SIZE});
}

/* Along the middle. */
static bool is_weak(const fracas_model *model, size_t interface)
{
    const fracas_surface_interface *joint = &model->surface->interface[interface];
    for (size_t end = 0; end < 2; end++) {
        const double *x = node_at(model, joint->element[0], (joint->edge[0] + end) % 3);
        if (fabs(x[0] - 0.5 * SIZE[0]) > 1e-9) return false;
    }
    return true;
}

/* Velocities of a uniform curvature and strain. The last cells at both ends turn
 * on as rigid bodies, by nodes whose motion out of the plane, with a pull all of it, is held. */
static void set_moving(fracas_batch *batch, const strip_case *it)
{
    const double turning = 2 * it->bending / DEPTH, half = 0.5 * SIZE[0],
                 inner = half - SIZE[0] / (double)it->cells;
    fracas_surface_tables *tables = tables_of(batch->model);
    tables->moves = true;
    for (size_t i = 0; i < unknowns_of(batch->model); i++) {
        const size_t e = i / 18;
        double centre = -half, v[3] = {0};
        for (size_t k = 0; k < 3; k++) centre += node_at(batch->model, e, k)[0] / 3;
        const double x = place_of(batch->model, i)[0] - half;
        const bool end = fabs(centre) > inner;
        v[0] = it->pull * (end ? copysign(inner, centre) : x);
        v[2] = -turning * (end ? inner * fabs(x) - 0.5 * inner * inner : 0.5 * x * x);
        if (end && (i % 3 == 2 || (i % 3 == 0 && it->pull > 0))) tables->held[e] |= 1u << i % 18;
        *value_of(batch, i, SURFACE_V) = v[i % 3];
    }
}

/* Until the line is broken, and as long again after its onset. */
static void run_strip(fracas_batch *batch, int64_t weak)
{
    RECORD(record);
    const fracas_step *step = &batch->step;
    double end = INFINITY;
    for (size_t running = 1; running > 0 && step->time[0] < end;) {
        OK(fracas_batch_step(batch, &record, &running));
        if (isinf(end) && step->broken[0] == weak) end = 2 * step->time[0] - step->first_onset[0];
        assert_true(step->time[0] < 2e-5);
    }
}

/* What breaking it creates, and by how much the ledger does not close, by what the crack costs: h
 * G_c by length, the energy that is dissipated. */
static double created_by(const strip_case *it, double *residual)
{
    OWN(fracas_model) model = strip_of(it);
    OWN(fracas_batch) batch = lane_of(model, 0, 0, 0);
    int64_t weak = 0;
    for (size_t i = 0; i < model->interfaces; i++) {
        const bool here = is_weak(model, i);
        weak += here;
        bar_set_strength(batch, 0, i, here ? SIGMA : 4 * SIGMA);
    }
    OK(fracas_batch_begin(batch));
    set_moving(batch, it);
    run_strip(batch, weak);
    const fracas_step *step = &batch->step;
    const double cost = DEPTH * G_C * SIZE[1], created = step->created[0] / cost;
    *residual = batch->lane[0].ledger.residual / cost;
    print_message("%2zu cells, bent at %g /s, pulled at %g /s, safety %.2f: %lld steps, "
                  "dissipated/cost - 1 = %.1e, %.3f by bending, created %.2e, residual %.1e\n",
                  it->cells, it->bending, it->pull, it->safety, (long long)batch->lane[0].steps,
                  step->dissipated[0] / cost - 1, step->dissipated_bending[0] / cost, created,
                  *residual);
    assert_true(step->broken[0] == weak && fabs(step->dissipated[0] / cost - 1) < 1e-12);
    assert_true((step->dissipated_bending[0] > 0.8 * cost) == (it->pull == 0));
    return created;
}

/* K delta_c/sigma_c of the line, K = beta E/h_s, h_s half a cell. */
static double steepness(const strip_case *it)
{
    return 5 * 320e9 * 2 * (double)it->cells / SIZE[0] * 2 * G_C / (SIGMA * SIGMA);
}

/* The mean stress m of a layer goes with the last layer of its Gauss point, and creates w h m^2/2K.
 * Did it go with the layer's own break, the outer one's would beside a middle that carries the
 * strength: N = 0 gives M = h^2 sigma/3 there, m = 6 M/h^2 = 2 sigma, and 2/(3 a) of the cost h
 * sigma delta_c/2, a = K delta_c/sigma. When the last one breaks, N and M have gone to 0 with its
 * traction, and m has followed but for waves of single elements: at most half the strength at both
 * skins is taken for these, which creates 1/(12 a), an eighth. They shrink with the elements; the
 * time step is no part of it: a half of it moves them by 2 %. */
static void a_bent_strip_breaks_without_a_gift(void **unused)
{
    const strip_case cases[] = {{8, 1e3, 0, 0.5}, {8, 1e3, 0, 0.25},    {12, 1e3, 0, 0.8},
                                {8, 3e3, 0, 0.5}, {8, 1e3, 1.2e3, 0.5}, {8, 1e3, 5e3, 0.5}};
    double created[6], residual;
    for (int i = 0; i < 6; i++) {
        created[i] = created_by(&cases[i], &residual);
        assert_true(fabs(residual) < 1e-4);
        assert_true(created[i] > 0 && created[i] * 12 * steepness(&cases[i]) < 1);
    }
    assert_true(fabs(created[1] / created[0] - 1) < 0.02 && created[2] < 0.3 * created[0]);
}

/* Tension and bending of either sign are one potential of this law, which leaves the flux with what
 * no jump has yet: its ledger closes there. */
static void a_law_on_resultants_bends_a_strip_apart(void **unused)
{
    const fracas_law *law = &fracas_law_becker_noels;
    const strip_case cases[] = {{8, 1e3, 0, 0.5, law},
                                {8, -1e3, 0, 0.5, law},
                                {8, 0, 5e3, 0.1, law},
                                {8, 1e3, 5e3, 0.1, law}};
    for (int i = 0; i < 4; i++) {
        double residual;
        assert_true(fabs(created_by(&cases[i], &residual)) < 1e-3);
        assert_true(fabs(residual) < 1e-4);
    }
}

TESTS(a_law_on_resultants_bends_a_strip_apart, a_bent_strip_breaks_without_a_gift)
