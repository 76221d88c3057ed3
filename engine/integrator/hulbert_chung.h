/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The explicit generalised-alpha scheme of Hulbert and Chung (1996), forces at t_n only. */
#ifndef FRACAS_ENGINE_INTEGRATOR_HULBERT_CHUNG_H
#define FRACAS_ENGINE_INTEGRATOR_HULBERT_CHUNG_H

/*   M [(1 - am) a_{n+1} + am a_n] = F(u_n, t_n),  a_0 = M^-1 F(u_0, 0)             (membrane.14)
 *   u_{n+1} = u_n + dt v_n + dt^2 [(1/2 - b) a_n + b a_{n+1}]
 *   v_{n+1} = v_n + dt [(1 - g) a_n + g a_{n+1}]                                    (membrane.15)
 * with the spectral radius r at the bifurcation, 0 <= r <= 1: am = (2 r - 1)/(1 + r),
 * b = (5 - 3 r)/((1 + r)^2 (2 - r)), g = 3/2 - am. r = 1 leaves a spurious root undamped.
 *
 * With <x, y> = x.M y, the kinetic energy of a linear body and the energy damped up to t_n are
 *   kinetic = 1/2 <v-, v+> + dt^2 e/2 (<a_n, a_n> - <a_{n+1} - a_n, a_{n+1} - a_n> (1 - am)/2)
 *   v- = v_n - dt/2 a_n,   v+ = v- + dt M^-1 F(u_n, t_n),   e = b + am - 1       (membrane.20)
 *   damped  = sum over steps dt^2/4 ((1 - r)/(1 + r))^3 <d, d>,  d = a_{n+1} - a_{n-1}
 *                                                                                (membrane.21) */
typedef struct {
    double alpha_m, beta, gamma; /* 1 */
    double excess, damping;      /* 1: e; ((1 - r)/(1 + r))^3 */
    double limit;                /* 1: stable for omega dt below this, of an undamped body */
} fracas_hulbert_chung;

/* limit = sqrt(12 (1 + r)(2 - r)/(10 - 5 r + r^2)); the published one is slightly above it. */
fracas_hulbert_chung fracas_hulbert_chung_of(double spectral_radius);

#endif
