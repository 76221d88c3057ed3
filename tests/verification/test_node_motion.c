/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Nodes that loads hold or move: which they are, their places, a strip bent on three lines, and the
 * work of several motions at once (docs/theory/loads.md). */
#include "engine/loading/load.h"
#include "tests/support/campaign_text.h"
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

#include "campaigns/plan/point_model.h"

#include <unistd.h>

static const fracas_kind *const node_motion = &fracas_loading_node_motion;

/* Nodes with from <= x <= to; NaN: no limit. */
static fracas_loading nodes(const char *direction, const char *holds, double from, double to)
{
    static const char *const absent[] = {"from_y", "to_y", "from_z", "to_z",
                                         "within", "at_x", "at_y",   "at_z"};
    fracas_loading loading = bare_load(node_motion);
    for (size_t k = 0; k < FRACAS_COUNT(absent); k++) *load_number(&loading, absent[k]) = NAN;
    *load_number(&loading, "from_x") = from;
    *load_number(&loading, "to_x") = to;
    loading.direction = load_choice(node_motion, "direction", direction);
    loading.own_choice = load_choice(node_motion, "holds", holds);
    loading.rise_by = load_choice(node_motion, "rise_by", "smooth");
    return loading;
}

static fracas_loading displaced(fracas_loading loading, double displacement, double rise)
{
    loading.displacement = displacement;
    loading.rise = rise;
    return loading;
}

static fracas_spec plate_of(bool shell)
{
    fracas_spec spec = shell ? shell_spec(&fracas_shape_plate)
                             : membrane_spec(&fracas_shape_plate, 2, 5);
    if (shell) spec.mesh.divisions = 5;
    spec.cohesive.fracture_energy = 1e12;
    spec.time.end = shell ? 100 : 1;
    return spec;
}

/* A run of a body that never cracks. */
static one_run begin_whole(fracas_spec spec, double distortion)
{
    const bool shell = spec.formulation == &fracas_formulation_shell.kind;
    return begin_run(distorted_model(spec, distortion, 5), 1, shell ? 1e6 : 1e12);
}

static double residual_of(const one_run *run)
{
    const fracas_ledger *ledger = &run->batch->lane[0].ledger;
    return ledger->largest_residual /
           fmax(fabs(ledger->work), fmax(ledger->kinetic, ledger->elastic));
}

/* ---- places ---- */

/* A ball of nodes moves by s(t) along one axis, and rests along the others; a strip of nodes rests
 * along x alone. Those are held, to the last bit at their places, and no others. */
static void nodes_are_where_they_are_told_to_be(void **unused)
{
    for (int shell = 0; shell < 2; shell++) {
        fracas_spec spec = plate_of(shell);
        const double w = spec.geometry.width, radius = 0.22 * w;
        spec.loading = displaced(nodes(shell ? "z" : "y", "all", NAN, NAN), shell ? 1e-3 : 1e-6,
                                 shell ? 0.05 : 1e-6);
        *load_number(&spec.loading, "within") = radius;
        *load_number(&spec.loading, "at_x") = 0.1 * w;
        spec.also[0] = nodes("x", "along", -w, -0.4 * w);
        one_run run = begin_whole(spec, 0.2);
        const fracas_surface_tables *t = run.model->plan;
        const size_t dimension = (size_t)t->body->dimension, axis = shell ? 2 : 1;
        const fracas_loading_traits *traits = node_motion->traits;
        size_t moved = 0, resting = 0;
        for (int s = 0; s < 200; s++) {
            step_run(&run);
            const double path = traits->load->path(&spec.loading, &(fracas_profile){0},
                                                   run.batch->step.time[0]);
            for (size_t e = 0; e < run.model->elements; e++)
                for (size_t i = 0; i < fracas_surface_unknowns(t); i++) {
                    const double *x = node_at(run.model, e, i / dimension),
                                 u = *surface_value(run.model, &run.batch->step, e, SURFACE_U,
                                                    (int)i, 0);
                    const bool in_ball = hypot(x[0] - 0.1 * w, x[1]) <= radius,
                               in_strip = x[0] <= -0.4 * w && i % dimension == 0;
                    assert_true((t->held[e] >> i & 1) == (in_ball || in_strip));
                    if (in_ball) assert_true(u == (i % dimension == axis ? path : 0));
                    if (in_strip) assert_true(u == 0);
                    moved += in_ball;
                    resting += in_strip;
                }
        }
        assert_true(moved > 1000 && resting > 1000 && residual_of(&run) < 1e-12);
        clear_run(&run);
    }
}

/* ---- a strip on three lines ---- */

/* A strip of width b, nu 0, on lines L apart that rest along z, is bent by w at its middle: force
 * F = 48 E I w/L^3 in the middle and -F/2 of each line, energy and work F w/2. The nose rises in 5
 * periods of the first mode, omega = pi^2 (D/(rho h))^(1/2)/L^2 at least, which leaves at most 4e-3
 * of w; the mesh errs by the square of its size. */
static void a_strip_bends_on_three_lines(void **unused)
{
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
        fracas_spec spec = shell_spec(&fracas_shape_plate);
        const double h = 0.05, b = 0.25, L = 0.5, w = 1e-3;
        spec.geometry.thickness = h;
        spec.geometry.height = b;
        spec.material.poisson = 0;
        spec.mesh.divisions = fine ? 4 : 2;
        spec.time.end = 1e3;
        spec.cohesive.fracture_energy = 1e12;
        const double D = spec.material.young * h * h * h / 12,
                     omega = PI * PI / (L * L) * sqrt(D / (spec.material.density * h)),
                     rise = 5 * 2 * PI / omega, force = 48 * D * b * w / (L * L * L);
        spec.loading = displaced(nodes("z", "along", 0, 0), -w, rise);
        spec.also[0] = nodes("z", "along", -L / 2, -L / 2);
        spec.also[1] = nodes("z", "along", L / 2, L / 2);
        fracas_model *model = distorted_model(spec, 0, 5);
        fracas_batch *batch = batch_with(
            model, 1, (fracas_batch_options){.width = 1, .history = 2, .reactions = true});
        for (size_t k = 0; k < strengths_of(model); k++) bar_set_strength(batch, 0, k, 1e6);
        RECORD(record);
        OK(fracas_batch_begin(batch));
        double sum[3] = {0}, time = 0, got[FRACAS_HOLDERS][3];
        int64_t tag[FRACAS_HOLDERS];
        size_t running = 1;
        assert_int_equal(model->formulation->held_edges(model, tag), 3);
        for (int n = 0; n < 3; n++) assert_int_equal(tag[n], -(n + 1));
        while (batch->step.time[0] < 1.3 * rise) {
            OK(fracas_batch_step(batch, &record, &running));
            model->formulation->reactions(model, &batch->step, 0, got);
            if (batch->step.time[0] < rise) continue;
            time += batch->step.kick[0]; /* the mean over what still vibrates */
            for (int n = 0; n < 3; n++) sum[n] += batch->step.kick[0] * got[n][2];
        }
        const fracas_ledger *ledger = &batch->lane[0].ledger;
        error[fine] = fabs(sum[0] / time / -force - 1);
        print_message("three lines: nose %.1e, lines %.1e, %.1e, work %.1e, residual %.1e\n",
                      sum[0] / time / -force - 1, sum[1] / time / (force / 2) - 1,
                      sum[2] / time / (force / 2) - 1, ledger->work / (0.5 * force * w) - 1,
                      ledger->largest_residual / ledger->work);
        assert_true(fabs(sum[1] / sum[0] + 0.5) < 4e-3 && fabs(sum[2] / sum[0] + 0.5) < 4e-3);
        assert_true(fabs(ledger->work / (0.5 * force * w) - 1) < error[fine] + 4e-3);
        assert_true(ledger->largest_residual < 1e-12 * ledger->work);
        fracas_batch_destroy(batch);
        fracas_model_destroy(model);
    }
    assert_true(error[1] < 0.01 && error[1] < error[0] / 2.5);
}

/* ---- work ---- */

/* Two motions on paths of their own, a third set at rest, masses of all kinds, a strained start:
 * nothing cracks, so the ledger closes to the rounding of 1e3 steps  (loads.8). Without the second
 * motion the work is another. */
static void work_of_several_motions_is_exact(void **unused)
{
    const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                          &fracas_integrator_hulbert_chung};
    for (int c = 0; c < 8; c++) {
        const bool shell = c & 1, heavy = c & 2;
        fracas_spec spec = plate_of(shell);
        const double w = spec.geometry.width, u = shell ? 1e-3 : 1e-6, rise = shell ? 0.05 : 1e-6;
        spec.time.integrator = schemes[c / 4];
        spec.time.spectral_radius = 0.8;
        if (heavy && shell) spec.time.rotary_inertia = 1;
        if (heavy && !shell) spec.time.mass = &fracas_mass_consistent;
        if (heavy) spec.initial = (fracas_initial){.strain = {1e-7, 0, 0}};
        spec.loading = displaced(nodes(shell ? "z" : "x", "along", 0.3 * w, w), u, rise);
        spec.also[0] = displaced(nodes("y", "all", -w, -0.3 * w), 0, 0.5 * rise);
        spec.also[0].velocity = 0.5 * u / rise;
        spec.also[1] = nodes("y", "along", -0.1 * w, 0.1 * w);
        double work[2];
        for (int second = 0; second < 2; second++) {
            if (second) spec.also[0].velocity *= 2;
            one_run run = begin_whole(spec, 0.2);
            assert_int_equal(tables_of(run.model)->motions, 2);
            while (run.batch->step.time[0] < 3 * rise) step_run(&run);
            work[second] = run.batch->lane[0].ledger.work;
            print_message("%s, %s: work %.3e J, residual %.1e\n", shell ? "shell" : "membrane",
                          spec.time.integrator->name, work[second], residual_of(&run));
            assert_true(residual_of(&run) < 1e-12);
            clear_run(&run);
        }
        assert_true(fabs(work[1] - work[0]) > 1e-3 * fabs(work[0]));
    }
}

/* ---- a mesh file's group ---- */

/* Four triangles in [0, 2] x [0, 1] mm, of which an edge inside, at x = 1 mm, is the group "rib".
 */
static fracas_campaign *campaign_of(const char *loading)
{
    static const char mesh[] =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 5 \"rib\"\n"
        "$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1e-3 0 0\n3 2e-3 0 0\n4 0 1e-3 0\n"
        "5 1e-3 1e-3 0\n6 2e-3 1e-3 0\n$EndNodes\n$Elements\n5\n1 1 2 5 1 2 5\n2 2 0 1 2 5\n"
        "3 2 0 1 5 4\n4 2 0 2 3 6\n5 2 0 2 6 5\n$EndElements\n";
    char path[] = "/tmp/fracas-rib-XXXXXX", text[1024];
    const int fd = mkstemp(path);
    assert_true(fd >= 0 && write(fd, mesh, sizeof mesh - 1) == sizeof mesh - 1 && close(fd) == 0);
    snprintf(text, sizeof text,
             "name: rib\nseed: 7\nmodel: membrane\n"
             "geometry: {shape: file, file: %s, thickness: 1 mm}\nmesh: {spacing: given}\n"
             "material: {young: 70 GPa, poisson: 0.25, density: 2700}\n"
             "cohesive: {fracture_energy: 1e9}\nstrength: {minimum: 1e9, scale: 1e7, shape: 2}\n"
             "loading: {type: node-motion, %s}\ntime: {end: 1 us}\nreplicas: 1\n",
             path, loading);
    fracas_campaign *campaign = read_text(text);
    unlink(path);
    return campaign;
}

/* Its two nodes, of all six corners of elements that are there, are held along y. */
static void a_group_inside_is_held(void **unused)
{
    OWN(fracas_campaign) campaign = campaign_of(
        "edge: rib, direction: y, velocity: 2 m/s, rise: 1 us");
    OWN(fracas_model) model = NULL;
    OK(fracas_point_model_create(campaign, 0, &model));
    const fracas_surface_tables *t = model->plan;
    size_t held = 0;
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 0; i < 6; i++) {
            const double *x = node_at(model, e, i / 2);
            assert_true((t->held[e] >> i & 1) == (i % 2 == 1 && x[0] == 1e-3));
            held += t->held[e] >> i & 1;
        }
    assert_int_equal(held, 6);
}

/* ---- refusals ---- */

static void refuses(fracas_spec spec, const char *what, const char *remedy)
{
    for (int n = 0; n < FRACAS_LOADINGS; n++) {
        const fracas_loading *loading = fracas_loading_at(&spec, n);
        if (loading && fracas_loading_sections[n].check(loading)) {
            assert_non_null(strstr(fracas_message(), what));
            assert_non_null(strstr(fracas_message(), remedy));
            return;
        }
    }
    fracas_model *model = NULL;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, what, remedy);
}

static void sets_without_sense_are_refused(void **unused)
{
    fracas_spec spec = plate_of(true);
    const double w = spec.geometry.width;
    const fracas_loading punch = displaced(nodes("z", "along", -0.1 * w, 0.1 * w), 1e-3, 0.1);
    spec.loading = displaced(nodes("z", "along", 0.501 * w, w), 1e-3, 0.1);
    refuses(spec, "loading node-motion has no node: the nearest, at (0.5, ", "widen them");
    spec.loading = punch;
    *load_number(&spec.loading, "to_x") = -0.2 * w;
    refuses(spec, "below from_x", "no node is between them");
    spec.loading = punch;
    spec.loading.velocity = 1;
    refuses(spec, "both are given", "leave one out");
    spec.loading = punch;
    spec.loading.displacement = 0;
    refuses(spec, "has rise, but neither displacement nor velocity", "give one");
    spec.loading = punch;
    spec.loading.rise = NAN;
    refuses(spec, "would jump", "rise: 20 us");
    spec.loading = punch;
    *load_number(&spec.loading, "at_y") = 1;
    refuses(spec, "at_x, at_y or at_z is given", "no within");
    spec.loading = punch;
    spec.loading.edge = load_choice(node_motion, "edge", "left");
    refuses(spec, "limits and the edges left", "leave one out");
    spec.loading = punch;
    spec.also[0] = nodes("z", "all", 0, 0);
    refuses(spec, "loading_2 node-motion and another one prescribe the same component", "take it");
    spec.also[0] = displaced(nodes("x", "along", 0, 0), 1e-3, 0.1);
    refuses(spec, "loading and loading_2 move nodes of one element", "an element apart");
    spec = plate_of(true);
    for (int tag = 1; tag < 5; tag++) spec.geometry.edge[tag] = &fracas_edge_fixed;
    spec.loading = displaced(nodes("z", "along", NAN, NAN), 1e-3, 0.1);
    *load_number(&spec.loading, "within") = 1e-3 * w;
    OWN(fracas_model) bare = make_model(&spec);
    const fracas_surface_border *border = &bare->surface->border[0];
    const double *middle = node_at(bare, border->element, 3 + border->edge); /* of no other */
    *load_number(&spec.loading, "at_x") = middle[0];
    *load_number(&spec.loading, "at_y") = middle[1];
    refuses(spec, "loading node-motion holds nothing", "free them");
    spec = plate_of(false);
    spec.loading = nodes("x", "all", 0, 0);
    refuses(spec, "", "nothing would ever move");
}

TESTS(nodes_are_where_they_are_told_to_be, a_strip_bends_on_three_lines,
      work_of_several_motions_is_exact, a_group_inside_is_held, sets_without_sense_are_refused)
