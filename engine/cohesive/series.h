/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A point of a surface whose opening is in series with the flux, whatever the law's envelope:
 * onset, peak, contact, friction, break (docs/theory/cohesive.md).
 *
 *   trial T' = m + k q (unbroken), k q (broken); S' its effective traction        (cohesive.12)
 *   at onset p = sigma_c (by the flux), max(sigma_c, S' - (S_m - sigma_c)) (by the mean, of
 *       effective value S_m), p <= sqrt(k_n G_c/steepest)                         (cohesive.13)
 *   a pressure T'_n < 0 is kept whole; once broken T_n = k_n min(0, q_n), T_t = 0
 *   s = q - delta = (T - m)/k (unbroken), 0 (broken)                              (cohesive.15)
 *   energies of the flux s (m + T)/2, stored T (q - s)/2                          (cohesive.16)
 * Where the peak is cut the traction falls at the onset. The energy lost with it counts as created.
 *   With mu_c > 0, faces pressed on each other carry friction F beside: |F| <= mu_c |T_n|, T_t =
 * T_cohesive + F, and the opening delta_t moves only while |F| is at its limit    (cohesive.17)
 *
 * A law calls series_begin, brings D up to date for the trial it returns, and calls series_finish.
 */
#ifndef FRACAS_ENGINE_COHESIVE_SERIES_H
#define FRACAS_ENGINE_COHESIVE_SERIES_H

#include "engine/cohesive/plane.h"

typedef struct {
    vd damage, peak; /* D, p [Pa] */
    vd slip, rub;    /* with friction: delta_t [m], F [Pa] */
} series_state;

/* The shear under friction. */
typedef struct {
    vd shear;     /* trial traction of the law where faces slip [Pa] */
    vd rub;       /* F where they slip [Pa] */
    vmask sticks; /* faces do not slip: delta_t stays */
    vd held;      /* then T_t [Pa] ... */
    vd carried;   /* ... and the law's part of it [Pa] */
} plane_friction;

/* `left` of the peak is the traction's envelope at D, `opened` the opening there by 2 G_c/p
 * (cohesive.17) */
LANES_FUNCTION plane_friction plane_rub(const plane_interface *at, vd trial_n, vd trial_t, vd left,
                                        vd opened, const series_state *state)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    vd energy = plane_energy(at, state->peak), span = opened * (energy + energy); /* delta p */
    vmask softened = lanes_lt(zero, span);
    vd held = trial_t - at->k_t * state->slip;
    vd secant = at->beta_c * at->beta_c * state->peak * state->peak * left /
                lanes_select(softened, span, one);
    vd reach = at->beta_c * state->peak; /* a rigid law carries up to this */
    vd carried = lanes_select(softened, secant * state->slip,
                              plane_max(zero - reach, plane_min(reach, held)));
    vd limit = at->mu_c * plane_max(zero, zero - trial_n), rest = held - carried;
    vmask sticks = lanes_and(lanes_lt(trial_n, zero), lanes_le(plane_abs(rest), limit));
    vd rub = lanes_select(lanes_lt(rest, zero), zero - limit, limit);
    return (plane_friction){
        .shear = trial_t - rub, .rub = rub, .sticks = sticks, .held = held, .carried = carried};
}

typedef struct {
    vd effective, p, energy; /* S' [Pa], p [Pa], G_c [J/m2] */
    plane_friction rub;      /* where it sticks, D stays */
    vd m_n, m_t, trial_n, trial_t;
    vd peak;       /* p, 0 without an onset */
    vmask cracked; /* has had its onset ... */
    vmask cracks;  /* ... in this step ... */
    vmask cut;     /* ... with its peak cut */
    vmask parted;  /* has lost its mean before this step */
} series_trial;

/* The law's answer to a trial. */
typedef struct {
    vd damage;     /* D after the step */
    vd factor;     /* T = T' factor in tension */
    vd midway;     /* the same at the D halfway */
    vd dissipated; /* so far [J/m2] */
    vd spent;      /* in this step [J/m2] */
} series_softening;

/* `steepest` as in the law's traits, `left` and `opened` as of plane_rub. */
LANES_FUNCTION series_trial series_begin(const plane_interface *at, const plane_input *in,
                                         int friction, double steepest, vd left, vd opened,
                                         const series_state *state)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    const vmask was_cracked = lanes_lt(zero, state->peak);
    series_trial t;
    t.parted = lanes_and(in->were_broken, lanes_le(one, state->damage));
    t.m_n = lanes_select(t.parted, zero, in->m_n);
    t.m_t = lanes_select(t.parted, zero, in->m_t);
    t.trial_n = t.m_n + at->k_n * in->q_n;
    t.trial_t = t.m_t + at->k_t * in->q_t; /* (cohesive.12) */

    const plane_traction held = plane_held(at, in);
    vd judged = plane_onset(at, held.n, held.t);
    t.cracks = lanes_and(lanes_lt(at->sigma_c * at->sigma_c, judged), lanes_le(state->peak, zero));
    t.cracked = lanes_or(was_cracked, t.cracks);
    vd fresh = at->sigma_c, most = at->sigma_c;
    t.peak = state->peak;
    if (!at->calm && lanes_any(t.cracks)) { /* (cohesive.13) */
        /* S_m - sigma_c: the step is late by that; beside an open layer the flux may have been
         * above for long: all of it is the peak */
        const vd passed = lanes_select(in->opened, zero, lanes_sqrt(judged) - at->sigma_c);
        if (at->onset_mean)
            fresh = plane_max(lanes_sqrt(plane_onset(at, t.trial_n, t.trial_t)) - passed, fresh);
        most = lanes_sqrt(at->k_n * at->energy / lanes_set(steepest)) +
               half * (at->k_n * at->opening) / lanes_set(steepest);
        t.peak = lanes_select(t.cracks, plane_min(fresh, most), t.peak);
    }
    t.cut = lanes_and(t.cracks, lanes_lt(most, fresh));
    t.p = lanes_select(t.cracked, t.peak, at->sigma_c);
    t.energy = plane_energy(at, t.p);

    t.rub = (plane_friction){.shear = t.trial_t, .rub = zero, .sticks = lanes_lt(one, zero)};
    if (friction) t.rub = plane_rub(at, t.trial_n, t.trial_t, left, opened, state);
    t.effective = lanes_sqrt(plane_effective(at, t.trial_n, t.rub.shear));
    return t;
}

/* `state` is brought up to date. */
LANES_FUNCTION plane_result series_finish(const plane_interface *at, const plane_input *in,
                                          int friction, const series_trial *t,
                                          const series_softening *it, series_state *state)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    const vd m_n = t->m_n, m_t = t->m_t, trial_n = t->trial_n, trial_t = t->trial_t;
    plane_friction rub = t->rub;
    plane_result r;
    r.cracked = t->cracked;
    r.cracks = t->cracks;
    r.t_n = lanes_select(lanes_lt(zero, trial_n), trial_n * it->factor, trial_n);
    r.t_t = rub.shear * it->factor + rub.rub;
    r.midway_n = lanes_select(lanes_lt(zero, trial_n), trial_n * it->midway, trial_n);
    r.midway_t = rub.shear * it->midway + rub.rub;
    r.spent = it->spent;
    if (friction) {
        r.t_t = lanes_select(rub.sticks, rub.held, r.t_t);
        rub.rub = lanes_select(rub.sticks, rub.held - rub.carried, rub.rub);
    }

    /* (cohesive.15), (cohesive.16), as long as it is not broken */
    r.s_n = (r.t_n - m_n) * at->softness_n;
    r.s_t = (r.t_t - m_t) * at->softness_t;
    vd slip = in->q_t - r.s_t;
    r.flux = half * (r.s_n * (m_n + r.t_n) + r.s_t * (m_t + r.t_t));
    r.stored = half * (r.t_n * (in->q_n - r.s_n) + (r.t_t - rub.rub) * slip);
    /* at its onset friction acts in full already */
    r.rubbed = friction ? half * (lanes_select(r.cracks, rub.rub, state->rub) + rub.rub) *
                              (slip - state->slip)
                        : zero;
    /* a cut peak: the traction falls at the onset, and with it the energy */
    r.created = zero;
    if (!at->calm) {
        vd whole = half * (in->q_n * (m_n + trial_n) + in->q_t * (m_t + trial_t));
        vd fallen = r.flux + r.stored + it->dissipated + r.rubbed - whole;
        r.created = lanes_select(t->cut, fallen, zero);
    }

    /* once all layers are */
    const vmask ended = lanes_and(r.cracked, lanes_le(one, it->damage)),
                broken = lanes_and(in->are_broken, ended);
    vd push = plane_min(in->q_n, zero);
    if (friction) { /* the mean presses no more */
        vd limit = at->mu_c * (zero - at->k_n * push);
        r.t_t = lanes_select(broken, plane_max(zero - limit, plane_min(limit, r.t_t)), r.t_t);
        rub.rub = lanes_select(broken, r.t_t, rub.rub);
    }
    vd bent = r.t_t * at->softness_t;
    vd after = half * (at->k_n * push * push + r.t_t * bent);
    r.breaks = lanes_and(ended, lanes_lt(state->damage, one));
    if (!at->calm) { /* (cohesive.6) */
        const vd dropped = lanes_select(broken, after - (r.flux + r.stored), zero);
        r.created += lanes_select(t->parted, zero, dropped);
    }
    r.t_n = lanes_select(broken, at->k_n * push, r.t_n);
    r.s_n = lanes_select(broken, zero, r.s_n);
    r.s_t = lanes_select(broken, zero, r.s_t);
    r.flux = lanes_select(broken, zero, r.flux);
    r.stored = lanes_select(broken, after, r.stored);

    r.damage = state->damage = lanes_select(r.cracked, it->damage, state->damage);
    r.dissipated = lanes_select(r.cracked, it->dissipated, zero);
    state->peak = t->peak;
    if (friction) {
        state->slip = lanes_select(r.cracked, lanes_select(broken, in->q_t - bent, slip), zero);
        state->rub = lanes_select(r.cracked, rub.rub, zero);
    }
    return r;
}

/* Values of a point after D and p: with friction, delta_t [m] and F [Pa]. */
enum { SERIES_SLIP = SURFACE_POINT_FIELDS, SERIES_RUB };

LANES_FUNCTION series_state series_load(const plane_interface *at, const double *point)
{
    series_state state;
    state.damage = lanes_load(point + SURFACE_DAMAGE * LANES);
    state.peak = lanes_load(point + SURFACE_PEAK * LANES);
    state.slip = state.rub = lanes_set(0.0);
    if (at->friction) {
        state.slip = lanes_load(point + SERIES_SLIP * LANES);
        state.rub = lanes_load(point + SERIES_RUB * LANES);
    }
    return state;
}

LANES_FUNCTION void series_store(const plane_interface *at, const series_state *state,
                                 double *point)
{
    if (at->calm) return;
    lanes_store(point + SURFACE_DAMAGE * LANES, state->damage);
    lanes_store(point + SURFACE_PEAK * LANES, state->peak);
    if (at->friction) {
        lanes_store(point + SERIES_SLIP * LANES, state->slip);
        lanes_store(point + SERIES_RUB * LANES, state->rub);
    }
}

#endif
