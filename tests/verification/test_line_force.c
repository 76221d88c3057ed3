/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Forces on lines inside a surface: their sums, the momentum of free bodies, a strip that bends
 * (docs/theory/loads.md). */
#include "engine/loading/load.h"
#include "tests/support/campaign_text.h"
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

#include "campaigns/plan/point_model.h"

static const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                             &fracas_integrator_hulbert_chung};

/* A plate with a force on an oblique line, of a membrane of both orders or a shell. */
enum { PLATES = 3 };
static fracas_spec plate_of(int which)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, 1 + which % 2, 6);
    if (which == 2) {
        spec = shell_spec(&fracas_shape_plate);
        spec.mesh.divisions = 5;
    }
    const double w = spec.geometry.width;
    spec.time.end = 1e3;
    spec.cohesive.fracture_energy = 1e12;
    spec.loading = bare_load(&fracas_loading_line_force);
    memcpy(load_number(&spec.loading, "force_x"), (double[3]){2, -3, which == 2 ? 5 : 0},
           3 * sizeof(double));
    *load_number(&spec.loading, "force_across") = which == 2 ? -1 : 0;
    memcpy(load_number(&spec.loading, "from_x"), (double[3]){-0.3 * w, -0.25 * w},
           3 * sizeof(double));
    memcpy(load_number(&spec.loading, "to_x"), (double[3]){0.35 * w, 0.2 * w}, 3 * sizeof(double));
    *load_number(&spec.loading, "within") = 0.3 * w;
    return spec;
}

/* Force by length in all, and the length given. */
static double force_of(const fracas_loading *loading, size_t i)
{
    return loading->own[i] + (i == 2 ? load_value(loading, "force_across") : 0);
}
static double length_of(const fracas_loading *loading)
{
    return hypot(load_value(loading, "to_x") - load_value(loading, "from_x"),
                 load_value(loading, "to_y") - load_value(loading, "from_y"));
}

static one_run begin(fracas_spec spec, double distortion)
{
    const bool shell = spec.formulation == &fracas_formulation_shell.kind;
    return begin_run(distorted_model(spec, distortion, 5), 1, shell ? 1e6 : 1e12);
}

static size_t component_of(const fracas_model *model, size_t u)
{
    return u % element_unknowns(model) % (size_t)tables_of(model)->body->dimension;
}

static void momentum_of(const one_run *run, double momentum[3])
{
    memset(momentum, 0, 3 * sizeof *momentum);
    for (size_t u = 0; u < unknowns_of(run->model); u++)
        momentum[component_of(run->model, u)] += mass_of(run->model, u) *
                                                 *value_of(run->batch, u, SURFACE_V);
}

/* ---- sums ---- */

/* The path of edges is longer than the line, its force is the line's: rounding of some 1e2 terms.
 * Elements on both sides have it, and no others. */
static void a_path_has_the_force_of_its_line(void **unused)
{
    for (int which = 0; which < PLATES; which++) {
        const fracas_spec spec = plate_of(which);
        fracas_model *model = distorted_model(spec, 0.2, 7);
        const fracas_surface_tables *t = model->plan;
        const size_t size = fracas_surface_unknowns(t), dimension = (size_t)t->body->dimension;
        double sum[3] = {0}, far = 0;
        size_t loaded = 0;
        for (size_t e = 0; e < t->nelements; e++) {
            if (!t->load_row[e]) continue;
            const double *force = t->load + (t->load_row[e] - 1) * size;
            for (size_t i = 0; i < size; i++) sum[i % dimension] += force[i];
            for (size_t k = 0; k < 3; k++) far = fmax(far, fabs(node_at(model, e, k)[0]));
            loaded++;
        }
        for (size_t i = 0; i < dimension; i++)
            assert_close(sum[i], force_of(&spec.loading, i) * length_of(&spec.loading), 1e-13);
        print_message("plate %d: %zu of %zu elements\n", which, loaded, t->nelements);
        assert_true(loaded % 2 == 0 && loaded < t->nelements / 2);
        assert_true(far < 0.5 * spec.geometry.width);
        fracas_model_destroy(model);
    }
}

/* dp/dt = force by length times length, until t: both schemes add it up exactly. Rounding of 300
 * steps; the largest component for scale. */
static void free_bodies_take_up_the_momentum(void **unused)
{
    for (int which = 0; which < 2 * PLATES; which++) {
        fracas_spec spec = plate_of(which / 2);
        double before[3], after[3], off = 0;
        spec.time.integrator = schemes[which % 2];
        one_run run = begin(spec, 0.2);
        for (int s = 0; s < 20; s++) step_run(&run);
        momentum_of(&run, before);
        const double start = run.batch->step.time[0];
        for (int s = 0; s < 300; s++) step_run(&run);
        momentum_of(&run, after);
        const double t = run.batch->step.time[0] - start, length = length_of(&spec.loading);
        for (size_t i = 0; i < 3; i++)
            off = fmax(off, fabs((after[i] - before[i]) / t - force_of(&spec.loading, i) * length));
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        print_message("plate %d, %s: dp/dt off by %.1e, residual %.1e of the work\n", which / 2,
                      schemes[which % 2]->name, off / (4 * length),
                      ledger->largest_residual / ledger->work);
        assert_true(off < 1e-12 * 4 * length);
        assert_true(ledger->work > 0 && ledger->largest_residual < 1e-12 * ledger->work);
        clear_run(&run);
    }
}

/* ---- a bent strip ---- */

/* On simple supports, nu 0, under a force by length F on a line across its middle:
 * w = F L^3/(48 D), D = E h^3/12, and the energy F w b/2. The force rises in two periods of the
 * first mode, after which that stands still; the third has 1/81 of w and 1/9 of the time, so that
 * a ramp leaves 2/(9 omega rise) of it, 2e-4 of w. The mesh errs by the square of its size. */
static void a_strip_bends_as_a_beam(void **unused)
{
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
        fracas_spec spec = shell_spec(&fracas_shape_plate);
        const double h = 0.02, b = 0.2, force = 1e-5, D = 200 * h * h * h / 12,
                     omega = M_PI * M_PI * h * 10 / sqrt(12), w = force / (48 * D);
        spec.geometry.thickness = h;
        spec.geometry.height = b;
        spec.material.poisson = 0;
        spec.mesh.divisions = fine ? 4 : 2;
        spec.geometry.edge[1] = spec.geometry.edge[2] = &fracas_edge_fixed;
        spec.time.end = 1e3;
        spec.time.safety = 0.8;
        spec.loading = bare_load(&fracas_loading_line_force);
        *load_number(&spec.loading, "force_across") = force;
        *load_number(&spec.loading, "from_y") = -b / 2;
        *load_number(&spec.loading, "to_y") = b / 2;
        spec.loading.rise = 2 * 2 * M_PI / omega;
        one_run run = begin(spec, 0);
        while (run.batch->step.time[0] < spec.loading.rise) step_run(&run);
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        double middle = 0;
        for (size_t u = 2; u < unknowns_of(run.model); u += 3)
            if (hypot(place_of(run.model, u)[0], place_of(run.model, u)[1]) < 1e-9)
                middle = *value_of(run.batch, u, SURFACE_U);
        error[fine] = fabs(middle / w - 1);
        print_message("strip: w %+.1e, energy %+.1e, work %+.1e, residual %.1e\n", middle / w - 1,
                      ledger->elastic / (0.5 * force * w * b) - 1,
                      ledger->work / (0.5 * force * w * b) - 1,
                      ledger->largest_residual / ledger->work);
        assert_true(fabs(ledger->work / (0.5 * force * middle * b) - 1) < 0.01);
        assert_true(fabs(ledger->elastic / (0.5 * force * middle * b) - 1) < 0.01);
        assert_true(ledger->largest_residual < 1e-12 * ledger->work);
        clear_run(&run);
    }
    assert_true(error[1] < 0.01 && error[1] < error[0] / 2.5);
}

/* ---- groups of a mesh file ---- */

/* Four triangles in [0, 2] x [0, 1] mm; the edge at x = 1 mm is the group 5, "rib", and with `more`
 * that at x = 0. */
static fracas_campaign *campaign_of(const char *loading, bool more)
{
    static const char mesh[] =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 5 \"rib\"\n"
        "$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1e-3 0 0\n3 2e-3 0 0\n4 0 1e-3 0\n"
        "5 1e-3 1e-3 0\n6 2e-3 1e-3 0\n$EndNodes\n$Elements\n%d\n1 1 2 5 1 2 5\n2 2 0 1 2 5\n"
        "3 2 0 1 5 4\n4 2 0 2 3 6\n5 2 0 2 6 5\n%s$EndElements\n";
    char path[40], text[2000], file[1000];
    make_path(path);
    snprintf(file, sizeof file, mesh, more ? 6 : 5, more ? "6 1 2 5 1 1 4\n" : "");
    write_bytes(path, file, strlen(file));
    snprintf(text, sizeof text,
             "name: rib\nseed: 7\nmodel: membrane\n"
             "geometry: {shape: file, file: %s, thickness: 1 mm}\nmesh: {spacing: given}\n"
             "material: {young: 70 GPa, poisson: 0.25, density: 2700}\n"
             "cohesive: {fracture_energy: 1e9}\nstrength: {minimum: 1e9, scale: 1e7, shape: 2}\n"
             "loading: {type: line-force, %s}\ntime: {end: 1 us}\nreplicas: 1\n",
             path, loading);
    fracas_campaign *campaign = read_text(text);
    unlink(path);
    return campaign;
}

static void a_group_is_loaded_by_its_name(void **unused)
{
    OWN(fracas_campaign) rib = campaign_of("force_x: 3000, edge: rib", false);
    OWN(fracas_campaign) line = campaign_of("force_x: 3000, from_x: 1 mm, to_x: 1 mm, to_y: 1 mm",
                                            false);
    OWNED char *used = plan_text(rib, 1, false), *unused_group = plan_text(line, 1, false);
    assert_null(strstr(used, "lie inside the body"));
    assert_non_null(strstr(unused_group, "\"rib\" lie inside the body"));
    for (int k = 0; k < 2; k++) {
        OWN(fracas_model) model = NULL;
        OK(fracas_point_model_create(k ? line : rib, 0, &model));
        one_run run = begin_run(model, 1, 1e9);
        double momentum[3], start[3];
        step_run(&run);
        momentum_of(&run, start);
        const double from = run.batch->step.time[0];
        for (int s = 0; s < 20; s++) step_run(&run);
        momentum_of(&run, momentum);
        assert_close((momentum[0] - start[0]) / (run.batch->step.time[0] - from), 3, 1e-12);
        fracas_batch_destroy(run.batch);
    }
}

static void a_group_on_the_boundary_too_is_refused(void **unused)
{
    OWN(fracas_campaign) both = campaign_of("force_x: 3000, edge: rib", true);
    fracas_model *model = NULL;
    FAILS(fracas_point_model_create(both, 0, &model), FRACAS_USAGE,
          "1 edges inside the body and 1 on its boundary", "load them by a traction");
}

/* ---- refusals ---- */

static void lines_without_sense_are_refused(void **unused)
{
    fracas_model *model = NULL;
    fracas_loading load = bare_load(&fracas_loading_line_force);
    const fracas_loading_traits *traits = fracas_loading_line_force.traits;
    FAILS(traits->check(&load), FRACAS_USAGE, "line-force has no line", "edge: NAME");
    load.edge = fracas_load_edges[6];
    OK(traits->check(&load));
    *load_number(&load, "to_y") = 1;
    FAILS(traits->check(&load), FRACAS_USAGE, "both a line and the edges edge_1", "leave one out");
    fracas_spec spec = plate_of(0);
    *load_number(&spec.loading, "within") = NAN;
    *load_number(&spec.loading, "from_x") = -3 * spec.geometry.width;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "the line's start is",
          "raise loading.within");
    spec = plate_of(0);
    memset(load_number(&spec.loading, "force_x"), 0, 3 * sizeof(double));
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "line-force has no force", "give it");
    spec = plate_of(0);
    spec.loading.edge = fracas_load_edges[0]; /* left, on the boundary */
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "no edge inside the body", "left");
}

TESTS(a_path_has_the_force_of_its_line, free_bodies_take_up_the_momentum, a_strip_bends_as_a_beam,
      a_group_is_loaded_by_its_name, a_group_on_the_boundary_too_is_refused,
      lines_without_sense_are_refused)
