/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `becker-noels`: Becker and Noels' law on the stress resultants of a shell (their equations 57
 * to 78; docs/theory/cohesive.md).
 *
 * At onset the flux is left: N_0, M_0 are what judged the onset, p the effective stress of the skin
 * that cracked, [u]_0, [Dt]_0 the jumps, taken off from then on. With i = n, s:
 *   Z_i = |N_0i| + 6 |M_0i|/h,  a_i = N_0i/Z_i,  b_i = M_0i/Z_i                    (cohesive.21)
 *   d_i = a_i [u]_i + b_i [Dt]_i,  d_e = sqrt(max(0, d_n)^2 + (beta_c d_s)^2)      (cohesive.22)
 *   N_n, M_n = (a_n, b_n) Z_n f max(0, d_n),  N_s, M_s = (a_s, b_s) Z_s beta_c f d_s
 *       with f of (cohesive.18)                                                    (cohesive.23)
 * (Z_i = 0: a_i = 1, b_i = 0). N_0n < 0: Z_n = max(0, N_0n + 6 |M_0n|/h), a_n = 0, b_n = +-h/6; the
 * rest is kept as contact at the arm c = (M_0n - b_n Z_n)/N_0n (cohesive.24) Contact at the height
 * r: force k min(0, g), g = [u]_n + r [Dt]_n (+ N_0n/k at c), on (1, r), k = k_n h/(1 + 12 r^2/h^2)
 * (cohesive.25) */
#if defined FRACAS_LAW
FRACAS_LAW(becker_noels, NO, NO, NO, RESULTANTS)
#else
#include "engine/cohesive/resultants.h"

/* Own values of a Gauss point, from these on two each. */
enum {
    BECKER_NOELS_JUMP = 0, /* [u]_0 [m] */
    BECKER_NOELS_TURN = 2, /* [Dt]_0 [1] */
    BECKER_NOELS_N = 4,    /* N_0 [N/m] */
    BECKER_NOELS_M = 6     /* M_0 [N] */
};

#if defined FRACAS_LAW_TABLES

static const fracas_param becker_noels_params[] = {FRACAS_SURFACE_FRICTIONLESS};
const fracas_law fracas_law_becker_noels = {
    FRACAS_LAW_HEAD(
        becker_noels, "becker-noels",
        "linear softening of a shell's stress resultants, normal and shear scaled by those at "
        "onset (Becker and Noels' paper); gains energy on mixed paths, and no ENERGY_DRIFT ends "
        "it: for comparison"),
    .open_ledger = true, .shares_of_onset = true, .fields = {RESULTANT_FIELDS, RESULTANT_FIELDS},
    .tension = RESULTANT_PLACE(BECKER_NOELS_N)};

#else

typedef struct {
    vd damage, peak;     /* D, p [Pa] */
    vd jump[2], turn[2]; /* at onset [m], [1] */
    vd n[2], m[2];       /* at onset [N/m], [N] */
} becker_noels_state;

/* The onset's shares  (cohesive.21), (cohesive.24) */
typedef struct {
    vd z[2], a[2], b[2]; /* N/m, 1, m */
    vd closing;          /* r [m] */
    vd kept, arm;        /* min(0, N_0n) [N/m], c [m] */
} becker_noels_shares;

LANES_FUNCTION becker_noels_shares becker_noels_shares_of(double h, const becker_noels_state *state)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), six = lanes_set(6.0 / h);
    becker_noels_shares s;
    vd n[2], m[2];
    const vmask pressed = lanes_lt(state->n[0], zero), down = lanes_lt(state->m[0], zero);
    for (int i = 0; i < 2; i++) {
        n[i] = state->n[i];
        m[i] = state->m[i];
        s.z[i] = (i ? plane_abs(n[i]) : n[i]) + six * plane_abs(m[i]);
    }
    s.z[0] = plane_max(zero, s.z[0]);
    const vd kern = s.z[0] * lanes_set(h / 6), bent = lanes_select(down, zero - kern, kern);
    s.kept = plane_min(n[0], zero);
    s.arm = (m[0] - bent) / lanes_select(pressed, n[0], one);
    s.arm = lanes_select(pressed, s.arm, zero);
    n[0] = plane_max(n[0], zero);
    m[0] = lanes_select(pressed, bent, m[0]);
    for (int i = 0; i < 2; i++) {
        const vmask loaded = lanes_lt(zero, s.z[i]);
        const vd share = one / lanes_select(loaded, s.z[i], one);
        s.a[i] = lanes_select(loaded, n[i] * share, i ? one : lanes_select(pressed, zero, one));
        s.b[i] = m[i] * share;
    }
    /* where the law's resultant acts, at most at a skin */
    const vd skin = lanes_set(h / 2), reach = skin * n[0];
    const vmask within = lanes_lt(plane_abs(m[0]), reach);
    s.closing = lanes_select(within, m[0] / lanes_select(within, n[0], one),
                             lanes_select(down, zero - skin, skin));
    return s;
}

/* d_n, d_s and their effective value [m]  (cohesive.22) */
typedef struct {
    vd jump[2], turn[2]; /* [u], [Dt] since the onset */
    vd d[2], pull, effective;
} becker_noels_opening;

LANES_FUNCTION becker_noels_opening becker_noels_open(const plane_interface *at,
                                                      const resultant_input *in,
                                                      const becker_noels_state *state,
                                                      const becker_noels_shares *s)
{
    becker_noels_opening o;
    for (int i = 0; i < 2; i++) {
        o.jump[i] = in->jump[i] - state->jump[i];
        o.turn[i] = in->turn[i] - state->turn[i];
        o.d[i] = s->a[i] * o.jump[i] + s->b[i] * o.turn[i];
    }
    const vd shear = at->beta_c * o.d[1];
    o.pull = plane_max(o.d[0], lanes_set(0.0));
    o.effective = lanes_sqrt(o.pull * o.pull + shear * shear);
    return o;
}

/* Adds the force of a contact at `arm`, which carries `held` [N/m] at the onset, and its energy,
 * where it is there at all  (cohesive.25). */
LANES_FUNCTION void becker_noels_press(const plane_interface *at, double h,
                                       const becker_noels_opening *o, vmask there, vd arm, vd held,
                                       resultant_result *r)
{
    const vd one = lanes_set(1.0), slender = lanes_set(12.0 / (h * h)) * (arm * arm);
    const vd stiff = at->k_n * lanes_set(h) / (one + slender);
    const vd zero = lanes_set(0.0), force = held + stiff * (o->jump[0] + arm * o->turn[0]),
             push = lanes_select(there, plane_min(zero, force), zero);
    r->n[0] += push;
    r->m[0] += arm * push;
    r->midway_n[0] += push;
    r->midway_m[0] += arm * push;
    r->stored += lanes_set(0.5) * (push * push / stiff);
}

/* Judges the skins; keeps what an onset finds. */
LANES_FUNCTION void becker_noels_judge(const plane_interface *at, const resultant_input *in,
                                       becker_noels_state *state, resultant_result *r)
{
    const vd zero = lanes_set(0.0), per_h = lanes_set(1.0 / in->thickness),
             per_h2 = lanes_set(6.0 / (in->thickness * in->thickness));
    const vd *n = at->onset_mean ? in->mean_n : in->flux_n,
             *m = at->onset_mean ? in->mean_m : in->flux_m;
    const vmask whole = lanes_le(state->peak, zero);
    const vd limit = at->sigma_c * at->sigma_c;
    vd judged[2];
    for (int skin = 0; skin < 2; skin++) {
        const vd by_m = lanes_set(skin ? 1.0 : -1.0) * per_h2;
        judged[skin] = plane_onset(at, n[0] * per_h + m[0] * by_m, n[1] * per_h + m[1] * by_m);
        r->cracks[2 * skin] = lanes_and(whole, lanes_lt(limit, judged[skin]));
    }
    r->cracks[1] = lanes_lt(lanes_set(1.0), zero); /* never before a skin */
    const vmask cracks = lanes_or(r->cracks[0], r->cracks[2]);
    r->cracked = lanes_or(lanes_lt(zero, state->peak), cracks);
    state->peak = lanes_select(cracks, lanes_sqrt(plane_max(judged[0], judged[1])), state->peak);
    for (int i = 0; i < 2; i++) {
        state->jump[i] = lanes_select(cracks, in->jump[i], state->jump[i]);
        state->turn[i] = lanes_select(cracks, in->turn[i], state->turn[i]);
        state->n[i] = lanes_select(cracks, n[i], state->n[i]);
        state->m[i] = lanes_select(cracks, m[i], state->m[i]);
    }
}

/* Energy of the flux that an onset leaves [J/m2 times thickness]. */
LANES_FUNCTION vd becker_noels_left(const resultant_input *in)
{
    vd left = lanes_set(0.0);
    for (int i = 0; i < 2; i++)
        left += in->jump[i] * (in->mean_n[i] + in->flux_n[i]) +
                in->turn[i] * (in->mean_m[i] + in->flux_m[i]);
    return lanes_set(0.5) * left;
}

/* The law at one Gauss point; `state` is brought up to date. */
LANES_FUNCTION resultant_result becker_noels(const plane_interface *at, const resultant_input *in,
                                             becker_noels_state *state)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5),
             h = lanes_set(in->thickness);
    resultant_result r;
    becker_noels_judge(at, in, state, &r);
    const vmask cracks = lanes_or(r.cracks[0], r.cracks[2]);
    const becker_noels_shares s = becker_noels_shares_of(in->thickness, state);
    const becker_noels_opening o = becker_noels_open(at, in, state, &s);
    const vd p = lanes_select(r.cracked, state->peak, at->sigma_c), energy = plane_energy(at, p),
             delta_c = (energy + energy) / p, reached = state->damage * delta_c;
    const vmask loading = lanes_lt(reached, o.effective),
                opened = lanes_or(loading, lanes_lt(zero, reached)), open = lanes_le(zero, o.d[0]);
    const vd damage = lanes_select(loading, plane_min(o.effective / delta_c, one), state->damage);
    const vd per = one / lanes_select(loading, o.effective, lanes_select(opened, reached, one));
    const vd factor = (one - damage) * per, midway = (one - half * (state->damage + damage)) * per;
    const vd pull = lanes_select(opened, o.pull, lanes_select(open, one, zero)),
             slide = lanes_select(opened, at->beta_c * o.d[1], one), way[2] = {pull, slide};
    for (int i = 0; i < 2; i++) { /* (cohesive.23) */
        const vd force = s.z[i] * way[i] * factor, mid = s.z[i] * way[i] * midway;
        r.n[i] = s.a[i] * force;
        r.m[i] = s.b[i] * force;
        r.midway_n[i] = s.a[i] * mid;
        r.midway_m[i] = s.b[i] * mid;
    }
    r.stored = half *
               (r.n[0] * o.jump[0] + r.m[0] * o.turn[0] + r.n[1] * o.jump[1] + r.m[1] * o.turn[1]);
    becker_noels_press(at, in->thickness, &o, r.cracked, s.closing, zero, &r);
    becker_noels_press(at, in->thickness, &o, lanes_lt(s.kept, zero), s.arm, s.kept, &r);
    r.breaks = lanes_and(lanes_and(r.cracked, lanes_le(one, damage)), lanes_lt(state->damage, one));
    r.created = lanes_select(cracks, r.stored - becker_noels_left(in), zero);
    r.spent = lanes_select(r.cracked, h * energy * (damage - state->damage), zero);
    r.damage = state->damage = lanes_select(r.cracked, damage, state->damage);
    r.dissipated = h * energy * r.damage;
    return r;
}

LANES_FUNCTION becker_noels_state becker_noels_load(const double *point)
{
    becker_noels_state state = {.damage = lanes_load(point + SURFACE_DAMAGE * LANES),
                                .peak = lanes_load(point + SURFACE_PEAK * LANES)};
    for (int i = 0; i < 2; i++) {
        state.jump[i] = lanes_load(point + resultant_place(BECKER_NOELS_JUMP + i));
        state.turn[i] = lanes_load(point + resultant_place(BECKER_NOELS_TURN + i));
        state.n[i] = lanes_load(point + resultant_place(BECKER_NOELS_N + i));
        state.m[i] = lanes_load(point + resultant_place(BECKER_NOELS_M + i));
    }
    return state;
}

LANES_FUNCTION resultant_result resultant_at_becker_noels(const plane_interface *at,
                                                          const resultant_input *in, double *point)
{
    becker_noels_state state = becker_noels_load(point);
    const resultant_result r = becker_noels(at, in, &state);
    if (at->calm) return r;
    for (int k = 0; k < RESULTANT_LAYERS; k++) {
        double *layer = point + k * RESULTANT_FIELDS * LANES;
        lanes_store(layer + SURFACE_DAMAGE * LANES, state.damage);
        lanes_store(layer + SURFACE_PEAK * LANES, state.peak);
    }
    for (int i = 0; i < 2; i++) {
        lanes_store(point + resultant_place(BECKER_NOELS_JUMP + i), state.jump[i]);
        lanes_store(point + resultant_place(BECKER_NOELS_TURN + i), state.turn[i]);
        lanes_store(point + resultant_place(BECKER_NOELS_N + i), state.n[i]);
        lanes_store(point + resultant_place(BECKER_NOELS_M + i), state.m[i]);
    }
    return r;
}

LANES_FUNCTION vd resultant_opening_becker_noels(const plane_interface *at,
                                                 const resultant_input *in, const double *point)
{
    const becker_noels_state state = becker_noels_load(point);
    const becker_noels_shares s = becker_noels_shares_of(in->thickness, &state);
    return becker_noels_open(at, in, &state, &s).effective / plane_critical_opening(at, state.peak);
}
#endif
#endif
