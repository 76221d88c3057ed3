/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Student's t distribution for whole degrees of freedom, same bits on every CPU. */
#ifndef FRACAS_SAMPLER_STUDENT_H
#define FRACAS_SAMPLER_STUDENT_H

#include <stdint.h>

/* P(|T| <= t) of Student's T with `nu` >= 1 degrees of freedom, where t = sqrt(nu) tan(pi x), 0 <=
 * x <= 1/2: a finite sum of powers of cos(pi x) (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4), to
 * 1e-15 + 1e-16 nu. */
double fracas_student_within(double x, int64_t nu);

/* The t with P(|T| <= t) = confidence, for nu >= 1 and 0 < confidence < 1: half the width of a t
 * interval is t s/sqrt(n) with nu = n - 1. To 1e-12 relative for confidence from 0.5 to 0.999; NaN
 * outside of the ranges. */
double fracas_student_quantile(double confidence, int64_t nu);

#endif
