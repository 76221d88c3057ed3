/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci */
/* Surfaces that start with velocities, strains, stresses and a change of temperature, against
 * closed forms (docs/theory/initial.md). */
#include "engine/loading/initial.h"
#include "engine/loading/load.h"
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

static const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                             &fracas_integrator_hulbert_chung};

/* A plate under no load: of a membrane (0) or a shell (1), by either scheme. */
enum { PLATES = 4 };
static fracas_spec plate_of(int which)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, 2, 5);
    if (which % 2) {
        spec = shell_spec(&fracas_shape_plate);
        spec.geometry.width = 1.2;
        spec.mesh.divisions = 5;
    }
    spec.time.integrator = schemes[which / 2];
    spec.time.end = 100;
    spec.loading = bare_load(&fracas_loading_none);
    return spec;
}

static void hold_edges(fracas_spec *spec)
{
    for (int i = 1; i <= 4; i++) spec->geometry.edge[i] = &fracas_edge_held;
}

/* It never cracks. */
static one_run begin_whole(fracas_spec spec, double distortion)
{
    const bool shell = spec.formulation == &fracas_formulation_shell.kind;
    spec.cohesive.fracture_energy = 1e12;
    return begin_run(distorted_model(spec, distortion, 5), 1, shell ? 1e6 : 1e12);
}

static double wave_of(const fracas_spec *spec)
{
    return sqrt(spec->material.young / spec->material.density);
}

static double volume_of(const fracas_spec *spec)
{
    return spec->geometry.width * spec->geometry.height * spec->geometry.thickness;
}

static double residual_of(const one_run *run)
{
    return run->batch->lane[0].ledger.largest_residual / run->batch->lane[0].ledger.initial;
}

/* ---- velocities ---- */

/* Velocity of unknown u by hand. */
static double rigid(const fracas_model *model, size_t u)
{
    const fracas_initial *given = &model->spec.initial;
    const size_t i = u % element_unknowns(model) % (size_t)tables_of(model)->body->dimension;
    const double *x = place_of(model, u);
    return given->velocity[i] + (i == 0   ? -given->spin * (x[1] - given->at[1])
                                 : i == 1 ? given->spin * (x[0] - given->at[0])
                                          : 0);
}

/* A free body moves on and turns: every node keeps its velocity, no strain comes, and the kinetic
 * energy is that of its lumped masses. Rounding of 200 steps. */
static void free_bodies_keep_their_velocities(void **unused)
{
    for (int which = 0; which < PLATES; which++) {
        fracas_spec spec = plate_of(which);
        const double v = 1e-4 * wave_of(&spec), omega = v / spec.geometry.width;
        spec.initial = (fracas_initial){.velocity = {3 * v, -v, which % 2 ? 2 * v : 0},
                                        .spin = omega,
                                        .at = {spec.geometry.width / 3, 0.1 * spec.geometry.width}};
        one_run run = begin_whole(spec, 0.2);
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        double kinetic = 0, off = 0;
        for (size_t u = 0; u < unknowns_of(run.model); u++) {
            const double own = rigid(run.model, u);
            kinetic += 0.5 * mass_of(run.model, u) * own * own;
        }
        for (int s = 0; s < 200; s++) step_run(&run);
        for (size_t u = 0; u < unknowns_of(run.model); u++)
            off = fmax(off, fabs(*value_of(run.batch, u, SURFACE_V) - rigid(run.model, u)));
        print_message("free plate %d: velocities %.1e, kinetic %.1e, elastic %.1e\n", which,
                      off / v, ledger->kinetic / kinetic - 1, ledger->elastic / kinetic);
        assert_true(off < 1e-10 * v && ledger->elastic < 1e-18 * kinetic);
        assert_close(ledger->kinetic, kinetic, 1e-12);
        assert_true(residual_of(&run) < 1e-12);
        clear_run(&run);
    }
}

/* Nodes beyond the limits start at rest, and so do held components. */
static void limits_choose_nodes(void **unused)
{
    for (int k = 0; k < 3; k++) {
        fracas_spec spec = plate_of(0);
        const double w = spec.geometry.width;
        spec.geometry.edge[2] = &fracas_edge_held; /* right, within the limits of k = 1 */
        spec.initial = (fracas_initial){.velocity = {1, 2}, .at = {0.1 * w, 0}};
        if (k != 1) spec.initial.within = w / 4;
        if (k > 0) {
            spec.initial.from[0] = 0;
            spec.initial.to[0] = NAN;
        }
        one_run run = begin_whole(spec, 0.2);
        size_t moves = 0;
        for (size_t u = 0; u < unknowns_of(run.model); u++) {
            const double *x = place_of(run.model, u);
            const bool inside = (k == 1 || hypot(x[0] - 0.1 * w, x[1]) <= w / 4) &&
                                (k == 0 || x[0] >= 0) && !is_held(run.model, u);
            assert_true(*value_of(run.batch, u, SURFACE_V) == (inside ? 1 + (double)(u % 2) : 0));
            moves += inside;
        }
        assert_true(moves > 20 && moves < unknowns_of(run.model) * 3 / 4);
        clear_run(&run);
    }
}

/* A row of nodes on a limit is within it whatever its round-off: as many move as in the mirror
 * image. */
static void limits_are_those_of_both_sides(void **unused)
{
    for (int64_t divisions = 3; divisions < 12; divisions++) {
        size_t moves[2] = {0};
        for (int side = 0; side < 2; side++) {
            fracas_spec spec = plate_of(0);
            spec.mesh.divisions = divisions;
            const double w = spec.geometry.width, at = w * (0.5 - 1.0 / (double)divisions);
            spec.initial = (fracas_initial){
                .velocity = {1}, .from = {side ? NAN : at, NAN}, .to = {side ? -at : NAN, NAN}};
            one_run run = begin_whole(spec, 0);
            for (size_t u = 0; u < unknowns_of(run.model); u++)
                moves[side] += *value_of(run.batch, u, SURFACE_V) != 0;
            clear_run(&run);
        }
        assert_true(moves[0] > 0 && moves[0] == moves[1]);
    }
}

/* ---- strains ---- */

/* Held all around, a body stays at rest and keeps sigma : eps/2 for every volume: strains,
 * stresses, and a change of temperature, E (alpha dT)^2/(1 - nu). Rounding of 100 steps. */
static void check_held(const char *what, fracas_spec spec, double energy)
{
    hold_edges(&spec);
    one_run run = begin_whole(spec, 0.2);
    const double strain = sqrt(2 * energy / spec.material.young);
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    double fastest = 0;
    for (int s = 0; s < 100; s++) step_run(&run);
    for (size_t u = 0; u < unknowns_of(run.model); u++)
        fastest = fmax(fastest, fabs(*value_of(run.batch, u, SURFACE_V)));
    print_message("held, %s: velocity %.1e, energy %.1e, residual %.1e\n", what,
                  fastest / (strain * wave_of(&spec)),
                  ledger->elastic / (energy * volume_of(&spec)) - 1, residual_of(&run));
    assert_true(fastest < 1e-10 * strain * wave_of(&spec));
    assert_close(ledger->elastic, energy * volume_of(&spec), 1e-12);
    assert_true(residual_of(&run) < 1e-12);
    clear_run(&run);
}

static void held_bodies_stay_at_rest(void **unused)
{
    for (int which = 0; which < PLATES; which++) {
        fracas_spec spec = plate_of(which);
        const double E = spec.material.young, nu = spec.material.poisson, a = 3e-4, b = -1e-4,
                     g = 2e-4, sx = 4e-4 * E, sy = -1e-4 * E, t = 2e-4 * E, hot = 8e-6 * 50;
        spec.initial = (fracas_initial){.strain = {a, b}, .strain_xy = g};
        check_held(
            "strains", spec,
            0.5 * E / (1 - nu * nu) * (a * a + b * b + 2 * nu * a * b) + E / (1 + nu) * g * g);
        spec.initial = (fracas_initial){.stress = {sx, sy}, .stress_xy = t};
        check_held("stresses", spec,
                   0.5 / E * (sx * sx + sy * sy - 2 * nu * sx * sy + 2 * (1 + nu) * t * t));
        spec.initial = (fracas_initial){.temperature = -50, .expansion = 8e-6};
        check_held("cooled", spec, E * hot * hot / (1 - nu));
    }
}

/* Cooled, it is under tension: stretched from the smaller size that is free of stress. */
static void cooling_stretches_held_bodies(void **unused)
{
    fracas_spec spec = plate_of(0);
    hold_edges(&spec);
    spec.initial = (fracas_initial){.temperature = -50, .expansion = 8e-6};
    one_run run = begin_whole(spec, 0.2);
    step_run(&run);
    for (size_t u = 0; u < unknowns_of(run.model); u++)
        assert_true(
            fabs(*value_of(run.batch, u, SURFACE_U) - 4e-4 * place_of(run.model, u)[u % 2]) <
            1e-12 * 4e-4 * spec.geometry.width);
    clear_run(&run);
}

/* Momentum along x of the elements right of the middle. */
static double momentum_right(const one_run *run)
{
    const fracas_model *model = run->model;
    double sum = 0;
    for (size_t e = 0; e < model->elements; e++) {
        double x = 0;
        for (size_t k = 0; k < 3; k++) x += node_at(model, e, k)[0];
        for (size_t k = 0; x > 0 && k < model->surface->corners; k++)
            sum += mass_of(model, e * element_unknowns(model) + 2 * k) *
                   *value_at(run->batch, e, SURFACE_V, 2 * k);
    }
    return sum;
}

/* Time of the velocities [s]: central difference has them half a step later. */
static double clock_of(const one_run *run)
{
    const bool central = run->model->spec.time.integrator == schemes[0];
    return run->batch->step.time[0] + (central ? 0.5 * run->model->time_step : 0);
}

/* nu 0, so that waves along x are plane; 12 mm by 2 mm. */
static fracas_spec strip_of(int scheme)
{
    fracas_spec spec = plate_of(2 * scheme);
    spec.geometry.height = 2e-3;
    spec.mesh.divisions = 4;
    spec.material.poisson = 0;
    spec.initial.strain[0] = 1e-4;
    return spec;
}

/* A strip without held edges, strained by eps: waves run inward from both ends, and behind them it
 * moves by c eps without stress. Its middle has E eps until they meet: half of the strip has the
 * momentum -E eps A t, but for what runs ahead of the front, below 1e-4 a few
 * elements of its width away. At L/(2 c) all energy is kinetic but
 * for the front's width, 2 of 24 elements. */
static void a_released_strip_shrinks(void **unused)
{
    for (int scheme = 0; scheme < 2; scheme++) {
        const fracas_spec spec = strip_of(scheme);
        const double length = spec.geometry.width, c = wave_of(&spec),
                     force = spec.material.young * 1e-4 * spec.geometry.height *
                             spec.geometry.thickness;
        one_run run = begin_whole(spec, 0);
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        double off = 0;
        step_run(&run);
        assert_close(ledger->elastic, 0.5 * force * 1e-4 * length, 1e-12);
        while (run.batch->step.time[0] < 0.3 * length / c) step_run(&run);
        off = momentum_right(&run) / (-force * clock_of(&run)) - 1;
        while (run.batch->step.time[0] < 0.5 * length / c) step_run(&run);
        print_message("%s, released: momentum %.1e, kinetic %.3f, residual %.1e\n",
                      schemes[scheme]->name, off, ledger->kinetic / ledger->initial,
                      residual_of(&run));
        assert_true(fabs(off) < 1e-4);
        assert_true(fabs(ledger->kinetic / ledger->initial - 1) < 2.0 / 24);
        assert_true(residual_of(&run) < 1e-12);
        clear_run(&run);
    }
}

/* Held at both ends and cut in the middle, which opens at once: the end pulls its half with
 * E eps A until the wave is there. The cut costs nothing. */
static void a_notch_opens_at_once(void **unused)
{
    for (int scheme = 0; scheme < 2; scheme++) {
        fracas_spec spec = strip_of(scheme);
        spec.geometry.edge[1] = spec.geometry.edge[2] = &fracas_edge_held;
        spec.notch = (fracas_notch){.from = {0, -1e-3}, .to = {0, 1e-3}};
        const double c = wave_of(&spec), force = spec.material.young * 1e-4 * spec.geometry.height *
                                                 spec.geometry.thickness;
        one_run run = begin_whole(spec, 0);
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        while (run.batch->step.time[0] < 0.3 * spec.geometry.width / c) step_run(&run);
        const double off = momentum_right(&run) / (force * clock_of(&run)) - 1;
        print_message("%s, cut: momentum %.1e, residual %.1e\n", schemes[scheme]->name, off,
                      residual_of(&run));
        assert_true(run.model->nnotch == 4 && run.batch->step.cracked[0] == 0);
        assert_true(ledger->dissipated == 0 && fabs(off) < 1e-4);
        assert_true(residual_of(&run) < 1e-12);
        clear_run(&run);
    }
}

/* An edge that moves does so from its strained place: u = eps L/2 + s(t), and slowly the strip has
 * the energy of eps + s/L, but for a vibration of 2 60/(omega T)^3, omega = pi c/L, T = 20 L/c:
 * 5e-4 of the motion's share. */
static void an_edge_moves_on_from_its_strain(void **unused)
{
    for (int scheme = 0; scheme < 2; scheme++) {
        fracas_spec spec = strip_of(scheme);
        const double length = spec.geometry.width, d = 5e-5 * length,
                     rise = 20 * length / wave_of(&spec), total = 1e-4 + 5e-5;
        spec.geometry.edge[1] = &fracas_edge_held;
        spec.loading = bare_load(&fracas_loading_edge_motion);
        spec.loading.edge = motion_choice("edge", "right");
        spec.loading.direction = motion_choice("direction", "outward");
        spec.loading.rise_by = motion_choice("rise_by", "smooth");
        spec.loading.displacement = d;
        spec.loading.rise = rise;
        one_run run = begin_whole(spec, 0);
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        while (run.batch->step.time[0] < rise) step_run(&run);
        const double energy = 0.5 * spec.material.young * total * total * volume_of(&spec);
        for (size_t u = 0; u < unknowns_of(run.model); u += 2)
            if (place_of(run.model, u)[0] > 0.4999 * length)
                assert_close(*value_of(run.batch, u, SURFACE_U), 1e-4 * length / 2 + d, 1e-9);
        print_message("%s, moved on: elastic %.1e, work %.1e, residual %.1e\n",
                      schemes[scheme]->name, ledger->elastic / energy - 1,
                      (ledger->initial + ledger->work) / energy - 1, residual_of(&run));
        assert_true(fabs(ledger->elastic / energy - 1) < 5e-4);
        assert_true(fabs((ledger->initial + ledger->work) / energy - 1) < 5e-4);
        assert_true(residual_of(&run) < 1e-12);
        clear_run(&run);
    }
}

/* ---- refusals ---- */

static void starts_without_sense_are_refused(void **unused)
{
    fracas_model *model = NULL;
    fracas_spec spec = plate_of(0), sphere = shell_spec(&fracas_shape_sphere);
    spec.initial = (fracas_initial){.velocity = {1, 0}, .at = {1, 1}, .within = 1e-3};
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "moves no node", "widen them");
    spec.initial = (fracas_initial){.spin = 0};
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "loading.type is none", "give it one");
    sphere.mesh.divisions = 4;
    sphere.initial.stress[0] = 1;
    FAILS(fracas_model_create(&sphere, &model), FRACAS_USAGE, "is not flat", "give strains");
    sphere.geometry.part = &fracas_part_octant;
    sphere.initial = (fracas_initial){.spin = 1};
    FAILS(fracas_model_create(&sphere, &model), FRACAS_USAGE, "a plane of symmetry the velocity",
          "the whole body");
    sphere.initial = (fracas_initial){.strain_xy = 1e-4};
    FAILS(fracas_model_create(&sphere, &model), FRACAS_USAGE, "shears a plane of symmetry",
          "the whole body");
    sphere.initial = (fracas_initial){.strain = {1e-4, 2e-4, -1e-4}};
    OK(fracas_model_create(&sphere, &model));
    fracas_model_destroy(model);
    spec = plate_of(1);
    spec.initial = (fracas_initial){.strain = {1e-4, 0, 1e-4}};
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "strain_z strains nothing", "flat");
    spec = plate_of(1); /* held edges alone move nothing */
    hold_edges(&spec);
    FAILS(fracas_model_create(&spec, &model), FRACAS_USAGE, "loading.type is none", "give it one");
    fracas_initial start = {.from = {2}, .to = {1}};
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "to_x is 1 m", "not beyond from_x");
    start = (fracas_initial){.within = NAN};
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "to_x is 0 m", "not beyond from_x");
    const fracas_initial none = {.velocity = {NAN, NAN},
                                 .radial = NAN,
                                 .spin = NAN,
                                 .at = {NAN, NAN},
                                 .within = NAN,
                                 .from = {NAN, NAN},
                                 .to = {NAN, NAN}};
    start = none;
    OK(fracas_initial_section.check(&start));
    start.from[1] = 0;
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "but no velocity_x", "all of the");
    start.velocity[0] = 0; /* as a sweep's first */
    OK(fracas_initial_section.check(&start));
    start = none;
    start.at[0] = 1;
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "no spin, radial or within", "");
    start = (fracas_initial){.temperature = 5};
    FAILS(fracas_initial_section.check(&start), FRACAS_USAGE, "temperature is 5 K", "8e-6 1/K");
}

TESTS(free_bodies_keep_their_velocities, limits_choose_nodes, limits_are_those_of_both_sides,
      held_bodies_stay_at_rest, cooling_stretches_held_bodies, a_released_strip_shrinks,
      a_notch_opens_at_once, an_edge_moves_on_from_its_strain, starts_without_sense_are_refused)
