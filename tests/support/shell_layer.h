/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A layer of a shell's interface with the law `nitsche`, written anew from docs/theory/cohesive.md
 * and shell.md. */
#ifndef FRACAS_TESTS_SUPPORT_SHELL_LAYER_H
#define FRACAS_TESTS_SUPPORT_SHELL_LAYER_H

#include "tests/support/plane.h"

typedef struct {
    double widest, peak; /* delta_max [m], p [Pa] */
    plane_memory rubbed; /* with friction, by the law that test_plane_laws verifies */
} layer;

/* A step of a layer. */
typedef struct {
    double t[2], s[2], flux, stored, dissipated, created, rubbed, spent, midway[2];
    int cracked, loads, broken, breaks, cut, pressed;
} layer_answer;

typedef struct {
    double k[2], sigma_c, beta_c, mu_c, energy, opening;
    int by_mean;
} layer_law;

/* Energies of a traction that the law gave: of the flux s, stored in the opening q - s. */
static inline void energies_of(const layer_law *law, const double m[2], const double q[2],
                               layer_answer *a)
{
    a->flux = a->stored = 0;
    for (int i = 0; i < 2; i++) {
        a->s[i] = (a->t[i] - m[i]) / law->k[i];
        a->flux += m[i] * a->s[i] + 0.5 * law->k[i] * a->s[i] * a->s[i];
        a->stored += 0.5 * a->t[i] * (q[i] - a->s[i]);
    }
}

/* Layers of its Gauss point, itself included: some had cracked before; all had broken before; all
 * have broken now. */
typedef struct {
    bool opened, were_broken, are_broken;
} layer_beside;

/* Without friction, by openings: theory of the law, not its code. */
static inline layer_answer layer_of(const layer_law *law, layer *x, const double mean[2],
                                    const double q[2], layer_beside beside)
{
    const bool opened = beside.opened;
    layer_answer a = {.spent = 0};
    const double old_c = law->opening > 0 ? law->opening
                                          : 2 * law->energy / x->peak; /* of the peak it had */
    const int was_broken = x->peak > 0 && x->widest >= old_c;
    const bool parted = beside.were_broken;
    const double m[2] = {parted ? 0 : mean[0], parted ? 0 : mean[1]},
                 trial[2] = {m[0] + law->k[0] * q[0], m[1] + law->k[1] * q[1]};
    const double s = effective_of(trial, law->beta_c);
    double whole = 0;
    for (int i = 0; i < 2; i++) whole += q[i] * (m[i] + 0.5 * law->k[i] * q[i]);
    if (x->peak == 0 &&
        judged_of(law->by_mean && !opened ? mean : trial, law->beta_c, 0) > law->sigma_c) {
        const double most = law->opening > 0 ? 0.5 * law->k[0] * law->opening
                                             : sqrt(law->k[0] * law->energy);
        const double late = opened ? 0 : judged_of(mean, law->beta_c, 0) - law->sigma_c;
        x->peak = law->by_mean ? fmax(judged_of(trial, law->beta_c, 0) - late, law->sigma_c)
                               : law->sigma_c;
        a.cut = x->peak > most;
        x->peak = fmin(x->peak, most);
    }
    a.pressed = trial[0] < 0;
    if (x->peak == 0) {
        for (int i = 0; i < 2; i++) a.midway[i] = a.t[i] = trial[i], a.s[i] = q[i];
        a.flux = whole;
        return a;
    }
    const double p = x->peak, delta_c = law->opening > 0 ? law->opening : 2 * law->energy / p,
                 was = x->widest;
    const double reach = (s - p) / (law->k[0] - p / delta_c);
    double factor, midway;
    a.cracked = 1;
    if (reach > x->widest) {
        a.loads = 1;
        x->widest = fmin(reach, delta_c);
        factor = p * (1 - x->widest / delta_c) / s;
        midway = p * (1 - 0.5 * (was + x->widest) / delta_c) / s;
    } else {
        const double stiff = x->widest > 0 ? p * (1 - x->widest / delta_c) / x->widest : INFINITY;
        midway = factor = isinf(stiff) ? 1 : stiff / (law->k[0] + stiff);
    }
    for (int i = 0; i < 2; i++) {
        const int kept = i == 0 && trial[0] < 0;
        a.t[i] = trial[i] * (kept ? 1 : factor);
        a.midway[i] = trial[i] * (kept ? 1 : midway);
    }
    energies_of(law, m, q, &a);
    a.dissipated = 0.5 * p * x->widest;
    a.spent = 0.5 * p * (x->widest - was);
    if (a.cut) a.created = a.flux + a.stored + a.dissipated - whole;
    if (x->widest >= delta_c) {
        const double held = a.flux + a.stored;
        a.broken = 1;
        a.breaks = !was_broken;
        if (!beside.are_broken) return a; /* its mean stays */
        a.t[0] = law->k[0] * fmin(0, q[0]);
        a.t[1] = a.s[0] = a.s[1] = a.flux = 0;
        a.stored = 0.5 * law->k[0] * fmin(0, q[0]) * fmin(0, q[0]);
        if (!parted) a.created += a.stored - held;
    }
    return a;
}

static inline layer_answer rubbed_layer(const layer_law *law, layer *x, const double mean[2],
                                        const double q[2], layer_beside beside)
{
    const plane_case kind = {.law = PLANE_NITSCHE,
                             .k_n = law->k[0],
                             .k_t = law->k[1],
                             .sigma_c = law->sigma_c,
                             .beta_c = law->beta_c,
                             .mu_c = law->mu_c,
                             .energy = law->energy,
                             .opening = law->opening,
                             .onset_mean = law->by_mean};
    const plane_case *kinds[] = {&kind};
    const plane_at at = {.m_n = mean[0],
                         .m_t = mean[1],
                         .q_n = q[0],
                         .q_t = q[1],
                         .opened = beside.opened,
                         .others_were_whole = !beside.were_broken,
                         .others_are_whole = !beside.are_broken};
    const double was = x->rubbed.damage;
    plane_out out;
    plane_call_baseline_1(kinds, &at, &x->rubbed, &out);
    layer_answer a = {.t = {out.t_n, out.t_t},
                      .s = {out.s_n, out.s_t},
                      .flux = out.flux,
                      .stored = out.stored,
                      .dissipated = out.dissipated,
                      .created = out.created,
                      .rubbed = out.cracked ? out.rubbed : 0,
                      .cracked = out.cracked,
                      .loads = x->rubbed.damage > was,
                      .broken = out.cracked && x->rubbed.damage >= 1,
                      .breaks = out.breaks,
                      .pressed = out.t_n < 0};
    x->peak = x->rubbed.peak;
    return a;
}

#endif
