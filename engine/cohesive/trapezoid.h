/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `trapezoid`: the strength is held up to a share of the critical opening, then softens
 * linearly; the opening in series with the discontinuous-Galerkin flux (docs/theory/cohesive.md).
 *
 * a = plateau, D = delta_max/delta_c, delta_c = 2 G_c/((1 + a) p), p the strength or peak:
 *   envelope  p t,  t = min(1, (1 - D)/(1 - a))                                     (cohesive.26)
 *   dissipated  G_c f,  f = max(D/(1 + a), (D - a^2)/(1 - a^2))                     (cohesive.27)
 * In series with a stiffness k, y = k delta_c, r = p/(1 - a):
 *   loading, S > p t + D y:  D = min(1, (S - p)/y) up to S = p + a y,
 *                            min(1, (S - r)/(y - r)) beyond                         (cohesive.28)
 *   T = p t loading, S p t/(p t + D y) on the secant                                (cohesive.29)
 */
#if defined FRACAS_LAW
FRACAS_LAW(trapezoid, FLUX, FLUX, YES, YES)
#else

/* Its own numbers: a; for the kernels 1/(1 - a), 1/(1 + a), 1 - a^2. */
enum { TRAPEZOID_PLATEAU, TRAPEZOID_FALL, TRAPEZOID_FULL, TRAPEZOID_SQUARE };

#if defined FRACAS_LAW_TABLES

static const fracas_param trapezoid_params[] = {
    FRACAS_LAW_NUMBER("plateau", own[TRAPEZOID_PLATEAU], "1", 0.5, 0, 0.95, false, 0,
                      "opening up to which the strength is held, over the critical opening; 0 for "
                      "linear softening"),
    FRACAS_LAW_REAL(fracture_energy, "J/m2", FRACAS_REQUIRED, 0, INFINITY, true,
                    FRACAS_GROUP_CHAINS, "fracture energy G_c"),
    FRACAS_LAW_REAL(beta, "1", 4, 1, 1e4, true, FRACAS_GROUP_CHAINS,
                    "interface stiffness K = beta E/h; above 1 for a positive operator, 1.5 or "
                    "more in practice"),
    FRACAS_SURFACE_SHAPED("strength delta_c (1 + plateau)/2"),
};

static double trapezoid_contact(const fracas_cohesive *cohesive)
{
    return cohesive->beta;
}

static double trapezoid_fullness(const fracas_cohesive *cohesive)
{
    return 0.5 * (1 + cohesive->own[TRAPEZOID_PLATEAU]);
}

/* sigma_c/((1 - a) delta_c), by sigma_c^2/(2 G_c) */
static double trapezoid_steepest(const fracas_cohesive *cohesive)
{
    return (1 + cohesive->own[TRAPEZOID_PLATEAU]) / (1 - cohesive->own[TRAPEZOID_PLATEAU]);
}

/* y [Pa] */
static double trapezoid_constant(const fracas_cohesive *cohesive, double stiffness, double strength)
{
    return stiffness * cohesive->fracture_energy / (trapezoid_fullness(cohesive) * strength);
}

static void trapezoid_own(const fracas_spec *spec, double own[FRACAS_LAW_OWN])
{
    const double a = spec->cohesive.own[TRAPEZOID_PLATEAU];
    own[TRAPEZOID_FALL] = 1 / (1 - a);
    own[TRAPEZOID_FULL] = 1 / (1 + a);
    own[TRAPEZOID_SQUARE] = 1 - a * a;
}

const fracas_law fracas_law_trapezoid = {
    FRACAS_LAW_HEAD(trapezoid, "trapezoid",
                    "the strength held up to a share of the critical opening, then linear "
                    "softening, the opening in series with the discontinuous-Galerkin flux"),
    .flux = true,
    .fields = {SURFACE_POINT_FIELDS, SURFACE_POINT_FIELDS + 2},
    .fullness = trapezoid_fullness,
    .steepest = trapezoid_steepest,
    .own = trapezoid_own,
    .contact = trapezoid_contact,
    .constant = trapezoid_constant};

#else
#include "engine/cohesive/series.h"

/* t, exactly 0 at D = 1  (cohesive.26) */
LANES_FUNCTION vd trapezoid_left(const double *own, vd damage)
{
    const vd one = lanes_set(1.0);
    return lanes_min(one, (one - damage) * lanes_set(own[TRAPEZOID_FALL]));
}

/* f, exactly 1 at D = 1  (cohesive.27) */
LANES_FUNCTION vd trapezoid_spent(const double *own, vd damage)
{
    const vd square = lanes_set(own[TRAPEZOID_PLATEAU] * own[TRAPEZOID_PLATEAU]);
    return lanes_max(damage * lanes_set(own[TRAPEZOID_FULL]),
                     (damage - square) / lanes_set(own[TRAPEZOID_SQUARE]));
}

typedef struct {
    vmask loading;  /* D grows, unless it is 1 */
    vd damage;      /* D */
    vd ratio;       /* T/S where it does not grow */
    vd limit, held; /* S beyond which it grows, T there [Pa] */
} trapezoid_step;

/* D of a trial S [Pa], from that before  (cohesive.28), (cohesive.29) */
LANES_FUNCTION trapezoid_step trapezoid_load(const double *own, vd trial, vd p, vd y, vd damage)
{
    const vd one = lanes_set(1.0), zero = lanes_set(0.0),
             steep = p * lanes_set(own[TRAPEZOID_FALL]);
    trapezoid_step s = {.held = p * trapezoid_left(own, damage)};
    s.limit = s.held + damage * y;
    s.loading = lanes_lt(s.limit, trial);
    const vmask softens = lanes_lt(p + lanes_set(own[TRAPEZOID_PLATEAU]) * y, trial);
    const vd from = lanes_select(softens, steep, p), by = y - lanes_select(softens, steep, zero);
    s.ratio = lanes_select(s.loading, trial - from, s.held) / lanes_select(s.loading, by, s.limit);
    /* D never falls, by rounding neither */
    s.damage = lanes_select(s.loading, lanes_max(damage, lanes_min(one, s.ratio)), damage);
    return s;
}

/* ---- chains ---- */

LANES_FUNCTION line_result line_trapezoid(const line_input *in)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), p = in->sigma_c, y = in->constant;
    const vmask broken = lanes_le(one, in->damage);
    const vd trial = in->stiffness * in->jump + lanes_select(broken, zero, in->mean);
    const trapezoid_step s = trapezoid_load(in->own, trial, p, y, in->damage);
    const vd tension = lanes_select(s.loading, p * trapezoid_left(in->own, s.damage),
                                    trial * s.ratio);
    const vd traction = lanes_select(lanes_lt(zero, trial), tension, trial);
    const vd slip = lanes_select(lanes_le(one, s.damage), zero,
                                 (traction - in->mean) * in->compliance);
    return (line_result){.traction = traction,
                         .slip = slip,
                         .damage = s.damage,
                         .dissipated = trapezoid_spent(in->own, s.damage),
                         .past_onset = trial - p,
                         .softening = y - p,
                         .trial = trial,
                         .secant = s.ratio,
                         .limit = s.limit,
                         .held = s.held};
}

/* ---- surfaces (engine/cohesive/series.h) ---- */

/* The law at one point; `state` is brought up to date. */
LANES_FUNCTION plane_result plane_trapezoid(const plane_interface *at, const plane_input *in,
                                            int friction, series_state *state)
{
    const vd half = lanes_set(0.5), per_full = lanes_set(at->own[TRAPEZOID_FULL]),
             before = state->damage;
    const double steepest = at->own[TRAPEZOID_FALL] / at->own[TRAPEZOID_FULL];
    const series_trial t = series_begin(at, in, friction, steepest, trapezoid_left(at->own, before),
                                        before * per_full, state);
    const vd y = (t.energy + t.energy) * per_full * at->k_n / t.p;
    const trapezoid_step s = trapezoid_load(at->own, t.effective, t.p, y, before);
    vd damage = s.damage;
    if (friction) damage = lanes_select(t.rub.sticks, before, damage);
    const vd loaded = t.p / t.effective, spent = trapezoid_spent(at->own, damage);
    const series_softening it = {
        .damage = damage,
        .factor = lanes_select(s.loading, loaded * trapezoid_left(at->own, damage), s.ratio),
        .midway = lanes_select(s.loading,
                               loaded * trapezoid_left(at->own, half * (before + damage)), s.ratio),
        .dissipated = t.energy * spent,
        .spent = t.energy * (spent - trapezoid_spent(at->own, before))};
    return series_finish(at, in, friction, &t, &it, state);
}

LANES_FUNCTION plane_result plane_at_trapezoid(const plane_interface *at, const plane_input *in,
                                               double *point)
{
    series_state state = series_load(at, point);
    const plane_result r = plane_trapezoid(at, in, at->friction, &state);
    series_store(at, &state, point);
    return r;
}

LANES_FUNCTION vd plane_opening_trapezoid(const plane_interface *at, const plane_input *in,
                                          const double *point)
{
    const plane_traction flux = plane_flux(at, in); /* the law carries it less friction */
    return lanes_sqrt(plane_onset(at, flux.n, flux.t)) * at->softness_n /
           (plane_critical_opening(at, lanes_load(point + SURFACE_PEAK * LANES)) *
            lanes_set(at->own[TRAPEZOID_FULL]));
}
#endif
#endif
