/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact and friction of a point in shear under pressure: faces that stick at the onset, hold
 * friction beside the law, rub once broken. Theory: docs/theory/cohesive.md. */
#include "tests/support/plane.h"

/* The mean pulls the point past its strength while the flux presses its faces together and shears
 * them by less than friction holds: they stick from the start, T is the flux's, nothing opens.
 * Exact, but for the rounding of m + k q. */
static void pressed_faces_stick_at_the_onset(void **unused)
{
    for (int i = 0; i < 20; i++) {
        const plane_case kind = plane_kind(PLANE_NITSCHE, 1, 10, 1.2, 1);
        const double m_n = 1.5 * kind.sigma_c, t_n = -5 * kind.sigma_c,
                     t_t = (i - 10) * 0.5 * kind.sigma_c;
        plane_walk w = plane_begin(kind);
        plane_step(&w,
                   (plane_at){.m_n = m_n, .q_n = (t_n - m_n) / kind.k_n, .q_t = t_t / kind.k_t});
        assert_true(w.out.cracks && w.memory.damage == 0 &&
                    fabs(w.out.rubbed) <= 1e-15 * t_t * t_t / kind.k_t);
        assert_true(fabs(w.out.t_n - t_n) < 1e-14 * 8 * kind.sigma_c &&
                    fabs(w.out.t_t - t_t) < 1e-14 * 8 * kind.sigma_c);
    }
}

/* The same with beta_c = 0.6 under a pressure of sigma_c: faces hold up to mu_c sigma_c + beta_c p,
 * p = sigma_c, and open beyond. */
static void pressed_faces_hold_friction_and_the_peak(void **unused)
{
    static const double held[] = {1.7, 1.9, -1.7, -1.9};
    for (int i = 0; i < 4; i++) {
        const plane_case kind = plane_kind(PLANE_NITSCHE, 0.6, 10, 1.2, 1);
        const double m_n = 1.5 * kind.sigma_c, t_n = -kind.sigma_c;
        plane_walk w = plane_begin(kind);
        plane_step(&w, (plane_at){.m_n = m_n, .q_n = (t_n - m_n) / kind.k_n});
        assert_true(w.out.cracks && w.memory.damage == 0);
        plane_at next = w.at;
        next.q_t = held[i] * kind.sigma_c / kind.k_t;
        plane_step(&w, next);
        assert_true((w.memory.damage > 0) == (fabs(held[i]) > 1.8));
    }
}

/* Broken faces: T_n = k_n min(0, q_n), whatever m; friction that sticks up to mu_c |T_n|, T_t = k_t
 * (q_t - slip), then slides. */
static void broken_faces_touch_and_rub(void **unused)
{
    for (int i = 0; i < 3 * 2; i++) {
        const double mu = i / 3 ? 0.4 : 0;
        const plane_case kind = plane_kind((plane_test_law)(i % 3), 0.8, 10, mu, 0);
        plane_walk w = plane_begin(kind);
        plane_go(&w, to(0, 0, 5, 0), 1000);
        assert_true(w.memory.damage == 1 && w.out.t_n == 0 && w.out.t_t == 0);
        const double start = kind.law == PLANE_NITSCHE ? 0 : w.memory.q_n, k_n = kind.k_n,
                     k_t = kind.k_t;
        plane_go(&w, (plane_at){50e6, -70e6, start, 0}, 100);
        plane_go(&w, (plane_at){50e6, -70e6, start - 0.1 * MICRON, 0}, 100);
        const double push = -0.1 * MICRON * k_n;
        assert_true(fabs(w.out.t_n / push - 1) < 1e-9 && fabs(w.out.t_t) < 1e-9 * fabs(push));
        assert_true(w.out.s_n == 0 && w.out.s_t == 0 && w.out.flux == 0);
        assert_true(fabs(w.out.stored / (0.5 * push * push / k_n) - 1) < 1e-9);
        const double reach = mu * fabs(push) / k_t, at = w.at.q_n, rubbed = w.rubbed;
        plane_go(&w, (plane_at){0, 0, at, 0.99 * reach}, 500); /* sticks */
        assert_true(fabs(w.out.t_t - k_t * 0.99 * reach) <= 1e-9 * fabs(push) &&
                    fabs(w.rubbed - rubbed) < 1e-9 * kind.energy);
        plane_go(&w, (plane_at){0, 0, at, reach + 0.3 * MICRON}, 500); /* slides */
        assert_true(fabs(w.out.t_t - mu * fabs(push)) < 1e-9 * fabs(push));
        assert_true(fabs(w.rubbed - rubbed - mu * fabs(push) * 0.3 * MICRON) <
                    1e-2 * mu * fabs(push) * MICRON + 1e-12);
        plane_go(&w, (plane_at){0, 0, at, 0.3 * MICRON - 0.5 * reach},
                 500); /* back: sticks at minus a half of the limit */
        assert_true(fabs(w.out.t_t + 0.5 * mu * fabs(push)) < 1e-9 * fabs(push));
        plane_go(&w, (plane_at){0, 0, start + 0.01 * MICRON, 0.1 * MICRON}, 500);
        assert_true(w.out.t_n == 0 && w.out.t_t == 0 && w.out.stored == 0);
        ASSERT_CLOSED(&w, "friction", mu);
    }
}

/* A point that breaks in shear under pressure has T_n = k_n min(0, q_n) and |F| <= mu_c |T_n| from
 * that step on, though until then the mean pressed it too. */
static void friction_obeys_the_pressure_at_the_break(void **unused)
{
    uint64_t seed = 19;
    int breaks = 0;
    for (int i = 0; i < 300; i++) {
        const plane_case kind = plane_kind(PLANE_NITSCHE, 0.5 + random_share(&seed),
                                           3 + 10 * random_share(&seed), 0.2 + random_share(&seed),
                                           i % 2);
        plane_walk w = plane_begin(kind);
        const double m_n = -200e6 * random_share(&seed), q_n = 0.1 * (random_share(&seed) - 0.6);
        plane_go(&w, to(m_n, 0, q_n, 0), 100);
        const double m_t = 300e6 * (2 * random_share(&seed) - 1);
        for (int k = 0; k < 4000; k++) {
            plane_step(&w, to(m_n, m_t * k / 4000, q_n, 12.0 * k / 4000));
            if (w.memory.damage < 1) continue;
            assert_true(fabs(w.out.t_n - kind.k_n * fmin(0, q_n * MICRON)) < 1e-9 * kind.sigma_c);
            assert_true(fabs(w.out.t_t) <= kind.mu_c * fabs(w.out.t_n) + 1e-9 * kind.sigma_c);
        }
        ASSERT_CLOSED(&w, "m_n", m_n);
        breaks += w.break_step > 0;
    }
    assert_true(breaks > 150);
}

TESTS(pressed_faces_stick_at_the_onset, pressed_faces_hold_friction_and_the_peak,
      broken_faces_touch_and_rub, friction_obeys_the_pressure_at_the_break)
