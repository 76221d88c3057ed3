/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The incomplete gamma functions and their inverse, same bits on every CPU.
 *
 * P(a, x) = integral_0^x t^(a-1) e^-t dt / Gamma(a), Q = 1 - P: the distribution function of a
 * gamma variable of shape a, and how likely it is to be exceeded. 0.001 <= a <= 1e6, x >= 0. */
#ifndef FRACAS_SAMPLER_INCOMPLETE_GAMMA_H
#define FRACAS_SAMPLER_INCOMPLETE_GAMMA_H

#include "sampler/probability.h"

/* P and Q. For a >= 0.1 both are within 1e-13 relative at the given x while above 1e-17, for a up
 * to 1e6; P stays so for smaller a. (x itself, rounded, moves them by up to sqrt(a) 1e-15.) */
void fracas_incomplete_gamma(double a, double x, double *lower, double *upper);

/* The x with P(a, x) = p.below, Q(a, x) = p.above, a >= 0.1, to 5e-14 relative for tails from 2^-53
 * on. */
double fracas_incomplete_gamma_inverse(double a, fracas_probability p);

/* The x with Q(a, x) = e^-t, t >= 40 (beyond 745 the probability is no double), a >= 0.1, to 5e-14
 * relative. */
double fracas_incomplete_gamma_far(double a, double t);

/* integral_0^1 exp(-mu x^p) dx = Gamma(1 + 1/p) mu^(-1/p) P(1/p, mu), mu >= 0 and 0.25 <= p <=
 * 1000, to 1e-14 relative. */
double fracas_stretched_exponential(double mu, double p);

#endif
