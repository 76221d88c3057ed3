/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The normal distribution, same bits on every CPU. */
#ifndef FRACAS_SAMPLER_NORMAL_H
#define FRACAS_SAMPLER_NORMAL_H

#include "sampler/probability.h"

/* Phi^-1(p.below) to 1e-15 relative: algorithm AS 241, routine PPND16 (Wichura, Applied Statistics
 * 37, 477-484, 1988). */
double fracas_normal_quantile(fracas_probability p);

/* P(Z > z) of a standard normal Z, any z, to 2e-15 relative. P(Z <= z): fracas_normal_upper(-z). */
double fracas_normal_upper(double z);

/* The z with P(Z > z) = e^-t, t >= 600 (beyond 745 the probability is no double); to 1e-15
 * relative. */
double fracas_normal_far(double t);

#endif
