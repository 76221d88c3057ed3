/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The weakest-link size effect: an interface of an extent `size` times the reference is as strong
 * as the weakest of `size` of them, P(strength > s) = P_reference(strength > s)^size, whether or
 * not `size` is a whole number. */
#ifndef FRACAS_SAMPLER_SIZE_H
#define FRACAS_SAMPLER_SIZE_H

#include "sampler/distribution/distribution.h"

/* extent/reference; 1 without a reference. */
double fracas_size_of(const fracas_strength *strength, fracas_extent extent);

/* F^-1 [Pa] of the weakest of `size`. */
double fracas_size_quantile(const fracas_strength *strength, double size, fracas_probability p);

/* Their mean and standard deviation; without a closed form by a quadrature within 1e-12
 * relative. */
fracas_moments fracas_size_moments(const fracas_strength *strength, double size);

#endif
