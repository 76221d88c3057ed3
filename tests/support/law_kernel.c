/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/support/law_point.h"

#include "engine/cohesive/kernels.h"
#include "tests/support/lanes_of.h"

#define OF(lanes, field) gathered(&(lanes)->field, sizeof *(lanes))
#define INTO(field, from) scatter(&out->field, sizeof *out, from)

static void store_masks(law_out *out, vmask cracked, vmask cracks, vmask breaks)
{
    for (int l = 0; l < LANES; l++) {
        out[l].cracked = lanes_get(cracked, l) != 0;
        out[l].cracks = lanes_get(cracks, l) != 0;
        out[l].breaks = lanes_get(breaks, l) != 0;
    }
}

/* What an interface of a chain does is one-dimensional: it has no shear. */
static void store_line(law_out *out, vd before, const vd now)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    INTO(damage, now);
    INTO(t_t, zero);
    INTO(s_t, zero);
    store_masks(out, lanes_lt(zero, now), lanes_and(lanes_lt(zero, now), lanes_le(before, zero)),
                lanes_and(lanes_lt(before, one), lanes_le(one, now)));
}

/* Energies as those of bar_flux  (cohesive.5), (cohesive.6). */
static void line_point(int law, const law_case *kind, const law_at *at, double *value, law_out *out)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    const vd mean = OF(at, m_n), q = OF(at, q_n), before = lanes_load(value), k = OF(kind, k_n);
    const line_input in = {.mean = mean,
                           .jump = q,
                           .damage = before,
                           .sigma_c = OF(kind, sigma_c),
                           .constant = OF(kind, constant),
                           .stiffness = k,
                           .compliance = one / k,
                           .own = kind->own};
    const line_result it = line_law(law, &in);
    lanes_store(value, it.damage);
    store_line(out, before, it.damage);
    INTO(t_n, it.traction);
    INTO(s_n, it.slip);
    INTO(flux, half * it.slip * (mean + it.traction));
    INTO(stored, half * it.traction * (q - it.slip));
    INTO(dissipated, OF(kind, energy) * it.dissipated);
    INTO(created, lanes_select(lanes_and(lanes_lt(before, one), lanes_le(one, it.damage)),
                               half * mean * mean / k, zero));
    INTO(peak, OF(kind, sigma_c));
    INTO(opening, (it.past_onset + in.sigma_c) / (it.softening + in.sigma_c));
}

static void link_point(const law_case *kind, const law_at *at, double *value, law_out *out)
{
    const vd zero = lanes_set(0.0), half = lanes_set(0.5);
    const vd before = lanes_load(value), q = OF(at, q_n), sigma_c = OF(kind, sigma_c);
    const vd energy = OF(kind, energy), delta_c = (energy + energy) / sigma_c;
    vd damage = before;
    const vd traction = rigid_link_law(q, &damage, sigma_c, delta_c, OF(kind, k_n));
    lanes_store(value, damage);
    store_line(out, before, damage);
    INTO(t_n, traction);
    INTO(s_n, zero);
    INTO(flux, zero);
    INTO(stored, half * traction * q);
    INTO(dissipated, energy * damage);
    INTO(created, zero);
    INTO(peak, sigma_c);
    INTO(opening, q / delta_c);
}

LANES_FUNCTION plane_interface interface_of(const law_case *kind)
{
    plane_interface at = {.k_n = OF(kind, k_n),
                          .k_t = OF(kind, k_t),
                          .sigma_c = OF(kind, sigma_c),
                          .beta_c = OF(kind, beta_c),
                          .mu_c = lanes_set(0.0),
                          .energy = OF(kind, energy),
                          .opening = lanes_set(0.0),
                          .onset_mean = kind->onset_mean,
                          .own = kind->own};
    at.softness_n = lanes_set(1.0) / at.k_n;
    at.softness_t = lanes_set(1.0) / at.k_t;
    at.per_beta_c = lanes_set(1.0) / at.beta_c;
    return at;
}

/* Where it has not cracked the flux holds, as in the sweep. */
static void store_surface(law_out *out, const law_at *in, const plane_interface *at,
                          const plane_result *r)
{
    const vd half = lanes_set(0.5), zero = lanes_set(0.0), m_n = OF(in, m_n), m_t = OF(in, m_t),
             q_n = OF(in, q_n), q_t = OF(in, q_t), flux_n = m_n + at->k_n * q_n,
             flux_t = m_t + at->k_t * q_t;
    INTO(t_n, lanes_select(r->cracked, r->t_n, flux_n));
    INTO(t_t, lanes_select(r->cracked, r->t_t, flux_t));
    INTO(s_n, lanes_select(r->cracked, r->s_n, q_n));
    INTO(s_t, lanes_select(r->cracked, r->s_t, q_t));
    INTO(flux,
         lanes_select(r->cracked, r->flux, half * (q_n * (m_n + flux_n) + q_t * (m_t + flux_t))));
    INTO(stored, lanes_select(r->cracked, r->stored, zero));
    INTO(dissipated, r->dissipated);
    INTO(created, r->created);
    INTO(damage, r->damage);
    store_masks(out, r->cracked, r->cracks, r->breaks);
}

static void plane_point(int law, const law_case *kind, const law_at *in, double *value,
                        law_out *out)
{
    const plane_interface at = interface_of(kind);
    const vmask all = lanes_le(lanes_set(0.0), lanes_set(0.0));
    const plane_input input = {.m_n = OF(in, m_n),
                               .m_t = OF(in, m_t),
                               .q_n = OF(in, q_n),
                               .q_t = OF(in, q_t),
                               .opened = lanes_lt(lanes_set(0.0), lanes_set(0.0)),
                               .were_broken = all,
                               .are_broken = all};
    const plane_result r = plane_law(law, &at, &input, value);
    store_surface(out, in, &at, &r);
    INTO(peak, lanes_load(value + SURFACE_PEAK * LANES));
    INTO(opening, plane_opening(law, &at, &input, value));
}

/* Membrane forces alone: N/h and the jumps are a point's. */
static void resultant_point(int law, const law_case *kind, const law_at *in, double *value,
                            law_out *out)
{
    const plane_interface at = interface_of(kind);
    const vd zero = lanes_set(0.0), h = lanes_set(kind->thickness),
             m[2] = {OF(in, m_n), OF(in, m_t)}, q[2] = {OF(in, q_n), OF(in, q_t)},
             k[2] = {at.k_n, at.k_t};
    resultant_input input = {.thickness = kind->thickness};
    for (int i = 0; i < 2; i++) {
        input.jump[i] = q[i];
        input.turn[i] = input.mean_m[i] = input.flux_m[i] = zero;
        input.mean_n[i] = h * m[i];
        input.flux_n[i] = h * (m[i] + k[i] * q[i]);
    }
    const resultant_result r = resultant_law(law, &at, &input, value);
    const plane_result as_point = {.damage = r.damage,
                                   .t_n = r.n[0] / h,
                                   .t_t = r.n[1] / h,
                                   .s_n = zero,
                                   .s_t = zero,
                                   .flux = zero,
                                   .stored = r.stored / h,
                                   .dissipated = r.dissipated / h,
                                   .created = r.created / h,
                                   .cracked = r.cracked,
                                   .cracks = lanes_or(r.cracks[0], r.cracks[2]),
                                   .breaks = r.breaks};
    store_surface(out, in, &at, &as_point);
    INTO(peak, lanes_load(value + SURFACE_PEAK * LANES));
    INTO(opening, resultant_opening(law, &at, &input, value));
}

law_unit LANES_UNIT(law_call);

void LANES_UNIT(law_call)(const law_case *const *kind, const law_at *in, law_memory *memory,
                          law_out *out)
{
    enum { VALUES = sizeof memory->value / sizeof *memory->value };
    law_case kinds[LANES];
    _Alignas(64) double value[VALUES * LANES];
    for (int l = 0; l < LANES; l++) {
        kinds[l] = *kind[l];
        for (int v = 0; v < VALUES; v++) value[v * LANES + l] = memory[l].value[v];
    }
    const int law = kinds->law;
    switch (kinds->form) {
    case LAW_LINE: line_point(law, kinds, in, value, out); break;
    case LAW_LINK: link_point(kinds, in, value, out); break;
    case LAW_PLANE: plane_point(law, kinds, in, value, out); break;
    case LAW_RESULTANTS: resultant_point(law, kinds, in, value, out); break;
    }
    for (int l = 0; l < LANES; l++)
        for (int v = 0; v < VALUES; v++) memory[l].value[v] = value[v * LANES + l];
}
