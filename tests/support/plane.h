/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A point of an interface on its own, led along a path of jumps and mean tractions, with its
 * energies. */
#ifndef FRACAS_TESTS_SUPPORT_PLANE_H
#define FRACAS_TESTS_SUPPORT_PLANE_H

#include "tests/support/plane_point.h"
#include "tests/support/test.h"

static const double MICRON = 1e-6; /* delta_c of plane_kind at its strength */

/* Where a walk is, where it was, and what has been done. The ledger of a walk is
 *   work of T on q and of s on m = flux + stored + dissipated + rubbed - created
 * with the work by the trapezoid rule, whose error in a step of length h is at most h/4 times the
 * second differences of the integrand at the step's two ends: a corner of the integrand inside a
 * step costs at most h/8 of what they sum to, a smooth curve h/12, a jump J, h J/2 of the 2 J that
 * they sum to. `slack` collects twice that, as a jump and a corner of one step may hide part of
 * each other; as the second difference at the end of a step needs the step that follows, a residual
 * is judged one step late. Roundings beside: 1e-14 of the energies' sum for each step. */
typedef struct {
    plane_case kind;
    plane_memory memory;
    plane_at at;
    plane_out out;
    double work, dissipated, rubbed, created, slack, residual;
    double t_before[2], s_before[2], rub_before, share, step_before;
    long steps, judged, onset_step, break_step;
    double excess; /* largest |residual|/allowed */
} plane_walk;

/* k_n = K max(1, 1/beta_c^2), k_t = beta_c^2 k_n; sigma_c 100 MPa, G_c 50 J/m2: delta_c 1 um. */
static inline plane_case plane_kind(plane_test_law law, double beta_c, double ratio, double mu_c,
                                    int onset_mean)
{
    const double spring = ratio * 100e6 / 1e-6, k_n = spring * fmax(1, 1 / (beta_c * beta_c));
    return (plane_case){.law = law,
                        .k_n = k_n,
                        .k_t = beta_c * beta_c * k_n,
                        .sigma_c = 100e6,
                        .beta_c = beta_c,
                        .mu_c = mu_c,
                        .energy = 50,
                        .onset_mean = onset_mean};
}

static inline double plane_held(const plane_walk *w)
{
    return w->out.flux + w->out.stored;
}

/* G_c of the peak it has. */
static inline double plane_fracture(const plane_walk *w)
{
    return w->kind.energy + 0.5 * w->kind.opening * w->memory.peak;
}

/* What the paper's law dissipates of G_c dD: T.d = p (1 - D) d_e (c u^2 + s v^2), where (u, v) is
 * the direction of the opening and (c, s) that of the traction at onset, so that with the secant's
 * energy T.d/2 the dissipation is (c u^2 + s v^2) G_c dD. */
static inline double plane_share(const plane_walk *w)
{
    const plane_memory *x = &w->memory;
    const double d_n = fmax(0, w->at.q_n - x->q_n), d_t = w->kind.beta_c * (w->at.q_t - x->q_t),
                 square = d_n * d_n + d_t * d_t;
    if (w->kind.law != PLANE_PAPER || !(square > 0) || !w->out.cracked) return 1;
    return (x->t_n * d_n * d_n + fabs(x->t_t) / w->kind.beta_c * d_t * d_t) / (x->peak * square);
}

static inline plane_walk plane_begin(plane_case kind)
{
    plane_walk w = {.kind = kind, .share = 1, .onset_step = -1, .break_step = -1};
    const plane_case *kinds[] = {&kind};
    plane_call_baseline_1(kinds, &w.at, &w.memory, &w.out);
    return w;
}

/* One step, to `to`. */
static inline void plane_step(plane_walk *w, plane_at to)
{
    const plane_out old = w->out;
    const plane_at from = w->at;
    const plane_memory was = w->memory;
    const plane_case *kinds[] = {&w->kind};
    plane_call_baseline_1(kinds, &to, &w->memory, &w->out);
    w->at = to;
    const plane_out *now = &w->out;
    const double dq_n = to.q_n - from.q_n, dq_t = to.q_t - from.q_t, dm_n = to.m_n - from.m_n,
                 dm_t = to.m_t - from.m_t;
    w->work += 0.5 * ((old.t_n + now->t_n) * dq_n + (old.t_t + now->t_t) * dq_t);
    w->work += 0.5 * ((old.s_n + now->s_n) * dm_n + (old.s_t + now->s_t) * dm_t);
    const double share = plane_share(w), grown = w->memory.damage - was.damage;
    const double mean_share = was.damage > 0 ? 0.5 * (share + w->share) : share;
    w->dissipated += plane_fracture(w) * grown * mean_share;
    w->created += now->created;
    w->rubbed += now->rubbed;
    /* second differences, each with the longer of its two steps */
    const double t[2] = {now->t_n - old.t_n, now->t_t - old.t_t},
                 s[2] = {now->s_n - old.s_n, now->s_t - old.s_t};
    const double rub = now->cracks ? 0 : w->memory.rub - was.rub, path = hypot(dq_n, dq_t);
    const double slip = now->cracks ? 0 : fabs(w->memory.slip - was.slip); /* an onset sets it */
    const double longer = fmax(path, w->step_before);
    w->slack += 0.5 * longer * hypot(t[0] - w->t_before[0], t[1] - w->t_before[1]);
    w->slack += 0.5 * hypot(dm_n, dm_t) * hypot(s[0] - w->s_before[0], s[1] - w->s_before[1]);
    w->slack += 0.5 * (longer + slip) * fabs(rub - w->rub_before);
    w->slack += was.damage > 0 ? 0.5 * plane_fracture(w) * fabs(grown * (share - w->share)) : 0;
    w->step_before = path;
    w->rub_before = rub;
    memcpy(w->t_before, t, sizeof t);
    memcpy(w->s_before, s, sizeof s);
    w->share = share;
    w->steps++;
    if (now->cracks) w->onset_step = w->steps;
    if (now->breaks) w->break_step = w->steps;
    const double scale = fabs(w->work) + fabs(now->flux) + now->stored + w->dissipated + w->rubbed +
                         fabs(w->created);
    const double allowed = w->slack + 1e-14 * (double)(w->steps + 10) * scale;
    if (w->steps > 1) w->excess = fmax(w->excess, fabs(w->residual) / allowed);
    w->residual = w->work - (now->flux + now->stored + w->dissipated + w->rubbed - w->created);
    w->judged++;
    if (!isfinite(w->residual) || !isfinite(now->t_n) || !isfinite(now->t_t) || grown < 0 ||
        !(fabs(now->dissipated - plane_fracture(w) * w->memory.damage) <=
          1e-14 * plane_fracture(w)))
        w->excess = INFINITY;
    /* D reaches 1 where the opening is that of the break, from which its time is found; 1e-9:
     * rounding of a softening that is 1e5 times as long as the flux's part */
    if ((now->breaks && !(now->opening > 1 - 1e-9)) ||
        (now->cracked && w->memory.damage < 1 && !(now->opening < 1 + 1e-9)))
        w->excess = INFINITY;
}

/* Straight on, in `steps` steps. */
static inline void plane_go(plane_walk *w, plane_at to, int steps)
{
    const plane_at from = w->at;
    for (int i = 1; i <= steps; i++) {
        const double x = (double)i / steps, y = 1 - x;
        plane_step(w, i == steps
                          ? to
                          : (plane_at){y * from.m_n + x * to.m_n, y * from.m_t + x * to.m_t,
                                       y * from.q_n + x * to.q_n, y * from.q_t + x * to.q_t});
    }
}

/* Means [Pa], and jumps by delta_c. */
static inline plane_at to(double m_n, double m_t, double q_n, double q_t)
{
    return (plane_at){m_n, m_t, q_n * MICRON, q_t * MICRON};
}

/* The ledger has closed at every step. */
#define ASSERT_CLOSED(w, where, number)                                                            \
    do {                                                                                           \
        if (!((w)->excess <= 1))                                                                   \
            fail_msg("%s %g: law %d beta_c %g K %g mu_c %g onset_mean %d: residual %g of what is " \
                     "allowed, %g J/m2 with slack %g",                                             \
                     where, number, (int)(w)->kind.law, (w)->kind.beta_c, (w)->kind.k_n,           \
                     (w)->kind.mu_c, (w)->kind.onset_mean, (w)->excess, (w)->residual,             \
                     (w)->slack);                                                                  \
    } while (0)

#endif
