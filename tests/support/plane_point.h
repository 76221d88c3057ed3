/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cohesive laws of a point that opens and slides, called with plain numbers. */
#ifndef FRACAS_TESTS_SUPPORT_PLANE_POINT_H
#define FRACAS_TESTS_SUPPORT_PLANE_POINT_H

#include "base/isa.h"

#include <math.h>

/* sqrt(max(0, n)^2 + (t/beta_c)^2)  (cohesive.10) */
static inline double effective_of(const double traction[2], double beta_c)
{
    return hypot(fmax(0, traction[0]), traction[1] / beta_c);
}

/* The traction compared with the strength  (cohesive.11) */
static inline double judged_of(const double traction[2], double beta_c, double mu_c)
{
    return traction[0] >= 0 ? effective_of(traction, beta_c)
                            : fmax(0, fabs(traction[1]) - mu_c * fabs(traction[0])) / beta_c;
}

typedef enum { PLANE_NITSCHE, PLANE_STANDARD, PLANE_PAPER } plane_test_law;

typedef struct {
    plane_test_law law;
    double k_n, k_t, sigma_c, beta_c, mu_c;
    double energy, opening; /* G_c, or delta_c: the other is 0 */
    int onset_mean;
} plane_case;

typedef struct {
    double m_n, m_t, q_n, q_t;
    int opened;                              /* another layer is */
    int others_were_whole, others_are_whole; /* before this step, after it */
} plane_at;

typedef struct {
    double damage, peak, slip, rub, q_n, q_t, t_n, t_t;
} plane_memory;

typedef struct {
    double t_n, t_t, s_n, s_t, flux, stored, created, rubbed, dissipated;
    double opening; /* over that of the break, once it has cracked */
    int cracked, cracks, breaks;
} plane_out;

/* A unit (base/isa.h) of tests/support/plane_kernel.c: `in`, `state` and `out` are [lane], and all
 * lanes are of one kind of law. */
typedef void plane_unit(const plane_case *const *kind, const plane_at *in, plane_memory *state,
                        plane_out *out);
plane_unit plane_call_baseline_1;

#endif
