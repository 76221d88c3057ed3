/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How steeply the number of flaws grows with the stress: what Mott's size law knows of the
 * strengths. */
#ifndef FRACAS_ANALYSIS_SUMMARY_MODULUS_H
#define FRACAS_ANALYSIS_SUMMARY_MODULUS_H

#include "campaigns/points.h"

typedef struct {
    double value;       /* M, NaN: none */
    const char *reason; /* why there is none; NULL: there is one */
} fracas_modulus;

/* M = d ln n/d ln sigma = m sigma_c/(sigma_c - minimum) at the mean strength sigma_c, n(sigma) the
 * flaws per length that are weaker than sigma (size-laws.9). Of Weibull strengths m is the shape,
 * given or found from mean and deviation to 1e-9; of flaws in the body their exponent, if half of
 * all interfaces or more have one. Other distributions have none. length: of the body [m], a ring's
 * circumference. */
fracas_modulus fracas_modulus_of(const fracas_point_table *table, size_t point, double length);

#endif
