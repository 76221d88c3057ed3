/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Correlated parameters: a Gaussian copula. */
#ifndef FRACAS_SAMPLER_DESIGN_CORRELATION_H
#define FRACAS_SAMPLER_DESIGN_CORRELATION_H

#include "sampler/probability.h"

#include <stdbool.h>
#include <stddef.h>

/* The lower triangle L, L L^T = C, of the correlation matrix C, n x n, symmetric with ones on its
 * diagonal; above it, 0. False if C is not positive definite: parameter `*at`, the first in
 * conflict with those before it, keeps a fraction `*rest` <= 1e-9 of its variance. */
bool fracas_correlation_factor(size_t n, const double *correlation, double *factor, size_t *at,
                               double *rest);

/* Turns independent coordinates p[n] of a point into correlated ones; a coordinate without
 * correlation to those before it stays as it is. `z`: room for n numbers. */
void fracas_correlate(size_t n, const double *factor, double *z, fracas_probability *p);

#endif
