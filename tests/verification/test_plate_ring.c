/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* A disk with a hole that is turned faster and faster, until it would crack: the membrane against
 * the motion along the radius alone, found without the engine (tests/support/axisymmetric.h).
 */
#include "tests/support/axisymmetric.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/test.h"

static const disk plate_ring = {.young = 320e9,
                                .poisson = 0.3,
                                .density = 3300,
                                .inner = 6.5e-3,
                                .outer = 13e-3,
                                .speed = 60000,
                                .ramp = 75e-6};
enum { TIMES = 4 };
static const double times[TIMES] = {5e-6, 10e-6, 20e-6, 26e-6};

/* Displacement of the hole at `time`, between two steps. */
static double hole_at(const disk *body, size_t n, double time)
{
    disk_run run = disk_begin(body, n);
    double before = 0;
    while (run.time < time) {
        before = run.u[0];
        disk_step(&run);
    }
    const double u = run.u[0] - (run.u[0] - before) * (run.time - time) / run.dt;
    disk_end(&run);
    return u;
}

/* ---- the reference itself ---- */

/* Of second order: from n to 2n elements errors fall to a quarter, so that the difference of 400
 * and 800 is three times the error of the latter: (h/a)^2 = 6e-6 for 400, by factors of the order
 * of 1. */
static void the_radius_alone_has_converged(void **unused)
{
    for (int i = 0; i < TIMES; i++) {
        const double coarse = hole_at(&plate_ring, 400, times[i]),
                     fine = hole_at(&plate_ring, 800, times[i]);
        print_message("t %4.0f us: hoop stress %.6f MPa, 400 elements: %.1e\n", times[i] * 1e6,
                      plate_ring.young * fine / plate_ring.inner * 1e-6, coarse / fine - 1);
        assert_true(fabs(coarse / fine - 1) < 1e-5);
    }
}

/* 30 modes: what the series leaves out falls with c_n/w_n^2, faster than n^-4: 1e-6. */
static void its_motion_is_the_series_of_vibrations(void **unused)
{
    disk_mode mode[30];
    disk_modes(&plate_ring, mode, 30);
    for (int i = 0; i < TIMES; i++) {
        const double series = disk_series(&plate_ring, mode, 30, plate_ring.inner, times[i]);
        assert_true(fabs(hole_at(&plate_ring, 800, times[i]) / series - 1) < 1e-5);
    }
}

/* w_1 ramp = 2e3: the vibration that is left has the amplitude 2/(w_1 ramp)^2 = 5e-7; 100 elements:
 * (h/a)^2 = 1e-4 by factors of the order of 1, so 1e-3 at most. */
static void turned_slowly_it_has_the_stress_of_the_textbook(void **unused)
{
    disk slow = plate_ring;
    slow.ramp = 2e-3;
    const double hoop = slow.young * hole_at(&slow, 100, slow.ramp) / slow.inner;
    print_message("static: %.4f of the closed form\n", hoop / disk_static_hoop(&slow));
    assert_true(fabs(hoop / disk_static_hoop(&slow) - 1) < 1e-3);
    assert_true(
        fabs(slow.young * disk_static(&slow, slow.inner) / slow.inner / disk_static_hoop(&slow) -
             1) < 1e-14);
}

/* ---- the membrane ---- */

typedef struct {
    double stress, moved; /* largest errors at the four times: of the hoop stress at the hole, of
                             how far its nodes moved; 1 */
    double residual;      /* largest of the ledger's in any step by its largest term */
} membrane_errors;

/* Mean over the elements at the hole: hoop stress in the middle of their edge, outward displacement
 * of its vertices. */
static void look_at_hole(const fracas_model *model, const fracas_step *step, double *stress,
                         double *moved)
{
    const fracas_surface *s = model->surface;
    size_t count = 0;
    *stress = *moved = 0;
    for (size_t b = 0; b < s->nborders; b++) {
        if (s->border[b].tag != 1) continue;
        const size_t e = s->border[b].element, k = s->border[b].edge, next = (k + 1) % 3;
        double u[12], at[2], sigma[3];
        for (int i = 0; i < 2 * (int)s->corners; i++)
            u[i] = *surface_value(model, step, e, SURFACE_U, i, 0);
        on_edge(k, 0.5, at);
        const membrane_place p = place_at(model, e, at[0], at[1]);
        stress_at(model, &p, u, sigma);
        const double r2 = p.x[0] * p.x[0] + p.x[1] * p.x[1];
        *stress += (sigma[0] * p.x[1] * p.x[1] + sigma[1] * p.x[0] * p.x[0] -
                    2 * sigma[2] * p.x[0] * p.x[1]) /
                   r2;
        for (int end = 0; end < 2; end++) {
            const size_t n = end ? next : k;
            const double *x = node_at(model, e, n);
            *moved += 0.5 * (u[2 * n] * x[0] + u[2 * n + 1] * x[1]) / plate_ring.inner;
        }
        count++;
    }
    *stress /= (double)count;
    *moved /= (double)count;
}

static fracas_model *disk_model(int64_t order, double size, const fracas_kind *mass,
                                const fracas_kind *integrator)
{
    fracas_spec spec = membrane_spec(&fracas_shape_annulus, order, 0);
    spec.mesh.size = size;
    spec.cohesive.fracture_energy = 1e12; /* with strengths of 1e12 Pa: nothing cracks */
    spec.loading = (fracas_loading){
        .type = &fracas_loading_centrifugal, .speed = plate_ring.speed, .ramp = plate_ring.ramp};
    spec.time.end = 27e-6;
    spec.time.mass = mass;
    spec.time.integrator = integrator;
    return distorted_model(spec, 0, 0);
}

/* Until 26 us. */
static membrane_errors turn_by(int64_t order, double size, const fracas_kind *mass,
                               const fracas_kind *integrator)
{
    one_run run = begin_run(disk_model(order, size, mass, integrator), 1, 1e12);
    const fracas_model *model = run.model;
    const fracas_batch *batch = run.batch;
    membrane_errors errors = {.residual = 0};
    for (int seen = 0; seen < TIMES;) {
        step_run(&run);
        assert_int_equal(run.running, 1);
        if (batch->step.time[0] < times[seen]) continue;
        double stress, moved;
        look_at_hole(model, &batch->step, &stress, &moved);
        const double exact = hole_at(&plate_ring, 400, batch->step.time[0]);
        errors.stress = fmax(errors.stress,
                             fabs(stress * plate_ring.inner / (plate_ring.young * exact) - 1));
        errors.moved = fmax(errors.moved, fabs(moved / exact - 1));
        seen++;
    }
    const fracas_ledger *ledger = &batch->lane[0].ledger;
    errors.residual = ledger->largest_residual /
                      fmax(ledger->work, fmax(ledger->kinetic, ledger->elastic));
    assert_int_equal(batch->step.cracked[0], 0);
    print_message("%s, order %d, %s mass, size %.1f mm, %zu elements, %lld steps: hoop stress "
                  "within %.1e, displacement %.1e, residual %.1e\n",
                  integrator->name, (int)order, mass->name, size * 1e3, model->elements,
                  (long long)batch->lane[0].steps, errors.stress, errors.moved, errors.residual);
    clear_run(&run);
    return errors;
}

static membrane_errors turn(int64_t order, double size, const fracas_kind *mass)
{
    return turn_by(order, size, mass, &fracas_integrator_central_difference);
}

/* Both have errors of the second order. The stress of a quadratic field misses u_rrr h^2/12 and its
 * like: the field is b/r at worst, u_rrr = 6 u/a^3, so (size/a)^2/2. Masses lumped by the diagonal
 * add errors of the second order to displacements: int r^2 over an element is wrong by about (11/57
 * - 1/6)/(1/6) = 16 % of what a linear field varies by in it, size^2/36 by a^2, and over the mass,
 * to which all of it is compared, (size/a)^2/10 is ample. The ledger's terms sum 1e4 elements and
 * 1e4 steps, each rounded to 1.1e-16: 1e-12 by the largest. */
static void a_disk_of_quadratic_triangles(void **unused)
{
    const membrane_errors coarse = turn(2, 0.6e-3, &fracas_mass_lumped),
                          fine = turn(2, 0.3e-3, &fracas_mass_lumped);
    const double size = 0.3e-3 / plate_ring.inner;
    assert_true(fine.stress < 0.5 * size * size &&
                coarse.stress < 2 * size * size); /* 0.11 %, 0.43 % */
    assert_true(fine.moved < 0.1 * size * size && coarse.moved < 0.4 * size * size);
    assert_true(fine.stress < 0.4 * coarse.stress &&
                fine.moved < 0.4 * coarse.moved); /* a quarter, and half as much again */
    assert_true(coarse.residual < 1e-12 && fine.residual < 1e-12);
}

/* Without lumping displacements are of the fourth order at the nodes, up to the time step's (w
 * dt)^2/24 and the circle's: below a thirtieth of those with lumping. */
static void consistent_masses_are_better(void **unused)
{
    const membrane_errors errors = turn(2, 0.8e-3, &fracas_mass_consistent);
    const double size = 0.8e-3 / plate_ring.inner;
    assert_true(errors.stress < 0.5 * size * size && errors.moved < 0.003 * size * size);
    assert_true(errors.residual < 1e-12);
}

/* The stress is that of the elements' middle, size sqrt(3)/6 away from the hole, where it falls as
 * less than 1/r: 0.29 size/a and less. The displacement's error is that of an inscribed polygon and
 * of chords, size^2/8 by a curvature of 2/a^2 at most: (size/a)^2/4, and as much for the circle. */
static void a_disk_of_linear_triangles(void **unused)
{
    const membrane_errors coarse = turn(1, 0.8e-3, &fracas_mass_lumped),
                          fine = turn(1, 0.4e-3, &fracas_mass_lumped);
    const double size = 0.4e-3 / plate_ring.inner;
    assert_true(fine.stress < 0.29 * size && coarse.stress < 0.58 * size);
    assert_true(fine.moved < 0.5 * size * size && coarse.moved < 2 * size * size);
    assert_true(fine.stress < 0.6 * coarse.stress &&
                fine.moved < 0.4 * coarse.moved); /* half, a quarter */
    assert_true(coarse.residual < 1e-12 && fine.residual < 1e-12);
}

/* The scheme that damps is of second order too: (w dt)^2 = (1e6/s 8e-9 s)^2 = 6e-5 of vibrations
 * that are a small part of the motion, so bounds are those of the mesh. With what it damps its
 * ledger is as exact (membrane.22). */
static void a_damped_disk_turns_alike(void **unused)
{
    const membrane_errors lumped = turn_by(2, 0.8e-3, &fracas_mass_lumped,
                                           &fracas_integrator_hulbert_chung);
    const membrane_errors consistent = turn_by(2, 0.8e-3, &fracas_mass_consistent,
                                               &fracas_integrator_hulbert_chung);
    const double size = 0.8e-3 / plate_ring.inner;
    assert_true(lumped.stress < 0.5 * size * size && lumped.moved < 0.1 * size * size);
    assert_true(consistent.stress < 0.5 * size * size && consistent.moved < 0.003 * size * size);
    assert_true(lumped.residual < 1e-12 && consistent.residual < 1e-12);
}

TESTS(the_radius_alone_has_converged, its_motion_is_the_series_of_vibrations,
      turned_slowly_it_has_the_stress_of_the_textbook, a_disk_of_quadratic_triangles,
      consistent_masses_are_better, a_disk_of_linear_triangles, a_damped_disk_turns_alike)
