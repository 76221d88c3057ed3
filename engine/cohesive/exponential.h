/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `exponential`: exponential softening, shifted so that the traction is 0 at the break; the
 * opening in series with the discontinuous-Galerkin flux (docs/theory/cohesive.md).
 *
 * e = cut, V = -log e, D = delta_max/delta_c, v = V D, p the strength or peak, N = 1 - e - e V:
 *   envelope  p t,  t = (exp(-v) - e)/(1 - e)                                       (cohesive.30)
 *   delta_c = V l,  l = G_c (1 - e)/(N p)                                           (cohesive.31)
 *   dissipated  G_c f,  f = (1 - exp(-v) - v (exp(-v) + e)/2)/N                     (cohesive.32)
 * In series with a stiffness k, y = k l, r = p/(1 - e):
 *   loading, S > p t + y v:  v = min(V, the root of y v + r (exp(-v) - e) = S)      (cohesive.33)
 *   T = p t loading, S p t/(p t + y v) on the secant                                (cohesive.34)
 */
#if defined FRACAS_LAW
FRACAS_LAW(exponential, FLUX, FLUX, YES, YES)
#else

/* Its own numbers: e; for the kernels V, 1/(1 - e), 1/N. */
enum { EXPONENTIAL_CUT, EXPONENTIAL_END, EXPONENTIAL_FALL, EXPONENTIAL_PER_AREA };

/* l by G_c/p, and delta_c by 2 G_c/p  (cohesive.31) */
static inline double exponential_length(const double *own)
{
    return own[EXPONENTIAL_PER_AREA] * (1 - own[EXPONENTIAL_CUT]);
}
static inline double exponential_opening(const double *own)
{
    return 0.5 * exponential_length(own) * own[EXPONENTIAL_END];
}

#if defined FRACAS_LAW_TABLES
#include "base/elementary.h"

static const fracas_param exponential_params[] = {
    FRACAS_LAW_NUMBER("cut", own[EXPONENTIAL_CUT], "1", 0.01, 1e-6, 0.5, false, 0,
                      "where the exponential ends, over its start; it is shifted down by as much, "
                      "so that the traction is 0 at the break"),
    FRACAS_LAW_REAL(fracture_energy, "J/m2", FRACAS_REQUIRED, 0, INFINITY, true,
                    FRACAS_GROUP_CHAINS, "fracture energy G_c"),
    FRACAS_LAW_REAL(beta, "1", 4, 1, 1e4, true, FRACAS_GROUP_CHAINS,
                    "interface stiffness K = beta E/h; above 1 for a positive operator, 1.5 or "
                    "more in practice"),
    FRACAS_SURFACE_SHAPED("strength delta_c (1/log(1/cut) - cut/(1 - cut))"),
};

static double exponential_contact(const fracas_cohesive *cohesive)
{
    return cohesive->beta;
}

static void exponential_numbers(const fracas_cohesive *cohesive, double own[FRACAS_LAW_OWN])
{
    const double end = -fracas_log(cohesive->own[EXPONENTIAL_CUT]);
    const double e = fracas_exp(-end); /* as kernels have it at D = 1: t is exactly 0 there */
    own[EXPONENTIAL_CUT] = e;
    own[EXPONENTIAL_END] = end;
    own[EXPONENTIAL_FALL] = 1 / (1 - e);
    own[EXPONENTIAL_PER_AREA] = 1 / (1 - e - e * end);
}

static void exponential_own(const fracas_spec *spec, double own[FRACAS_LAW_OWN])
{
    exponential_numbers(&spec->cohesive, own);
}

static double exponential_fullness(const fracas_cohesive *cohesive)
{
    double own[FRACAS_LAW_OWN];
    exponential_numbers(cohesive, own);
    return 1 / (exponential_length(own) * own[EXPONENTIAL_END]);
}

/* sigma_c/((1 - e) l), over sigma_c^2/(2 G_c) */
static double exponential_steepest(const fracas_cohesive *cohesive)
{
    double own[FRACAS_LAW_OWN];
    exponential_numbers(cohesive, own);
    return 2 * own[EXPONENTIAL_FALL] / exponential_length(own);
}

/* y [Pa] */
static double exponential_constant(const fracas_cohesive *cohesive, double stiffness,
                                   double strength)
{
    double own[FRACAS_LAW_OWN];
    exponential_numbers(cohesive, own);
    return stiffness * cohesive->fracture_energy * exponential_length(own) / strength;
}

const fracas_law fracas_law_exponential = {
    FRACAS_LAW_HEAD(exponential, "exponential",
                    "exponential softening, steep at first and with a long tail, the opening in "
                    "series with the discontinuous-Galerkin flux"),
    .flux = true,
    .fields = {SURFACE_POINT_FIELDS, SURFACE_POINT_FIELDS + 2},
    .fullness = exponential_fullness,
    .steepest = exponential_steepest,
    .own = exponential_own,
    .contact = exponential_contact,
    .constant = exponential_constant};

#else
#include "base/elementary_lanes.h"
#include "engine/cohesive/series.h"

/* v */
LANES_FUNCTION vd exponential_place(const double *own, vd damage)
{
    return damage * lanes_set(own[EXPONENTIAL_END]);
}

/* exp(-v) */
LANES_FUNCTION vd exponential_fallen(const double *own, vd damage)
{
    return lanes_exp(lanes_set(0.0) - exponential_place(own, damage));
}

/* t, exactly 0 at D = 1; `x` is exp(-v)  (cohesive.30) */
LANES_FUNCTION vd exponential_left(const double *own, vd x)
{
    return lanes_max(lanes_set(0.0),
                     (x - lanes_set(own[EXPONENTIAL_CUT])) * lanes_set(own[EXPONENTIAL_FALL]));
}

/* f, exactly 1 at D = 1. Below v = 7/8, where its terms cancel, N f = v ((1 - e)/2 + v^2 sum) with
 * the sum of (-1)^n (n - 2)/(2 n!) v^(n - 3), n = 3, 4, ..., to 1e-17  (cohesive.32) */
LANES_FUNCTION vd exponential_spent(const double *own, vd damage, vd x)
{
    static const double series[16] = {-1. / 12,
                                      2. / 48,
                                      -3. / 240,
                                      4. / 1440,
                                      -5. / 10080,
                                      6. / 80640,
                                      -7. / 725760,
                                      8. / 7257600,
                                      -9. / 79833600,
                                      10. / 958003200,
                                      -11. / 12454041600,
                                      12. / 174356582400,
                                      -13. / 2615348736e3,
                                      14. / 41845579776e3,
                                      -15. / 711374856192e3,
                                      16. / 12804747411456e3};
    const vd one = lanes_set(1.0), half = lanes_set(0.5), e = lanes_set(own[EXPONENTIAL_CUT]);
    const vd v = exponential_place(own, damage), v2 = v * v, v4 = v2 * v2;
    const vd sum = lanes_poly8(series, v) + (v4 * v4) * lanes_poly8(series + 8, v);
    const vd near = v * (half * (one - e) + v2 * sum), far = (one - x) - half * (v * (x + e));
    const vd area = lanes_select(lanes_lt(v, lanes_set(0.875)), near, far);
    return lanes_select(lanes_le(one, damage), one,
                        lanes_min(one, area * lanes_set(own[EXPONENTIAL_PER_AREA])));
}

typedef struct {
    vmask loading;  /* D grows */
    vd damage, x;   /* D, exp(-v) */
    vd left;        /* t */
    vd ratio;       /* T/S where D does not grow */
    vd limit, held; /* S beyond which it grows, T there [Pa] */
} exponential_step;

/* The root of h(v) = v + r/y (exp(-v) - e) - S/y, of S above the `limit`, at most V.
 * h is convex and grows, for r < y (cohesive.7). The tangent at the v before, left of the root,
 * leads right of it. Newton's steps from there only fall, each at least halving the distance. A
 * lane stops where its next would not fall, and stays there, whatever other lanes need. */
LANES_FUNCTION vd exponential_root(const double *own, vd trial, vd p, vd y,
                                   const exponential_step *s)
{
    enum { STEPS = 40 };
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), last = lanes_set(own[EXPONENTIAL_END]),
             r = p * lanes_set(own[EXPONENTIAL_FALL]), steep = r / y,
             goal = trial / y + steep * lanes_set(own[EXPONENTIAL_CUT]),
             least = exponential_place(own, s->damage);
    vd v = least + (trial - s->limit) / lanes_max(zero, y - r * s->x);
    v = lanes_min(last, v);
    for (int i = 0; i < STEPS; i++) {
        const vd fall = steep * lanes_exp(zero - v);
        const vd next = lanes_max(least, v - ((v - goal) + fall) / (one - fall));
        const vmask moves = lanes_and(s->loading, lanes_lt(next, v));
        if (!lanes_any(moves)) break;
        v = lanes_select(moves, next, v);
    }
    return v;
}

/* D of a trial S [Pa], from that before and its exp(-v)  (cohesive.33), (cohesive.34) */
LANES_FUNCTION exponential_step exponential_load(const double *own, vd trial, vd p, vd y, vd damage,
                                                 vd x)
{
    const vd one = lanes_set(1.0), v = exponential_place(own, damage);
    exponential_step s = {.damage = damage, .x = x, .left = exponential_left(own, x)};
    s.held = p * s.left;
    s.limit = s.held + y * v;
    s.ratio = s.held / s.limit;
    s.loading = lanes_and(lanes_lt(s.limit, trial), lanes_lt(damage, one));
    if (lanes_any(s.loading)) {
        const vd root = exponential_root(own, trial, p, y, &s) / lanes_set(own[EXPONENTIAL_END]);
        /* D never falls, by rounding neither */
        s.damage = lanes_select(s.loading, lanes_max(damage, lanes_min(one, root)), damage);
        s.x = exponential_fallen(own, s.damage);
        s.left = exponential_left(own, s.x);
    }
    return s;
}

/* ---- chains ---- */

LANES_FUNCTION line_result line_exponential(const line_input *in)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), p = in->sigma_c, y = in->constant;
    const vmask broken = lanes_le(one, in->damage);
    const vd trial = in->stiffness * in->jump + lanes_select(broken, zero, in->mean);
    const exponential_step s = exponential_load(in->own, trial, p, y, in->damage,
                                                exponential_fallen(in->own, in->damage));
    const vd tension = lanes_select(s.loading, p * s.left, trial * s.ratio);
    const vd traction = lanes_select(lanes_lt(zero, trial), tension, trial);
    const vd slip = lanes_select(lanes_le(one, s.damage), zero,
                                 (traction - in->mean) * in->compliance);
    return (line_result){.traction = traction,
                         .slip = slip,
                         .damage = s.damage,
                         .dissipated = exponential_spent(in->own, s.damage, s.x),
                         .past_onset = trial - p,
                         .softening = y * lanes_set(in->own[EXPONENTIAL_END]) - p,
                         .trial = trial,
                         .secant = s.ratio,
                         .limit = s.limit,
                         .held = s.held};
}

/* ---- surfaces (engine/cohesive/series.h) ---- */

/* The law at one point; `state` is brought up to date. */
LANES_FUNCTION plane_result plane_exponential(const plane_interface *at, const plane_input *in,
                                              int friction, series_state *state)
{
    const double *own = at->own;
    const vd half = lanes_set(0.5), before = state->damage, was = exponential_fallen(own, before);
    const double length = exponential_length(own), steepest = 2 * own[EXPONENTIAL_FALL] / length;
    const series_trial t = series_begin(at, in, friction, steepest, exponential_left(own, was),
                                        before * lanes_set(exponential_opening(own)), state);
    const vd y = t.energy * lanes_set(length) * at->k_n / t.p;
    exponential_step s = exponential_load(own, t.effective, t.p, y, before, was);
    if (friction) {
        s.damage = lanes_select(t.rub.sticks, before, s.damage);
        s.x = lanes_select(t.rub.sticks, was, s.x);
    }
    series_softening it = {.damage = s.damage, .factor = s.ratio, .midway = s.ratio};
    const vd spent = exponential_spent(own, s.damage, s.x);
    it.dissipated = t.energy * spent;
    it.spent = lanes_set(0.0);
    if (lanes_any(s.loading)) {
        const vd loaded = t.p / t.effective,
                 midway = exponential_fallen(own, half * (before + s.damage));
        it.factor = lanes_select(s.loading, loaded * exponential_left(own, s.x), s.ratio);
        it.midway = lanes_select(s.loading, loaded * exponential_left(own, midway), s.ratio);
        it.spent = t.energy * (spent - exponential_spent(own, before, was));
    }
    return series_finish(at, in, friction, &t, &it, state);
}

LANES_FUNCTION plane_result plane_at_exponential(const plane_interface *at, const plane_input *in,
                                                 double *point)
{
    series_state state = series_load(at, point);
    const plane_result r = plane_exponential(at, in, at->friction, &state);
    series_store(at, &state, point);
    return r;
}

LANES_FUNCTION vd plane_opening_exponential(const plane_interface *at, const plane_input *in,
                                            const double *point)
{
    const plane_traction flux = plane_flux(at, in); /* the law carries it less friction */
    return lanes_sqrt(plane_onset(at, flux.n, flux.t)) * at->softness_n /
           (plane_critical_opening(at, lanes_load(point + SURFACE_PEAK * LANES)) *
            lanes_set(exponential_opening(at->own)));
}
#endif
#endif
