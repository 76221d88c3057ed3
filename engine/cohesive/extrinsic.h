/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An interface of a surface that leaves the flux at its onset: `camacho-ortiz-standard` and
 * `camacho-ortiz`.
 *
 * At onset T_0 is the traction held against the strength, p its effective value, q_0 the jump.
 * Then with the opening d = q - q_0, d_e = sqrt(max(0, d_n)^2 + (beta_c d_t)^2), delta_c = 2 G_c/p,
 * and D the largest d_e/delta_c so far, at most 1:
 *   f = (1 - D)/d_e loading, (1 - D)/(D delta_c) on the secant                     (cohesive.18)
 *   standard:  T_n = p f d_n,             T_t = p f beta_c^2 d_t                   (cohesive.19)
 *   paper's:   T_n = max(0, T_0n) f d_n,  T_t = |T_0t| f beta_c d_t                (cohesive.20)
 *   closed, d_n < 0:  T_n = k_n d_n, broken or not
 * T = T_0 while nothing has opened. An interface that shears under pressure starts from d_n =
 * T_0n/k_n. Energies: stored T.d/2, dissipated G_c D (the paper's law on mixed paths less: its
 * residual shows it). Friction as in `nitsche`, beside the law, on d_t; T_0 is then less the
 * friction at onset. */
#ifndef FRACAS_ENGINE_COHESIVE_EXTRINSIC_H
#define FRACAS_ENGINE_COHESIVE_EXTRINSIC_H

/* Values of a point, after D and p. */
enum {
    EXTRINSIC_JUMP_N = SURFACE_POINT_FIELDS, /* q_0 [m] */
    EXTRINSIC_JUMP_T,
    EXTRINSIC_START_N, /* T_0 [Pa] */
    EXTRINSIC_START_T,
    EXTRINSIC_FIELDS,
    EXTRINSIC_SLIP = EXTRINSIC_FIELDS, /* with friction: delta_t [m], F [Pa] */
    EXTRINSIC_RUB,
    EXTRINSIC_FIELDS_FRICTION
};

#ifndef FRACAS_LAW_TABLES

typedef struct {
    vd damage, peak; /* D, p [Pa] */
    vd q_n, q_t;     /* q_0 [m] */
    vd t_n, t_t;     /* T_0 [Pa] */
    vd slip, rub;    /* with friction: [m], [Pa] */
} extrinsic_state;

/* d_e [m] */
LANES_FUNCTION vd extrinsic_opening(const plane_interface *at, vd d_n, vd d_t)
{
    const vd pull = plane_max(d_n, lanes_set(0.0)), shear = at->beta_c * d_t;
    return lanes_sqrt(pull * pull + shear * shear);
}

/* The law at one point; `state` is brought up to date. `standard`: (cohesive.19), else
 * (cohesive.20). */
LANES_FUNCTION plane_result plane_extrinsic(const plane_interface *at, const plane_input *in,
                                            int standard, int friction, extrinsic_state *state)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    const vmask was_cracked = lanes_lt(zero, state->peak);
    const plane_traction held = plane_held(at, in);
    plane_result r;
    vd judged = plane_onset(at, held.n, held.t);
    r.cracks = lanes_and(lanes_lt(at->sigma_c * at->sigma_c, judged), lanes_le(state->peak, zero));
    r.cracked = lanes_or(was_cracked, r.cracks);
    state->peak = lanes_select(r.cracks, lanes_sqrt(judged), state->peak);
    state->q_n = lanes_select(r.cracks, in->q_n - plane_min(held.n, zero) * at->softness_n,
                              state->q_n);
    state->q_t = lanes_select(r.cracks, in->q_t, state->q_t);
    state->t_n = lanes_select(r.cracks, plane_max(held.n, zero), state->t_n);
    /* an onset under pressure has friction at its limit; the law starts with the rest, beta_c p */
    vd pressed = friction ? at->mu_c * plane_max(zero, zero - held.n) : zero;
    vd rubs = lanes_select(lanes_lt(held.t, zero), zero - pressed, pressed);
    state->t_t = lanes_select(r.cracks, held.t - rubs, state->t_t);
    if (friction) state->slip = lanes_select(r.cracks, zero - rubs * at->softness_t, state->slip);
    vd p = lanes_select(r.cracked, state->peak, at->sigma_c);

    vd d_n = in->q_n - state->q_n, d_t = in->q_t - state->q_t;
    vd pull = plane_max(d_n, zero), push = plane_min(d_n, zero);
    vd opening = extrinsic_opening(at, d_n, d_t), energy = plane_energy(at, p);
    vd delta_c = (energy + energy) / p;
    vd reached = state->damage * delta_c;
    vmask loading = lanes_lt(reached, opening), opened = lanes_or(loading, lanes_lt(zero, reached));
    vd damage = lanes_select(loading, plane_min(opening / delta_c, one), state->damage);
    /* (cohesive.18) */
    vd factor = (one - damage) / lanes_select(loading, opening, lanes_select(opened, reached, one));
    vd amplitude_n = standard ? p : state->t_n;
    vd amplitude_t = at->beta_c * (standard ? p * at->beta_c : plane_abs(state->t_t));
    vd open_n = lanes_select(opened, amplitude_n * factor * pull, state->t_n);
    vd law_t = lanes_select(opened, amplitude_t * factor * d_t, state->t_t);
    r.t_n = lanes_select(lanes_lt(d_n, zero), at->k_n * push, open_n);
    vd rub = zero;
    r.rubbed = zero;
    if (friction) {
        vd limit = at->mu_c * (zero - at->k_n * push);
        rub = plane_max(zero - limit, plane_min(limit, at->k_t * (d_t - state->slip)));
        vd slip = d_t - rub * at->softness_t;
        r.rubbed = lanes_select(was_cracked, half * (state->rub + rub) * (slip - state->slip),
                                zero);
        state->slip = lanes_select(r.cracked, slip, zero);
        state->rub = lanes_select(r.cracked, rub, zero);
    }
    r.t_t = law_t + rub;
    r.s_n = r.s_t = r.flux = zero;
    r.stored = half * (r.t_n * d_n + law_t * d_t + rub * rub * at->softness_t);
    vmask broken = lanes_and(r.cracked, lanes_le(one, damage));
    r.breaks = lanes_and(broken, lanes_lt(state->damage, one));
    /* the flux is left with the energy it had */
    vd left = in->q_n * (in->m_n + half * at->k_n * in->q_n) +
              in->q_t * (in->m_t + half * at->k_t * in->q_t);
    r.created = lanes_select(r.cracks, r.stored - left, zero);
    state->damage = lanes_select(r.cracked, damage, state->damage);
    r.damage = state->damage;
    r.dissipated = energy * state->damage;
    return r;
}

LANES_FUNCTION plane_result extrinsic_at(const plane_interface *at, const plane_input *in,
                                         int standard, double *point)
{
    extrinsic_state state = {.damage = lanes_load(point + SURFACE_DAMAGE * LANES),
                             .peak = lanes_load(point + SURFACE_PEAK * LANES),
                             .q_n = lanes_load(point + EXTRINSIC_JUMP_N * LANES),
                             .q_t = lanes_load(point + EXTRINSIC_JUMP_T * LANES),
                             .t_n = lanes_load(point + EXTRINSIC_START_N * LANES),
                             .t_t = lanes_load(point + EXTRINSIC_START_T * LANES),
                             .slip = lanes_set(0.0),
                             .rub = lanes_set(0.0)};
    if (at->friction) {
        state.slip = lanes_load(point + EXTRINSIC_SLIP * LANES);
        state.rub = lanes_load(point + EXTRINSIC_RUB * LANES);
    }
    const plane_result r = plane_extrinsic(at, in, standard, at->friction, &state);
    if (at->calm) return r;
    lanes_store(point + SURFACE_DAMAGE * LANES, state.damage);
    lanes_store(point + SURFACE_PEAK * LANES, state.peak);
    lanes_store(point + EXTRINSIC_JUMP_N * LANES, state.q_n);
    lanes_store(point + EXTRINSIC_JUMP_T * LANES, state.q_t);
    lanes_store(point + EXTRINSIC_START_N * LANES, state.t_n);
    lanes_store(point + EXTRINSIC_START_T * LANES, state.t_t);
    if (at->friction) {
        lanes_store(point + EXTRINSIC_SLIP * LANES, state.slip);
        lanes_store(point + EXTRINSIC_RUB * LANES, state.rub);
    }
    return r;
}

LANES_FUNCTION vd extrinsic_opening_at(const plane_interface *at, const plane_input *in,
                                       const double *point)
{
    return extrinsic_opening(at, in->q_n - lanes_load(point + EXTRINSIC_JUMP_N * LANES),
                             in->q_t - lanes_load(point + EXTRINSIC_JUMP_T * LANES)) /
           plane_critical_opening(at, lanes_load(point + SURFACE_PEAK * LANES));
}
#endif
#endif
