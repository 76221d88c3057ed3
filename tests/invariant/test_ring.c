/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* The ring's energy: forces are its gradient, it does not see where the ring is, the ledger closes
 * with it. */
#include "tests/support/dense.h"
#include "tests/support/ring_sample.h"

typedef enum { WHOLE, CRACKS, LOADS, UNLOADS, CLOSES, BREAKS, GAPES, TOUCHES, NKINDS } joint_kind;

static double potential(one_run *s, const ring_state *state)
{
    const ring_answer a = answer(s, state);
    return a.elastic + a.cohesive + a.dissipated;
}

/* A trial traction S, damage and jump across the interface for each kind; x = K delta_c - sigma_c.
 * The jump across is so large that couples are 1e-3 (whole) to 5e-2 of the forces. */
static void draw_joint(joint_kind kind, double x, uint64_t *seed, double *trial, double *damage,
                       double *across)
{
    const double r = 0.5 + 0.5 * ring_noise(seed), z = 0.5 + 0.5 * ring_noise(seed),
                 sigma_c = BAR_STRENGTH_MEAN;
    *damage = kind == WHOLE || kind == CRACKS    ? 0
              : kind == GAPES || kind == TOUCHES ? 1
                                                 : 0.05 + 0.9 * r;
    *across = (kind == WHOLE ? 2e-8 : 2e-6) * ring_noise(seed);
    switch (kind) {
    case WHOLE: *trial = 0.95 * sigma_c * (2 * z - 1); break;
    case CRACKS:
    case LOADS: *trial = sigma_c + x * (*damage + (0.1 + 0.8 * z) * (1 - *damage)); break;
    case UNLOADS: *trial = (0.05 + 0.9 * z) * (sigma_c + x * *damage); break;
    case BREAKS: *trial = sigma_c + x * (1.05 + z); break;
    case GAPES: *trial = x * (0.01 + z); break;
    default: *trial = -(0.05 + z) * sigma_c;
    }
}

static ring_point at_angle(double angle)
{
    return (ring_point){cos(angle), sin(angle)};
}

/* The direction of interface e when its elements lie along a and b. */
static ring_point normal_of(const one_run *s, size_t e, ring_point a, ring_point b)
{
    const size_t n = s->model->elements;
    if (s->model->spec.geometry.direction == &fracas_direction_initial)
        return at_angle(RING_PI * (0.5 + 2.0 * (double)(e + 1) / (double)n));
    const ring_point sum = ring_plus(a, 1, b);
    return ring_plus((ring_point){0, 0}, 1 / sqrt(ring_inner(sum, sum)), sum);
}

/* A random state: the whole ring turned by `whole`, every element by up to `each` from there and
 * strained by up to 2e-3, every interface of a random kind. Laid out from element `first` on; where
 * the ends meet the interface is broken and open, whatever is between them: false if they overlap,
 * which would press with forces beside which all others vanish. */
static bool draw_state(const one_run *s, size_t first, double whole, double each, uint64_t *seed,
                       ring_state *state, int *seen)
{
    const size_t n = s->model->elements;
    const double h = s->model->element_size, young = 275e9, spring = 4 * young / h,
                 delta_c = 2 * 100 / BAR_STRENGTH_MEAN;
    ring_point chord[MOST], left = {1e-5, 2e-5};
    double stress[MOST];
    for (size_t e = 0; e < n; e++) {
        const double strain = 2e-3 * ring_noise(seed);
        stress[e] = young * strain;
        chord[e] = ring_plus((ring_point){0, 0}, h * (1 + strain),
                             at_angle(RING_PI * (0.5 + (2.0 * (double)e + 1) / (double)n) + whole +
                                      each * ring_noise(seed)));
    }
    for (size_t i = 0; i < n; i++) {
        const size_t e = (first + i) % n, next = (e + 1) % n;
        const ring_point right = ring_plus(left, 1, chord[e]),
                         n_of_e = normal_of(s, e, chord[e], chord[next]);
        ring_put(s, e, 0, left);
        ring_put(s, e, 1, right);
        if (i == n - 1) break;
        const joint_kind kind = (joint_kind)((ring_noise(seed) + 1) * 0.5 * NKINDS);
        double trial, across;
        draw_joint(kind, spring * delta_c - BAR_STRENGTH_MEAN, seed, &trial, &state->damage[e],
                   &across);
        const double q =
            (trial - (kind == GAPES || kind == TOUCHES ? 0 : 0.5 * (stress[e] + stress[next]))) /
            spring;
        left = ring_plus(ring_plus(right, q, n_of_e), across, (ring_point){n_of_e.y, -n_of_e.x});
        seen[kind]++;
    }
    const size_t end = (first + n - 1) % n;
    state->damage[end] = 1;
    for (size_t e = 0; e < n; e++)
        memcpy(state->u[e], ring_field(s, e, RING_U_LEFT), sizeof state->u[e]);
    return ring_jump(s, end).x > 0;
}

/* Directions, sizes and turns of the states that are looked at: elements turned by up to a radian
 * each, the ring by as much as one likes, where the energy allows. */
static const struct {
    size_t elements;
    bool current;
    double whole, each; /* radians */
} kind_of_state[] = {{12, true, 0, 0.05},
                     {12, true, 2.2, 1.0},
                     {12, false, 0, 0.05},
                     {12, false, 0, 0.6},
                     {3, true, 1.5707963267948966, 0.4},
                     {3, false, 0, 0.4},
                     {4, true, -3, 1.0}};
enum { NSTATES = sizeof kind_of_state / sizeof *kind_of_state };

static void next_state(const one_run *s, int kind, size_t trial, uint64_t *seed, ring_state *state,
                       int *seen)
{
    for (int attempt = 0; attempt < 1000; attempt++) {
        int here[NKINDS] = {0};
        if (!draw_state(s, trial % s->model->elements, kind_of_state[kind].whole,
                        kind_of_state[kind].each, seed, state, here))
            continue;
        for (int k = 0; k < NKINDS; k++) seen[k] += here[k];
        return;
    }
    fail_msg("no state whose ends do not overlap");
}

/* f = -dU/du by centred differences. Round-off: U of 1e-3 J is a sum of some 30 terms, 1e-18 J,
 * over 2e-12 m: 1e-6 N beside the largest forces of 3e2 N and more. Truncation: (1e-12 m/20 um)^2.
 * In no state does the difference straddle an onset or a break, where U jumps, or a change of
 * branch, where its curvature does. 2e-8 of the largest force covers both. */
static void forces_are_the_gradient_of_the_energy(void **unused)
{
    uint64_t seed = 11;
    int seen[NKINDS] = {0};
    for (int k = 0; k < NSTATES; k++) {
        one_run s = small_ring(kind_of_state[k].elements, 4,
                               kind_of_state[k].current ? &fracas_direction_current
                                                        : &fracas_direction_initial);
        double worst = 0;
        for (size_t trial = 0; trial < 60; trial++) {
            ring_state state;
            next_state(&s, k, trial, &seed, &state, seen);
            const ring_answer a = answer(&s, &state);
            for (size_t i = 0; i < 4 * s.model->elements; i++) {
                double *u = &state.u[i / 4][i % 4], here = *u;
                *u = here + 1e-12;
                double up = potential(&s, &state), far = *u;
                *u = here - 1e-12;
                double slope = (up - potential(&s, &state)) / (far - *u);
                *u = here;
                const ring_point *f = &a.force[i / 4][i % 4 / 2];
                worst = fmax(worst, fabs(slope + (i % 2 ? f->y : f->x)) / a.largest);
            }
        }
        print_message("[  figures ] %2zu elements, %s, turned by %g and %g: force and gradient "
                      "differ by %.1e of the largest force\n",
                      s.model->elements, kind_of_state[k].current ? "current" : "initial",
                      kind_of_state[k].whole, kind_of_state[k].each, worst);
        assert_true(worst < 2e-8);
        clear_run(&s);
    }
    for (int k = 0; k < NKINDS; k++) assert_true(seen[k] > 100);
}

/* The state, turned by `angle` about the origin and moved. */
static ring_state moved(const one_run *s, const ring_state *state, double angle, ring_point by)
{
    ring_state to = *state;
    for (size_t i = 0; i < 2 * s->model->elements; i++) {
        const ring_point start = ring_origin(s, i / 2, i % 2),
                         u = {state->u[i / 2][i % 2 * 2], state->u[i / 2][i % 2 * 2 + 1]};
        const ring_point at = ring_minus(
            ring_plus(ring_turned(ring_plus(start, 1, u), angle), 1, by), start);
        to.u[i / 2][i % 2 * 2] = at.x;
        to.u[i / 2][i % 2 * 2 + 1] = at.y;
    }
    return to;
}

/* Turning and moving the ring changes neither energy, and turns the forces. Displacements of up to
 * 2e-4 m are rounded by 2.7e-20 m, some four times an interface: 5.5e16 Pa/m x 1e-19 m = 6e-3 Pa of
 * tractions of 3e8 Pa and more, 2e-11 of them, and of the energies less. With `initial` a ring may
 * be moved, not turned: a tenth of a radian must show. */
static void the_energy_does_not_see_where_the_ring_is(void **unused)
{
    uint64_t seed = 5;
    int seen[NKINDS] = {0};
    double worst = 0, turned = 0;
    for (int k = 0; k < NSTATES; k++) {
        const bool current = kind_of_state[k].current;
        one_run s = small_ring(kind_of_state[k].elements, 4,
                               current ? &fracas_direction_current : &fracas_direction_initial);
        for (size_t trial = 0; trial < 60; trial++) {
            ring_state state;
            next_state(&s, k, trial, &seed, &state, seen);
            const double angle = trial % 3 == 0 ? 0.5 * RING_PI : RING_PI * ring_noise(&seed);
            const ring_state there = moved(
                &s, &state, current ? angle : 0,
                (ring_point){1e-4 * ring_noise(&seed), 1e-4 * ring_noise(&seed)});
            const ring_answer a = answer(&s, &state), b = answer(&s, &there);
            const double held = fabs(a.elastic) + fabs(a.cohesive) + a.dissipated;
            worst = fmax(
                worst, fmax(fabs(b.elastic - a.elastic), fmax(fabs(b.cohesive - a.cohesive),
                                                              fabs(b.dissipated - a.dissipated))) /
                           held);
            for (size_t i = 0; i < 2 * s.model->elements; i++) {
                const ring_point f = ring_turned(a.force[i / 2][i % 2], current ? angle : 0),
                                 g = b.force[i / 2][i % 2];
                worst = fmax(worst, fmax(fabs(f.x - g.x), fabs(f.y - g.y)) / a.largest);
            }
            if (current) continue;
            const ring_state aside = moved(&s, &state, 0.1, (ring_point){0, 0});
            turned = fmax(turned, fabs(potential(&s, &aside) - potential(&s, &state)) / held);
        }
        clear_run(&s);
    }
    print_message(
        "[  figures ] energies and forces differ by %.1e; initial, turned by 0.1: by %.1e\n", worst,
        turned);
    assert_true(worst < 2e-11);
    assert_true(turned > 1e-3);
}

/* One interface alone: elements 0 and 1 as they start, all others moved out by 0.1 mm, broken off
 * and out of reach. Interface 0 has this damage, both elements this strain, the jump is such that
 * the trial traction is `trial` at t = 1 us, after a step of 1 ns in which it grows at 1 m/s, and
 * the elements' lengths at 0.5 m/s; across it is `across` [m]. Takes that step. */
static ring_answer one_event(one_run *s, double damage, double strain, double trial, double across)
{
    const double h = s->model->element_size, young = 275e9, spring = 4 * young / h, dt = 1e-9;
    const ring_point zero = {0, 0}, n = at_angle(RING_PI * (0.5 + 2.0 / 12)), m = {n.y, -n.x};
    const ring_point jump = ring_plus(ring_plus(zero, (trial - young * strain) / spring, n), across,
                                      m);
    fracas_step *step = &s->batch->step;
    for (size_t e = 0; e < 12; e++) {
        const ring_point along = at_angle(RING_PI * (0.5 + (double)(2 * e + 1) / 12)),
                         out = {along.y, -along.x};
        *ring_field(s, e, RING_DAMAGE) = e ? 1 : damage;
        for (size_t side = 0; side < 2; side++) {
            ring_point u = e > 1    ? ring_plus(zero, 1e-4, out)
                           : e == 1 ? jump
                                    : zero,
                       v = e == 1 ? n : zero;
            if (e < 2 && side == e)
                u = ring_plus(u, (e ? 1 : -1) * strain * h, along); /* their outer ends */
            if (e < 2 && side == e) v = ring_plus(v, e ? 0.5 : -0.5, along);
            ring_put(s, e, side, ring_plus(ring_plus(ring_origin(s, e, side), 1, u), -dt, v));
            memcpy(ring_field(s, e, side ? RING_V_RIGHT : RING_V_LEFT), (double[]){v.x, v.y},
                   2 * sizeof(double));
        }
    }
    step->time[0] = 1e-6;
    step->drift[0] = dt;
    step->kick[0] = step->created[0] = 0;
    step->cracked[0] = step->broken[0] = 0;
    s->model->formulation->advance(s->model, step);
    return (ring_answer){.elastic = step->elastic[0],
                         .cohesive = step->cohesive[0],
                         .dissipated = step->dissipated[0] - 11e-4};
}

/* An uncracked interface resists a jump across it by K p^2/2, which its onset drops and books; a
 * break drops -m^2/(2K). Between just before and just after, 1e-10 of the trial traction apart,
 * nothing else changes: 1e-10 G_c of some 0.1 J/m2. The trial traction of such elements is linear
 * in time, and so the times of both are exact, but for positions of 4e-5 m that are rounded by
 * 7e-21 m, some of them, at 1 m/s. */
static void events_book_what_they_drop_at_the_time_they_happen(void **unused)
{
    for (int i = 0; i < 2; i++) {
        one_run s = small_ring(12, 4, i ? &fracas_direction_initial : &fracas_direction_current);
        const double young = 275e9, spring = 4 * young / s.model->element_size, p = 1e-8,
                     x = spring * 200 / BAR_STRENGTH_MEAN - BAR_STRENGTH_MEAN;
        const double strain = 1e-3, mean = young * strain,
                     rate = spring + 0.5 * young / s.model->element_size;
        const fracas_step *step = &s.batch->step;
        const double restraint = 1e-6 * 0.5 * spring * p * p,
                     flux = 1e-6 * 0.5 * mean * mean / spring;
        for (int breaks = 0; breaks < 2; breaks++) {
            const double level = BAR_STRENGTH_MEAN + (breaks ? x : 0), damage = breaks ? 0.9 : 0,
                         late = 4e-10;
            const ring_answer a = one_event(&s, damage, strain, level * (1 - 1e-10), p);
            assert_int_equal(step->cracked[0] + step->broken[0], 0);
            const ring_answer b = one_event(&s, damage, strain, level * (1 + 1e-10), p);
            assert_int_equal(step->cracked[0], !breaks);
            assert_int_equal(step->broken[0], breaks);
            const double change = b.elastic + b.cohesive + b.dissipated -
                                  (a.elastic + a.cohesive + a.dissipated);
            const double dropped = breaks ? flux - restraint : 0; /* the chords are at rest */
            assert_true(fabs(step->created[0] - dropped) <= 1e-9 * flux);
            assert_true(fabs(change - dropped) < 1e-6 * flux);
            one_event(&s, damage, strain, level + rate * late, p);
            const double *when = breaks ? step->break_time : step->onset_time;
            assert_true(fabs(when[0] - (1e-6 - late)) < 3e-20);
        }
        const ring_answer with = one_event(&s, 0, 0, 0, p), without = one_event(&s, 0, 0, 0, 0);
        assert_true(fabs((with.elastic - without.elastic) / restraint - 1) <
                    1e-6); /* of differences of 1e-6 J by 1e-4 J */
        clear_run(&s);
    }
}

/* ---- ledger ---- */

/* Rings that break up: free, free and spinning, pulled, pulled ever faster, pushed outward, pushed
 * harder and harder. */
static fracas_spec broken_up(int load, bool current, double safety)
{
    fracas_spec spec = ring_reference(1250, 1e4, 4e-7);
    spec.geometry.direction = current ? &fracas_direction_current : &fracas_direction_initial;
    spec.time.safety = safety;
    const fracas_kind *out = &fracas_axis_radial;
    switch (load) {
    case 1: spec.loading.circumferential = 300; break;
    case 2:
        spec.loading = (fracas_loading){.type = &fracas_loading_imposed_rate, .rate = 1e4};
        break;
    case 3:
        spec.loading = (fracas_loading){.type = &fracas_loading_held_velocity,
                                        .direction = out,
                                        .velocity = 50,
                                        .acceleration = 3e8};
        break;
    case 4:
        spec.loading = (fracas_loading){
            .type = &fracas_loading_force, .direction = out, .force = 1e6};
        break;
    case 5:
        spec.loading = (fracas_loading){
            .type = &fracas_loading_force, .direction = out, .force = 4e5, .force_rate = 5e12};
        break;
    default: break;
    }
    return spec;
}

static ledger_figures broken_up_ledger(const fracas_spec *spec)
{
    OWN(fracas_model) model = make_model(spec);
    return break_up(model, 0, 8, 1.0 / 300, NULL);
}

/* Through break-up, default step: |residual| < 1e-3, created < 1e-2 of dissipated, the bar's
 * figures; halving the step divides the residual by 4, less what breaks at other instants changes,
 * and so it is the step's, not a missing term. */
static void the_ledger_closes_to_second_order(void **unused)
{
    static const char *const load[] = {"free",          "free, spinning", "imposed rate",
                                       "held velocity", "force",          "growing force"};
    for (int i = 0; i < 7; i++) {
        const bool current = i < 6;
        const fracas_spec whole = broken_up(i % 6, current, 0.25),
                          half = broken_up(i % 6, current, 0.125);
        const ledger_figures a = broken_up_ledger(&whole), b = broken_up_ledger(&half);
        print_message(
            "[  figures ] %-14s %s: %5.1f fragments, work/dissipated %.3e; residual %.1e, "
            "at half the step %.1e; created %.1e\n",
            load[i % 6], current ? "current" : "initial", a.fragments, a.work, a.residual,
            b.residual, a.created);
        assert_true(a.fragments > 20);
        assert_true((i % 6 < 2) == (a.work == 0));
        assert_true(a.residual < 1e-3);
        assert_true(b.residual < a.residual / 2);
        assert_true(a.created > 0 && a.created < 1e-2);
    }
}

/* Circumferential drives turn with the ring, which swells: their direction at the end of a step is
 * not that at its start. With the work of the force before and after, each along its own, the
 * kinetic energy v_{n-1/2} v_{n+1/2} gains just that work, and what is left in an uncracked ring is
 * what elements' forces, nearly linear in the displacements, miss by: at half the step a quarter.
 */
static void the_work_of_turning_drives_is_of_second_order(void **unused)
{
    for (int i = 0; i < 3; i++) {
        double residual[2], work[2];
        for (int half = 0; half < 2; half++) {
            fracas_spec spec = ring_reference(300, 1e4, 3e-6);
            spec.loading = (fracas_loading){.type = i ? &fracas_loading_force
                                                      : &fracas_loading_held_velocity,
                                            .direction = &fracas_axis_circumferential,
                                            .velocity = 100,
                                            .acceleration = 1e8,
                                            .force = i == 1 ? 3e5 : 1e5,
                                            .force_rate = i == 1 ? 0 : 1e11};
            spec.time.safety = half ? 0.2 : 0.4;
            spec.cohesive.fracture_energy = 1e4; /* strong interfaces need it of these elements */
            one_run s = begin(&spec, BAR_STRENGTH_MEAN);
            for (size_t e = 0; e < 300; e++) {
                *ring_field(&s, e, RING_STRENGTH) = 2e9;
                *ring_field(&s, e, RING_LAW) = 2 * (4 * 275e9 / s.model->element_size) * 1e4 / 2e9 -
                                               2e9;
            }
            finish_run(&s);
            assert_int_equal(s.record.outcome, FRACAS_INTACT);
            residual[half] = s.record.residual;
            work[half] = s.record.work;
            clear_run(&s);
        }
        print_message("[  figures ] circumferential %s: work %.3e J, residual %.1e of it, at half "
                      "the step %.1e\n",
                      i == 0   ? "velocity"
                      : i == 1 ? "force"
                               : "growing force",
                      work[0], residual[0] / work[0], residual[1] / work[1]);
        assert_true(residual[0] < 1e-7 * work[0]);
        assert_true(residual[1] < residual[0] / 3.5);
    }
}

/* ---- spin ---- */

/* A ring that starts to turn with speed V, unstressed, swings about its steady rotation: sigma =
 * rho V^2 (1 - cos w t), w = c/R. V is 10 m/s: strains, and corrections of w^2 by 3 V^2/R^2, are of
 * the size of (V/c)^2 = 1e-6. Of a polygon of 400 w is c/R_n, 1.0e-5 lower: in three periods 1.9e-4
 * of the swing; its speed R_n/R times V, and its interfaces play: 2.1e-5 and 1.0e-5 of the stress,
 * at the crest of 2: 2.5e-4 together. The mean of some 1e4 steps counts the end of the period
 * twice, another 1e-4. Angular momentum is m V R, the polygon's (R_n/R)^2 = 1 + (pi/n)^2/3 times
 * that, + (pi/n)^4/15 = 2.5e-10. */
static void a_spinning_ring_swings_about_its_hoop_stress(void **unused)
{
    const double speed = 10, w = BAR_WAVE_SPEED / RING_RADIUS, stress = 2750 * speed * speed;
    fracas_spec spec = ring_reference(400, 0, 3 * 2 * RING_PI / w);
    spec.loading.circumferential = speed;
    one_run s = begin(&spec, BAR_STRENGTH_MEAN);
    const double h = s.model->element_size;
    double worst = 0, sum = 0, steps = 0;
    while (s.running) {
        step_run(&s);
        const ring_point chord = ring_chord(&s, 37);
        const double found = 275e9 * (sqrt(ring_inner(chord, chord)) / h - 1),
                     t = s.batch->step.time[0];
        worst = fmax(worst, fabs(found - stress * (1 - cos(w * t))) / stress);
        sum += found;
        steps++;
    }
    const fracas_fragment *ring = s.record.fragment;
    const double angular = ring->angular_momentum[2];
    print_message("[  figures ] hoop stress within %.1e of rho V^2, its mean %.6f of it; angular "
                  "momentum %.8f m V R\n",
                  worst, sum / steps / stress, angular / (s.model->mass * speed * RING_RADIUS));
    assert_int_equal(s.record.fragments, 1);
    assert_true(worst < 2.6e-4);
    assert_true(fabs(sum / steps / stress - 1) < 3.5e-4);
    assert_true(fabs(angular / (s.model->mass * speed * RING_RADIUS) - 1 -
                     RING_PI * RING_PI / 3 / 160000) < 1e-9);
    clear_run(&s);
}

TESTS(forces_are_the_gradient_of_the_energy, the_energy_does_not_see_where_the_ring_is,
      events_book_what_they_drop_at_the_time_they_happen, the_ledger_closes_to_second_order,
      the_work_of_turning_drives_is_of_second_order, a_spinning_ring_swings_about_its_hoop_stress)
