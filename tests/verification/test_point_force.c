/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Forces at points and on sets of nodes: where they act, their sums, the momentum of free bodies, a
 * plate that bends under one (docs/theory/loads.md). */
#include "engine/loading/load.h"
#include "tests/support/campaign_text.h"
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

static const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                             &fracas_integrator_hulbert_chung};
static const double force[3] = {2, -3, 5};
static const double across = -1;

/* At a point unless limits are set. */
static fracas_loading at_point(bool shell)
{
    static const char *const absent[] = {"from_x", "to_x",   "from_y", "to_y", "from_z",
                                         "to_z",   "within", "at_x",   "at_y", "at_z"};
    fracas_loading loading = bare_load(&fracas_loading_point_force);
    for (size_t k = 0; k < FRACAS_COUNT(absent); k++) *load_number(&loading, absent[k]) = NAN;
    memcpy(load_number(&loading, "total_x"), force, (shell ? 3 : 2) * sizeof *force);
    if (shell) *load_number(&loading, "total_across") = across;
    return loading;
}

enum { POINT, BALL, LIMITS, EDGE, SETS };
enum { KINDS = 3 }; /* a membrane of both orders, a shell */

static fracas_spec pushed(int which, int set)
{
    const bool shell = which == 2;
    fracas_spec spec = shell ? shell_spec(&fracas_shape_plate)
                             : membrane_spec(&fracas_shape_plate, 1 + which % 2, 6);
    if (shell) spec.mesh.divisions = 5;
    const double w = spec.geometry.width;
    spec.time.end = 1e3;
    spec.cohesive.fracture_energy = 1e12;
    spec.loading = at_point(shell);
    if (set == POINT) *load_number(&spec.loading, "at_x") = 0.2 * w;
    if (set == BALL) *load_number(&spec.loading, "within") = 0.3 * w;
    if (set == LIMITS) *load_number(&spec.loading, "from_x") = 0.3 * w;
    if (set == EDGE) spec.loading.edge = fracas_load_edges[1]; /* right */
    return spec;
}

static double force_of(const fracas_spec *spec, size_t i)
{
    return load_value(&spec->loading, (const char *const[]){"total_x", "total_y", "total_z"}[i]) +
           (i == 2 ? load_value(&spec->loading, "total_across") : 0);
}

/* The node is one of the set, by hand. */
static bool has(const fracas_spec *spec, int set, const double x[3])
{
    const double w = spec->geometry.width, slack = 1e-9 * w;
    return set == BALL ? hypot(x[0], x[1]) <= 0.3 * w + slack : x[0] >= 0.3 * w - slack;
}

/* Sums of F_k, and of (x, y) F_k along x. */
typedef struct {
    double force[3], first[2];
} sums;

static sums sums_of(const fracas_model *model)
{
    const fracas_surface_tables *t = model->plan;
    const size_t size = fracas_surface_unknowns(t), dimension = (size_t)t->body->dimension;
    sums of = {{0}, {0}};
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; t->load_row[e] && k < model->surface->corners; k++) {
            const double *f = t->load + (t->load_row[e] - 1) * size + k * dimension;
            for (size_t i = 0; i < dimension; i++) of.force[i] += f[i];
            for (size_t i = 0; i < 2; i++) of.first[i] += f[0] * node_at(model, e, k)[i];
        }
    return of;
}

/* Forces add up to F; at a point or on an edge their moment is that of F there: rounding of some
 * 1e2 terms. */
static void forces_have_their_sum_and_place(void **unused)
{
    for (int which = 0; which < KINDS * SETS; which++) {
        const int set = which % SETS;
        const fracas_spec spec = pushed(which / SETS, set);
        fracas_model *model = distorted_model(spec, 0.2, 7);
        const double w = spec.geometry.width, place[2] = {set == POINT ? 0.2 * w : 0.5 * w, 0};
        const sums of = sums_of(model);
        for (size_t i = 0; i < (which / SETS == 2 ? 3 : 2); i++)
            assert_close(of.force[i], force_of(&spec, i), 1e-13);
        for (size_t i = 0; i < 2 && (set == POINT || set == EDGE); i++)
            assert_true(fabs(of.first[i] / of.force[0] - place[i]) < 1e-12 * w);
        fracas_model_destroy(model);
    }
}

/* Nodes of a ball or within limits have the force, and no others: in each element by its area, in
 * the middle of an edge 16/3 times that of a vertex. */
static void the_set_has_the_force(void **unused)
{
    for (int which = 0; which < KINDS * 2; which++) {
        const int set = which % 2 ? LIMITS : BALL;
        const fracas_spec spec = pushed(which / 2, set);
        fracas_model *model = distorted_model(spec, 0.2, 7);
        const fracas_surface_tables *t = model->plan;
        const size_t size = fracas_surface_unknowns(t), dimension = (size_t)t->body->dimension;
        double share = 0;
        for (size_t e = 0; e < t->nelements; e++)
            for (size_t k = 0; k < model->surface->corners; k++) {
                const double *f = t->load_row[e]
                                      ? t->load + (t->load_row[e] - 1) * size + k * dimension
                                      : (const double[3]){0};
                const double per = f[0] / model->surface->area[e] / (k < 3 ? 3 : 16);
                const bool wanted = has(&spec, set, node_at(model, e, k));
                assert_int_equal(wanted, fabs(f[0]) > 0);
                if (!wanted) continue;
                if (share == 0) share = per;
                assert_close(per, share, 1e-12);
            }
        fracas_model_destroy(model);
    }
}

static void momentum_of(const one_run *run, double momentum[3])
{
    const size_t dimension = (size_t)tables_of(run->model)->body->dimension;
    memset(momentum, 0, 3 * sizeof *momentum);
    for (size_t u = 0; u < unknowns_of(run->model); u++)
        momentum[u % element_unknowns(run->model) % dimension] +=
            mass_of(run->model, u) * *value_of(run->batch, u, SURFACE_V);
}

/* dp/dt = force until t, and work = energy: both schemes add them up exactly. Rounding of 300
 * steps. */
static void free_bodies_take_up_the_momentum(void **unused)
{
    for (int which = 0; which < 2 * KINDS * SETS; which++) {
        fracas_spec spec = pushed(which / 2 / SETS, which / 2 % SETS);
        double before[3], after[3], off = 0;
        spec.time.integrator = schemes[which % 2];
        one_run run = begin_run(distorted_model(spec, 0.2, 5), 1,
                                which / 2 / SETS == 2 ? 1e6 : 1e12);
        for (int s = 0; s < 20; s++) step_run(&run);
        momentum_of(&run, before);
        const double start = run.batch->step.time[0];
        for (int s = 0; s < 300; s++) step_run(&run);
        momentum_of(&run, after);
        const double t = run.batch->step.time[0] - start;
        for (size_t i = 0; i < 3; i++)
            off = fmax(off, fabs((after[i] - before[i]) / t - force_of(&spec, i)));
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        assert_true(off < 1e-12 * 4);
        assert_true(ledger->work > 0 && ledger->largest_residual < 1e-12 * ledger->work);
        clear_run(&run);
    }
}

/* F . u/F of a shell under a force along z: the mean of its nodes, as the force is spread. */
static double pushed_through(const one_run *run)
{
    const fracas_surface_tables *t = tables_of(run->model);
    const size_t size = fracas_surface_unknowns(t);
    double along = 0, sum = 0;
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 2; t->load_row[e] && i < size; i += 3) {
            const double f = t->load[(t->load_row[e] - 1) * size + i];
            sum += f;
            along += f * *value_of(run->batch, e * size + i, SURFACE_U);
        }
    return along / sum;
}

/* A square plate on simple supports under F in its middle: w = 0.0116008 F a^2/D (Timoshenko and
 * Woinowsky-Krieger, Theory of plates and shells, table 23), and the energy F w/2. F rises in two
 * periods of the first mode, which then stands still. The next modes have 5 times its frequency and
 * 1/25 of w: 2/(5 omega rise) of it, 6e-4 of w, is left. The mesh errs by the square of its size.
 */
static void a_plate_bends_under_a_point(void **unused)
{
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
        fracas_spec spec = shell_spec(&fracas_shape_plate);
        const double h = 0.02, F = 1e-6, a = 1, nu = spec.material.poisson,
                     D = spec.material.young * h * h * h / (12 * (1 - nu * nu)),
                     omega = 2 * M_PI * M_PI / (a * a) * sqrt(D / (spec.material.density * h)),
                     w = 0.0116008 * F * a * a / D;
        spec.geometry.thickness = h;
        spec.geometry.width = spec.geometry.height = a;
        spec.mesh.divisions = fine ? 16 : 8;
        for (int edge = 1; edge <= 4; edge++) spec.geometry.edge[edge] = &fracas_edge_fixed;
        spec.time.end = 1e3;
        spec.time.safety = 0.8;
        spec.cohesive.fracture_energy = 1e12;
        spec.loading = at_point(true);
        memset(load_number(&spec.loading, "total_x"), 0, 3 * sizeof(double));
        *load_number(&spec.loading, "total_across") = F;
        spec.loading.rise = 2 * 2 * M_PI / omega;
        one_run run = begin_run(distorted_model(spec, 0, 1), 1, 1e6);
        while (run.batch->step.time[0] < spec.loading.rise) step_run(&run);
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        const double middle = pushed_through(&run);
        error[fine] = fabs(middle / w - 1);
        print_message("plate: w %+.1e, energy %+.1e, work %+.1e, residual %.1e\n", middle / w - 1,
                      ledger->elastic / (0.5 * F * w) - 1, ledger->work / (0.5 * F * w) - 1,
                      ledger->largest_residual / ledger->work);
        assert_true(fabs(ledger->work / (0.5 * F * middle) - 1) < 0.02);
        assert_true(fabs(ledger->elastic / ledger->work - 1) < 0.01);
        assert_true(ledger->largest_residual < 1e-12 * ledger->work);
        clear_run(&run);
    }
    assert_true(error[1] < 0.02 && error[1] < error[0] / 2.5);
}

static void forces_without_sense_are_refused(void **unused)
{
    fracas_model *model = NULL;
    fracas_loading load = at_point(true);
    const fracas_loading_traits *traits = fracas_loading_point_force.traits;
    OK(traits->check(&load));
    load.edge = fracas_load_edges[6];
    OK(traits->check(&load));
    *load_number(&load, "at_y") = 1e-3;
    FAILS(traits->check(&load), FRACAS_USAGE, "both a point and the edges edge_1");
    load = at_point(true);
    *load_number(&load, "from_x") = 1;
    *load_number(&load, "to_x") = 0;
    FAILS(traits->check(&load), FRACAS_USAGE, "to_x is 0 m, below from_x, 1 m");
    fracas_spec spec = pushed(2, POINT);
    *load_number(&spec.loading, "at_x") = 3 * spec.geometry.width;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "point-force is beside the body",
          "away, more than an edge", "move at_x, at_y, at_z");
    spec = pushed(2, POINT); /* a ball between nodes is a point */
    *load_number(&spec.loading, "within") = 1e-6 * spec.geometry.width;
    *load_number(&spec.loading, "at_y") = 0.01 * spec.geometry.width;
    OK(fracas_model_create(&spec, &model));
    const sums of = sums_of(model);
    assert_true(fabs(of.first[1] / of.force[0] - 0.01 * spec.geometry.width) <
                1e-12 * spec.geometry.width);
    fracas_model_destroy(model);
    spec = pushed(2, EDGE); /* most of it into a support */
    spec.geometry.edge[2] = &fracas_edge_fixed;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "% of the force of loading point-force",
          "holds the body");
    load = at_point(true);
    *load_number(&load, "from_z") = 0; /* a limit */
    *load_number(&load, "at_x") = 1;
    *load_number(&load, "from_x") = 0;
    FAILS(traits->check(&load), FRACAS_USAGE, "both limits and a point");
    spec = pushed(2, LIMITS);
    *load_number(&spec.loading, "from_x") = 3 * spec.geometry.width;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "loading point-force has no node",
          "beside its limits");
    spec = pushed(0, EDGE);
    memset(load_number(&spec.loading, "total_x"), 0, 2 * sizeof(double));
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "point-force has no force", "give it");
}

/* A limit at z = 0 is one. */
static void limits_at_zero_count(void **unused)
{
    fracas_spec spec = shell_spec(&fracas_shape_sphere);
    fracas_model *model;
    spec.geometry.part = load_choice(&fracas_shape_sphere, "part", "octant");
    spec.mesh.divisions = 4;
    spec.loading = at_point(true);
    memset(load_number(&spec.loading, "total_x"), 0, 3 * sizeof(double));
    *load_number(&spec.loading, "to_z") = 0; /* the equator, whose z is held alone */
    OK(fracas_model_create(&spec, &model));
    const fracas_surface_tables *t = model->plan;
    const size_t size = fracas_surface_unknowns(t);
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; t->load_row[e] && k < model->surface->corners; k++) {
            const double *f = t->load + (t->load_row[e] - 1) * size + 3 * k;
            assert_int_equal(fabs(f[0]) + fabs(f[1]) > 0,
                             node_at(model, e, k)[2] < 1e-9 * spec.geometry.radius);
        }
    fracas_model_destroy(model);
}

TESTS(forces_have_their_sum_and_place, the_set_has_the_force, limits_at_zero_count,
      free_bodies_take_up_the_momentum, a_plate_bends_under_a_point,
      forces_without_sense_are_refused)
