/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `nitsche`: linear softening, the opening in series with the discontinuous-Galerkin flux. */
#if defined FRACAS_LAW
FRACAS_LAW(nitsche, FLUX, FLUX, YES, YES)
#elif defined FRACAS_LAW_TABLES

static const fracas_param nitsche_params[] = {
    FRACAS_LAW_REAL(fracture_energy, "J/m2", FRACAS_REQUIRED, 0, INFINITY, true,
                    fracas_chain_models, "fracture energy G_c"),
    FRACAS_LAW_REAL(beta, "1", 4, 1, 1e4, true, fracas_chain_models,
                    "interface stiffness K = beta E/h; above 1 for a positive operator, 1.5 or "
                    "more in practice"),
    FRACAS_SURFACE_LAW,
};

static double nitsche_contact(const fracas_cohesive *cohesive)
{
    return cohesive->beta;
}

/* x = K delta_c - sigma_c [Pa]  (cohesive.2) */
static double nitsche_constant(double stiffness, double energy, double strength)
{
    return 2 * stiffness * energy / strength - strength;
}

const fracas_law fracas_law_nitsche = {
    FRACAS_LAW_HEAD(nitsche, "nitsche",
                    "linear softening, the opening in series with the discontinuous-Galerkin flux"),
    .flux = true,
    .steepest = 1,
    .fields = {SURFACE_POINT_FIELDS, SURFACE_POINT_FIELDS + 2},
    .contact = nitsche_contact,
    .constant = nitsche_constant};

#else

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
    vd ratio = lanes_select(loading, excess, sigma_c - sigma_c * damage) /
               lanes_select(loading, x, sigma_c + reached);
    vd capped = lanes_select(lanes_lt(ratio, one), ratio, one);
    vd now = lanes_select(loading, capped, damage);
    vd tension = lanes_select(loading, sigma_c * (one - now), trial * ratio);
    vd traction = lanes_select(lanes_lt(zero, trial), tension, trial);
    vd slip = lanes_select(lanes_le(one, now), zero, (traction - in->mean) * in->compliance);
    return (line_result){.traction = traction,
                         .slip = slip,
                         .damage = now,
                         .dissipated = now,
                         .past_onset = excess,
                         .softening = x};
}

/* ---- surfaces ----
 *
 *   trial T' = m + k q (unbroken), k q (broken); S' its effective traction        (cohesive.12)
 *   at onset p = sigma_c (by the flux), max(sigma_c, S' - (S_m - sigma_c)) (by the mean, of
 *       effective value S_m), p <= sqrt(k_n G_c)                                  (cohesive.13)
 *   loading, S' - p > D x, x = k_n delta_c - p:  D = min(1, (S' - p)/x), T = T' p (1 - D)/S'
 *   else on the secant T = T' p (1 - D)/(p + D x)                                 (cohesive.14)
 *   a pressure T'_n < 0 is kept whole; once broken T_n = k_n min(0, q_n), T_t = 0
 *   s = q - delta = (T - m)/k (unbroken), 0 (broken)                              (cohesive.15)
 *   energies of the flux s (m + T)/2, stored T (q - s)/2, dissipated G_c D        (cohesive.16)
 * Where the peak is cut, k_n delta_c = 2 p, the traction falls at the onset. The energy lost with
 * it counts as created.
 *   With mu_c > 0, faces pressed on each other carry friction F beside: |F| <= mu_c |T_n|, T_t =
 * T_cohesive + F, and the opening delta_t moves only while |F| is at its limit    (cohesive.17) */

typedef struct {
    vd damage, peak; /* D, p [Pa] */
    vd slip, rub;    /* with friction: delta_t [m], F [Pa] */
} nitsche_state;

/* The shear under friction. */
typedef struct {
    vd shear;     /* trial traction of the law where faces slip [Pa] */
    vd rub;       /* F where they slip [Pa] */
    vmask sticks; /* faces do not slip: delta_t stays */
    vd held;      /* then T_t [Pa] ... */
    vd carried;   /* ... and the law's part of it [Pa] */
} plane_friction;

/* (cohesive.17) */
LANES_FUNCTION plane_friction plane_rub(const plane_interface *at, vd trial_n, vd trial_t,
                                        const nitsche_state *state)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    vd energy = plane_energy(at, state->peak),
       span = state->damage * (energy + energy); /* D delta_c p */
    vmask softened = lanes_lt(zero, span);
    vd held = trial_t - at->k_t * state->slip;
    vd secant = at->beta_c * at->beta_c * state->peak * state->peak * (one - state->damage) /
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

/* The law at one point; `state` is brought up to date. */
LANES_FUNCTION plane_result plane_nitsche(const plane_interface *at, const plane_input *in,
                                          int friction, nitsche_state *state)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    const vmask was_broken = lanes_le(one, state->damage),
                was_cracked = lanes_lt(zero, state->peak);
    const vd m_n = lanes_select(was_broken, zero, in->m_n),
             m_t = lanes_select(was_broken, zero, in->m_t);
    const vd trial_n = m_n + at->k_n * in->q_n,
             trial_t = m_t + at->k_t * in->q_t; /* (cohesive.12) */

    plane_result r;
    const plane_traction held = plane_held(at, in);
    vd judged = plane_onset(at, held.n, held.t);
    r.cracks = lanes_and(lanes_lt(at->sigma_c * at->sigma_c, judged), lanes_le(state->peak, zero));
    r.cracked = lanes_or(was_cracked, r.cracks);
    vd peak = state->peak, fresh = at->sigma_c, most = at->sigma_c;
    if (lanes_any(r.cracks)) { /* (cohesive.13) */
        /* S_m - sigma_c: the step is late by that; beside an open layer the flux may have been
         * above for long: all of it is the peak */
        const vd passed = lanes_select(in->opened, zero, lanes_sqrt(judged) - at->sigma_c);
        if (at->onset_mean)
            fresh = plane_max(lanes_sqrt(plane_onset(at, trial_n, trial_t)) - passed, fresh);
        most = lanes_sqrt(at->k_n * at->energy) + half * (at->k_n * at->opening);
        peak = lanes_select(r.cracks, plane_min(fresh, most), peak);
    }
    vd p = lanes_select(r.cracked, peak, at->sigma_c), energy = plane_energy(at, p);

    plane_friction rub = {.shear = trial_t, .rub = zero};
    if (friction) rub = plane_rub(at, trial_n, trial_t, state);
    vd effective = lanes_sqrt(plane_effective(at, trial_n, rub.shear));
    vd x = (energy + energy) * at->k_n / p - p;
    vd excess = effective - p, reached = state->damage * x;
    vmask loading = lanes_lt(reached, excess);
    vd ratio = lanes_select(loading, excess, p * (one - state->damage)) /
               lanes_select(loading, x, p + reached);
    vd damage = lanes_select(loading, plane_min(ratio, one), state->damage);
    if (friction) damage = lanes_select(rub.sticks, state->damage, damage);
    vd factor = lanes_select(loading, p * (one - damage) / effective, ratio); /* (cohesive.14) */
    r.t_n = lanes_select(lanes_lt(zero, trial_n), trial_n * factor, trial_n);
    r.t_t = rub.shear * factor + rub.rub;
    vd midway = lanes_select(loading, p * (one - half * (state->damage + damage)) / effective,
                             ratio);
    r.midway_n = lanes_select(lanes_lt(zero, trial_n), trial_n * midway, trial_n);
    r.midway_t = rub.shear * midway + rub.rub;
    r.spent = energy * (damage - state->damage);
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
    vd whole = half * (in->q_n * (m_n + trial_n) + in->q_t * (m_t + trial_t));
    vd fallen = r.flux + r.stored + energy * damage + r.rubbed - whole;
    r.created = lanes_select(lanes_and(r.cracks, lanes_lt(most, fresh)), fallen, zero);

    /* once it is */
    vmask broken = lanes_and(r.cracked, lanes_le(one, damage));
    vd push = plane_min(in->q_n, zero);
    if (friction) { /* the mean presses no more */
        vd limit = at->mu_c * (zero - at->k_n * push);
        r.t_t = lanes_select(broken, plane_max(zero - limit, plane_min(limit, r.t_t)), r.t_t);
        rub.rub = lanes_select(broken, r.t_t, rub.rub);
    }
    vd bent = r.t_t * at->softness_t;
    vd after = half * (at->k_n * push * push + r.t_t * bent);
    r.breaks = lanes_and(broken, lanes_lt(state->damage, one));
    r.created += lanes_select(r.breaks, after - (r.flux + r.stored), zero); /* (cohesive.6) */
    r.t_n = lanes_select(broken, at->k_n * push, r.t_n);
    r.s_n = lanes_select(broken, zero, r.s_n);
    r.s_t = lanes_select(broken, zero, r.s_t);
    r.flux = lanes_select(broken, zero, r.flux);
    r.stored = lanes_select(broken, after, r.stored);

    state->damage = lanes_select(r.cracked, damage, state->damage);
    r.dissipated = energy * state->damage;
    state->peak = peak;
    if (friction) {
        state->slip = lanes_select(r.cracked, lanes_select(broken, in->q_t - bent, slip), zero);
        state->rub = lanes_select(r.cracked, rub.rub, zero);
    }
    return r;
}

/* Values of a point after D and p: with friction, delta_t [m] and F [Pa]. */
enum { NITSCHE_SLIP = SURFACE_POINT_FIELDS, NITSCHE_RUB };

LANES_FUNCTION plane_result plane_at_nitsche(const plane_interface *at, const plane_input *in,
                                             double *point)
{
    nitsche_state state = {.damage = lanes_load(point + SURFACE_DAMAGE * LANES),
                           .peak = lanes_load(point + SURFACE_PEAK * LANES)};
    if (at->friction) {
        state.slip = lanes_load(point + NITSCHE_SLIP * LANES);
        state.rub = lanes_load(point + NITSCHE_RUB * LANES);
    }
    const plane_result r = plane_nitsche(at, in, at->friction, &state);
    lanes_store(point + SURFACE_DAMAGE * LANES, state.damage);
    lanes_store(point + SURFACE_PEAK * LANES, state.peak);
    if (at->friction) {
        lanes_store(point + NITSCHE_SLIP * LANES, state.slip);
        lanes_store(point + NITSCHE_RUB * LANES, state.rub);
    }
    return r;
}

LANES_FUNCTION vd plane_opening_nitsche(const plane_interface *at, const plane_input *in,
                                        const double *point)
{
    const plane_traction flux = plane_flux(at, in);
    return lanes_sqrt(plane_effective(at, flux.n, flux.t)) * at->softness_n /
           plane_critical_opening(at, lanes_load(point + SURFACE_PEAK * LANES));
}
#endif
