/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cohesive laws at a point of an interface that opens (n) and slides (t), over lanes
 * (docs/theory/cohesive.md).
 *
 * Common to them: strength sigma_c; peak p, the effective traction at onset, 0 before; delta_c =
 * 2 G_c/p, or delta_c the same everywhere and G_c = p delta_c/2; D = delta_max/delta_c; beta_c =
 * shear strength/normal strength; stiffnesses k_n and k_t = beta_c^2 k_n of the flux; mean
 * tractions m, jumps q.
 *   effective traction  S = sqrt(max(0, T_n)^2 + (T_t/beta_c)^2)                  (cohesive.10)
 *   onset  S > sigma_c for T_n >= 0, max(0, |T_t| - mu_c |T_n|)/beta_c > sigma_c for T_n < 0, of
 *       the flux T = m + k q, or of the mean T = m                                (cohesive.11) */
#ifndef FRACAS_ENGINE_COHESIVE_PLANE_H
#define FRACAS_ENGINE_COHESIVE_PLANE_H

#include "engine/cohesive/energy.h"

typedef struct {
    vd k_n, k_t;               /* Pa/m */
    vd sigma_c;                /* Pa */
    vd softness_n, softness_t; /* 1/k_n, 1/k_t [m/Pa] */
    vd beta_c, per_beta_c;     /* 1: beta_c, 1/beta_c */
    vd mu_c;                   /* 1 */
    vd energy, opening;        /* G_c [J/m2], 2 G_c/p [m]: one is given, the other 0 */
    int onset_mean;            /* onset of the mean; else of the flux */
    int friction;              /* mu_c > 0 */
    const double *own;         /* the law's own numbers (trait `own`) */
    /* A constant of each call. In a calm step the law may take it that there is no friction, onset
     * or break, and that D alone changes: it stores nothing. `cracks`, `breaks` say where it errs.
     */
    int calm;
} plane_interface;

typedef struct {
    vd m_n, m_t;  /* Pa */
    vd q_n, q_t;  /* m */
    vmask opened; /* flux held against strength, even with onset_mean: by a shell's open layer */
    /* All layers of the Gauss point were broken before this step, are after it: only then a broken
     * one loses its mean. True where there is one layer. */
    vmask were_broken, are_broken;
} plane_input;

typedef struct {
    vd n, t; /* Pa */
} plane_traction;

typedef struct {
    vd damage;          /* D after the step */
    vd t_n, t_t;        /* traction T [Pa] */
    vd s_n, s_t;        /* the flux's part of the jump [m]; 0 once it is left */
    vd flux, stored;    /* energies of the flux, and in openings and contact [J/m2] */
    vd dissipated;      /* G_c D [J/m2] */
    vd created, rubbed; /* this step's energy put in by onset or break, lost to friction [J/m2] */
    vmask cracked; /* past onset: the above holds; elsewhere the flux's own T = m + k q, s = q */
    vmask cracks, breaks; /* in this step */
    /* For shells: energy dissipated in this step [J/m2], and the traction at the D halfway through
     * it [Pa]. */
    vd spent, midway_n, midway_t;
} plane_result;

LANES_FUNCTION vd plane_max(vd a, vd b)
{
    return lanes_max(a, b);
}
LANES_FUNCTION vd plane_min(vd a, vd b)
{
    return lanes_min(a, b);
}
LANES_FUNCTION vd plane_abs(vd a)
{
    return plane_max(a, lanes_set(0.0) - a);
}

/* S^2  (cohesive.10) */
LANES_FUNCTION vd plane_effective(const plane_interface *at, vd t_n, vd t_t)
{
    vd pull = plane_max(t_n, lanes_set(0.0)), shear = t_t * at->per_beta_c;
    return pull * pull + shear * shear;
}

/* Square of the effective traction held against sigma_c  (cohesive.11) */
LANES_FUNCTION vd plane_onset(const plane_interface *at, vd t_n, vd t_t)
{
    const vd zero = lanes_set(0.0);
    if (at->calm) return plane_effective(at, t_n, t_t); /* the same for mu_c = 0 */
    return plane_effective(at, t_n,
                           plane_max(zero, plane_abs(t_t) + at->mu_c * plane_min(t_n, zero)));
}

/* T = m + k q of the flux. */
LANES_FUNCTION plane_traction plane_flux(const plane_interface *at, const plane_input *in)
{
    return (plane_traction){in->m_n + at->k_n * in->q_n, in->m_t + at->k_t * in->q_t};
}

/* The traction that is held against sigma_c: that of the flux, or the mean  (cohesive.11) */
LANES_FUNCTION plane_traction plane_held(const plane_interface *at, const plane_input *in)
{
    const plane_traction flux = plane_flux(at, in);
    if (!at->onset_mean) return flux;
    return (plane_traction){lanes_select(in->opened, flux.n, in->m_n),
                            lanes_select(in->opened, flux.t, in->m_t)};
}

/* G_c of a point with this peak [J/m2]. */
LANES_FUNCTION vd plane_energy(const plane_interface *at, vd peak)
{
    return cohesive_energy(at->energy, at->opening, peak);
}

/* 2 G_c/p of a point with this peak [m]: delta_c of linear softening. */
LANES_FUNCTION vd plane_critical_opening(const plane_interface *at, vd peak)
{
    const vd zero = lanes_set(0.0);
    return lanes_select(lanes_lt(zero, at->opening), at->opening, (at->energy + at->energy) / peak);
}

#endif
