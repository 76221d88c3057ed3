/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step of the shell in a batch: what its kick and energies are by the operator, and what edges
 * hold. */
#include "tests/support/shell_bodies.h"
#include "tests/support/test.h"

static void a_step_is_the_operator(void **unused)
{
    const int widths[] = {1, 4, 8};
    for (int which = 0; which < BODIES; which++)
        for (int w = 0; w < 6; w++) {
            fracas_spec spec = shell_spec(&fracas_shape_sphere);
            spec.time.rotary_inertia = w / 3;
            if (which != SPHERE)
                spec.geometry.edge[1] = spec.geometry.edge[3] = &fracas_edge_clamped;
            check_first_step(body_of(which, spec, 3, 5), widths[w % 3], 1e3, 1e-6);
        }
}

/* In planes of symmetry nodes are held across t, on a plate's diaphragms along it. */
static void rotary_inertia_of_held_nodes(void **unused)
{
    const double unit[2] = {1, 1};
    fracas_spec spec = shell_spec(&fracas_shape_sphere);
    spec.time.rotary_inertia = 1;
    spec.geometry.part = &fracas_part_octant;
    spec.mesh.divisions = 4;
    check_first_step(distorted_model(spec, DISTORTION, 5), 8, 1e3, 1e-6);
    spec.geometry.shape = &fracas_shape_file;
    for (int tag = 1; tag <= PLATE_SIDES; tag++)
        spec.geometry.edge[tag] = tag % 2 ? &fracas_edge_diaphragm : &fracas_edge_symmetry;
    const shell_grid grid = {.nx = 3, .ny = 4, .map = flat_map, .how = unit, .distortion = 0.1};
    check_first_step(grid_model(&spec, &grid), 1, 1e3, 1e-6);
}

static void lifted_map(const void *unused, double s, double t, double x[3])
{
    x[0] = s;
    x[1] = t;
    x[2] = 0.7;
}

/* Edges move along t, as fast as all else: nothing turns, no edge works. */
static void rotary_inertia_of_a_translation(void **unused)
{
    double kinetic[2];
    for (int rotary = 0; rotary < 2; rotary++) {
        fracas_spec spec = shell_spec(&fracas_shape_file);
        for (int tag = 1; tag <= PLATE_SIDES; tag++) spec.geometry.edge[tag] = &fracas_edge_held;
        spec.time.rotary_inertia = rotary;
        spec.loading.rate = 1e-6;
        const shell_grid grid = {.nx = 3, .ny = 3, .map = lifted_map, .distortion = 0.1};
        one_run run = begin_run(grid_model(&spec, &grid), 1, 1e3);
        step_run(&run);
        kinetic[rotary] = run.batch->step.kinetic[0];
        clear_run(&run);
    }
    assert_true(kinetic[0] > 0 && fabs(kinetic[1] / kinetic[0] - 1) < 1e-12);
}

/* Edges begin to move along t, and work against R, too. Before any crack the ledger is exact for
 * constant velocities of the edges, of Hulbert-Chung with what it damps (membrane.21): round-off of
 * 60 steps, 1e-12 of the work. */
static void check_work_on_rotary_inertia(const fracas_kind *integrator)
{
    fracas_spec spec = shell_spec(&fracas_shape_file);
    for (int tag = 1; tag <= PLATE_SIDES; tag++) spec.geometry.edge[tag] = &fracas_edge_held;
    spec.geometry.thickness = 0.5;
    spec.time.rotary_inertia = 1;
    spec.time.safety = 0.1;
    spec.time.integrator = integrator;
    spec.time.spectral_radius = 0.5;
    spec.loading.start = &fracas_start_rest;
    spec.loading.rate = 1e-6;
    const shell_grid grid = {.nx = 3, .ny = 3, .map = lifted_map, .distortion = 0.1};
    one_run run = begin_run(grid_model(&spec, &grid), 1, 1e3);
    for (int n = 0; n < 60; n++) step_run(&run);
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    print_message("%s: work %g, residual %g, damped %g of it\n", integrator->name, ledger->work,
                  ledger->residual / ledger->work, ledger->damped / ledger->work);
    assert_true(ledger->work > 0 && fabs(ledger->residual) < 1e-12 * ledger->work);
    assert_true(integrator == &fracas_integrator_central_difference
                    ? ledger->damped == 0
                    : ledger->damped > 1e-6 * ledger->work);
    clear_run(&run);
}

static void rotary_inertia_takes_work(void **unused)
{
    check_work_on_rotary_inertia(&fracas_integrator_central_difference);
    check_work_on_rotary_inertia(&fracas_integrator_hulbert_chung);
}

/* Held edges of two kinds meet in a corner: it does not limit the step. A plate twice as thick as
 * its cells are long has steps 3 times as long and more with rotary inertia. */
static void rotary_inertia_in_corners(void **unused)
{
    static const double unit[2] = {1, 1};
    const fracas_kind *const kinds[] = {&fracas_edge_clamped, &fracas_edge_held,
                                        &fracas_edge_diaphragm, &fracas_edge_symmetry};
    for (int k = 0; k < 4; k++) {
        double step[2];
        for (int rotary = 0; rotary < 2; rotary++) {
            fracas_spec spec = shell_spec(&fracas_shape_file);
            spec.geometry.thickness = 0.5;
            spec.geometry.edge[1] = &fracas_edge_symmetry;
            spec.geometry.edge[3] = kinds[k];
            spec.time.rotary_inertia = rotary;
            const shell_grid grid = {.nx = 4, .ny = 4, .map = flat_map, .how = unit};
            OWN(fracas_model) model = grid_model(&spec, &grid);
            step[rotary] = model->critical_step;
        }
        print_message("%s beside a symmetry: steps %.2f times as long\n", kinds[k]->name,
                      step[1] / step[0]);
        assert_true(step[1] > 3 * step[0]);
    }
}

/* The critical step by power iteration, which needs no mass matrix: Lanczos' bound is above omega^2
 * by less than 2e-3 of it, and 20 000 powers, of a mode as near as 1e-3, are below by 1e-4. */
static void rotary_inertia_bounds_the_step(void **unused)
{
    double longest[2];
    for (int rotary = 0; rotary < 2; rotary++) {
        fracas_spec spec = shell_spec(&fracas_shape_sphere);
        spec.time.rotary_inertia = rotary;
        spec.geometry.part = &fracas_part_octant;
        spec.geometry.thickness = 0.3;
        spec.mesh.divisions = 6;
        OWN(fracas_model) model = distorted_model(spec, DISTORTION, 5);
        const size_t n = unknowns_of(model);
        OWNED double *u = vector_of(n), *a = vector_of(n);
        fracas_surface_operator *op = open_operator(model);
        uint64_t noise = 7;
        double square = 0;
        for (size_t i = 0; i < n; i++) u[i] = is_held(model, i) ? 0 : next_share(&noise) - 0.5;
        for (int power = 0; power < 20000; power++) {
            fracas_surface_operator_apply(op, u, a);
            square = sqrt(dot_of(a, a, n) / dot_of(u, u, n));
            for (size_t i = 0; i < n; i++) u[i] = -a[i] / square;
        }
        longest[rotary] = model->critical_closed;
        const double ratio = square / pow(2 / model->critical_closed, 2);
        print_message("rotary inertia %d: critical step %g s, omega^2 by powers %.5f\n", rotary,
                      model->critical_closed, ratio);
        assert_true(ratio < 1 && ratio > 1 - 2.2e-3);
        fracas_surface_operator_close(op);
    }
    assert_true(longest[1] > 1.5 * longest[0]);
}

/* ---- edges ---- */

/* What an edge of the flat plate does to a node on it, component i: 'f' free, '0' at rest, 'v' with
 * the loading. */
static char held_of(const fracas_kind *kind, int axis, int i)
{
    if (kind == &fracas_edge_held) return 'v';
    if (kind == &fracas_edge_fixed || kind == &fracas_edge_clamped) return '0';
    if (kind == &fracas_edge_symmetry) return i == axis ? '0' : 'f';
    if (kind == &fracas_edge_diaphragm) return i == axis ? 'f' : '0';
    return 'f';
}

/* Only elements that have the edge are held on it; and after 20 steps nodes are where they should
 * be, the ledger closes by what the edges do: its residual is that of the trapezoidal rule of work,
 * of the order of (omega dt)^2/10 of what they do. */
static void edges_hold_what_they_should(void **unused)
{
    const fracas_kind *const kinds[] = {&fracas_edge_free,     &fracas_edge_held,
                                        &fracas_edge_fixed,    &fracas_edge_clamped,
                                        &fracas_edge_symmetry, &fracas_edge_diaphragm};
    const double unit[2] = {1, 1}, rate = 1e-6;
    for (int k = 0; k < 6; k++)
        for (int tag = 1; tag <= PLATE_SIDES; tag++) {
            fracas_spec spec = shell_spec(&fracas_shape_file);
            spec.geometry.edge[tag] = kinds[k];
            spec.loading.rate = rate;
            spec.loading.ratio = 0.5;
            spec.time.rotary_inertia = tag % 2;
            one_run run = begin_run(grid_model(&spec, &(shell_grid){.nx = 3,
                                                                    .ny = 3,
                                                                    .map = flat_map,
                                                                    .how = unit,
                                                                    .distortion = 0.1,
                                                                    .seed = 3}),
                                    1, 1e3);
            const fracas_surface *s = run.model->surface;
            const double speed[3] = {rate, 0.5 * rate, rate};
            for (int n = 0; n < 20; n++) step_run(&run);
            for (size_t i = 0; i < unknowns_of(run.model); i++) {
                const size_t e = i / SHELL_UNKNOWNS, node = i % SHELL_UNKNOWNS / 3;
                char expected = 'f';
                for (size_t b = 0; b < s->nborders; b++) {
                    const fracas_surface_border *border = &s->border[b];
                    const bool on = node == border->edge || node == (border->edge + 1) % 3 ||
                                    node == 3 + border->edge;
                    if (border->element == e && border->tag == tag && on)
                        expected = held_of(kinds[k], tag < 3 ? 0 : 1, (int)i % 3);
                }
                assert_true((expected != 'f') == is_held(run.model, i));
                const double v = *value_of(run.batch, i, SURFACE_V),
                             u = *value_of(run.batch, i, SURFACE_U);
                const double by_loading = speed[i % 3] * place_of(run.model, i)[i % 3];
                if (expected == '0') assert_true(v == 0 && u == 0);
                if (expected == 'v')
                    assert_true(fabs(v - by_loading) <= 1e-15 * rate &&
                                fabs(u - run.batch->step.time[0] * by_loading) < 1e-13 * rate);
            }
            const fracas_ledger *ledger = &run.batch->lane[0].ledger;
            assert_true(fabs(ledger->residual) <
                        0.02 * fmax(fabs(ledger->work), 1e-10 * ledger->initial));
            clear_run(&run);
        }
}

/* `how`: the angle by which the plate is turned about y, out of the plane z = 0 [rad]. */
static void tilted_map(const void *how, double s, double t, double x[3])
{
    const double angle = *(const double *)how;
    x[0] = s * cos(angle);
    x[1] = t;
    x[2] = s * sin(angle);
}

/* A symmetry lies in a plane x, y or z = const that the shell meets at a right angle: the edge s =
 * 1 is in a plane x = const and in one z = const, which only plates that lie or stand meet so; a
 * diaphragm may be met at any angle. An octant of one element passes: its edges lean by less than
 * coarse meshes may. */
static void oblique_edges_are_refused(void **unused)
{
    const double degrees[] = {0, 30, 45, 60, 90};
    for (int k = 0; k < 5; k++)
        for (int which = 0; which < 2; which++) {
            const double angle = degrees[k] * PI / 180;
            fracas_spec spec = shell_spec(&fracas_shape_file);
            fracas_model *free_one = grid_model(
                             &spec,
                             &(shell_grid){.nx = 2, .ny = 2, .map = tilted_map, .how = &angle}),
                         *model = NULL;
            gmsh_file file = gmsh_write(free_one->surface, false, true, false);
            const fracas_attachment mesh = {
                .path = "tilted", .text = file.bytes, .size = file.size};
            spec.geometry.file = &mesh;
            spec.geometry.edge[2] = which ? &fracas_edge_diaphragm : &fracas_edge_symmetry;
            spec.mesh = (fracas_mesh){.spacing = &fracas_spacing_given};
            const fracas_err err = fracas_model_create(&spec, &model);
            assert_int_equal(err, which || k == 0 || k == 4
                                      ? FRACAS_OK
                                      : FRACAS_USAGE); /* a diaphragm may be met at any angle */
            if (err) assert_non_null(strstr(fracas_message(), "right angle"));
            if (!err) fracas_model_destroy(model);
            free(file.bytes);
            fracas_model_destroy(free_one);
        }
    fracas_spec spec = shell_spec(&fracas_shape_sphere);
    spec.geometry.part = &fracas_part_octant;
    spec.mesh.divisions = 1;
    fracas_model_destroy(distorted_model(spec, 0, 0));
}

TESTS(a_step_is_the_operator, rotary_inertia_of_held_nodes, rotary_inertia_of_a_translation,
      rotary_inertia_takes_work, rotary_inertia_in_corners, rotary_inertia_bounds_the_step,
      edges_hold_what_they_should, oblique_edges_are_refused)
