/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Forces on surfaces: their sums, closed forms of bodies that do not crack, and their work
 * (docs/theory/loads.md). */
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

/* ---- bodies ---- */

static fracas_spec pressed(const fracas_kind *shape, int64_t divisions, double pressure)
{
    fracas_spec spec = shell_spec(shape);
    spec.geometry.part = &fracas_part_octant;
    spec.geometry.thickness = 0.02;
    spec.mesh.divisions = divisions;
    spec.loading = bare_load(&fracas_loading_pressure);
    *load_number(&spec.loading, "pressure") = pressure;
    return spec;
}

static fracas_spec pushed(const fracas_formulation *model, double x, double y, double z)
{
    fracas_spec spec = model == &fracas_formulation_shell
                           ? pressed(&fracas_shape_plate, 4, 0)
                           : membrane_spec(&fracas_shape_plate, 2, 4);
    spec.loading = bare_load(&fracas_loading_body_force);
    memcpy(load_number(&spec.loading, "x"), (double[3]){x, y, z}, 3 * sizeof(double));
    return spec;
}

static fracas_spec pulled(fracas_spec spec, const char *edge, double normal, double shear,
                          double across)
{
    static const fracas_kind right = {"right", ""},
                             outer = {"outer_edge", ""}, *const edges[] = {&right, &outer};
    spec.loading = bare_load(&fracas_loading_traction);
    for (size_t k = 0; k < FRACAS_COUNT(edges); k++)
        if (strcmp(edges[k]->name, edge) == 0) spec.loading.edge = edges[k];
    memcpy(load_number(&spec.loading, "normal"), (double[3]){normal, shear, across},
           3 * sizeof(double));
    return spec;
}

/* A run of a body that never cracks. */
static one_run begin_whole(fracas_spec spec, double distortion)
{
    const bool shell = spec.formulation == &fracas_formulation_shell.kind;
    spec.cohesive.fracture_energy = 1e12;
    return begin_run(distorted_model(spec, distortion, 5), 1, shell ? 1e6 : 1e12);
}

/* ---- sums of forces ---- */

typedef struct {
    double force[3], moment; /* about z */
    double outward;          /* sum of F . x/|x| over x, y, z */
} resultant;

static resultant resultant_of(const fracas_model *model)
{
    const fracas_surface_tables *t = model->plan;
    const size_t size = fracas_surface_unknowns(t), dimension = (size_t)t->body->dimension;
    resultant sum = {.moment = 0};
    for (size_t e = 0; e < t->nelements; e++) {
        if (!t->load_row[e]) continue;
        const double *force = t->load + (t->load_row[e] - 1) * size;
        for (size_t i = 0; i < size; i++) {
            const double *x = node_at(model, e, i / dimension);
            const double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
            sum.force[i % dimension] += force[i];
            if (i % dimension < 2)
                sum.moment += i % dimension == 0 ? -x[1] * force[i] : x[0] * force[i];
            sum.outward += r > 0 ? force[i] * x[i % dimension] / r : 0;
        }
    }
    return sum;
}

static resultant resultant_on(fracas_spec spec)
{
    fracas_model *model = distorted_model(spec, 0.2, 7);
    const resultant sum = resultant_of(model);
    fracas_model_destroy(model);
    return sum;
}

/* int n dA over an octant is a quarter of a disk along each axis, whatever the mesh does inside: by
 * the divergence theorem the error is that of its rims, of fourth order (chords of arcs through
 * their middle, and 12 points of degree 6). */
static void pressure_on_an_octant_is_a_quarter_disk(void **unused)
{
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
        const resultant sum = resultant_on(pressed(&fracas_shape_sphere, fine ? 8 : 4, 3));
        error[fine] = 0;
        for (int i = 0; i < 3; i++)
            error[fine] = fmax(error[fine], fabs(sum.force[i] / (3 * M_PI / 4) - 1));
    }
    print_message("octant: forces within %.1e, %.1e\n", error[0], error[1]);
    assert_true(error[1] < 2e-5 && error[1] < error[0] / 10);
}

/* int exp(-max(0, r - R)/L) dA = pi R^2 + 2 pi L (R + L) on a plane; beyond the edges of the plate,
 * at 10 L from the spot, there is (10 + 1/L..) e^-10, 1e-3 of it at most. The kink at r = R costs
 * second order. The middle is off the nodes. */
static void a_spot_has_the_force_of_its_profile(void **unused)
{
    const double R = 0.12, L = 0.03, exact = M_PI * R * R + 2 * M_PI * L * (R + L);
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
        fracas_spec spec = pressed(&fracas_shape_plate, fine ? 16 : 8, 1);
        spec.loading.spot = R;
        spec.loading.spot_decay = L;
        spec.loading.spot_at[0] = 0.03;
        spec.loading.spot_at[1] = -0.02;
        error[fine] = fabs(resultant_on(spec).force[2] / exact - 1);
        spec.loading.spot_decay = NAN;
        assert_true(fabs(resultant_on(spec).force[2] / (M_PI * R * R) - 1) < (fine ? 0.03 : 0.1));
    }
    print_message("spot: force within %.1e, %.1e\n", error[0], error[1]);
    assert_true(error[1] < 1e-3 && error[1] < error[0]);
    fracas_loading lost = bare_load(&fracas_loading_pressure);
    lost.spot_at[0] = 1;
    FAILS(fracas_load_check(&lost), FRACAS_USAGE, "spot_x is given", "give its radius");
    fracas_spec push = pushed(&fracas_formulation_membrane, 2, 0, 0);
    push.loading.spot = 1e3; /* the whole body */
    const double whole = resultant_on(pushed(&fracas_formulation_membrane, 2, 0, 0)).force[0];
    assert_true(resultant_on(push).force[0] == whole);
}

/* Straight edges are integrated exactly: round-off of some 1e3 terms. */
static void forces_on_plates_are_exact(void **unused)
{
    const resultant face = resultant_on(pressed(&fracas_shape_plate, 5, 3));
    assert_true(fabs(face.force[2] - 3) < 1e-12 && fabs(face.force[0]) < 1e-12 &&
                fabs(face.force[1]) < 1e-12);
    const fracas_spec strip = pulled(membrane_spec(&fracas_shape_plate, 1, 5), "right", 2e6, 3e6,
                                     0);
    const double area = strip.geometry.height * strip.geometry.thickness;
    const resultant end = resultant_on(strip); /* outward is +x, along the edge is +y */
    assert_true(fabs(end.force[0] / (2e6 * area) - 1) < 1e-12 &&
                fabs(end.force[1] / (3e6 * area) - 1) < 1e-12);
    const fracas_spec beam = pulled(pressed(&fracas_shape_plate, 5, 0), "right", 0, 0, 7);
    assert_true(fabs(resultant_on(beam).force[2] / (7 * 0.02) - 1) < 1e-12);
    const resultant weight = resultant_on(pushed(&fracas_formulation_shell, 2, -3, 5));
    const double mass = 2 * 0.02; /* density times thickness, of 1 by 1 */
    assert_true(fabs(weight.force[0] - 2 * mass) < 1e-12 * mass &&
                fabs(weight.force[1] + 3 * mass) < 1e-12 * mass &&
                fabs(weight.force[2] - 5 * mass) < 1e-12 * mass);
}

/* A rim of radius R pulled outward by s and sheared by q: sum of F . x/R = 2 pi R h s, moment
 * 2 pi R^2 h q, both but for the fourth order of its chords. */
static void traction_on_a_rim_pulls_and_turns(void **unused)
{
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
        const fracas_spec ring = pulled(membrane_spec(&fracas_shape_annulus, 2, fine ? 6 : 3),
                                        "outer_edge", 2e6, 3e6, 0);
        const double outer = ring.geometry.outer, h = ring.geometry.thickness;
        const resultant sum = resultant_on(ring);
        error[fine] = fmax(fabs(sum.outward / (2 * M_PI * outer * h * 2e6) - 1),
                           fabs(sum.moment / (2 * M_PI * outer * outer * h * 3e6) - 1));
        assert_true(fabs(sum.force[0]) < 1e-10 * 2e6 * outer * h);
    }
    print_message("rim: within %.1e, %.1e\n", error[0], error[1]);
    assert_true(error[1] < 1e-4 && error[1] < error[0] / 10);
}

/* ---- loads that move nothing ---- */

static void refuses(fracas_spec spec, const char *one, const char *other)
{
    fracas_model *model = NULL;
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, one, other);
}

static void loads_that_move_nothing_are_refused(void **unused)
{
    fracas_spec strip = pulled(membrane_spec(&fracas_shape_plate, 1, 5), "right", 2e6, 0, 0);
    strip.geometry.edge[2] = &fracas_edge_fixed;
    refuses(strip, "traction", "free the edge");
    strip.geometry.edge[2] = &fracas_edge_sliding; /* held along x */
    refuses(strip, "traction", "free the edge");
    *load_number(&strip.loading, "shear") = 1;
    fracas_model_destroy(distorted_model(strip, 0, 0));
    refuses(pushed(&fracas_formulation_membrane, 0, 0, 5), "body-force", "are 0");
    refuses(pulled(membrane_spec(&fracas_shape_annulus, 2, 3), "right", 1, 0, 0),
            "loading.edge is right", "inner_edge, outer_edge");
    refuses(pulled(pressed(&fracas_shape_sphere, 4, 0), "right", 1, 0, 0),
            "no edges that can be named", "take another load");
}

/* ---- amplitudes ---- */

static double amplitude(const fracas_loading *loading, double x, double t)
{
    const fracas_load_clock clock = fracas_load_clock_at(loading, (double[3]){0, x, 0});
    fracas_profile history;
    OK(fracas_load_history(loading, &history));
    const double a = fracas_load_amplitude(loading, &history, &clock, t);
    fracas_profile_clear(&history);
    return a;
}

static bool near(double a, double b)
{
    return fabs(a - b) <= 4e-16 * fmax(1, fabs(b)); /* one or two roundings */
}

static void amplitudes_rise_decay_and_change_sign(void **unused)
{
    fracas_loading l = bare_load(&fracas_loading_pressure);
    assert_true(amplitude(&l, 0, 0) == 1 && amplitude(&l, 0, 1e9) == 1);
    l.rise = 2;
    assert_true(amplitude(&l, 0, 0) == 0 && amplitude(&l, 0, 0.5) == 0.25 &&
                amplitude(&l, 0, 3) == 1);
    l.decay = 4;
    assert_true(near(amplitude(&l, 0, 1), 0.5 * exp(-0.25)) && near(amplitude(&l, 0, 8), exp(-2)));
    l.duration = 5;
    assert_true(near(amplitude(&l, 0, 8), -0.6 * exp(-2)) && amplitude(&l, 0, 5) == 0);
    assert_true(fracas_load_largest(&l, 8) == 1 && near(fracas_load_largest(&l, 20), 3));
}

static void a_history_is_linear_between_its_lines(void **unused)
{
    static const char text[] = "time,pressure\n0,0.5\n2,1\n2,-3\n4,0\n";
    const fracas_attachment file = {.path = "h.csv", .text = text, .size = sizeof text - 1};
    fracas_loading l = bare_load(&fracas_loading_pressure);
    l.history = &file;
    assert_true(amplitude(&l, 0, 0) == 0.5 && amplitude(&l, 0, 1) == 0.75 &&
                amplitude(&l, 0, 2) == -3 && amplitude(&l, 0, 3) == -1.5 &&
                amplitude(&l, 0, 9) == 0 && amplitude(&l, 0, -1) == 0);
    l.decay = 4;
    assert_true(near(amplitude(&l, 0, 3), -1.5 * exp(-0.75)));
    assert_true(fracas_load_largest(&l, 1) == 3);
}

/* A front along y from 1, at 3 when the clock starts, 2 a second, that has decayed by t/(1.5 times
 * its travel). */
static void fronts_arrive_and_decay_by_their_travel(void **unused)
{
    fracas_loading l = bare_load(&fracas_loading_pressure);
    l.front = 2;
    l.front_along = &fracas_front_y;
    l.front_at = 3;
    l.front_from = 1;
    assert_true(amplitude(&l, 7, 1.99) == 0 && amplitude(&l, 7, 2) == 1 &&
                amplitude(&l, 2, 0) == 1);
    l.decay_by_travel = 1.5;
    assert_true(near(amplitude(&l, 7, 3), exp(-1 / 4.5)));
    assert_true(near(amplitude(&l, 2, 0), exp(-0.5 / 0.75))); /* half a second after it passed */
    assert_true(amplitude(&l, 0.5, 9) == 0);                  /* behind where it began */
    l.front = -2;                                             /* the other way: at -1 after 2 */
    l.front_from = 5;
    assert_true(amplitude(&l, -1, 1.99) == 0 && near(amplitude(&l, -1, 3), exp(-1 / 4.5)));
}

/* ---- closed forms ---- */

/* Mean outward displacement of the vertices. */
static double outward(const one_run *run)
{
    const fracas_model *model = run->model;
    double sum = 0;
    for (size_t e = 0; e < model->elements; e++)
        for (size_t k = 0; k < 3; k++)
            for (size_t i = 0; i < 3; i++)
                sum += node_at(model, e, k)[i] / model->spec.geometry.radius *
                       *surface_value(model, &run->batch->step, e, SURFACE_U, 3 * k + i, 0);
    return sum / (3 * (double)model->elements);
}

/* w'' + omega^2 w = p e^(-t/T)/(rho h), omega^2 = 2 E/((1 - nu) rho R^2), from rest. */
static double breathing(const fracas_spec *spec, double t)
{
    const fracas_material *m = &spec->material;
    const double radius = spec->geometry.radius,
                 push = load_value(&spec->loading, "pressure") /
                        (m->density * spec->geometry.thickness),
                 omega = sqrt(2 * m->young / ((1 - m->poisson) * m->density)) / radius;
    if (!(spec->loading.decay > 0)) return push / (omega * omega) * (1 - cos(omega * t));
    const double b = 1 / spec->loading.decay;
    return push / (omega * omega + b * b) *
           (exp(-b * t) - cos(omega * t) + b / omega * sin(omega * t));
}

/* Largest error of the mean displacement over two periods, by the largest displacement. */
static double breathing_error(int64_t divisions, double decay)
{
    fracas_spec spec = pressed(&fracas_shape_sphere, divisions, 1);
    spec.loading.decay = decay;
    one_run run = begin_whole(spec, 0);
    const double end = 2 * 2 * M_PI / sqrt(2 * 200 / (0.7 * 2));
    double error = 0, largest = 0, work = 0;
    while (run.batch->step.time[0] < end) {
        step_run(&run);
        work = fmax(work, run.batch->lane[0].ledger.work);
        const double exact = breathing(&spec, run.batch->step.time[0]);
        error = fmax(error, fabs(outward(&run) - exact));
        largest = fmax(largest, fabs(exact));
    }
    const double residual = run.batch->lane[0].ledger.largest_residual / work;
    print_message("octant, %d divisions, decay %g: displacement within %.1e, residual %.1e\n",
                  (int)divisions, decay, error / largest, residual);
    assert_true(residual < 1e-12);
    clear_run(&run);
    return error / largest;
}

/* At least second order of the mesh, whose kinks between elements the flux crosses, and 0.2 %: 8e-4
 * with 24 divisions, 1e-4 with 48. */
static void a_sphere_under_pressure_breathes(void **unused)
{
    const double decays[] = {NAN, 0.2};
    for (int d = 0; d < 2; d++) {
        const double coarse = breathing_error(8, decays[d]), fine = breathing_error(24, decays[d]);
        assert_true(fine < coarse / 9 && fine < 2e-3);
    }
}

/* u = a t^2/2 at all nodes: leapfrog's from half a kick on, whatever the mesh; 1e3 steps round. */
static void bodies_fall_alike(void **unused)
{
    const fracas_formulation *const models[] = {&fracas_formulation_membrane,
                                                &fracas_formulation_shell};
    const double push[3] = {2, -3, 5};
    for (int m = 0; m < 2; m++) {
        fracas_spec spec = pushed(models[m], push[0], push[1], push[2]);
        if (m == 1) spec.time.rotary_inertia = 1;
        one_run run = begin_whole(spec, 0.2);
        const fracas_surface_tables *t = run.model->plan;
        const size_t dimension = (size_t)t->body->dimension;
        for (int s = 0; s < 100; s++) step_run(&run);
        const double time = run.batch->step.time[0];
        for (size_t e = 0; e < t->nelements; e++)
            for (size_t i = 0; i < fracas_surface_unknowns(t); i++) {
                const double exact = push[i % dimension] * time * time / 2;
                const double u = *surface_value(run.model, &run.batch->step, e, SURFACE_U, i, 0);
                assert_true(fabs(u - exact) < 1e-10 * 5 * time * time);
            }
        clear_run(&run);
    }
}

/* A strip of length L, fixed at its left end, nu 0: its right end moves out by 2 s L/E until 2 L/c,
 * and back. A front that is smeared over some elements shifts the end by their share of L. */
static void a_pulled_strip_swings(void **unused)
{
    fracas_spec spec = pulled(membrane_spec(&fracas_shape_plate, 2, 2), "right", 1e6, 0, 0);
    spec.geometry.width = 40e-3;
    spec.geometry.height = 2e-3;
    spec.material.poisson = 0;
    spec.geometry.edge[1] = &fracas_edge_fixed;
    const double length = spec.geometry.width,
                 c = sqrt(spec.material.young / spec.material.density);
    one_run run = begin_whole(spec, 0);
    const fracas_surface *surface = run.model->surface;
    double worst = 0;
    while (run.batch->step.time[0] < 5 * length / c) {
        step_run(&run);
        const double transits = run.batch->step.time[0] * c / length, turn = fmod(transits, 4),
                     exact = 1e6 * length / spec.material.young * (turn < 2 ? turn : 4 - turn);
        double sum = 0, count = 0;
        for (size_t b = 0; b < surface->nborders; b++)
            if (surface->border[b].tag == 2) {
                sum += *surface_value(run.model, &run.batch->step, surface->border[b].element,
                                      SURFACE_U, 2 * surface->border[b].edge, 0);
                count++;
            }
        worst = fmax(worst, fabs(sum / count - exact) * spec.material.young / (1e6 * length));
    }
    print_message("strip: end within %.1e s L/E\n", worst);
    assert_true(worst < 2 * 1e-3 / length); /* two elements by L */
    clear_run(&run);
}

/* Mean displacement along z of the vertices at the origin. */
static double lift(const one_run *run)
{
    double sum = 0, count = 0;
    for (size_t e = 0; e < run->model->elements; e++)
        for (size_t k = 0; k < 3; k++) {
            const double *x = node_at(run->model, e, k);
            if (fabs(x[0]) + fabs(x[1]) > 1e-9) continue;
            sum += *surface_value(run->model, &run->batch->step, e, SURFACE_U, 3 * k + 2, 0);
            count++;
        }
    return sum / count;
}

/* A force F that steps up on a spot in the middle of an infinite plate lifts the middle at
 *   dw/dt = F/(8 sqrt(D m)) [1 - s/(2 pi c t)],   D = E h^3/(12 (1 - nu^2)), m = rho h, c =
 * sqrt(D/m), s the mean of r^2 over the load: from the Hankel transform dw/dt = int q^(k) sin(k^2 c
 * t)/(m c k) dk, q^ = F/(2 pi) (1 - k^2 s/4 + ...). The term of k^4 is 0, that of k^6 at most 1e-3.
 * Echoes from the edges of waves slower than k = 2/sqrt(s) come after c t = a sqrt(s)/2 =
 * 0.011, a half of a side. */
static double lift_error(int64_t divisions)
{
    const double R = 0.05, L = 0.01, h = 0.01;
    fracas_spec spec = pressed(&fracas_shape_plate, divisions, 1);
    spec.loading.spot = R;
    spec.loading.spot_decay = L;
    spec.geometry.thickness = h;
    const double m = 2 * h, D = 200 * h * h * h / (12 * (1 - 0.09)), c = sqrt(D / m),
                 F = M_PI * R * R + 2 * M_PI * L * (R + L),
                 tail = L * (R * R * R + 3 * R * R * L + 6 * R * L * L + 6 * L * L * L),
                 s = 2 * M_PI / F * (R * R * R * R / 4 + tail);
    one_run run = begin_whole(spec, 0);
    double t[2], w[2];
    for (int i = 0; i < 2; i++) {
        while (run.batch->step.time[0] < (i ? 8e-3 : 2e-3) / c) step_run(&run);
        t[i] = run.batch->step.time[0];
        w[i] = lift(&run);
    }
    const double exact = F / (8 * sqrt(D * m)) *
                         (t[1] - t[0] - s / (2 * M_PI * c) * log(t[1] / t[0])),
                 error = (w[1] - w[0]) / exact - 1;
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    print_message("spot, %d divisions: lift within %.1e\n", (int)divisions, error);
    assert_true(ledger->largest_residual < 1e-12 * ledger->work);
    clear_run(&run);
    return fabs(error);
}

/* Second order of the mesh: (2/3)^2 = 0.44 from mesh to mesh, and a quarter as much again. */
static void a_spot_lifts_a_plate_as_a_point_force(void **unused)
{
    const double coarse = lift_error(24), fine = lift_error(36);
    assert_true(fine < 0.55 * coarse && fine < 0.012);
}

/* ---- fronts and work ---- */

/* A front runs over a free plate at v: momentum p v t^2/2 times its height while it is on it, by
 * elements that are loaded whole when it reaches their middle, half a diameter off at most. */
static void a_front_loads_what_it_has_passed(void **unused)
{
    fracas_spec spec = pressed(&fracas_shape_plate, 12, 3);
    spec.geometry.width = 2;
    spec.loading.front = 4;
    spec.loading.front_at = -1;
    one_run run = begin_whole(spec, 0);
    const fracas_surface_tables *t = run.model->plan;
    const size_t nodes = 6;
    while (run.batch->step.time[0] < 0.4) step_run(&run);
    double momentum = 0;
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; k < nodes; k++)
            momentum += t->lumped[(2 * e + 1) * nodes + k] *
                        *surface_value(run.model, &run.batch->step, e, SURFACE_V, 3 * k + 2, 0);
    const double time = run.batch->step.time[0] + 0.5 * run.batch->step.drift[0],
                 exact = 3 * 4 * time * time / 2;
    print_message("front: momentum within %.1e\n", momentum / exact - 1);
    assert_true(fabs(momentum / exact - 1) < 2.0 / 12 / 1.6 * 2.0 / 12 / 1.6);
    clear_run(&run);
}

/* Residual of the ledger until a time, by its largest term. */
static double residual_of(fracas_spec spec, double end)
{
    one_run run = begin_whole(spec, 0.2);
    while (run.batch->step.time[0] < end) step_run(&run);
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    const double largest = fmax(fabs(ledger->work), fmax(ledger->kinetic, ledger->elastic));
    assert_true(largest > 0 && fabs(ledger->work) > 1e-3 * largest);
    const double residual = ledger->largest_residual / largest;
    clear_run(&run);
    return residual;
}

/* Every load of every body, held and free, both schemes, lumped, consistent and rotary masses:
 * nothing cracks, so the ledger closes to the rounding of 1e3 steps (loads.4), (membrane.22). */
static void work_is_exact(void **unused)
{
    const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                          &fracas_integrator_hulbert_chung};
    for (int s = 0; s < 2; s++) {
        fracas_spec cases[6] = {
            pressed(&fracas_shape_sphere, 5, 2),
            pressed(&fracas_shape_plate, 4, 2),
            pushed(&fracas_formulation_shell, 1, 2, 3),
            pulled(pressed(&fracas_shape_plate, 4, 0), "right", 1, 2, 3),
            pushed(&fracas_formulation_membrane, 1e9, 2e9, 0),
            pulled(membrane_spec(&fracas_shape_annulus, 2, 3), "outer_edge", 1e6, 2e6, 0)};
        cases[0].loading.decay = 0.1;
        cases[0].loading.front = 5;
        cases[0].loading.front_along = &fracas_front_z;
        cases[1].loading.rise = 0.1;
        cases[1].geometry.edge[1] = cases[1].geometry.edge[2] = &fracas_edge_clamped;
        cases[1].time.rotary_inertia = 1;
        cases[2].geometry.edge[3] = &fracas_edge_fixed;
        cases[2].loading.duration = 0.1;
        cases[3].geometry.edge[1] = &fracas_edge_fixed;
        cases[4].geometry.edge[1] = &fracas_edge_fixed;
        cases[4].time.mass = cases[5].time.mass = &fracas_mass_consistent;
        cases[5].loading.rise = 1e-6;
        for (int c = 0; c < 6; c++) {
            cases[c].time.integrator = schemes[s];
            const double residual = residual_of(cases[c], c < 4 ? 0.3 : 5e-6);
            print_message("%s, %s of a %s: residual %.1e\n", schemes[s]->name,
                          cases[c].loading.type->name, cases[c].geometry.shape->name, residual);
            assert_true(residual < 1e-12);
        }
    }
}

TESTS(loads_that_move_nothing_are_refused, a_history_is_linear_between_its_lines,
      pressure_on_an_octant_is_a_quarter_disk, forces_on_plates_are_exact,
      traction_on_a_rim_pulls_and_turns, a_spot_has_the_force_of_its_profile,
      a_spot_lifts_a_plate_as_a_point_force, amplitudes_rise_decay_and_change_sign,
      fronts_arrive_and_decay_by_their_travel, a_sphere_under_pressure_breathes, bodies_fall_alike,
      a_pulled_strip_swings, a_front_loads_what_it_has_passed, work_is_exact)
