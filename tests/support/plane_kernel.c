/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/support/plane_point.h"

#include "engine/cohesive/kernels.h"

plane_unit LANES_UNIT(plane_call);

void LANES_UNIT(plane_call)(const plane_case *const *kind, const plane_at *in, plane_memory *state,
                            plane_out *out)
{
#define GATHER(name, from)                                  \
    _Alignas(64) double name##_lanes[LANES];                \
    for (int l = 0; l < LANES; l++) name##_lanes[l] = from; \
    const vd name = lanes_load(name##_lanes)
#define SCATTER(to, from)                               \
    do {                                                \
        _Alignas(64) double lanes_[LANES];              \
        lanes_store(lanes_, from);                      \
        for (int l = 0; l < LANES; l++) to = lanes_[l]; \
    } while (0)
    GATHER(k_n, kind[l]->k_n);
    GATHER(k_t, kind[l]->k_t);
    GATHER(sigma_c, kind[l]->sigma_c);
    GATHER(beta_c, kind[l]->beta_c);
    GATHER(mu_c, kind[l]->mu_c);
    GATHER(energy, kind[l]->energy);
    GATHER(opening, kind[l]->opening);
    GATHER(m_n, in[l].m_n);
    GATHER(m_t, in[l].m_t);
    GATHER(q_n, in[l].q_n);
    GATHER(q_t, in[l].q_t);
    GATHER(damage, state[l].damage);
    GATHER(peak, state[l].peak);
    GATHER(slip, state[l].slip);
    GATHER(rub, state[l].rub);
    GATHER(start_q_n, state[l].q_n);
    GATHER(start_q_t, state[l].q_t);
    GATHER(start_t_n, state[l].t_n);
    GATHER(start_t_t, state[l].t_t);
    const plane_interface at = {.k_n = k_n,
                                .k_t = k_t,
                                .sigma_c = sigma_c,
                                .beta_c = beta_c,
                                .mu_c = mu_c,
                                .energy = energy,
                                .opening = opening,
                                .softness_n = lanes_set(1.0) / k_n,
                                .softness_t = lanes_set(1.0) / k_t,
                                .per_beta_c = lanes_set(1.0) / beta_c,
                                .onset_mean = kind[0]->onset_mean};
    GATHER(opened, in[l].opened);
    const plane_input input = {
        .m_n = m_n, .m_t = m_t, .q_n = q_n, .q_t = q_t, .opened = lanes_lt(lanes_set(0.0), opened)};
    const int friction = kind[0]->mu_c > 0;
    plane_result r;
    if (kind[0]->law == PLANE_NITSCHE) {
        nitsche_state s = {.damage = damage, .peak = peak, .slip = slip, .rub = rub};
        r = plane_nitsche(&at, &input, friction, &s);
        SCATTER(state[l].damage, s.damage);
        SCATTER(state[l].peak, s.peak);
        SCATTER(state[l].slip, s.slip);
        SCATTER(state[l].rub, s.rub);
    } else {
        extrinsic_state s = {.damage = damage,
                             .peak = peak,
                             .q_n = start_q_n,
                             .q_t = start_q_t,
                             .t_n = start_t_n,
                             .t_t = start_t_t,
                             .slip = slip,
                             .rub = rub};
        r = plane_extrinsic(&at, &input, kind[0]->law == PLANE_STANDARD, friction, &s);
        SCATTER(state[l].damage, s.damage);
        SCATTER(state[l].peak, s.peak);
        SCATTER(state[l].q_n, s.q_n);
        SCATTER(state[l].q_t, s.q_t);
        SCATTER(state[l].t_n, s.t_n);
        SCATTER(state[l].t_t, s.t_t);
        SCATTER(state[l].slip, s.slip);
        SCATTER(state[l].rub, s.rub);
    }
    SCATTER(out[l].t_n, r.t_n);
    SCATTER(out[l].t_t, r.t_t);
    SCATTER(out[l].s_n, r.s_n);
    SCATTER(out[l].s_t, r.s_t);
    SCATTER(out[l].flux, r.flux);
    SCATTER(out[l].stored, r.stored);
    SCATTER(out[l].created, r.created);
    SCATTER(out[l].rubbed, r.rubbed);
    SCATTER(out[l].dissipated, r.dissipated);
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
