/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Edges that move as prescribed: their places, closed forms of bodies that do not crack, and the
 * work of their forces (docs/theory/loads.md). */
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

/* ---- bodies ---- */

/* Displaced smoothly by `displacement` in `rise`; second NULL: the one edge alone. */
static fracas_spec moved(fracas_spec spec, const char *edge, const char *second,
                         const char *direction, double displacement, double rise)
{
    spec.loading = (fracas_loading){.type = &fracas_loading_edge_motion,
                                    .edge = motion_choice("edge", edge),
                                    .second_edge = second ? motion_choice("second_edge", second)
                                                          : NULL,
                                    .direction = motion_choice("direction", direction),
                                    .displacement = displacement,
                                    .rise = rise,
                                    .rise_by = motion_choice("rise_by", "smooth")};
    return spec;
}

/* A run of a body that never cracks. */
static one_run begin_whole(fracas_spec spec, double distortion)
{
    const bool shell = spec.formulation == &fracas_formulation_shell.kind;
    spec.cohesive.fracture_energy = 1e12;
    spec.time.end = shell ? 100 : 1;
    return begin_run(distorted_model(spec, distortion, 5), 1, shell ? 1e6 : 1e12);
}

static fracas_spec plate_of(const fracas_formulation *model)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, 2, 5);
    if (model != &fracas_formulation_shell) return spec;
    spec = shell_spec(&fracas_shape_plate);
    spec.mesh.divisions = 5;
    return spec;
}

/* ---- the path ---- */

/* s(t) of 3 m or 3 m/s. */
static double path_at(fracas_loading loading, double t)
{
    const fracas_loading_traits *traits = loading.type->traits;
    fracas_profile history;
    OK(fracas_load_history(&loading, &history));
    const double s = traits->load->path(&loading, &history, t);
    fracas_profile_clear(&history);
    return s;
}

static void near(double a, double b)
{
    assert_true(fabs(a - b) <= 2e-15 * fmax(1, fabs(b))); /* a few roundings of numbers up to 3 */
}

/* Halfway the smooth rise is 1/2, and its integral to its end 1/2; 10/32 - 15/64 + 6/128 ... */
static void paths_rise_as_told(void **unused)
{
    fracas_loading l =
        moved(plate_of(&fracas_formulation_membrane), "top", NULL, "outward", 3, 2).loading;
    near(path_at(l, -1), 0);
    near(path_at(l, 0), 0);
    near(path_at(l, 1), 1.5);
    near(path_at(l, 0.5), 3 * (10.0 / 64 - 15.0 / 256 + 6.0 / 1024));
    near(path_at(l, 7), 3);
    l.displacement = 0, l.velocity = 3;
    near(path_at(l, 1), 3 * 2 * (2.5 / 16 - 3.0 / 32 + 1.0 / 64));
    near(path_at(l, 2), 3);
    near(path_at(l, 3), 6);
    l.rise_by = motion_choice("rise_by", "linear");
    near(path_at(l, 1), 0.75);
    near(path_at(l, 3), 6);
    l.rise = NAN;
    near(path_at(l, 3), 9);
}

/* A velocity's factors 0.5 at 1, 1 at 3, then -2 from 3 on: integrals by hand. */
static void histories_are_integrated(void **unused)
{
    static const char text[] = "1,0.5\n3,1\n3,-2\n";
    const fracas_attachment file = {.path = "h.csv", .text = text, .size = sizeof text - 1};
    fracas_loading l =
        moved(plate_of(&fracas_formulation_membrane), "top", NULL, "outward", 0, NAN).loading;
    l.history = &file;
    l.velocity = 2;
    near(path_at(l, 0.5), 2 * 0.25);
    near(path_at(l, 2), 2 * (0.5 + 0.625));
    near(path_at(l, 3), 2 * (0.5 + 1.5));
    near(path_at(l, 4), 2 * (0.5 + 1.5 - 2));
    l.velocity = 0, l.displacement = 2;
    near(path_at(l, 2), 1.5);
    FAILS(fracas_loading_sections[0].check(&l), FRACAS_USAGE, "says 0.5 at 0 s", "would jump");
}

static void refuses(const fracas_loading *loading, const char *one, const char *other)
{
    FAILS(fracas_loading_sections[0].check(loading), FRACAS_USAGE, one, other);
}

static void motions_without_sense_are_refused(void **unused)
{
    static const char text[] = "0,0\n1,0\n1,1\n";
    const fracas_attachment file = {.path = "h.csv", .text = text, .size = sizeof text - 1};
    const fracas_spec plate = plate_of(&fracas_formulation_membrane);
    fracas_loading l = moved(plate, "top", "bottom", "outward", 1, 2).loading;
    OK(fracas_loading_sections[0].check(&l));
    l.velocity = 1;
    refuses(&l, "both are given", "leave one out");
    l.displacement = 0;
    OK(fracas_loading_sections[0].check(&l));
    l.velocity = 0;
    refuses(&l, "neither is given", "displacement: 2 um");
    l.displacement = -1;
    OK(fracas_loading_sections[0].check(&l));
    l.rise = NAN;
    refuses(&l, "neither rise nor history", "would jump");
    l.history = &file;
    refuses(&l, "two factors at 1 s", "would jump");
    l.rise = 2;
    refuses(&l, "history and rise", "leave rise out");
    l.history = NULL;
    l.second_edge = l.edge;
    refuses(&l, "are both top", "name another edge");
    fracas_spec spec = moved(plate, "top", NULL, "along", 1e-6, 1e-6);
    spec.geometry.edge[4] = &fracas_edge_sliding; /* not held along itself */
    fracas_model *model = NULL;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "sliding, does not hold it",
          "leave it free");
    spec = moved(membrane_spec(&fracas_shape_annulus, 2, 3), "top", NULL, "outward", 1, 1);
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "loading.edge is top",
          "inner_edge, outer_edge");
    spec = moved(membrane_spec(&fracas_shape_annulus, 2, 3), "outer_edge", "left", "outward", 1, 1);
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "loading.second_edge is left",
          "inner_edge, outer_edge");
}

/* ---- places ---- */

/* All components of moved edges are where they are told to be, to the last bit: those beside the
 * direction at 0. The fixed left edge stays, its corners included; the corner of both moved edges
 * goes with both. */
static void check_places(fracas_spec spec, const double top[3], const double right[3], int steps)
{
    one_run run = begin_whole(spec, 0.2);
    const fracas_surface_tables *t = run.model->plan;
    const fracas_step *step = &run.batch->step;
    const size_t dimension = (size_t)t->body->dimension, nodes = run.model->surface->corners;
    const double fixed[3] = {0};
    size_t checked = 0, both = 0; /* elements with a fixed and a moved edge */
    double largest = 0;
    for (int s = 0; s < steps; s++) {
        step_run(&run);
        const double path = path_at(spec.loading, step->time[0]);
        largest = fmax(largest, fabs(path));
        for (size_t b = 0; b < run.model->surface->nborders; b++) {
            const fracas_surface_border *border = &run.model->surface->border[b];
            const double *to = border->tag == 4 ? top : border->tag == 2 ? right : fixed;
            both += b > 0 && border[-1].element == border->element &&
                    border[-1].tag + border->tag == 5;
            const size_t node[3] = {border->edge, (border->edge + 1) % 3, 3 + border->edge};
            for (size_t n = 0; border->tag != 3 && n < (nodes == 6 ? 3 : 2); n++) {
                const double *x = node_at(run.model, border->element, node[n]);
                const bool corner = fabs(x[0]) > 0.4999 * spec.geometry.width &&
                                    fabs(x[1]) > 0.4999 * spec.geometry.height;
                const bool shared = corner && x[0] > 0 && x[1] > 0;
                for (size_t i = 0; (to == fixed || !corner || shared) && i < dimension;
                     i++, checked++) {
                    const double also = shared && to != fixed && top[i] != right[i]
                                            ? to == top ? right[i] : top[i]
                                            : 0;
                    const double u = *surface_value(run.model, step, border->element, SURFACE_U,
                                                    (int)(dimension * node[n] + i), 0);
                    assert_true(u == path * (to[i] + also));
                }
            }
        }
    }
    assert_true(checked > 100 && largest > 0 && both > 0);
    clear_run(&run);
}

static void edges_are_where_they_are_told_to_be(void **unused)
{
    const fracas_formulation *const models[] = {&fracas_formulation_membrane,
                                                &fracas_formulation_shell};
    const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                          &fracas_integrator_hulbert_chung};
    for (int m = 0; m < 2; m++)
        for (int s = 0; s < 2; s++) {
            const double u = m ? 1e-3 : 1e-6, rise = m ? 0.05 : 1e-6;
            fracas_spec spec = moved(plate_of(models[m]), "top", "right", "outward", u, rise);
            spec.time.integrator = schemes[s];
            spec.geometry.edge[1] = &fracas_edge_fixed;
            check_places(spec, (double[]){0, 1, 0}, (double[]){1, 0, 0}, 300);
            spec.loading.direction = motion_choice("direction", "along"); /* the body on the left */
            check_places(spec, (double[]){-1, 0, 0}, (double[]){0, 1, 0}, 300);
            spec.loading.direction = motion_choice("direction", "across");
            if (m) check_places(spec, (double[]){0, 0, 1}, (double[]){0, 0, 1}, 300);
        }
}

/* Neighbours on a bent rim go the same way at their common node, by the mean of their normals:
 * along the radius, as borders are of one length, but for rounding of 1e2 of them. */
static void bent_edges_stay_whole(void **unused)
{
    for (int64_t order = 1; order <= 2; order++) {
        const fracas_spec spec = moved(membrane_spec(&fracas_shape_annulus, order, 3), "outer_edge",
                                       NULL, "outward", 1e-6, 1e-6);
        fracas_model *model = distorted_model(spec, 0.2, 5);
        const fracas_surface *surface = model->surface;
        const fracas_surface_tables *t = model->plan;
        size_t checked = 0;
        for (size_t b = 0; b < surface->nborders; b++) {
            const fracas_surface_border *border = &surface->border[b];
            const size_t e = border->element,
                         node[3] = {border->edge, (border->edge + 1) % 3, 3 + border->edge};
            for (int n = 0; border->tag == 2 && n <= order; n++, checked++) {
                const double *d = t->direction +
                                  (t->moved_row[e] - 1) * fracas_surface_unknowns(t) + 2 * node[n],
                             *x = node_at(model, e, node[n]), r = hypot(x[0], x[1]);
                assert_true(hypot(d[0] - x[0] / r, d[1] - x[1] / r) < 1e-13);
            }
        }
        assert_true(checked > 30);
        fracas_model_destroy(model);
    }
}

/* ---- closed forms ---- */

static double largest_energy(const fracas_ledger *ledger)
{
    return fmax(fabs(ledger->work), fmax(ledger->kinetic, ledger->elastic));
}

static double residual_of(const one_run *run)
{
    const fracas_ledger *ledger = &run->batch->lane[0].ledger;
    return ledger->largest_residual / largest_energy(ledger);
}

/* A plate of height H between edges that slide, each displaced by u slowly: even stress, E 2u/H
 * with free sides, E/(1 - nu^2) 2u/H where they slide, too; energy = work = sigma eps/2 of its
 * volume. The smooth rise's third derivative jumps by 60/T^3 at both ends, which leaves a vibration
 * of up to 2 60/(omega T)^3 of u, omega = pi c/H the lowest: 2 (60/(20 pi)^3) = 5e-4 for T = 20
 * H/c. Energies are twice as sensitive: 1e-3. */
static void a_slow_pull_stretches_evenly(void **unused)
{
    for (int constrained = 0; constrained < 2; constrained++)
        for (int64_t order = 1; order <= 2; order++) {
            fracas_spec spec = membrane_spec(&fracas_shape_plate, order, 4);
            const double E = spec.material.young, nu = spec.material.poisson,
                         height = spec.geometry.height, c = sqrt(E / spec.material.density),
                         u = 1e-6, volume = height * spec.geometry.width * spec.geometry.thickness,
                         modulus = constrained ? E / (1 - nu * nu) : E, strain = 2 * u / height;
            spec = moved(spec, "bottom", "top", "outward", u, 20 * height / c);
            for (int tag = 1; tag <= 4; tag++)
                if (constrained || tag > 2) spec.geometry.edge[tag] = &fracas_edge_sliding;
            one_run run = begin_whole(spec, 0.2);
            while (run.batch->step.time[0] < 21 * height / c) step_run(&run);
            const fracas_ledger *ledger = &run.batch->lane[0].ledger;
            const double energy = 0.5 * modulus * strain * strain * volume,
                         force = run.batch->step.driven[0][0]; /* of both edges along their paths */
            print_message(
                "%s sides, order %d: energy %.1e, work %.1e, stress %.1e, residual %.1e\n",
                constrained ? "sliding" : "free", (int)order, ledger->elastic / energy - 1,
                ledger->work / energy - 1,
                force / (2 * modulus * strain * spec.geometry.width * spec.geometry.thickness) - 1,
                residual_of(&run));
            assert_true(fabs(ledger->elastic / energy - 1) < 1e-3);
            assert_true(fabs(ledger->work / energy - 1) < 1e-3);
            assert_true(fabs(force / (2 * modulus * strain * spec.geometry.width *
                                      spec.geometry.thickness) -
                             1) < 1e-3);
            assert_true(residual_of(&run) < 1e-12);
            clear_run(&run);
        }
}

/* An edge that moves at v from rest pulls with rho c v, c^2 = E/((1 - nu^2) rho) between edges that
 * slide: work rho c v^2 A t, half of it kinetic, half elastic, momentum rho c v A t until the wave
 * gets to the other end. The first element takes its share at once, and the front is as wide as
 * some elements: 2 h by c t. */
static void a_wave_runs_from_an_edge(void **unused)
{
    const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                          &fracas_integrator_hulbert_chung};
    for (int s = 0; s < 2; s++)
        for (int heavy = 0; heavy < 2; heavy++) {
            fracas_spec spec = membrane_spec(&fracas_shape_plate, 1 + heavy, 2);
            spec.geometry.width = 40e-3;
            spec.geometry.height = 1e-3;
            spec = moved(spec, "right", NULL, "outward", 0, NAN);
            spec.loading.velocity = 3;
            for (int tag = 2; tag <= 4; tag++) spec.geometry.edge[tag] = &fracas_edge_sliding;
            spec.time.integrator = schemes[s];
            if (heavy) spec.time.mass = &fracas_mass_consistent;
            const double nu = spec.material.poisson, rho = spec.material.density,
                         c = sqrt(spec.material.young / (rho * (1 - nu * nu))), v = 3,
                         area = spec.geometry.height * spec.geometry.thickness;
            one_run run = begin_whole(spec, 0);
            while (run.batch->step.time[0] < 0.9 * spec.geometry.width / c) step_run(&run);
            const double t = run.batch->step.time[0], power = rho * c * v * v * area;
            const fracas_ledger *ledger = &run.batch->lane[0].ledger;
            const fracas_surface_tables *tables = run.model->plan;
            double momentum = 0;
            for (size_t e = 0; e < run.model->elements; e++)
                for (size_t k = 0; k < run.model->surface->corners; k++)
                    for (size_t l = 0; l < run.model->surface->corners; l++)
                        momentum += fracas_surface_mass(tables, e, k, l) *
                                    *surface_value(run.model, &run.batch->step, e, SURFACE_V,
                                                   (int)(2 * l), 0);
            print_message("%s, order %d: work %.1e, kinetic %.1e, momentum %.1e, residual %.1e\n",
                          schemes[s]->name, 1 + heavy, ledger->work / (power * t) - 1,
                          2 * ledger->kinetic / (power * t) - 1, momentum * v / (power * t) - 1,
                          residual_of(&run));
            const double least = 2 * 0.5e-3 / (0.9 * spec.geometry.width);
            assert_true(fabs(ledger->work / (power * t) - 1) < least);
            assert_true(fabs(2 * ledger->kinetic / (power * t) - 1) < 2 * least);
            assert_true(fabs(momentum * v / (power * t) - 1) < least);
            assert_true(residual_of(&run) < 1e-12);
            clear_run(&run);
        }
}

/* A free plate that an edge takes along with the acceleration b: the edge pulls with m b, on
 * average over the vibration that the start leaves, and the velocity's smooth rise to v takes the
 * work m v^2/2. A vibration of 2 60/(omega T)^3 of v with omega = pi c/(2 L), T = 40 L/c: 5e-4. */
static void an_edge_takes_the_body_along(void **unused)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, 1, 4);
    const double c = sqrt(spec.material.young / spec.material.density), v = 10,
                 rise = 40 * spec.geometry.width / c;
    spec = moved(spec, "right", NULL, "outward", 0, rise);
    spec.loading.velocity = v;
    one_run run = begin_whole(spec, 0.2);
    double impulse = 0;
    while (run.batch->step.time[0] < rise) {
        step_run(&run);
        impulse += run.batch->step.driven[0][0] * run.batch->step.kick[0];
    }
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    const double mass = run.model->mass;
    print_message("taken along: work %.1e, kinetic %.1e, impulse %.1e, residual %.1e\n",
                  ledger->work / (0.5 * mass * v * v) - 1,
                  ledger->kinetic / (0.5 * mass * v * v) - 1, impulse / (mass * v) - 1,
                  residual_of(&run));
    assert_true(fabs(ledger->work / (0.5 * mass * v * v) - 1) < 1e-3);
    assert_true(fabs(ledger->kinetic / (0.5 * mass * v * v) - 1) < 1e-3);
    assert_true(fabs(impulse / (mass * v) - 1) < 1e-3);
    assert_true(residual_of(&run) < 1e-12);
    clear_run(&run);
}

/* A strip of length L and width b, nu 0, clamped at its left end: its right end, which may turn, is
 * moved across by w slowly: energy = work = 3 D b w^2/(2 L^3), D = E h^3/12, but for shear, which
 * these shells have none of. The vibration left, omega = 3.927^2 (D/(rho h))^(1/2)/L^2, T = 5
 * periods: 2 60/(10 pi)^3 = 4e-3; and the mesh's second order. */
static void a_cantilever_bends(void **unused)
{
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
        fracas_spec spec = shell_spec(&fracas_shape_plate);
        spec.geometry.height = 0.25;
        spec.geometry.thickness = 0.05;
        spec.material.poisson = 0;
        spec.mesh.divisions = fine ? 2 : 1;
        spec.geometry.edge[1] = &fracas_edge_clamped;
        const double h = spec.geometry.thickness, w = 1e-3,
                     D = spec.material.young * h * h * h / 12,
                     omega = 3.927 * 3.927 * sqrt(D / (spec.material.density * h)),
                     rise = 5 * 2 * PI / omega, energy = 1.5 * D * spec.geometry.height * w * w;
        one_run run = begin_whole(moved(spec, "right", NULL, "across", w, rise), 0);
        while (run.batch->step.time[0] < rise) step_run(&run);
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        error[fine] = ledger->elastic / energy - 1;
        print_message("cantilever: energy %.1e, work %.1e, residual %.1e\n", error[fine],
                      ledger->work / energy - 1, residual_of(&run));
        assert_true(fabs(ledger->work - ledger->elastic) < 4e-3 * energy);
        assert_true(residual_of(&run) < 1e-12);
        clear_run(&run);
    }
    assert_true(fabs(error[1]) < 0.01 && fabs(error[1]) < fabs(error[0]) / 2);
}

/* ---- work ---- */

/* Every direction and path, bodies free and held, both schemes, lumped, consistent and rotary
 * masses: nothing cracks, so the ledger closes to the rounding of 1e3 steps  (loads.8). */
static void work_is_exact(void **unused)
{
    const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                          &fracas_integrator_hulbert_chung};
    const double radius[] = {0.8, 0, 1};
    for (int s = 0; s < 4; s++) {
        const fracas_spec shell = plate_of(&fracas_formulation_shell),
                          plane = plate_of(&fracas_formulation_membrane);
        fracas_spec cases[6] = {moved(shell, "top", "right", "across", 1e-3, 0.1),
                                moved(shell, "top", NULL, "outward", 1e-3, 0.1),
                                moved(shell, "left", "right", "along", 0, NAN),
                                moved(plane, "top", "bottom", "outward", 1e-6, 2e-6),
                                moved(plane, "left", "right", "along", 0, 1e-6),
                                moved(membrane_spec(&fracas_shape_annulus, 2, 3), "outer_edge",
                                      NULL, "outward", 1e-6, 2e-6)};
        cases[0].geometry.edge[4] = &fracas_edge_clamped;
        cases[0].geometry.edge[1] = &fracas_edge_fixed;
        cases[0].time.rotary_inertia = cases[2].time.rotary_inertia = 1;
        cases[1].geometry.edge[4] = &fracas_edge_symmetry;
        cases[2].loading.velocity = 1e-2;
        cases[3].geometry.edge[4] = &fracas_edge_sliding;
        cases[3].time.mass = cases[4].time.mass = &fracas_mass_consistent;
        cases[4].loading.velocity = 1;
        cases[4].loading.rise_by = motion_choice("rise_by", "linear");
        cases[5].geometry.edge[1] = &fracas_edge_fixed;
        for (int c = 0; c < 6; c++) {
            cases[c].time.integrator = schemes[s > 0];
            cases[c].time.spectral_radius = radius[s > 0 ? s - 1 : 0];
            const double end = c < 3 ? 0.3 : 5e-6;
            one_run run = begin_whole(cases[c], 0.2);
            while (run.batch->step.time[0] < end) step_run(&run);
            const fracas_ledger *ledger = &run.batch->lane[0].ledger;
            print_message("%s %g, %s of a %s: residual %.1e of %.1e J\n", schemes[s > 0]->name,
                          cases[c].time.spectral_radius, cases[c].loading.direction->name,
                          cases[c].geometry.shape->name, residual_of(&run), largest_energy(ledger));
            assert_true(fabs(ledger->work) > 1e-3 * largest_energy(ledger));
            assert_true(residual_of(&run) < 1e-12);
            clear_run(&run);
        }
    }
}

TESTS(paths_rise_as_told, histories_are_integrated, motions_without_sense_are_refused,
      edges_are_where_they_are_told_to_be, bent_edges_stay_whole, a_slow_pull_stretches_evenly,
      a_wave_runs_from_an_edge, an_edge_takes_the_body_along, a_cantilever_bends, work_is_exact)
