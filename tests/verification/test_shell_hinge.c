/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `becker-noels` on an interface driven along paths: energies in closed form, unloading,
 * contact, and every force against the law written once more (docs/theory/cohesive.md). */
#include "tests/support/shell_hinge.h"
#include "tests/support/test.h"

#define STEPS 100

/* ---- the law once more, by the paper's eta and h_eq (its equations 57 to 78) ---- */

typedef struct {
    double depth, k, beta_c, energy, opening;
    hinge_stress at; /* at the onset */
    hinge_jump from;
    double peak, widest; /* p [Pa], delta_max [m] */
} zone;

/* Normal and tangential stress of the skin that is pulled most, or sheared most [Pa]. */
static double skin_of(const zone *z, int i)
{
    const double n = z->at.n[i] / z->depth, m = 6 * fabs(z->at.m[i]) / (z->depth * z->depth);
    return i == 0 ? n + m : fabs(n) + m;
}

/* (57), (58): (1 - eta) [u] + eta h_eq [Dt], with their signs */
static double opening_of(const zone *z, int i, const hinge_jump *jump)
{
    const double h = z->depth, skin = skin_of(z, i), n = z->at.n[i];
    if (i == 0 && n < 0) return skin > 0 ? copysign(h / 6, z->at.m[0]) * jump->t[0] : 0;
    if (skin == 0) return jump->u[i];
    const double eta = 1 - fabs(n) / (h * skin),
                 height = eta == 0 ? 0 : fabs(z->at.m[i]) / (h * skin - fabs(n));
    return (1 - eta) * copysign(jump->u[i], n * jump->u[i]) +
           eta * height * copysign(jump->t[i], z->at.m[i] * jump->t[i]);
}

/* N, M of the law's own part when it carries the whole of its stress. */
static void whole_of(const zone *z, int i, double *n, double *m)
{
    const bool pressed = i == 0 && z->at.n[0] < 0;
    *n = pressed ? 0 : z->at.n[i];
    *m = z->at.m[i];
    if (pressed) *m = copysign(fmax(0, skin_of(z, 0)) * z->depth * z->depth / 6, z->at.m[0]);
}

static void press(const zone *z, double arm, double held, const hinge_jump *jump,
                  hinge_stress *carried, double *stored)
{
    const double h = z->depth, stiff = z->k * h / (1 + 12 * arm * arm / (h * h));
    const double force = fmin(0, held + stiff * (jump->u[0] + arm * jump->t[0]));
    carried->n[0] += force;
    carried->m[0] += arm * force;
    *stored += force * force / (2 * stiff);
}

/* Carried after a move to a jump; `stored` per length. */
static hinge_stress carried_by(zone *z, const hinge_jump *to, double *stored)
{
    const double h = z->depth, delta_c = z->opening > 0 ? z->opening : 2 * z->energy / z->peak;
    hinge_jump jump;
    hinge_stress carried = {.n = {0}};
    for (int i = 0; i < 2; i++) {
        jump.u[i] = to->u[i] - z->from.u[i];
        jump.t[i] = to->t[i] - z->from.t[i];
    }
    const double d[2] = {opening_of(z, 0, &jump), opening_of(z, 1, &jump)},
                 wide = hypot(fmax(0, d[0]), z->beta_c * d[1]);
    z->widest = fmin(delta_c, fmax(z->widest, wide));
    *stored = 0;
    for (int i = 0; i < 2; i++) {
        const double share = (1 / z->widest - 1 / delta_c) * /* (67) to (78) */
                             (i ? z->beta_c * d[1] : fmax(0, d[0]));
        double n, m;
        whole_of(z, i, &n, &m);
        carried.n[i] += share * n;
        carried.m[i] += share * m;
        *stored += 0.5 * share * (n * jump.u[i] + m * jump.t[i]);
    }
    double n, m, arm;
    whole_of(z, 0, &n, &m);
    arm = fabs(m) < 0.5 * h * n ? m / n : copysign(0.5 * h, m);
    press(z, arm, 0, &jump, &carried, stored);
    if (z->at.n[0] < 0)
        press(z, (z->at.m[0] - m) / z->at.n[0], z->at.n[0], &jump, &carried, stored);
    return carried;
}

/* ---- paths ---- */

static double random_of(uint64_t *seed)
{
    return 2 * next_share(seed) - 1;
}

static zone zone_of(const hinge *h)
{
    const fracas_cohesive *cohesive = &h->model->spec.cohesive;
    double shearing;
    const double k = spring_of(h->model, 0, &shearing), beta_c = cohesive->coupling;
    return (zone){.depth = h->model->spec.geometry.thickness,
                  .k = k * fmax(1, 1 / (beta_c * beta_c)),
                  .beta_c = beta_c,
                  .energy = cohesive->fracture_energy,
                  .opening = cohesive->critical_opening};
}

/* Largest effective stress of the skins [Pa]  (cohesive.11) */
static double effective_of_skins(const zone *z, const hinge_stress *at)
{
    double most = 0;
    for (int side = -1; side <= 1; side += 2) {
        const double h = z->depth, n = at->n[0] / h + side * 6 * at->m[0] / (h * h),
                     s = at->n[1] / h + side * 6 * at->m[1] / (h * h);
        most = fmax(most, hypot(fmax(0, n), s / z->beta_c));
    }
    return most;
}

static hinge_stress scaled(const hinge_stress *of, double by)
{
    return (hinge_stress){{by * of->n[0], by * of->n[1]}, {by * of->m[0], by * of->m[1]}};
}

static hinge_jump moved(const hinge_jump *by, double x)
{
    return (hinge_jump){{x * by->u[0], x * by->u[1]}, {x * by->t[0], x * by->t[1]}};
}

/* A body whose interface has its onset at this state of stress, without jumps. */
static zone crack_at(hinge *h, const hinge_stress *direction, hinge_stress *stress)
{
    zone z = zone_of(h);
    *stress = scaled(direction, 1.0625 * HINGE_STRENGTH / effective_of_skins(&z, direction));
    z.at = *stress;
    z.peak = effective_of_skins(&z, stress);
    hinge_go(h, stress, &(hinge_jump){.u = {0}});
    assert_true(fabs(hinge_value(h, SURFACE_PEAK) / z.peak - 1) < 1e-12);
    return z;
}

/* h G_c of this peak [J/m]. */
static double cost_of(const zone *z)
{
    return z->depth * (z->opening > 0 ? 0.5 * z->peak * z->opening : z->energy);
}

/* To the break in STEPS steps, which meet it, and on without a force. Returns the work by its cost,
 * `first` that of the first step. */
static double break_along(hinge *h, const zone *z, const hinge_stress *stress, hinge_jump way,
                          double *first)
{
    const double d[2] = {opening_of(z, 0, &way), opening_of(z, 1, &way)},
                 delta_c = 2 * cost_of(z) / z->depth / z->peak,
                 far = delta_c / hypot(fmax(0, d[0]), z->beta_c * d[1]);
    for (int i = 1; i <= STEPS + 10; i++) {
        const hinge_jump to = moved(&way, far * i / STEPS);
        hinge_go(h, stress, &to);
        if (i == 1) *first = h->work / cost_of(z);
    }
    assert_true(hinge_value(h, SURFACE_DAMAGE) == 1 && h->batch->step.broken[0] == 1);
    assert_true(fabs(h->answer.dissipated / h->length / cost_of(z) - 1) < 1e-12);
    return h->work / cost_of(z);
}

static fracas_spec spec_number(int which)
{
    static const double coupling[] = {1, 0.6, 1.7};
    fracas_spec spec = hinge_spec();
    spec.cohesive.coupling = coupling[which % 3];
    spec.cohesive.onset = which / 3 % 2 ? &fracas_onset_flux : &fracas_onset_mean;
    if (which / 6 % 2) {
        spec.cohesive.fracture_energy = 0;
        spec.cohesive.critical_opening = 1.2e-6;
    }
    return spec;
}
enum { SPECS = 12 };

/* N and M work on d_n alone, a potential: h G_c whatever the part of tension and bending, along
 * openings, turns of either sign and both at once. Shear and torsion likewise. Forces are linear
 * between steps and the trapezoidal rule exact; sums of some hundred products that are rounded, and
 * of forces of the strained bulk that cancel: 1e-12. */
static void pure_modes_take_the_fracture_energy(void **unused)
{
    enum { N, M, BOTH };
    const double h = 3e-4;
    int runs = 0;
    for (int which = 0; which < SPECS; which++)
        for (int mode = 0; mode < 2; mode++)         /* normal, along the edge */
            for (int part = N; part <= BOTH; part++) /* stress */
                for (int sign = -1; sign <= 1; sign += 2)
                    for (int path = N; path <= BOTH; path++) { /* jump */
                        if (part != BOTH && path != part) continue;
                        const fracas_spec spec = spec_number(which);
                        hinge body = hinge_begin(&spec);
                        hinge_stress direction = {.n = {0}}, stress;
                        hinge_jump way = {.u = {0}};
                        const double n = mode == 0 ? 1 : -sign; /* no pressure here */
                        direction.n[mode] = part == M ? 0 : n;
                        direction.m[mode] = part == N ? 0 : sign * h / 9;
                        way.u[mode] = path == M ? 0 : n;
                        way.t[mode] = path == N ? 0 : sign * 2 / h;
                        const zone z = crack_at(&body, &direction, &stress);
                        double first;
                        const double taken = break_along(&body, &z, &stress, way, &first);
                        assert_true(fabs(taken - 1) < 1e-12);
                        assert_true(body.answer.cohesive < 1e-12 * cost_of(&z));
                        hinge_end(&body);
                        runs++;
                    }
    assert_int_equal(runs, SPECS * 2 * 2 * (1 + 1 + 3));
}

/* Under pressure the moment softens, and costs h G_c, while the pressure is carried on, at the arm
 * c: a turn about it moves no force of contact. */
static void a_moment_under_pressure_takes_the_fracture_energy(void **unused)
{
    const double h = 3e-4;
    for (int which = 0; which < SPECS; which++)
        for (int sign = -1; sign <= 1; sign += 2)
            for (int k = 1; k < 6; k++) {
                const fracas_spec spec = spec_number(which);
                hinge body = hinge_begin(&spec);
                const hinge_stress direction = {.n = {-1, 0}, .m = {sign * h * (1 + k) / 6, 0}};
                hinge_stress stress;
                double first;
                const zone z = crack_at(&body, &direction, &stress);
                const hinge_jump way = {.u = {sign * sign * h / 6, 0}, .t = {sign, 0}};
                assert_true(fabs(break_along(&body, &z, &stress, way, &first) - 1) < 1e-12);
                assert_true(fabs(body.carried.n[0] / stress.n[0] - 1) < 1e-12);
                hinge_end(&body);
            }
}

/* Stress at an angle f of its effective value, jump at an angle g of the opening: of the two works
 * N d_n and S d_s, cos f cos^2 g + sin f sin^2 g of h G_c; cos^3 + sin^3 where both are one. With a
 * moment in both or not. The force falls at once from N_0 to its part along the jump: the work
 * counts after the first step, (1 - 1/STEPS)^2 of it. */
static void mixed_paths_take_less(void **unused)
{
    const double h = 3e-4, quarter = 0.5 * PI;
    double least = 1;
    for (int which = 0; which < SPECS; which++)
        for (int bent = 0; bent < 2; bent++)
            for (int f = 0; f <= 4; f++)
                for (int g = 0; g <= 4; g++) {
                    const double b = spec_number(which).cohesive.coupling,
                                 c = cos((f + 0.25) * quarter / 4.5),
                                 s = sin((f + 0.25) * quarter / 4.5), x = cos(g * quarter / 4),
                                 y = sin(g * quarter / 4);
                    const fracas_spec spec = spec_number(which);
                    hinge body = hinge_begin(&spec);
                    const hinge_stress direction = bent ? (hinge_stress){.m = {c * h, s * b * h}}
                                                        : (hinge_stress){.n = {c, s * b}};
                    const hinge_jump way = bent ? (hinge_jump){.t = {x / h, y / b / h}}
                                                : (hinge_jump){.u = {x, y / b}};
                    hinge_stress stress;
                    const zone z = crack_at(&body, &direction, &stress);
                    double first, left = pow(1 - 1.0 / STEPS, 2);
                    const double taken = (break_along(&body, &z, &stress, way, &first) - first) /
                                         left;
                    assert_true(fabs(taken - (c * x * x + s * y * y)) < 1e-12);
                    least = fmin(least, taken);
                    hinge_end(&body);
                }
    assert_true(fabs(least / sin(quarter / 18) - 1) < 1e-12); /* slid under tension */
}

/* Back and forth on the secant, to the onset's jump and beyond it into contact: nothing is lost or
 * gained, forces are as before, and stored + dissipated is the work at each step. */
static void unloading_closes(void **unused)
{
    static const hinge_stress directions[] = {
        {{1, 0}, {0, 0}}, {{0, 0}, {3e-4, 0}},  {{0, 0}, {-3e-4, 0}},   {{1, 0}, {-2e-5, 0}},
        {{0, 1}, {0, 0}}, {{0, 0}, {0, -3e-4}}, {{-0.2, 0}, {3e-4, 0}}, {{0.5, 0}, {3e-4, 0}}};
    for (int which = 0; which < SPECS; which++)
        for (size_t k = 0; k < sizeof directions / sizeof *directions; k++) {
            const fracas_spec spec = spec_number(which);
            hinge body = hinge_begin(&spec);
            hinge_stress stress;
            const zone z = crack_at(&body, &directions[k], &stress);
            const double delta_c = 2 * cost_of(&z) / z.depth / z.peak,
                         begun = body.answer.cohesive / body.length;
            hinge_jump way = {.u = {z.at.n[0] > 0, z.at.n[1]}};
            for (int i = 0; i < 2; i++) way.t[i] = z.at.m[i] / 1e-4;
            const double d[2] = {opening_of(&z, 0, &way), opening_of(&z, 1, &way)},
                         far = delta_c / hypot(fmax(0, d[0]), z.beta_c * d[1]);
            for (int leg = 1; leg <= 3; leg++) {
                hinge_stress there = {.n = {0}};
                double work = 0;
                for (int i = 1; i <= 9 * STEPS; i++) {
                    const int phase = (i - 1) / STEPS; /* 0: on, then back past 0, and on again */
                    const double part = (double)((i - 1) % STEPS + 1) / STEPS, top = 0.3 * leg,
                                 x = phase == 0  ? top - 0.3 * (1 - part)
                                     : phase < 5 ? top * (1 - 0.3 * (phase - 1 + part))
                                                 : top * (1 - 0.3 * (9 - phase - part));
                    const hinge_jump to = moved(&way, far * x);
                    hinge_go(&body, &stress, &to);
                    const double held = (body.answer.cohesive + body.answer.dissipated) /
                                        body.length;
                    /* a step meets no kink of the force, at 0, where contact begins */
                    if (phase < 4 || phase > 5)
                        assert_true(fabs(body.work + begun - held) < 1e-11 * cost_of(&z));
                    if (i == STEPS) there = body.carried, work = body.work;
                }
                for (int c = 0; c < 2; c++)
                    assert_true(fabs(body.carried.n[c] - there.n[c]) < 1e-11 * z.peak * z.depth &&
                                fabs(body.carried.m[c] - there.m[c]) <
                                    1e-11 * z.peak * z.depth * z.depth);
                assert_true(fabs(body.work - work) < 1e-11 * cost_of(&z));
                assert_true(fabs(hinge_value(&body, SURFACE_DAMAGE) - 0.3 * leg) < 1e-12);
            }
            hinge_end(&body);
        }
}

/* ---- what the method puts in ---- */

/* An onset beside jumps leaves the flux with the energy that they have there: <N> [u] + K h
 * [u]^2/2, <M> [Dt] + K h^3/12 [Dt]^2/2, K beta_c^2 along the edge. Kept pressure stores N_0^2/(2
 * k). Sums of ten terms: 1e-12. */
static void an_onset_books_what_it_drops(void **unused)
{
    uint64_t seed = 3;
    for (int run = 0; run < 10 * SPECS; run++) {
        const fracas_spec spec = spec_number(run % SPECS);
        hinge body = hinge_begin(&spec);
        zone z = zone_of(&body);
        const double h = z.depth;
        hinge_stress direction;
        hinge_jump jump;
        for (int i = 0; i < 2; i++) {
            direction.n[i] = random_of(&seed);
            direction.m[i] = h * random_of(&seed);
            jump.u[i] = 1e-9 * random_of(&seed);
            jump.t[i] = 1e-9 / h * random_of(&seed);
        }
        const hinge_stress stress = scaled(&direction,
                                           3 * HINGE_STRENGTH / effective_of_skins(&z, &direction));
        hinge_go(&body, &stress, &jump);
        assert_true(hinge_value(&body, SURFACE_PEAK) > 0);
        double left = 0, size = 0;
        for (int i = 0; i < 2; i++) {
            const double stiff = z.k * h * (i ? z.beta_c * z.beta_c : 1);
            const double part[2] = {
                jump.u[i] * (stress.n[i] + 0.5 * stiff * jump.u[i]),
                jump.t[i] * (stress.m[i] + 0.5 * stiff * h * h / 12 * jump.t[i])};
            left += part[0] + part[1];
            size += fabs(part[0]) + fabs(part[1]);
        }
        const double stored = body.answer.cohesive / body.length;
        assert_true(fabs(body.answer.created / body.length - (stored - left)) <
                    1e-11 * (size + stored));
        hinge_end(&body);
    }
}

/* The break of a point lets go of K_3 ([u].t)^2/2 against shearing off, in that step alone: of a
 * torsion [u].t is linear along the edge, its mean square ([Dt] length)^2/12. */
static void a_break_books_what_it_drops(void **unused)
{
    fracas_spec spec = hinge_spec();
    spec.cohesive.beta_shear = 1;
    hinge body = hinge_begin(&spec);
    const hinge_stress direction = {.m = {0, 1}};
    hinge_stress stress;
    const zone z = crack_at(&body, &direction, &stress);
    const hinge_jump way = {.t = {0, 1}};
    const double far = 2 * z.energy / z.peak / opening_of(&z, 1, &way);
    double shearing, created = 0, at[2] = {0.5 * far, 1.5 * far};
    spring_of(body.model, 0, &shearing);
    for (int i = 0; i < 4; i++) { /* opens, breaks, and nothing more */
        const hinge_jump to = moved(&way, at[i > 0]);
        hinge_go(&body, &stress, &to);
        const double put = body.answer.created / body.length;
        if (i == 1) created = put;
        else assert_true(put == 0);
    }
    const double lift = at[1] * body.length;
    assert_true(fabs(created / (-0.5 * shearing * lift * lift / 12) - 1) < 1e-12);
    hinge_end(&body);
}

/* ---- anywhere ---- */

/* The largest differences of N, M and of the stored energy from the law once more, by p h, p h^2, h
 * G_c. seen: loading, unloading, closed, pressed at onset, broken. */
static void walk(const fracas_spec *spec, uint64_t *seed, double worst[3], long seen[5])
{
    hinge body = hinge_begin(spec);
    const double h = spec->geometry.thickness;
    hinge_stress direction, stress;
    for (int i = 0; i < 2; i++) {
        direction.n[i] = random_of(seed);
        direction.m[i] = 0.5 * h * random_of(seed);
    }
    zone z = crack_at(&body, &direction, &stress);
    const double delta_c = 2 * cost_of(&z) / h / z.peak;
    hinge_jump from = {.u = {0}};
    for (int leg = 0; leg < 6; leg++) {
        hinge_jump end;
        for (int i = 0; i < 2; i++) {
            end.u[i] = 1.5 * delta_c * random_of(seed);
            end.t[i] = 5 * delta_c / h * random_of(seed);
        }
        for (int k = 1; k <= 20; k++) {
            double stored;
            hinge_jump to;
            for (int i = 0; i < 2; i++) {
                to.u[i] = from.u[i] + 0.05 * k * (end.u[i] - from.u[i]);
                to.t[i] = from.t[i] + 0.05 * k * (end.t[i] - from.t[i]);
            }
            const double was = z.widest;
            hinge_go(&body, &stress, &to);
            const hinge_stress expected = carried_by(&z, &to, &stored);
            const double d = hinge_value(&body, SURFACE_DAMAGE) - z.widest / delta_c;
            for (int i = 0; i < 2; i++) {
                worst[0] = fmax(worst[0], fabs(body.carried.n[i] - expected.n[i]) / (z.peak * h));
                worst[0] = fmax(worst[0],
                                fabs(body.carried.m[i] - expected.m[i]) / (z.peak * h * h));
            }
            worst[1] = fmax(worst[1],
                            fabs(body.answer.cohesive / body.length - stored) / cost_of(&z));
            worst[1] = fmax(worst[1], fabs(body.answer.dissipated / body.length / cost_of(&z) -
                                           z.widest / delta_c));
            worst[2] = fmax(worst[2], fabs(d));
            seen[z.widest == delta_c ? 4 : z.widest > was ? 0 : 1]++;
            seen[2] += opening_of(&z, 0, &to) < 0;
            seen[3] += z.at.n[0] < 0;
        }
        from = end;
    }
    hinge_end(&body);
}

/* K [u] is up to 100 times p where it is pressed, and [u] a difference of displacements: 1e-16 x
 * 100 x the some hundred terms of a force, 1e-11; the bound is ten times that. */
static void every_force_is_the_papers(void **unused)
{
    uint64_t seed = 5;
    double worst[3] = {0};
    long seen[5] = {0};
    for (int run = 0; run < 400; run++) {
        const fracas_spec spec = spec_number(run % SPECS);
        walk(&spec, &seed, worst, seen);
    }
    print_message("forces within %.1e, energies %.1e, damage %.1e; loading %ld, unloading %ld, "
                  "closed %ld, pressed %ld, broken %ld\n",
                  worst[0], worst[1], worst[2], seen[0], seen[1], seen[2], seen[3], seen[4]);
    for (int i = 0; i < 5; i++) assert_true(seen[i] > 1000);
    assert_true(worst[0] < 1e-10 && worst[1] < 1e-10 && worst[2] < 1e-12);
}

/* ---- when ---- */

/* Rates of stress [Pa m/s ...] and of jumps, an onset within 20 to 70 steps. */
static void draw_rates(const zone *z, double dt, uint64_t *seed, hinge_stress *stress,
                       hinge_jump *jump)
{
    for (int i = 0; i < 2; i++) {
        stress->n[i] = random_of(seed);
        stress->m[i] = 0.5 * z->depth * random_of(seed);
        jump->u[i] = 1e-8 / dt * random_of(seed);
        jump->t[i] = 1e-8 / z->depth / dt * random_of(seed);
    }
    *stress = scaled(stress, HINGE_STRENGTH / effective_of_skins(z, stress) /
                                 ((20 + 50 * next_share(seed)) * dt));
}

/* Times of onset and break [s]: the former where the skin's line crosses the strength; the law
 * keeps what it finds at the end of that step. */
static void fate_of(zone *z, double dt, const hinge_stress *stress, const hinge_jump *jump,
                    bool flux, double time[2])
{
    hinge_stress judged = *stress;
    for (int i = 0; i < 2 && flux; i++) {
        const double stiff = z->k * z->depth * (i ? z->beta_c * z->beta_c : 1);
        judged.n[i] += stiff * jump->u[i];
        judged.m[i] += stiff * z->depth * z->depth / 12 * jump->t[i];
    }
    time[0] = HINGE_STRENGTH / effective_of_skins(z, &judged);
    const double found = (floor(time[0] / dt) + 1) * dt;
    z->at = scaled(&judged, found);
    z->peak = effective_of_skins(z, &z->at);
    const double d[2] = {opening_of(z, 0, jump), opening_of(z, 1, jump)};
    time[1] = found + 2 * cost_of(z) / z->depth / z->peak / hypot(fmax(0, d[0]), z->beta_c * d[1]);
}

/* Stresses and jumps grow with the time, with rates of their own, in a body all of whose nodes are
 * moved. What is crossed is linear in t: round-off of some 1000 steps, of jumps that are
 * differences of displacements up to 30 times as large: 1e-10 of the time. */
static void onsets_and_breaks_come_when_they_must(void **unused)
{
    uint64_t seed = 9;
    double worst[2] = {0};
    long pressed = 0;
    for (int run = 0; run < 10 * SPECS; run++) {
        const fracas_spec spec = spec_number(run % SPECS);
        hinge body = hinge_begin(&spec);
        const double dt = body.model->time_step;
        double time[2];
        zone z = zone_of(&body);
        hinge_stress stress;
        hinge_jump jump;
        draw_rates(&z, dt, &seed, &stress, &jump);
        fate_of(&z, dt, &stress, &jump, spec.cohesive.onset == &fracas_onset_flux, time);
        body.model->spec.time.end = time[1] + 2.5 * dt;
        for (size_t i = 0; i < unknowns_of(body.model); i += 3) {
            double u[3], moved[3] = {0};
            const double *x = place_of(body.model, i);
            hinge_strain(&body, &stress, x, u);
            if (i / 18 == body.model->surface->interface[0].element[1])
                hinge_move(&body, &jump, x, moved);
            tables_of(body.model)->held[i / 18] = tables_of(body.model)->fixed[i / 18] = 0x3ffff;
            for (size_t c = 0; c < 3; c++)
                *value_of(body.batch, i + c, SURFACE_V) = u[c] + moved[c];
        }
        RECORD(record);
        run_to_end(body.batch, &record);
        worst[0] = fmax(worst[0], fabs(record.interface[0].onset_time / time[0] - 1));
        worst[1] = fmax(worst[1], fabs(record.interface[0].break_time / time[1] - 1));
        pressed += z.at.n[0] < 0;
        hinge_end(&body);
    }
    print_message("onsets within %.1e, breaks %.1e, %ld pressed\n", worst[0], worst[1], pressed);
    assert_true(worst[0] < 1e-10 && worst[1] < 1e-9 && pressed > 20);
}

TESTS(onsets_and_breaks_come_when_they_must, pure_modes_take_the_fracture_energy,
      a_moment_under_pressure_takes_the_fracture_energy, mixed_paths_take_less, unloading_closes,
      an_onset_books_what_it_drops, a_break_books_what_it_drops, every_force_is_the_papers)
