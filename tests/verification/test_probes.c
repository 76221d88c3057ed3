/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Probes: the point of a body nearest to a place, and its motion against closed forms
 * (docs/theory/probes.md). */
#include "tests/support/lanes.h"
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/ring.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

static fracas_spot spot_of(const fracas_model *model, double x, double y, double z)
{
    fracas_spot spot;
    model->formulation->locate(model, (double[3]){x, y, z}, &spot);
    return spot;
}

static double apart(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

/* ---- places ---- */

/* u_i = b_i + sum_j A_ij x_j. */
static void linear(const double x[3], double u[3])
{
    static const double A[3][3] = {{1, -2, 0.5}, {3, 0.25, -1}, {-0.75, 2, 1.5}}, b[3] = {4, 5, -6};
    for (int i = 0; i < 3; i++) u[i] = b[i] + A[i][0] * x[0] + A[i][1] * x[1] + A[i][2] * x[2];
}

/* Random points of every seventh element: found to 1e-9 of an element, and a displacement that is
 * linear in x (and a velocity twice that) to the rounding of coordinates that are found so far. */
static void check_surface(fracas_spec spec)
{
    fracas_model *model = distorted_model(spec, 0.2, 3);
    OWN(fracas_batch) batch = batch_with(model, 1, (fracas_batch_options){.width = 1});
    const fracas_surface *surface = model->surface;
    const int dimension = tables_of(model)->body->dimension;
    uint64_t noise = 11;
    double worst = 0, size = model->element_size;
    for (size_t e = 0; e < model->elements; e++)
        for (size_t k = 0; k < surface->corners; k++) {
            double u[3];
            linear(node_at(model, e, k), u);
            for (int i = 0; i < dimension; i++) {
                const int at = dimension * (int)k + i;
                *surface_value(model, &batch->step, e, SURFACE_U, at, 0) = u[i];
                *surface_value(model, &batch->step, e, SURFACE_V, at, 0) = 2 * u[i];
            }
        }
    for (size_t e = 0; e < model->elements; e += 7) {
        const double a = next_share(&noise), b = next_share(&noise) * (1 - a);
        const surface_shape shape = shape_at(surface->corners, a, b);
        double x[3] = {0}, wanted[3], u[3], v[3];
        for (size_t k = 0; k < surface->corners; k++)
            for (int i = 0; i < 3; i++) x[i] += shape.value[k] * node_at(model, e, k)[i];
        const fracas_spot spot = spot_of(model, x[0], x[1], x[2]);
        assert_int_equal(spot.element, e);
        assert_true(spot.distance < 1e-9 * size && apart(spot.place, x) < 1e-9 * size);
        linear(spot.place, wanted);
        model->formulation->motion_at(model, &batch->step, 0, &spot, u, v);
        for (int i = 0; i < dimension; i++) {
            worst = fmax(worst, fabs(u[i] - wanted[i]));
            assert_true(fabs(v[i] - 2 * wanted[i]) < 1e-13 * 20);
        }
    }
    print_message("%s, order %d: linear within %.1e\n", spec.geometry.shape->name, surface->order,
                  worst);
    assert_true(worst < 1e-13 * 10); /* |u| to 10, sums of 6 products */
    fracas_batch_destroy(batch);
    batch = NULL;
    fracas_model_destroy(model);
}

static void linear_motion_is_exact_everywhere(void **unused)
{
    for (int which = 0; which < BODIES; which++) check_surface(body_of(which, 5));
    fracas_spec sphere = shell_spec(&fracas_shape_sphere), plate = shell_spec(&fracas_shape_plate);
    sphere.geometry.part = &fracas_part_octant;
    sphere.mesh.divisions = plate.mesh.divisions = 6;
    check_surface(sphere);
    check_surface(plate);
}

/* Off a sphere: the foot of the perpendicular, at right angles to the surface; off a corner of a
 * plate: the corner; on an interface: the element of the lower number. */
static void places_off_the_body_have_a_foot(void **unused)
{
    fracas_spec sphere = shell_spec(&fracas_shape_sphere);
    sphere.mesh.divisions = 4;
    fracas_model *model = make_model(&sphere);
    for (int n = 0; n < 20; n++) {
        const double x[3] = {sin(n), cos(n), 0.3 * n - 3}, r = apart(x, (double[3]){0});
        const double out[3] = {1.2 * x[0] / r, 1.2 * x[1] / r, 1.2 * x[2] / r};
        const fracas_spot spot = spot_of(model, out[0], out[1], out[2]);
        /* quadratic patches of 1/4 of an icosahedron's edge miss the sphere by 2e-3 at most, and
         * their normals the radius by 1e-2 */
        assert_true(fabs(spot.distance - 0.2) < 2e-3);
        for (int i = 0; i < 3; i++) assert_true(fabs(spot.place[i] - out[i] / 1.2) < 5e-3);
        double nearest = INFINITY; /* no point of a fine grid on the elements is nearer */
        for (size_t e = 0; e < model->elements; e++)
            for (int a = 0; a <= 8; a++)
                for (int b = 0; a + b <= 8; b++) {
                    const surface_shape shape = shape_at(6, a / 8.0, b / 8.0);
                    double at[3] = {0};
                    for (size_t k = 0; k < 6; k++)
                        for (int i = 0; i < 3; i++)
                            at[i] += shape.value[k] * node_at(model, e, k)[i];
                    nearest = fmin(nearest, apart(at, out));
                }
        assert_true(spot.distance <= nearest * (1 + 1e-12) && nearest < spot.distance + 0.02);
    }
    fracas_model_destroy(model);
    const fracas_spec plate = membrane_spec(&fracas_shape_plate, 2, 4);
    model = make_model(&plate);
    const fracas_spot corner = spot_of(model, 7e-3, 6e-3, 0);
    assert_true(fabs(corner.distance - sqrt(2) * 1e-3) < 1e-15);
    assert_true(apart(corner.place, (double[3]){6e-3, 5e-3, 0}) < 1e-15);
    for (size_t i = 0; i < model->interfaces; i += 5) {
        const fracas_surface_interface *of = &model->surface->interface[i];
        const double *middle = node_at(model, of->element[0], 3 + of->edge[0]);
        assert_int_equal(spot_of(model, middle[0], middle[1], 0).element, of->element[0]);
    }
    fracas_model_destroy(model);
}

static void chains_are_found_from_end_to_end(void **unused)
{
    fracas_spec spec = bar_reference(50, 1e4, 1e-7);
    bar_grade(&spec, 4);
    fracas_model *model = make_model(&spec);
    double start = 0;
    for (size_t e = 0; e < model->elements; start += model->sizes[e++]) {
        const double x = start + 0.3 * model->sizes[e];
        const fracas_spot spot = spot_of(model, x, 0, 0), end = spot_of(model, start, 0, 0);
        assert_int_equal(spot.element, e);
        assert_true(fabs(spot.weight[1] - 0.3) < 1e-10 && fabs(spot.place[0] - x) < 1e-16);
        assert_int_equal(end.element, e > 0 ? e - 1 : 0); /* an interface: the lower one */
    }
    fracas_model_destroy(model);
    spec = ring_reference(40, 1e4, 1e-7);
    model = make_model(&spec);
    for (size_t e = 0; e < model->elements; e++) {
        const double angle = 2 * M_PI * ((double)e + 0.3) / 40;
        const fracas_spot spot = spot_of(model, RING_RADIUS * cos(angle), RING_RADIUS * sin(angle),
                                         0);
        assert_int_equal(spot.element, e);
        assert_true(spot.distance < RING_RADIUS * 4e-3); /* 1 - cos(pi/40) between its chords */
        assert_true(fabs(spot.weight[1] - 0.3) < 2e-3);
    }
    fracas_model_destroy(model);
}

static void probes_off_the_body_are_refused(void **unused)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, 2, 4);
    fracas_model *model = make_model(&spec);
    const fracas_probes far = {2, {{"near", {0}}, {"far", {0.01, 0, 0}}}};
    fracas_batch *batch = NULL;
    FAILS(fracas_batch_create(model, 1, &(fracas_batch_options){.probes = &far}, &batch),
          FRACAS_USAGE,
          "probe far at (0.01, 0, 0) m is 0.004 m away from the body, whose nearest "
          "point is (0.006, 0, 0) m");
    FAILS(fracas_model_check_probes(model, &far, false), FRACAS_USAGE, "move it there");
    fracas_model_destroy(model);
}

/* ---- motion ---- */

/* A realization that never cracks, with its probes. */
static void run_whole(fracas_spec spec, const fracas_probes *probes, int64_t history,
                      fracas_record *record)
{
    spec.cohesive.fracture_energy = 1e12;
    const double strength = spec.formulation == &fracas_formulation_shell.kind ? 1e6 : 1e12;
    fracas_model *model = make_model(&spec);
    OWN(fracas_batch) batch = batch_with(
        model, 1, (fracas_batch_options){.width = 1, .history = history, .probes = probes});
    for (size_t k = 0; k < strengths_of(model); k++) bar_set_strength(batch, 0, k, strength);
    fracas_record_init(record);
    OK(fracas_batch_run(batch, record));
    assert_int_equal(record->nprobe, record->nhistory * probes->count);
    for (size_t i = 0; i < record->nprobe; i++) {
        assert_true(record->probe[i].time == record->history[i / probes->count].time);
        assert_int_equal(record->probe[i].probe, i % probes->count);
    }
    fracas_batch_destroy(batch);
    batch = NULL;
    fracas_model_destroy(model);
}

/* u = a t^2/2 of leapfrog to rounding, v = a (t + dt/2) half a step later. */
static void bodies_fall(void **unused)
{
    const double push[3] = {2, -3, 5};
    const fracas_probes probes = {3, {{"a", {0.1, -0.2, 0}}, {"b", {0.5, 0.5, 0}}, {"c", {0}}}};
    fracas_spec spec = shell_spec(&fracas_shape_plate);
    spec.mesh.divisions = 4;
    spec.loading = bare_load(&fracas_loading_body_force);
    memcpy(load_number(&spec.loading, "x"), push, sizeof push);
    spec.time.end = 0.3;
    RECORD(record);
    run_whole(spec, &probes, 30, &record);
    assert_true(record.nhistory >= 30);
    for (size_t n = 0; n < record.nprobe; n++) {
        const fracas_probe_row *row = &record.probe[n];
        for (int i = 0; i < 3; i++) {
            const double t = row->time, exact = push[i] * t * t / 2,
                         fast = push[i] * (t + 0.5 * record.time_step);
            assert_true(fabs(row->displacement[i] - exact) < 1e-10 * fabs(exact) + 1e-15);
            /* the last step of the history may be any: all have the model's length */
            assert_true(fabs(row->velocity[i] - fast) < 1e-10 * fabs(fast));
        }
    }
}

/* A closed form of a sphere under a sudden pressure p, w = p/(rho h omega^2) (1 - cos omega t),
 * omega^2 = 2 E/((1 - nu) rho R^2): probes move outward by it, within 2 % on this mesh
 * (verification/loads: of second order, less for the mean). */
static void a_sphere_breathes(void **unused)
{
    fracas_spec spec = shell_spec(&fracas_shape_sphere);
    spec.geometry.part = &fracas_part_octant;
    spec.geometry.thickness = 0.02;
    spec.mesh.divisions = 16;
    spec.loading = bare_load(&fracas_loading_pressure);
    *load_number(&spec.loading, "pressure") = 1;
    const double omega = sqrt(2 * 200 / (0.7 * 2)), most = 2 / (2 * 0.02 * omega * omega);
    spec.time.end = 2 * M_PI / omega;
    const double d = sqrt(1.0 / 3), h = sqrt(0.5);
    const fracas_probes probes = {
        3, {{"middle", {d, d, d}}, {"edge", {h, h, 0}}, {"pole", {0, 0, 1}}}};
    double worst = 0;
    RECORD(record);
    run_whole(spec, &probes, 50, &record);
    for (size_t n = 0; n < record.nprobe; n++) {
        const fracas_probe_row *row = &record.probe[n];
        const double *x = probes.probe[row->probe].place, *u = row->displacement,
                     w = u[0] * x[0] + u[1] * x[1] + u[2] * x[2],
                     exact = most / 2 * (1 - cos(omega * row->time));
        worst = fmax(worst, fabs(w - exact) / most);
    }
    print_message("sphere: probes within %.1e of the largest\n", worst);
    assert_true(worst < 0.02);
}

/* Before the first onset a bar moves by rate x t, exactly but for round-off, from its left end. */
static void a_bar_stretches(void **unused)
{
    fracas_spec spec = bar_reference(100, 1e4, 1e-7);
    spec.geometry.ends = &fracas_ends_held;
    const fracas_probes probes = {
        3, {{"left", {0}}, {"inner", {0.01234, 0, 0}}, {"right", {0.05, 0, 0}}}};
    RECORD(record);
    run_whole(spec, &probes, 10, &record);
    for (size_t n = 0; n < record.nprobe; n++) {
        const fracas_probe_row *row = &record.probe[n];
        const double v = 1e4 * probes.probe[row->probe].place[0];
        assert_true(fabs(row->displacement[0] - v * row->time) <= 1e-14 * v * row->time);
        assert_true(fabs(row->velocity[0] - v) <= 1e-14 * v && row->displacement[1] == 0);
    }
}

/* A ring that expands freely: each point outward by (w_0/omega) sin(omega t), omega = c/R of the
 * breathing ring, small strains: of second order in the strain, 1e-3, and of chords, 1e-4. */
static void a_ring_breathes(void **unused)
{
    fracas_spec spec = ring_reference(100, 1e2, 1);
    const double omega = BAR_WAVE_SPEED / RING_RADIUS, most = 1e2 * RING_RADIUS / omega;
    spec.time.end = M_PI / omega;
    const fracas_probes probes = {2, {{"x", {RING_RADIUS, 0, 0}}, {"y", {0, -RING_RADIUS, 0}}}};
    double worst = 0;
    RECORD(record);
    run_whole(spec, &probes, 20, &record);
    for (size_t n = 0; n < record.nprobe; n++) {
        const fracas_probe_row *row = &record.probe[n];
        const double w = row->probe == 0 ? row->displacement[0] : -row->displacement[1];
        worst = fmax(worst, fabs(w - most * sin(omega * row->time)) / most);
    }
    print_message("ring: within %.1e\n", worst);
    assert_true(worst < 2e-3);
}

/* ---- lanes ---- */

/* Replicas that break, by themselves and side by side, stopped half-way and gone on with: the same
 * bits of every row, and those of a run without probes elsewhere. */
static void probes_depend_on_their_lane_alone(void **unused)
{
    enum { COUNT = 3, STEPS = 20 };
    fracas_spec spec = membrane_spec(&fracas_shape_plate, 2, 6);
    spec.cohesive.fracture_energy = 100;
    spec.loading.rate = 2e4;
    spec.time.end = 6e-7;
    spec.time.safety = 0.5;
    const fracas_probes probes = {2, {{"a", {1e-3, 2e-3, 0}}, {"b", {-6e-3, 0, 0}}}};
    fracas_model *model = make_model(&spec);
    fracas_record alone[COUNT], beside[COUNT], plain[COUNT];
    for (size_t l = 0; l < COUNT; l++)
        run_replicas(model, l, 1, 0.2,
                     (fracas_batch_options){.width = 1, .history = 20, .probes = &probes},
                     &alone[l]);
    run_replicas(model, 0, COUNT, 0.2, (fracas_batch_options){.history = 20}, plain);
    OWN(fracas_batch) half = batch_with(model, COUNT,
                                        (fracas_batch_options){.history = 20, .probes = &probes});
    for (size_t l = 0; l < COUNT; l++) {
        bar_draw(half, l, 0.2, l);
        fracas_record_init(&beside[l]);
    }
    size_t running = 1;
    OK(fracas_batch_begin(half));
    for (int s = 0; s < STEPS && running > 0; s++) OK(fracas_batch_step(half, beside, &running));
    assert_true(running == COUNT && half->step.cracked[0] > 0);
    lane_tape tape = {0};
    for (size_t l = 0; l < COUNT; l++) OK(fracas_batch_save(half, l, put_on_tape, &tape));
    OWN(fracas_batch) rest = batch_with(model, COUNT,
                                        (fracas_batch_options){.history = 20, .probes = &probes});
    for (size_t l = 0; l < COUNT; l++) bar_draw(rest, l, 0.2, l);
    OK(fracas_batch_begin(rest));
    for (size_t l = 0; l < COUNT; l++) OK(fracas_batch_load(rest, l, get_from_tape, &tape));
    run_to_end(rest, beside);
    fracas_batch *other = batch_with(model, 1, (fracas_batch_options){.history = 20});
    tape.at = 0;
    FAILS(fracas_batch_load(other, 0, get_from_tape, &tape), FRACAS_DAMAGED, "or probes");
    fracas_batch_destroy(other);
    for (size_t l = 0; l < COUNT; l++) {
        assert_true(alone[l].broken > 0 && alone[l].nprobe == 2 * alone[l].nhistory);
        assert_same_record(&alone[l], &beside[l]);
        assert_memory_equal(&alone[l], &plain[l], offsetof(fracas_record, nfragment));
        assert_memory_equal(alone[l].history, plain[l].history,
                            plain[l].nhistory * sizeof *plain[l].history);
        assert_true(plain[l].nprobe == 0 && !plain[l].probe);
        fracas_record_clear(&alone[l]);
        fracas_record_clear(&beside[l]);
        fracas_record_clear(&plain[l]);
    }
    free(tape.byte);
    fracas_batch_destroy(half);
    fracas_batch_destroy(rest);
    half = rest = NULL;
    fracas_model_destroy(model);
}

TESTS(linear_motion_is_exact_everywhere, places_off_the_body_have_a_foot,
      chains_are_found_from_end_to_end, probes_off_the_body_are_refused, bodies_fall,
      a_sphere_breathes, a_bar_stretches, a_ring_breathes, probes_depend_on_their_lane_alone)
