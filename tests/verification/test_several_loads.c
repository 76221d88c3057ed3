/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Several loads at once: superposition, momentum, the ledger, refusals (docs/theory/loads.md). */
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

#include <stdlib.h>

static const fracas_kind right_edge = {"right", ""};

static fracas_spec plate(void)
{
    fracas_spec spec = shell_spec(&fracas_shape_plate);
    spec.geometry.thickness = 0.02;
    spec.mesh.divisions = 4;
    spec.cohesive.fracture_energy = 1e12; /* never cracks */
    return spec;
}

static fracas_loading pressure(double p)
{
    fracas_loading load = bare_load(&fracas_loading_pressure);
    *load_number(&load, "pressure") = p;
    return load;
}

static fracas_loading body_force(double x, double y, double z)
{
    fracas_loading load = bare_load(&fracas_loading_body_force);
    memcpy(load_number(&load, "x"), (double[3]){x, y, z}, 3 * sizeof(double));
    return load;
}

static fracas_loading traction(const fracas_kind *edge, double normal, double across)
{
    fracas_loading load = bare_load(&fracas_loading_traction);
    load.edge = edge;
    *load_number(&load, "normal") = normal;
    *load_number(&load, "across") = across;
    return load;
}

static fracas_loading motion(const fracas_kind *edge, double by)
{
    fracas_loading load = bare_load(&fracas_loading_edge_motion);
    load.edge = edge;
    load.direction = motion_choice("direction", "outward");
    load.rise_by = motion_choice("rise_by", "smooth");
    load.displacement = by;
    load.rise = 0.2;
    return load;
}

/* Displacements at the end of a run, [element][unknown], and the largest residual of the ledger by
 * its largest term; the caller frees. */
static double *field_of(fracas_spec spec, double end, size_t *count, double *residual)
{
    const bool shell = spec.formulation == &fracas_formulation_shell.kind;
    one_run run = begin_run(distorted_model(spec, 0.2, 5), 1, shell ? 1e6 : 1e12);
    while (run.batch->step.time[0] < end) step_run(&run);
    const fracas_surface_tables *t = run.model->plan;
    const size_t size = fracas_surface_unknowns(t);
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    double *u = malloc(t->nelements * size * sizeof *u);
    assert_non_null(u);
    *count = t->nelements * size;
    for (size_t i = 0; i < *count; i++)
        u[i] = *surface_value(run.model, &run.batch->step, i / size, SURFACE_U, i % size, 0);
    *residual = ledger->largest_residual /
                fmax(fabs(ledger->work), fmax(ledger->kinetic, ledger->elastic));
    clear_run(&run);
    return u;
}

/* Equations are linear until an interface cracks: u of both loads is the sum of u of each, to the
 * rounding of some 1e3 steps, 1e3 x 1.1e-16; so is the ledger's residual. */
static void assert_superposes(fracas_spec spec, double end, fracas_loading a, fracas_loading b,
                              const char *what)
{
    const fracas_loading *const load[3][2] = {{&a, NULL}, {&b, NULL}, {&a, &b}};
    double *u[3], residual[3], error = 0, largest = 0;
    size_t count = 0;
    for (int c = 0; c < 3; c++) {
        spec.loading = *load[c][0];
        spec.also[0] = load[c][1] ? *load[c][1] : (fracas_loading){0};
        u[c] = field_of(spec, end, &count, &residual[c]);
    }
    for (size_t i = 0; i < count; i++) {
        error = fmax(error, fabs(u[2][i] - u[0][i] - u[1][i]));
        largest = fmax(largest, fabs(u[2][i]));
    }
    print_message("%s: superposition within %.1e, residual %.1e\n", what, error / largest,
                  residual[2]);
    assert_true(largest > 0 && error < 1e-12 * largest);
    for (int c = 0; c < 3; c++) {
        assert_true(residual[c] < 1e-12);
        free(u[c]);
    }
}

static void loads_superpose(void **unused)
{
    fracas_spec spec = plate();
    fracas_loading front = pressure(2), here = pressure(3), there = pressure(3);
    front.front = 5;
    front.decay = 0.1;
    here.spot = there.spot = 0.2;
    here.spot_at[0] = 0.2;
    there.spot_at[0] = -0.2;
    assert_superposes(spec, 0.3, pressure(1), traction(&right_edge, 2, 1), "pressure + traction");
    assert_superposes(spec, 0.3, front, body_force(1, 2, 3), "front + body-force");
    assert_superposes(spec, 0.3, here, there, "two spots");
    spec.geometry.edge[1] = spec.geometry.edge[2] = &fracas_edge_fixed; /* left, right */
    assert_superposes(spec, 0.3, body_force(1, 2, 3), motion(&right_edge, 1e-3), "force + motion");
    spec.time.integrator = &fracas_integrator_hulbert_chung;
    assert_superposes(spec, 0.3, body_force(1, 2, 3), motion(&right_edge, 1e-3),
                      "the same, damped");
    spec.geometry.edge[1] = spec.geometry.edge[2] = NULL;
    assert_superposes(spec, 0.3, front, traction(&right_edge, 2, 1), "front + traction, damped");
}

/* What only membranes take, and what only the first of a list can be: a spun body, and one that
 * expands. Its velocities are the expansion's start; alone, the others have none. */
static void first_loadings_superpose(void **unused)
{
    for (int scheme = 0; scheme < 2; scheme++) {
        fracas_spec spec = membrane_spec(&fracas_shape_plate, 1 + scheme, 5);
        spec.cohesive.fracture_energy = 1e12;
        spec.time.end = 100;
        spec.time.integrator = scheme ? &fracas_integrator_hulbert_chung
                                      : &fracas_integrator_central_difference;
        const double wave = sqrt(spec.material.young / spec.material.density),
                     time = spec.geometry.width / wave;
        fracas_loading spun = bare_load(&fracas_loading_centrifugal),
                       pull = traction(&right_edge, 1e-4 * spec.material.young, 0),
                       expansion = bare_load(&fracas_loading_expansion),
                       moved = motion(&right_edge, 1e-4 * spec.geometry.width);
        spun.speed = 1e-2 / time;
        spun.ramp = 2 * time;
        expansion.rate = 1e-4 / time;
        expansion.ratio = -0.5;
        expansion.start = &fracas_start_moving;
        moved.rise = time;
        assert_superposes(spec, 1.5 * time, spun, pull, "spun + traction");
        assert_superposes(spec, 1.5 * time, expansion, pull, "expansion + traction");
        spec.geometry.edge[1] = spec.geometry.edge[2] = &fracas_edge_fixed; /* left, right */
        assert_superposes(spec, 1.5 * time, spun, moved, "spun + motion");
    }
}

/* A free body has momentum F t of the sum of its loads, whatever waves run in it; half a step ahead
 * of t_n, and half a step behind at the start: exact for constant loads. */
static void momentum_is_that_of_all_loads(void **unused)
{
    fracas_spec spec = plate();
    spec.loading = pressure(2);
    spec.also[0] = body_force(0, 0, 5);
    spec.also[1] = body_force(1, 0, 0);
    one_run run = begin_run(distorted_model(spec, 0.2, 5), 1, 1e6);
    while (run.batch->step.time[0] < 0.2) step_run(&run);
    const fracas_surface_tables *t = run.model->plan;
    const size_t nodes = run.model->surface->corners;
    double momentum[3] = {0};
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 0; i < 3 * nodes; i++)
            momentum[i % 3] += t->lumped[(2 * e + 1) * nodes + i / 3] *
                               *surface_value(run.model, &run.batch->step, e, SURFACE_V, i, 0);
    const double time = run.batch->step.time[0] + 0.5 * run.batch->step.kick[0],
                 area = run.model->mass / (spec.material.density * spec.geometry.thickness),
                 along = run.model->mass * time, across = (2 * area + 5 * run.model->mass) * time;
    print_message("momentum within %.1e, %.1e\n", momentum[0] / along - 1,
                  momentum[2] / across - 1);
    assert_true(fabs(momentum[0] / along - 1) < 1e-12);
    assert_true(fabs(momentum[2] / across - 1) < 1e-12);
    clear_run(&run);
}

static void refuse(fracas_loading a, fracas_loading b, const char *one, const char *other)
{
    fracas_spec spec = plate();
    fracas_model *model = NULL;
    spec.loading = a;
    spec.also[0] = b;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, one, other);
}

static void what_contradicts_itself_is_refused(void **unused)
{
    refuse(motion(&right_edge, 1e-3), motion(&right_edge, 1e-3), "loading and loading_2 move the",
           "same edge right: leave one out");
    refuse(motion(&right_edge, 1e-3), traction(&right_edge, 1, 0), "loading_2 traction",
           "a load moves");
    fracas_loading expansion = bare_load(&fracas_loading_expansion);
    expansion.rate = expansion.ratio = 1;
    expansion.start = &fracas_start_moving;
    refuse(expansion, motion(&right_edge, 1e-3), "loading expansion and loading_2 edge-motion",
           "leave one out");
    fracas_spec spec = plate(); /* beside another, a load without a force is none */
    fracas_model *model = NULL;
    spec.loading = pressure(1);
    spec.also[0] = pressure(0);
    OK(fracas_model_create(&spec, &model));
    fracas_model_destroy(model);
}

static void all_loads_go_beside_another(void **unused)
{
    for (size_t k = 0; k < fracas_loading_sections[0].nkinds; k++) {
        const fracas_kind *kind = fracas_loading_sections[0].kinds[k];
        bool listed = false;
        for (size_t o = 0; o < fracas_loading_sections[1].nkinds; o++)
            listed = listed || fracas_loading_sections[1].kinds[o] == kind;
        assert_int_equal(listed, ((const fracas_loading_traits *)kind->traits)->load != NULL);
    }
}

TESTS(loads_superpose, first_loadings_superpose, momentum_is_that_of_all_loads,
      what_contradicts_itself_is_refused, all_loads_go_beside_another)
