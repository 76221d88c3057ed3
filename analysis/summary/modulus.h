/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Growth of the number of flaws with the stress, for Mott's scaling law. */
#ifndef FRACAS_ANALYSIS_SUMMARY_MODULUS_H
#define FRACAS_ANALYSIS_SUMMARY_MODULUS_H

#include "campaigns/points.h"

typedef struct {
    double value;       /* M, NaN: none */
    const char *reason; /* why there is none; NULL: there is one */
} fracas_modulus;

/* M = d ln n/d ln sigma = m sigma_c/(sigma_c - minimum) at the mean strength sigma_c, n(sigma) the
 * flaws per length weaker than sigma (scaling-laws.9). For Weibull strengths m is the shape, given
 * or found from mean and deviation to 1e-9; for flaws in the body their exponent, if half of all
 * interfaces or more have one. Other distributions have none. length: of the body [m], a ring's
 * circumference. */
fracas_modulus fracas_modulus_of(const fracas_point_table *table, size_t point, double length);

#endif
