/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/support/plane_point.h"

#include "engine/cohesive/kernels.h"
#include "tests/support/lanes_of.h"

#define OF(lanes, field) .field = gathered(&(lanes)->field, sizeof *(lanes))
#define INTO(lanes, from, field) scatter(&(lanes)->field, sizeof *(lanes), (from).field)

/* The laws' memories. */
#define NITSCHE(X) X(damage) X(peak) X(slip) X(rub)
#define EXTRINSIC(X) NITSCHE(X) X(q_n) X(q_t) X(t_n) X(t_t)
#define TAKE(field) OF(state, field),
#define GIVE(field) INTO(state, s, field);

plane_unit LANES_UNIT(plane_call);

void LANES_UNIT(plane_call)(const plane_case *const *kind, const plane_at *in, plane_memory *state,
                            plane_out *out)
{
    plane_case kinds[LANES];
    double opened[LANES], whole[2][LANES];
    for (int l = 0; l < LANES; l++) {
        kinds[l] = *kind[l];
        opened[l] = in[l].opened;
        whole[0][l] = in[l].others_were_whole;
        whole[1][l] = in[l].others_are_whole;
    }
    plane_interface at = {
        OF(kinds, k_n),  OF(kinds, k_t),    OF(kinds, sigma_c), OF(kinds, beta_c),
        OF(kinds, mu_c), OF(kinds, energy), OF(kinds, opening), .onset_mean = kinds->onset_mean};
    at.softness_n = lanes_set(1.0) / at.k_n;
    at.softness_t = lanes_set(1.0) / at.k_t;
    at.per_beta_c = lanes_set(1.0) / at.beta_c;
    const plane_input input = {
        OF(in, m_n),
        OF(in, m_t),
        OF(in, q_n),
        OF(in, q_t),
        .opened = lanes_lt(lanes_set(0.0), gathered(opened, sizeof *opened)),
        .were_broken = lanes_le(gathered(whole[0], sizeof **whole), lanes_set(0.0)),
        .are_broken = lanes_le(gathered(whole[1], sizeof **whole), lanes_set(0.0))};
    const int friction = kinds->mu_c > 0;
    _Alignas(64) double point[SURFACE_POINT_FIELDS_MOST * LANES];
    plane_result r;
    if (kinds->law == PLANE_NITSCHE) {
        series_state s = {NITSCHE(TAKE)};
        r = plane_nitsche(&at, &input, friction, &s);
        NITSCHE(GIVE)
        lanes_store(point + SURFACE_PEAK * LANES, s.peak);
        scatter(&out->opening, sizeof *out, plane_opening_nitsche(&at, &input, point));
    } else {
        extrinsic_state s = {EXTRINSIC(TAKE)};
        r = plane_extrinsic(&at, &input, kinds->law == PLANE_STANDARD, friction, &s);
        EXTRINSIC(GIVE)
        lanes_store(point + SURFACE_PEAK * LANES, s.peak);
        lanes_store(point + EXTRINSIC_JUMP_N * LANES, s.q_n);
        lanes_store(point + EXTRINSIC_JUMP_T * LANES, s.q_t);
        scatter(&out->opening, sizeof *out, extrinsic_opening_at(&at, &input, point));
    }
    INTO(out, r, t_n);
    INTO(out, r, t_t);
    INTO(out, r, s_n);
    INTO(out, r, s_t);
    INTO(out, r, flux);
    INTO(out, r, stored);
    INTO(out, r, created);
    INTO(out, r, rubbed);
    INTO(out, r, dissipated);
    for (int l = 0; l < LANES; l++) {
        out[l].cracked = lanes_get(r.cracked, l) != 0;
        out[l].cracks = lanes_get(r.cracks, l) != 0;
        out[l].breaks = lanes_get(r.breaks, l) != 0;
        if (out[l].cracked) continue; /* as the sweep: the flux's own */
        const double t_n = in[l].m_n + kind[l]->k_n * in[l].q_n,
                     t_t = in[l].m_t + kind[l]->k_t * in[l].q_t;
        out[l].t_n = t_n;
        out[l].t_t = t_t;
        out[l].s_n = in[l].q_n;
        out[l].s_t = in[l].q_t;
        out[l].flux = 0.5 * (in[l].q_n * (in[l].m_n + t_n) + in[l].q_t * (in[l].m_t + t_t));
        out[l].stored = out[l].rubbed = out[l].dissipated = 0;
    }
}
