/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Surfaces that start with a velocity away from a place or an axis, or in the shape of a mode,
 * against closed forms (docs/theory/initial.md). */
#include "engine/loading/initial.h"
#include "engine/loading/load.h"
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

/* Under no load; it never cracks. */
static one_run begin(fracas_spec spec, double distortion)
{
    const bool shell = spec.formulation == &fracas_formulation_shell.kind;
    spec.cohesive.fracture_energy = 1e12;
    spec.loading = bare_load(&fracas_loading_none);
    spec.time.end = 1e3;
    spec.time.safety = 0.8;
    return begin_run(distorted_model(spec, distortion, 5), 1, shell ? 1e6 : 1e12);
}

static double residual_of(const one_run *run)
{
    return run->batch->lane[0].ledger.largest_residual / run->batch->lane[0].ledger.initial;
}

static double wave_of(const fracas_spec *spec)
{
    return sqrt(spec->material.young / spec->material.density);
}

static size_t component_of(const fracas_model *model, size_t u)
{
    return u % element_unknowns(model) % (size_t)tables_of(model)->body->dimension;
}

/* ---- away from a place or an axis ---- */

/* A plate with a hole: every node has v0 outward from the middle, so that the kinetic energy is
 * m v0^2/2 and the momentum 0, to rounding of some 1e3 terms. One step later it is no longer all
 * kinetic; the ledger holds. */
static void plates_with_a_hole_part(void **unused)
{
    for (int which = 0; which < 4; which++) {
        fracas_spec spec = membrane_spec(&fracas_shape_annulus, 1 + which % 2, 3);
        if (which > 1) {
            spec = shell_spec(&fracas_shape_annulus);
            spec.geometry.inner = 0.5;
            spec.geometry.outer = 1;
            spec.mesh.divisions = 2 + which % 2;
        }
        const double v = 1e-4 * wave_of(&spec), rho = spec.material.density;
        double mass = 0, kinetic = 0, momentum[3] = {0};
        spec.initial.radial = v;
        one_run run = begin(spec, 0.2);
        for (size_t e = 0; e < run.model->elements; e++)
            mass += rho * spec.geometry.thickness * run.model->surface->area[e];
        for (size_t u = 0; u < unknowns_of(run.model); u++) {
            const double *x = place_of(run.model, u), own = *value_of(run.batch, u, SURFACE_V);
            const size_t i = component_of(run.model, u);
            assert_true(fabs(own - v * x[i] / hypot(x[0], x[1])) < 1e-14 * v);
            kinetic += 0.5 * mass_of(run.model, u) * own * own;
            momentum[i] += mass_of(run.model, u) * own;
        }
        for (int s = 0; s < 50; s++) step_run(&run);
        print_message("annulus %d: kinetic %.1e, momentum %.1e, residual %.1e\n", which,
                      kinetic / (0.5 * mass * v * v) - 1,
                      hypot(momentum[0], momentum[1]) / (mass * v), residual_of(&run));
        assert_close(kinetic, 0.5 * mass * v * v, 1e-13);
        /* an even perturbation of the mesh would leave less than its share of the mass */
        assert_true(hypot(momentum[0], momentum[1]) < 0.05 * mass * v && momentum[2] == 0);
        assert_close(run.batch->lane[0].ledger.initial, kinetic, 1e-12);
        assert_true(residual_of(&run) < 1e-12);
        clear_run(&run);
    }
}

/* Nodes of a round body swing by w = v0/omega sin(omega t) away from the middle or the axis.
 * Largest misses over two periods, by v0/omega: of a node, and of the mean by mass. */
typedef struct {
    double node, mean;
} breath;

static breath miss_of_breathing(const char *what, fracas_spec spec, int axis, double omega)
{
    const double v = 1e-3 * wave_of(&spec);
    breath miss = {0};
    spec.geometry.thickness = 0.02;
    spec.initial.radial = v;
    if (axis >= 0) spec.initial.axis = fracas_front_axes[axis];
    one_run run = begin(spec, 0);
    while (run.batch->step.time[0] < 4 * M_PI / omega) {
        for (int s = 0; s < 20; s++) step_run(&run);
        const double w = sin(omega * run.batch->step.time[0]);
        double moved = 0, all = 0;
        for (size_t u = 0; u < unknowns_of(run.model); u++) {
            const int i = (int)component_of(run.model, u);
            const double x = place_of(run.model, u)[i], mass = mass_of(run.model, u),
                         out = i == axis ? 0 : x / spec.geometry.radius,
                         by = *value_of(run.batch, u, SURFACE_U) * omega / v;
            miss.node = fmax(miss.node, fabs(by - w * out));
            moved += mass * by * out;
            all += mass * out * out;
        }
        miss.mean = fmax(miss.mean, fabs(moved / all - w));
    }
    print_message("%s: w within %.1e of v0/omega, its mean %.1e, residual %.1e\n", what, miss.node,
                  miss.mean, residual_of(&run));
    assert_true(residual_of(&run) < 1e-12);
    clear_run(&run);
    return miss;
}

/* omega^2 = 2 E/((1 - nu) rho R^2) of a sphere, E/(rho R^2) of a tube with nu 0. Means converge
 * with the square of the mesh or faster; nodes beside the octant's irregular corner do, too. A
 * tube has even rows, and R is that of its nodes: chords are shorter by (pi/(2 n))^2/24. */
static void round_bodies_breathe(void **unused)
{
    fracas_spec sphere = shell_spec(&fracas_shape_sphere),
                tube = shell_spec(&fracas_shape_cylinder);
    const double omega = wave_of(&sphere) * sqrt(2 / (1 - sphere.material.poisson));
    breath miss[2];
    sphere.geometry.part = tube.geometry.part = &fracas_part_octant;
    for (int fine = 0; fine < 2; fine++) {
        sphere.mesh.divisions = fine ? 24 : 12;
        miss[fine] = miss_of_breathing("octant", sphere, -1, omega);
    }
    assert_true(miss[1].mean < 1e-3 && miss[1].mean < miss[0].mean / 3);
    assert_true(miss[1].node < 0.02 && miss[1].node < miss[0].node / 3);
    tube.geometry.length = 1;
    tube.material.poisson = 0;
    tube.mesh.divisions = 8;
    miss[0] = miss_of_breathing("tube", tube, 1, wave_of(&tube));
    assert_true(miss[0].mean < 1e-3 && miss[0].node < 0.05);
}

/* A tube spinning about its axis y keeps its velocities spin e_y x x. Rounding of 100 steps. */
static void a_tube_spins_about_its_axis(void **unused)
{
    fracas_spec spec = shell_spec(&fracas_shape_cylinder);
    const double spin = 1e-4 * wave_of(&spec);
    double kinetic = 0, off = 0;
    spec.geometry.length = 1;
    spec.mesh.divisions = 2;
    spec.initial = (fracas_initial){.spin = spin, .axis = &fracas_front_y, .at = {0.1, 9, 0}};
    one_run run = begin(spec, 0);
    for (int s = 0; s < 100; s++) step_run(&run);
    for (size_t u = 0; u < unknowns_of(run.model); u++) {
        const double *x = place_of(run.model, u);
        const double own[3] = {spin * x[2], 0, -spin * (x[0] - 0.1)};
        const double v = own[component_of(run.model, u)];
        kinetic += 0.5 * mass_of(run.model, u) * v * v;
        off = fmax(off, fabs(*value_of(run.batch, u, SURFACE_V) - v));
    }
    print_message("tube: velocities %.1e of spin R\n", off / spin);
    assert_true(off < 1e-10 * spin);
    assert_close(run.batch->lane[0].ledger.kinetic, kinetic, 1e-12);
    clear_run(&run);
}

/* ---- shapes of modes ---- */

/* Largest miss of u_i = v0/omega sin(omega t) s(x) over a period, by v0/omega, and of the kinetic
 * energy at the start from `share` m v0^2/2. */
typedef struct {
    double motion, energy;
} mode_miss;

static mode_miss miss_of_mode(const char *what, fracas_spec spec, size_t i, double omega,
                              double share)
{
    const double side[2] = {spec.geometry.width, spec.geometry.height}, v = 1e-4 * wave_of(&spec),
                 mass = spec.material.density * side[0] * side[1] * spec.geometry.thickness;
    mode_miss miss = {0};
    spec.initial.velocity[i] = v;
    for (int k = 0; k < 2; k++) {
        spec.initial.from[k] = -side[k] / 2;
        spec.initial.to[k] = side[k] / 2;
    }
    one_run run = begin(spec, 0);
    while (run.batch->step.time[0] < 2 * M_PI / omega) {
        for (int s = 0; s < 50; s++) step_run(&run);
        for (size_t u = 0; u < unknowns_of(run.model); u++) {
            const double *x = place_of(run.model, u);
            double mode = component_of(run.model, u) == i ? sin(omega * run.batch->step.time[0])
                                                          : 0;
            for (int k = 0; k < 2; k++)
                if (spec.initial.half_waves[k] > 0)
                    mode *= sin(M_PI * spec.initial.half_waves[k] * (x[k] / side[k] + 0.5));
            miss.motion = fmax(miss.motion,
                               fabs(*value_of(run.batch, u, SURFACE_U) * omega / v - mode));
        }
    }
    miss.energy = run.batch->lane[0].ledger.initial / (share * 0.5 * mass * v * v) - 1;
    print_message("%s: motion within %.1e, kinetic energy %.1e, residual %.1e\n", what, miss.motion,
                  miss.energy, residual_of(&run));
    assert_true(residual_of(&run) < 1e-12);
    clear_run(&run);
    return miss;
}

/* The same on two meshes, of n and 2 n divisions: the period errs with their square, and so does
 * the motion of its end; the finer has less than a third, and `most`. The kinetic energy is a sum
 * by even rows of nodes, for which sin^2 adds up exactly. */
static void check_mode(const char *what, fracas_spec spec, size_t i, double omega, double share,
                       double most)
{
    mode_miss miss[2];
    for (int fine = 0; fine < 2; fine++) {
        miss[fine] = miss_of_mode(what, spec, i, omega, share);
        spec.mesh.divisions *= 2;
    }
    assert_true(miss[1].motion < most && miss[1].motion < miss[0].motion / 3);
    assert_true(fabs(miss[1].energy) < 1e-12);
}

/* A strip held at both ends, or at one, along itself, nu 0: omega = n pi c/L. 24 and 48 elements
 * along it, on lumped masses. */
static void strips_swing_along_themselves(void **unused)
{
    for (int free_end = 0; free_end < 2; free_end++) {
        fracas_spec spec = membrane_spec(&fracas_shape_plate, 2, 2);
        const double n = free_end ? 0.5 : 2;
        spec.geometry.height = 1e-3;
        spec.material.poisson = 0;
        spec.geometry.edge[1] = &fracas_edge_held;
        if (!free_end) spec.geometry.edge[2] = &fracas_edge_held;
        spec.initial.half_waves[0] = n;
        check_mode(free_end ? "quarter wave" : "two half waves", spec, 0,
                   n * M_PI * wave_of(&spec) / spec.geometry.width, 0.5, 2e-3);
    }
}

/* Bending on simple supports, omega = pi^2 (m^2/a^2 + n^2/b^2) sqrt(D/(rho h)): a strip with nu 0,
 * whose long edges are free, and a plate. */
static void plates_swing_in_their_modes(void **unused)
{
    fracas_spec strip = shell_spec(&fracas_shape_plate), plate = strip;
    const double c = wave_of(&strip), nu = plate.material.poisson, h = 0.02;
    strip.geometry.thickness = plate.geometry.thickness = h;
    strip.geometry.height = 0.2;
    strip.material.poisson = 0;
    strip.mesh.divisions = 2;
    strip.geometry.edge[1] = strip.geometry.edge[2] = &fracas_edge_fixed;
    strip.initial.half_waves[0] = 2;
    check_mode("strip, 2 half waves", strip, 2, 4 * M_PI * M_PI * h * c / sqrt(12), 0.5, 0.02);
    for (int k = 1; k <= 4; k++) plate.geometry.edge[k] = &fracas_edge_fixed;
    plate.mesh.divisions = 10;
    plate.initial.half_waves[0] = 1;
    plate.initial.half_waves[1] = 2;
    check_mode("plate, 1 by 2", plate, 2, 5 * M_PI * M_PI * h * c / sqrt(12 * (1 - nu * nu)), 0.25,
               0.04);
}

/* ---- refusals ---- */

static void starts_without_sense_are_refused(void **unused)
{
    const fracas_initial none = {.velocity = {NAN, NAN, NAN},
                                 .radial = NAN,
                                 .spin = NAN,
                                 .half_waves = {NAN, NAN, NAN},
                                 .at = {NAN, NAN, NAN},
                                 .within = NAN,
                                 .from = {NAN, NAN, NAN},
                                 .to = {NAN, NAN, NAN}};
    fracas_initial start = none;
    start.half_waves[0] = 2;
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "half_waves_x is 2, but no velocity",
          "which they would shape");
    start.velocity[2] = 1;
    start.from[0] = 0;
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "give from_x and to_x", "begins");
    start.to[0] = 1;
    OK(fracas_initial_section.check(&start));
    start = none;
    start.at[1] = start.velocity[0] = 1;
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "no spin, radial or within", "");
    start.radial = 1;
    OK(fracas_initial_section.check(&start));
    start = none;
    start.axis = &fracas_front_y;
    start.velocity[0] = 1;
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "axis is y", "no radial and no spin");
    /* from a place beside a plane of symmetry it would cross the plane */
    fracas_model *model = NULL;
    fracas_spec sphere = shell_spec(&fracas_shape_sphere);
    sphere.mesh.divisions = 4;
    sphere.geometry.part = &fracas_part_octant;
    sphere.loading = bare_load(&fracas_loading_none);
    sphere.initial = (fracas_initial){.radial = 1, .at = {0.1}};
    FAILS(fracas_model_create(&sphere, &model), FRACAS_USAGE, "a plane of symmetry the velocity",
          "the whole body");
    /* a unit square: of 8 divisions two edges are a quarter long, and more by the diagonals */
    fracas_spec plate = shell_spec(&fracas_shape_plate);
    plate.mesh.divisions = 8;
    plate.loading = bare_load(&fracas_loading_none);
    plate.initial = (fracas_initial){.velocity = {0, 0, 1}, .half_waves = {4}};
    plate.initial.from[0] = -0.5;
    plate.initial.to[0] = 0.5;
    FAILS(fracas_model_create(&plate, &model), FRACAS_USAGE, "half_waves_x of initial is 4",
          "a half wave is 0.25 m long", "give it 2 edges");
    plate.initial.half_waves[0] = 3;
    OK(fracas_model_create(&plate, &model));
    fracas_model_destroy(model);
}

TESTS(plates_with_a_hole_part, round_bodies_breathe, a_tube_spins_about_its_axis,
      strips_swing_along_themselves, plates_swing_in_their_modes, starts_without_sense_are_refused)
