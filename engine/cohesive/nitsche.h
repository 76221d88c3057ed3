/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `nitsche`: linear softening, the opening in series with the discontinuous-Galerkin flux. */
#if defined FRACAS_LAW
FRACAS_LAW(nitsche, FLUX, FLUX, YES, YES)
#elif defined FRACAS_LAW_TABLES

static const fracas_param nitsche_params[] = {
    FRACAS_LAW_REAL(fracture_energy, "J/m2", FRACAS_REQUIRED, 0, INFINITY, true,
                    FRACAS_GROUP_CHAINS, "fracture energy G_c"),
    FRACAS_LAW_REAL(beta, "1", 4, 1, 1e4, true, FRACAS_GROUP_CHAINS,
                    "interface stiffness K = beta E/h; above 1 for a positive operator, 1.5 or "
                    "more in practice"),
    FRACAS_SURFACE_LAW,
};

static double nitsche_contact(const fracas_cohesive *cohesive)
{
    return cohesive->beta;
}

/* x = K delta_c - sigma_c [Pa]  (cohesive.2) */
static double nitsche_constant(const fracas_cohesive *cohesive, double stiffness, double strength)
{
    return 2 * stiffness * cohesive->fracture_energy / strength - strength;
}

const fracas_law fracas_law_nitsche = {
    FRACAS_LAW_HEAD(nitsche, "nitsche",
                    "linear softening, the opening in series with the discontinuous-Galerkin flux"),
    .flux = true, .fields = {SURFACE_POINT_FIELDS, SURFACE_POINT_FIELDS + 2},
    .contact = nitsche_contact, .constant = nitsche_constant};

#else
#include "engine/cohesive/series.h"

/* ---- chains ----
 *
 * Mean stress m = <sigma>, jump q, stiffness K, strength sigma_c, delta_c = 2 G_c/sigma_c, D =
 * delta_max/delta_c, x = K delta_c - sigma_c:
 *   trial traction  S = m + K q (unbroken), K q (broken)                            (cohesive.1)
 *   loading, S - sigma_c > D x:  D = min(1, (S - sigma_c)/x)                        (cohesive.2)
 *   T = sigma_c (1 - D) loading, S sigma_c (1 - D)/(sigma_c + D x) on the secant    (cohesive.3)
 *   T = S where S <= 0: contact by the flux itself
 *   s = q - delta = (T - m)/K (unbroken), 0 (broken)                                (cohesive.4)
 * At D = 0 the secant is exactly T = S, plain interior penalty. */

LANES_FUNCTION line_result line_nitsche(const line_input *in)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), x = in->constant;
    const vd sigma_c = in->sigma_c, damage = in->damage;
    vmask broken = lanes_le(one, damage);
    vd trial = in->stiffness * in->jump + lanes_select(broken, zero, in->mean);
    vd excess = trial - sigma_c;
    vd reached = damage * x;
    vmask loading = lanes_lt(reached, excess);
    vd held = sigma_c - sigma_c * damage, limit = sigma_c + reached;
    vd ratio = lanes_select(loading, excess, held) / lanes_select(loading, x, limit);
    vd now = lanes_select(loading, lanes_min(one, ratio), damage);
    vd tension = lanes_select(loading, sigma_c * (one - now), trial * ratio);
    vd traction = lanes_select(lanes_lt(zero, trial), tension, trial);
    vd slip = lanes_select(lanes_le(one, now), zero, (traction - in->mean) * in->compliance);
    return (line_result){.traction = traction,
                         .slip = slip,
                         .damage = now,
                         .dissipated = now,
                         .past_onset = excess,
                         .softening = x,
                         .trial = trial,
                         .secant = ratio,
                         .limit = limit,
                         .held = held};
}

/* ---- surfaces (engine/cohesive/series.h) ----
 *
 *   loading, S' - p > D x, x = k_n delta_c - p:  D = min(1, (S' - p)/x), T = T' p (1 - D)/S'
 *   else on the secant T = T' p (1 - D)/(p + D x)                                 (cohesive.14)
 *   dissipated G_c D                                                              (cohesive.16) */

/* The law at one point; `state` is brought up to date. */
LANES_FUNCTION plane_result plane_nitsche(const plane_interface *at, const plane_input *in,
                                          int friction, series_state *state)
{
    const vd one = lanes_set(1.0), half = lanes_set(0.5);
    const series_trial t = series_begin(at, in, friction, 1, one - state->damage, state->damage,
                                        state);
    vd x = (t.energy + t.energy) * at->k_n / t.p - t.p;
    vd excess = t.effective - t.p, reached = state->damage * x;
    vmask loading = lanes_lt(reached, excess);
    vd ratio = lanes_select(loading, excess, t.p * (one - state->damage)) /
               lanes_select(loading, x, t.p + reached);
    vd damage = lanes_select(loading, plane_min(ratio, one), state->damage);
    if (friction) damage = lanes_select(t.rub.sticks, state->damage, damage);
    const series_softening it = {
        .damage = damage,
        .factor = lanes_select(loading, t.p * (one - damage) / t.effective,
                               ratio), /* (cohesive.14) */
        .midway = lanes_select(loading, t.p * (one - half * (state->damage + damage)) / t.effective,
                               ratio),
        .dissipated = t.energy * damage,
        .spent = t.energy * (damage - state->damage)};
    return series_finish(at, in, friction, &t, &it, state);
}

LANES_FUNCTION plane_result plane_at_nitsche(const plane_interface *at, const plane_input *in,
                                             double *point)
{
    series_state state = series_load(at, point);
    const plane_result r = plane_nitsche(at, in, at->friction, &state);
    series_store(at, &state, point);
    return r;
}

LANES_FUNCTION vd plane_opening_nitsche(const plane_interface *at, const plane_input *in,
                                        const double *point)
{
    const plane_traction flux = plane_flux(at, in); /* the law carries it less friction */
    return lanes_sqrt(plane_onset(at, flux.n, flux.t)) * at->softness_n /
           plane_critical_opening(at, lanes_load(point + SURFACE_PEAK * LANES));
}
#endif
