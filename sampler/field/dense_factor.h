/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cholesky factor of a covariance matrix, singular ones included. */
#ifndef FRACAS_SAMPLER_DENSE_FACTOR_H
#define FRACAS_SAMPLER_DENSE_FACTOR_H

#include "sampler/field/covariance.h"

#include <math.h>
#include <stdint.h>

typedef struct {
    size_t n, rank;
    double *row; /* [n*rank] L, 0 above its diagonal */
} fracas_dense_factor;

/* L L^T = the correlations of the sites order[0 ... n-1] at these positions, which are put in the
 * order of their pivots; each row of L has the norm 1. FRACAS_ENVIRONMENT without memory; the
 * factor is to be cleared whatever is returned. */
FRACAS_MUST_USE fracas_err fracas_dense_factor_init(const fracas_covariance *covariance,
                                                    const double (*position)[3], size_t n,
                                                    uint32_t *order, fracas_dense_factor *factor);
void fracas_dense_factor_clear(fracas_dense_factor *factor);

/* (L L^T)[i][j] */
double fracas_dense_factor_product(const fracas_dense_factor *factor, size_t i, size_t j);

/* |a - b| [m] */
static inline double fracas_distance(const double a[3], const double b[3])
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* a.b in a fixed order, n >= 0 */
double fracas_dot(size_t n, const double *a, const double *b);

#endif
