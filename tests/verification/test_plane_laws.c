/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* The cohesive laws of a point that opens and slides, against what must hold of them by themselves:
 * the ledger of energies on any path, traction against separation, onset, cycles, extremes, lanes.
 * Theory: docs/theory/cohesive.md. */
#include "tests/support/plane.h"
#include "tests/support/test.h"

static const double PI = 3.14159265358979323846;

typedef void path(plane_walk *w, double angle);

/* Steps of a path, such that the bound of the quadrature stays below 1e-3 G_c: it goes with the
 * step. */
enum { STEPS = 5000 };

/* Until it is broken, whatever m, beta_c and friction: jumps are c = (1/beta_c) times as long in
 * shear where beta_c < 1. */
static double far_t(const plane_walk *w)
{
    return 3 * fmax(1, 1 / w->kind.beta_c);
}

static void straight(plane_walk *w, double angle)
{
    plane_go(w, to(0, 0, 3 * cos(angle), far_t(w) * sin(angle)), STEPS);
    plane_step(w, w->at);
}

static void straight_with_mean(plane_walk *w, double angle)
{
    const double m_n = 1.2 * w->kind.sigma_c * cos(angle),
                 m_t = 1.2 * w->kind.beta_c * w->kind.sigma_c * sin(angle);
    plane_go(w, (plane_at){.m_n = m_n, .m_t = m_t}, STEPS / 8); /* through the onset */
    plane_go(w, to(0.2 * m_n, 0.3 * m_t, 3 * cos(angle), far_t(w) * sin(angle)), STEPS);
    plane_go(w, to(-0.2 * m_n, 0.1 * m_t, 3 * cos(angle), far_t(w) * sin(angle)), STEPS / 8);
    plane_step(w, w->at);
}

static void open_then_slide(plane_walk *w, double angle)
{
    plane_go(w, to(0, 0, 0.3 + 0.3 * fabs(cos(angle)), 0), STEPS / 4);
    plane_go(w, to(0, 0, 0.4, far_t(w) * (angle > PI ? -1 : 1)), STEPS);
    plane_step(w, w->at);
}

static void slide_then_open(plane_walk *w, double angle)
{
    plane_go(w, to(0, 0, 0, 0.6 / w->kind.beta_c * (angle > PI ? -1 : 1)), STEPS / 4);
    plane_go(w, to(0, 0, 3, 0.3 * cos(angle)), STEPS);
    plane_step(w, w->at);
}

static void spiral(plane_walk *w, double angle)
{
    for (int i = 1; i <= 2 * STEPS; i++) {
        const double turn = angle + 6 * PI * i / (2 * STEPS), radius = 3.0 * i / (2 * STEPS);
        plane_step(w, to(40e6 * sin(turn), 30e6 * cos(angle), radius * cos(turn),
                         radius / w->kind.beta_c * sin(turn)));
    }
    plane_go(w, to(0, 0, 0, 0), STEPS / 4); /* closes */
    plane_step(w, w->at);
}

static void with_unloading(plane_walk *w, double angle)
{
    const double c = cos(angle), s = sin(angle) / w->kind.beta_c;
    const double leg[][2] = {{0.4, 0.4}, {0.1, 0.1},   {0.6, 0.5}, {-0.3, 0.4},
                             {0.5, 0.7}, {0.2, -0.6},  {0, 0},     {0.8, -0.1},
                             {3, 3},     {-0.5, -0.5}, {0.5, -0.5}};
    for (size_t i = 0; i < sizeof leg / sizeof *leg; i++)
        plane_go(w, to(i % 3 == 1 ? 30e6 : 0, i % 4 == 2 ? -25e6 : 0, leg[i][0] * c, leg[i][1] * s),
                 STEPS / 4);
    plane_step(w, w->at);
}

static void pressed_and_sheared(plane_walk *w, double angle)
{
    const double push = -0.05 - 0.1 * fabs(cos(angle)), s = 1 / w->kind.beta_c;
    plane_go(w, to(-20e6, 0, push, 0), STEPS / 8);
    plane_go(w, to(-20e6, 10e6, push, 0.5 * s), STEPS / 4);
    plane_go(w, to(-10e6, 0, push, 0.2 * s), STEPS / 4);   /* sticks, slips back */
    plane_go(w, to(0, 0, 0.05, 0.3 * s), STEPS / 8);       /* opens */
    plane_go(w, to(0, 0, 0.5 * push, 0.3 * s), STEPS / 8); /* closes */
    plane_go(w, to(0, -20e6, push, -0.4 * s), STEPS / 4);
    plane_go(w, to(0, 0, push, 4 * s), STEPS); /* breaks in shear */
    plane_go(w, to(0, 0, push, 3 * s), STEPS / 2);
    plane_go(w, to(0, 0, 0.3 * push, 3.1 * s), STEPS / 4);
    plane_step(w, w->at);
}

/* The ledger (plane_walk) at every point of every path: laws, shares of shear strength, stiffnesses
 * (1.5: barely above the least; the cut of the peak acts), friction, both onsets. */
static void the_ledger_closes_on_every_path(void **unused)
{
    path *const paths[] = {straight, straight_with_mean, open_then_slide,    slide_then_open,
                           spiral,   with_unloading,     pressed_and_sheared};
    const double couplings[] = {0.5, 1, 2}, ratios[] = {1.5, 4, 25}, frictions[] = {0, 0.3, 1.2};
    long cracked = 0, broken = 0, walks = 0;
    for (int i = 0; i < 3 * 3 * 3 * 3 * 2; i++) {
        const plane_case kind = plane_kind((plane_test_law)(i % 3), couplings[i / 3 % 3],
                                           ratios[i / 9 % 3], frictions[i / 27 % 3], i / 81);
        for (size_t p = 0; p < sizeof paths / sizeof *paths; p++)
            for (int k = 0; k < 3; k++) {
                const double angle = 0.15 + 2.1 * k + 0.01 * i;
                plane_walk w = plane_begin(kind);
                paths[p](&w, angle);
                ASSERT_CLOSED(&w, "path and angle", (double)p + angle / 10);
                assert_true(w.slack < 5e-2 * kind.energy +
                                          1e-2 * fabs(w.work)); /* the bound says something */
                assert_true(w.dissipated <= kind.energy * (1 + 1e-12) && w.rubbed >= -w.slack);
                if (w.break_step > 0 && kind.law != PLANE_PAPER)
                    assert_true(fabs(w.dissipated / kind.energy - 1) < 1e-12);
                cracked += w.onset_step > 0;
                broken += w.break_step > 0;
                walks++;
            }
    }
    assert_true(cracked > walks / 2 && broken > walks / 3);
}

/* The same where delta_c is given: G_c is then that of the peak, p delta_c/2. */
static void the_ledger_closes_with_a_critical_opening(void **unused)
{
    path *const paths[] = {straight, straight_with_mean, with_unloading, pressed_and_sheared};
    for (int i = 0; i < 3 * 2 * 2 * 2 * 4; i++) {
        plane_case kind = plane_kind((plane_test_law)(i % 3), 0.8, i / 3 % 2 ? 1 : 8,
                                     i / 6 % 2 ? 0.3 : 0, i / 12 % 2);
        kind.energy = 0;
        kind.opening = MICRON;
        plane_walk w = plane_begin(kind);
        paths[i / 24](&w, 0.3 + 0.02 * i);
        ASSERT_CLOSED(&w, "path", (double)(i / 24));
        if (w.out.cracked) assert_true(w.slack < 0.05 * plane_fracture(&w) + 1e-2 * fabs(w.work));
        if (kind.law == PLANE_NITSCHE)
            assert_true(w.memory.peak <= 0.5 * kind.k_n * kind.opening * (1 + 1e-15));
        if (w.break_step > 0 && kind.law != PLANE_PAPER)
            assert_true(fabs(w.dissipated / (0.5 * w.memory.peak * MICRON) - 1) < 1e-12);
    }
}

/* m = 0: what it takes to break the point is G_c exactly, on any path: at the end the faces carry
 * nothing, and nothing is stored. The extrinsic laws add what the flux held at the onset. The
 * paper's: G_c (c^3 + s^3) of the angle. */
static void a_full_break_takes_the_fracture_energy(void **unused)
{
    path *const paths[] = {straight, open_then_slide, slide_then_open};
    const double couplings[] = {0.5, 1, 2}, ratios[] = {4, 25};
    for (int i = 0; i < 3 * 3 * 2 * 3 * 9; i++) {
        const plane_case kind = plane_kind((plane_test_law)(i % 3), couplings[i / 3 % 3],
                                           ratios[i / 9 % 2], 0, 0);
        const int p = i / 18 % 3, k = i / 54;
        if (kind.law == PLANE_PAPER && p > 0) continue;
        const double angle = PI * (k / 8.0 - 0.5);
        plane_walk w = plane_begin(kind);
        paths[p](&w, angle);
        ASSERT_CLOSED(&w, "angle", angle);
        assert_true(w.break_step > 0 && w.memory.damage == 1 && w.slack < 1e-3 * kind.energy);
        double expected = kind.energy;
        if (kind.law == PLANE_PAPER) {
            const double shear = kind.beta_c * far_t(&w) * sin(angle), pull = 3 * cos(angle),
                         whole = hypot(pull, shear);
            expected *= pow(fabs(pull / whole), 3) + pow(fabs(shear / whole), 3);
        }
        assert_true(kind.law != PLANE_NITSCHE || w.created == 0);
        assert_true(w.out.flux == 0 && w.out.stored < 1e-10 * kind.energy);
        assert_true(fabs(w.work + w.created - expected) <= w.slack + 1e-9 * kind.energy);
    }
}

/* T = p (1 - delta/delta_c) along the opening's direction, k_n : beta_c^2 k_n; the secant to the
 * origin on unloading, and the same traction on the way back. delta = q - s (nitsche), q - q_0
 * (extrinsic). A handful of roundings of T' = m + k q, which is up to 1e2 p here: 1e-12 p; of a
 * ratio of openings of 1e-3 delta_c at least. */
static void traction_follows_separation(void **unused)
{
    uint64_t seed = 7;
    int loading = 0, unloading = 0;
    for (int i = 0; i < 3000; i++) {
        const plane_test_law law = i % 2 ? PLANE_STANDARD : PLANE_NITSCHE;
        const plane_case kind = plane_kind(law, 0.4 + 2 * random_share(&seed),
                                           2 + 30 * random_share(&seed), 0, 0);
        plane_walk w = plane_begin(kind);
        for (int leg = 0; leg < 20; leg++) {
            const plane_at here = to(law == PLANE_NITSCHE ? 80e6 * (random_share(&seed) - 0.5) : 0,
                                     60e6 * (random_share(&seed) - 0.5),
                                     1.3 * random_share(&seed) - 0.2,
                                     (1.6 * random_share(&seed) - 0.8) / kind.beta_c);
            const double before = w.memory.damage;
            plane_step(&w, here);
            if (!w.out.cracked || w.memory.damage >= 1) continue;
            const double p = w.memory.peak, delta_c = 2 * kind.energy / p;
            const double d_n = fmax(0, law == PLANE_NITSCHE ? here.q_n - w.out.s_n
                                                            : here.q_n - w.memory.q_n);
            const double d_t = law == PLANE_NITSCHE ? here.q_t - w.out.s_t
                                                    : here.q_t - w.memory.q_t;
            const double opening = hypot(d_n, kind.beta_c * d_t), most = w.memory.damage * delta_c;
            if (opening < 1e-3 * delta_c) continue;
            const bool grew = w.memory.damage > before;
            if (grew) assert_true(fabs(opening / most - 1) < 1e-9);
            else assert_true(opening <= most * (1 + 1e-9));
            const double traction = grew ? p * (1 - opening / delta_c)
                                         : p * (1 - w.memory.damage) * opening / most;
            const double closed = law == PLANE_NITSCHE
                                      ? fmin(0, w.out.t_n)
                                      : kind.k_n * fmin(0, here.q_n - w.memory.q_n);
            assert_true(fabs(w.out.t_n - closed - traction * d_n / opening) < 1e-9 * p);
            assert_true(fabs(w.out.t_t - traction * kind.beta_c * kind.beta_c * d_t / opening) <
                        1e-9 * p * kind.beta_c);
            if (law == PLANE_NITSCHE) {
                assert_true(fabs(w.out.t_n - here.m_n - kind.k_n * w.out.s_n) < 1e-9 * p);
                assert_true(fabs(w.out.t_t - here.m_t - kind.k_t * w.out.s_t) < 1e-9 * p);
            }
            loading += grew;
            unloading += !grew;
            const plane_walk there = w;
            plane_step(&w, (plane_at){here.m_n, here.m_t, 0.3 * here.q_n,
                                      0.3 * here.q_t}); /* away and back: as it was, unless grown */
            if (w.memory.damage == there.memory.damage) {
                plane_step(&w, here);
                assert_true(hypot(w.out.t_n - there.out.t_n,
                                  (w.out.t_t - there.out.t_t) / kind.beta_c) < 1e-9 * p);
                assert_true(w.memory.damage == there.memory.damage);
            }
        }
    }
    assert_true(loading > 1000 && unloading > 1000);
}

/* In the norm |T|^2 = T_n^2 + (T_t/beta_c)^2 the law `nitsche` shrinks distances as long as x >= p:
 * on softening the radius falls by p/x of what the trial's grows, across it by p (1 - D)/S' <= 1;
 * secant and contact have slopes of at most 1. So the traction is continuous at onset, on turning
 * back and at the break, |dT| <= |dT'|: m = 0, so that a break leaves nothing behind. */
static void traction_is_continuous(void **unused)
{
    uint64_t seed = 11;
    long onsets = 0, breaks = 0;
    for (int i = 0; i < 400; i++) {
        const plane_case kind = plane_kind(PLANE_NITSCHE, 0.4 + 2 * random_share(&seed),
                                           2 + 20 * random_share(&seed), 0, 0);
        plane_walk w = plane_begin(kind);
        for (int leg = 0; leg < 12; leg++) {
            const plane_at end = to(0, 0, 1.6 * random_share(&seed) - 0.3,
                                    (2 * random_share(&seed) - 1) / kind.beta_c);
            const plane_at start = w.at;
            for (int k = 1; k <= 100; k++) {
                const plane_out old = w.out;
                const plane_at from = w.at;
                const double x = k / 100.0;
                plane_step(&w, (plane_at){.q_n = start.q_n + x * (end.q_n - start.q_n),
                                          .q_t = start.q_t + x * (end.q_t - start.q_t)});
                const double most = hypot(kind.k_n * (w.at.q_n - from.q_n),
                                          kind.k_t * (w.at.q_t - from.q_t) / kind.beta_c);
                assert_true(hypot(w.out.t_n - old.t_n, (w.out.t_t - old.t_t) / kind.beta_c) <=
                            most + 1e-9 * kind.sigma_c);
            }
        }
        onsets += w.onset_step > 0;
        breaks += w.break_step > 0;
        ASSERT_CLOSED(&w, "walk", (double)i);
    }
    assert_true(onsets > 300 && breaks > 100);
}

/* Extrinsic: nothing opens without a jump from where it was, T = T_0 at the onset, also under
 * pressure with friction, and the direction of an opening that goes on in that of T_0 is its. Then
 * |dT| <= (k + softening) |dq|. */
static void extrinsic_onset_is_continuous(void **unused)
{
    uint64_t seed = 13;
    for (int i = 0; i < 3000; i++) {
        const plane_case kind = plane_kind(
            i % 2 ? PLANE_STANDARD : PLANE_PAPER, 0.4 + 2 * random_share(&seed),
            4 + 20 * random_share(&seed), i % 3 ? 0.4 : 0, i / 2 % 2);
        plane_walk w = plane_begin(kind);
        const double t_n = kind.sigma_c * (4 * random_share(&seed) - 2),
                     t_t = kind.sigma_c * 8 * kind.beta_c * (random_share(&seed) - 0.5);
        const plane_at on = kind.onset_mean ? (plane_at){t_n, t_t, 0.1 * MICRON, -0.1 * MICRON}
                                            : (plane_at){0.5 * t_n, 0.5 * t_t, 0.5 * t_n / kind.k_n,
                                                         0.5 * t_t / kind.k_t};
        plane_step(&w, on);
        if (!w.out.cracked) continue;
        const double p = w.memory.peak, friction = t_n < 0 ? -kind.mu_c * t_n : 0;
        const double expected = judged_of((const double[2]){t_n, t_t}, kind.beta_c, kind.mu_c);
        assert_true(fabs(p / expected - 1) < 1e-12);
        assert_true(fabs(w.out.t_n - t_n) < 1e-12 * kind.sigma_c * 10 &&
                    fabs(w.out.t_t - t_t) < 1e-12 * kind.sigma_c * 100);
        /* on along T_0's direction by 1e-4 delta_c: T moves by p 1e-4 of softening, the pressed
         * faces' friction not at all */
        const double delta_c = 2 * kind.energy / p, c = fmax(0, t_n) / p,
                     s = sqrt(fmax(0, 1 - c * c)) * (t_t < 0 ? -1 : 1);
        plane_step(&w, (plane_at){0, 0, on.q_n + 1e-4 * delta_c * c,
                                  on.q_t + 1e-4 * delta_c * s / kind.beta_c});
        const double pull = kind.law == PLANE_PAPER ? c : 1,
                     shear = kind.law == PLANE_PAPER ? fabs(s) : 1;
        const double cohesive_t = t_t - (t_t < 0 ? -friction : friction);
        assert_true(fabs(w.out.t_n - (t_n < 0 ? t_n : pull * p * c * (1 - 1e-4))) < 1e-9 * p);
        assert_true(fabs(w.out.t_t - (t_t < 0 ? -friction : friction) -
                         shear * p * kind.beta_c * s * (1 - 1e-4)) <
                    1e-9 * (p * kind.beta_c + friction));
        assert_true(kind.law == PLANE_PAPER ||
                    fabs(shear * p * kind.beta_c * s - cohesive_t) < 1e-9 * p * kind.beta_c);
    }
}

/* sqrt(T_n^2 + (T_t/beta_c)^2) in tension, (|T_t| - mu_c |T_n|)/beta_c under pressure, of the flux
 * or of the mean. `nitsche` softens at once by what the flux is above its peak. */
static void onset_is_at_the_strength(void **unused)
{
    uint64_t seed = 17;
    for (int i = 0; i < 20000; i++) {
        const plane_case kind = plane_kind((plane_test_law)(i % 3), 0.3 + 3 * random_share(&seed),
                                           4 + 20 * random_share(&seed), i / 3 % 2 ? 0.5 : 0,
                                           i / 6 % 2);
        const double t_n = 300e6 * (random_share(&seed) - 0.5),
                     t_t = 600e6 * (random_share(&seed) - 0.5) * kind.beta_c;
        const double value = judged_of((const double[2]){t_n, t_t}, kind.beta_c, kind.mu_c);
        const double part = random_share(&seed),
                     other = kind.onset_mean
                                 ? 0
                                 : 1; /* the flux: any split of it; the mean: all of it */
        const double turned = kind.onset_mean && i % 5 == 0
                                  ? -0.5 * part
                                  : part; /* so that the flux is below its mean */
        const plane_at at = {.m_n = t_n * (1 - other * part),
                             .m_t = t_t * (1 - other * part),
                             .q_n = t_n * turned / kind.k_n,
                             .q_t = t_t * turned / kind.k_t};
        plane_walk w = plane_begin(kind);
        plane_step(&w, at);
        assert_int_equal(w.out.cracked, value > kind.sigma_c);
        assert_int_equal(w.out.cracks, value > kind.sigma_c);
        if (!w.out.cracked)
            assert_true(w.memory.peak == 0 && w.memory.damage == 0 && w.out.created == 0 &&
                        w.out.rubbed == 0);
        /* the peak: by the flux the strength itself, by the mean the flux less what the mean is
         * above the strength, cut at sqrt(k_n G_c) */
        const double f_n = at.m_n + kind.k_n * at.q_n, f_t = at.m_t + kind.k_t * at.q_t;
        const double flux = f_n >= 0 ? hypot(f_n, f_t / kind.beta_c)
                                     : (fabs(f_t) - kind.mu_c * fabs(f_n)) / kind.beta_c;
        double peak = kind.law != PLANE_NITSCHE ? value
                      : kind.onset_mean         ? fmax(flux - (value - kind.sigma_c), kind.sigma_c)
                                                : kind.sigma_c;
        if (kind.law == PLANE_NITSCHE) peak = fmin(peak, sqrt(kind.k_n * kind.energy));
        if (w.out.cracked) assert_true(fabs(w.memory.peak / peak - 1) < 1e-12);
        const double x = 2 * kind.k_n * kind.energy / peak - peak,
                     damage = fmax(0, flux - peak) / x;
        if (w.out.cracked && kind.law == PLANE_NITSCHE && x > 0.02 * peak) {
            const double factor = flux > peak ? peak * (1 - damage) / flux : 1,
                         friction = copysign(kind.mu_c * fmax(0, -f_n), f_t);
            assert_true(fabs(w.memory.damage - fmin(1, damage)) < 1e-12 * (1 + flux / x));
            if (damage < 1) {
                assert_true(fabs(w.out.t_n - (f_n > 0 ? factor * f_n : f_n)) < 1e-10 * flux);
                assert_true(fabs(w.out.t_t - factor * (f_t - friction) - friction) <
                            1e-10 * flux * kind.beta_c);
            }
        }
        plane_step(&w, at); /* once cracked, never again */
        assert_true(!w.out.cracks && w.out.cracked == (value > kind.sigma_c));
    }
}

/* The mean rises in as many steps as one likes, while the jump stays: the peak is the strength and
 * what the flux has above the mean, and traction and damage at the end are those of any other
 * steps. Along one direction all of it is linear: roundings of sums of up to 1000 steps, 1e-12.
 * Booking nothing as created, the ledger closes. */
static void steps_do_not_decide_the_peak(void **unused)
{
    uint64_t seed = 37;
    int opened = 0;
    for (int i = 0; i < 400; i++) {
        const plane_case kind = plane_kind(PLANE_NITSCHE, 0.4 + 2 * random_share(&seed),
                                           4 + 20 * random_share(&seed), 0, 1);
        const double angle = PI * (random_share(&seed) - 0.5), c = kind.sigma_c * cos(angle),
                     s = kind.sigma_c * kind.beta_c * sin(angle);
        const double beyond = 0.4 * random_share(&seed) - 0.1,
                     last = 1.1 + 0.5 * random_share(&seed);
        const double peak = kind.sigma_c * (1 + fmax(0, beyond));
        double damage = 0;
        for (int steps = 1; steps <= 1000; steps *= 10) {
            plane_walk w = plane_begin(kind);
            plane_step(&w, (plane_at){.q_n = beyond * c / kind.k_n, .q_t = beyond * s / kind.k_t});
            plane_go(&w, (plane_at){last * c, last * s, w.at.q_n, w.at.q_t}, steps);
            assert_true(w.out.cracked && w.created == 0 && fabs(w.memory.peak / peak - 1) < 1e-12);
            if (steps == 1) damage = w.memory.damage;
            assert_true(fabs(w.memory.damage - damage) < 1e-12);
            plane_step(&w, w.at);
            ASSERT_CLOSED(&w, "steps", (double)steps);
        }
        opened += damage > 0;
    }
    assert_true(opened > 300);
}

/* Random loading, unloading, contact and sliding in a box of several delta_c, by legs of 40 steps,
 * and back to where it began: the ledger closes, D only grows; every step dissipates at least
 * nothing: G_c dD >= 0, and what friction takes, beyond the quadrature's error; the work over a
 * cycle is not negative. At equal jumps the energy W(q, D) + G_c D never falls as D grows (its
 * derivative is G_c (1 - (delta/(D delta_c))^2) >= 0), for nitsche without m and for the standard
 * law. The paper's law and friction have a state beside D (the direction, the faces' slip), so that
 * a cycle may give back what was stored when it began, no more; begun at nothing stored, it gives
 * nothing. */
static void no_cycle_gains_energy(void **unused)
{
    uint64_t seed = 23;
    long gains = 0, breaks = 0;
    for (int i = 0; i < 10000; i++) {
        const plane_test_law law = (plane_test_law)(i % 3);
        const plane_case kind = plane_kind(law, 0.5 + 1.5 * random_share(&seed),
                                           3 + 20 * random_share(&seed), i / 3 % 2 ? 0.3 : 0, 0);
        plane_walk w = plane_begin(kind);
        const double box = pow(10, 1.2 * random_share(&seed) - 0.6);
        plane_at start = w.at;
        double work = 0, stored = 0, slack = 0;
        for (int leg = 0; leg < 10; leg++) {
            const double before = w.rubbed, before_slack = w.slack;
            plane_at next = to(0, 0, box * (2 * random_share(&seed) - 1) * (leg % 3 == 1 ? 0.1 : 1),
                               2 * box * (2 * random_share(&seed) - 1));
            if (leg == 9) next = start;
            plane_go(&w, next, 40);
            assert_true(w.rubbed - before >= -(w.slack - before_slack) - 1e-12 * kind.energy);
            if (leg == 2 && i % 4) { /* some begin at the virgin state */
                start = w.at;
                work = w.work + (law == PLANE_NITSCHE ? 0 : w.created);
                stored = plane_held(&w);
                slack = w.slack;
            }
        }
        plane_step(&w, w.at);
        ASSERT_CLOSED(&w, "cycle", (double)i);
        const double done = w.work + (law == PLANE_NITSCHE ? 0 : w.created) - work;
        const bool plain = kind.mu_c == 0 && law != PLANE_PAPER;
        assert_true(done >=
                    (plain ? 0 : -stored) - (w.slack - slack) - 1e-9 * (stored + kind.energy));
        gains += done > 1e-3 * kind.energy;
        breaks += w.break_step > 0;
    }
    assert_true(gains > 5000 && breaks > 2000);
}

/* Peaks above sqrt(k_n G_c) are cut: at the onset the traction falls to what the cut law carries,
 * and the energy that goes with it is booked as created (less than nothing). Without that the
 * ledger would lack up to (S' - p)^2/(2 k). */
static void cut_peaks_are_booked(void **unused)
{
    uint64_t seed = 29;
    long cut = 0;
    for (int i = 0; i < 2000; i++) {
        plane_case kind = plane_kind(PLANE_NITSCHE, 0.4 + 2 * random_share(&seed),
                                     0.3 + 4 * random_share(&seed), i % 3 ? 0 : 0.5, i / 3 % 2);
        const double angle = 2 * PI * random_share(&seed), most = sqrt(kind.k_n * kind.energy),
                     m = most * 3 * random_share(&seed);
        plane_walk w = plane_begin(kind);
        plane_go(&w, (plane_at){.q_n = m * cos(angle) / kind.k_n, .q_t = m * sin(angle) / kind.k_t},
                 400);
        plane_go(&w,
                 (plane_at){m * cos(angle), kind.beta_c * m * sin(angle), m * cos(angle) / kind.k_n,
                            m * sin(angle) / kind.k_t},
                 400);
        plane_go(&w, to(0, 0, 8 * cos(angle), 8 * sin(angle) / kind.beta_c), 2000);
        plane_step(&w, w.at);
        ASSERT_CLOSED(&w, "angle", angle);
        if (!w.out.cracked) continue;
        assert_true(w.memory.peak <= most * (1 + 1e-15) && w.memory.damage <= 1);
        cut += w.memory.peak > most * (1 - 1e-12);
    }
    assert_true(cut > 500);
}

/* Nothing, next to nothing and far too much: everything finite, D in [0, 1]. */
static void extremes_stay_finite(void **unused)
{
    const double strengths[] = {1e-6, 1, 1e8, 1e15, 1e30},
                 values[] = {0, -0.0, 1e-30, -1e-30, 1, -1, 1e4, -1e4};
    for (int i = 0; i < 3 * 5 * 2 * 2 * 3; i++) {
        const double couplings[] = {0.01, 1, 100};
        plane_case kind = plane_kind((plane_test_law)(i % 3), couplings[i / 60], 5,
                                     i / 30 % 2 ? 0.3 : 0, i / 15 % 2);
        kind.sigma_c = strengths[i / 3 % 5];
        plane_walk w = plane_begin(kind);
        assert_true(w.out.t_n == 0 && w.out.t_t == 0 && w.out.stored == 0 && w.out.flux == 0 &&
                    !w.out.cracked);
        for (int k = 0; k < 8 * 8 * 8 * 8; k++) {
            const double big = 1e-6 * 100, stress = 1e8;
            plane_step(&w, (plane_at){stress * values[k % 8], stress * values[k / 64 % 8],
                                      big * values[k / 8 % 8], big * values[k / 512 % 8]});
            const plane_out *o = &w.out;
            const double sum = o->t_n + o->t_t + o->s_n + o->s_t + o->flux + o->stored +
                               o->created + o->rubbed + o->dissipated;
            assert_true(isfinite(sum) && w.memory.damage >= 0 && w.memory.damage <= 1);
            assert_true(isfinite(w.memory.slip) && isfinite(w.memory.rub) &&
                        isfinite(w.memory.peak));
        }
    }
}

/* ---- 4 and 8 lanes ---- */

FRACAS_KERNEL_TABLE(plane_unit, plane_call);

/* Calls all eight points with one unit. */
static void call_eight(fracas_isa isa, int lanes, const plane_case *const *kind, const plane_at *in,
                       plane_memory *state, plane_out *out)
{
    for (int first = 0; first < 8; first += lanes)
        plane_call[isa][lanes](kind + first, in + first, state + first, out + first);
}

/* Bit for bit, each lane of a strength, a path and a state of its own. */
static void lanes_do_what_one_does(void **unused)
{
    uint64_t seed = 31;
    long cracked = 0, broken = 0;
    for (int i = 0; i < 3 * 2 * 2 * 20; i++) {
        plane_case kind[8];
        const plane_case *kinds[8];
        plane_memory one[8] = {{0}}, wide[FRACAS_NISAS][FRACAS_LANES_MAX + 1][8] = {{{{0}}}};
        const double coupling = 0.5 + 1.5 * random_share(&seed);
        for (int l = 0; l < 8; l++) {
            kind[l] = plane_kind((plane_test_law)(i % 3), coupling, 4, i / 3 % 2 ? 0.3 : 0,
                                 i / 6 % 2);
            kind[l].sigma_c *= 0.8 + 0.4 * random_share(&seed);
            kinds[l] = &kind[l];
        }
        for (int k = 0; k < 300; k++) {
            plane_at in[8];
            plane_out a[8], b[8];
            memset(a, 0, sizeof a); /* padding too */
            for (int l = 0; l < 8; l++) {
                in[l] = to(150e6 * (2 * random_share(&seed) - 1),
                           150e6 * (2 * random_share(&seed) - 1),
                           2.4 * random_share(&seed) * k / 300 - 0.5,
                           (3 * random_share(&seed) - 1.5) * k / 300);
                plane_call_baseline_1(kinds + l, in + l, one + l, a + l);
                cracked += a[l].cracks;
                broken += a[l].breaks;
            }
            for (fracas_isa isa = FRACAS_ISA_BASELINE; isa < FRACAS_NISAS; isa++)
                for (int lanes = 1; lanes <= FRACAS_LANES_MAX; lanes++) {
                    fracas_isa had;
                    if (!plane_call[isa][lanes] || fracas_isa_choose(isa, &had)) continue;
                    memset(b, 0, sizeof b);
                    call_eight(isa, lanes, kinds, in, wide[isa][lanes], b);
                    assert_memory_equal(a, b, sizeof a);
                    assert_memory_equal(one, wide[isa][lanes], sizeof one);
                }
        }
    }
    assert_true(cracked > 1000 && broken > 200);
}

TESTS(the_ledger_closes_on_every_path, the_ledger_closes_with_a_critical_opening,
      a_full_break_takes_the_fracture_energy, traction_follows_separation, traction_is_continuous,
      extrinsic_onset_is_continuous, onset_is_at_the_strength, steps_do_not_decide_the_peak,
      no_cycle_gains_energy, cut_peaks_are_booked, extremes_stay_finite, lanes_do_what_one_does)
