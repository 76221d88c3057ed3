/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gaussian fields of mean 0 and variance 1 with the covariance of a strength. */
#ifndef FRACAS_SAMPLER_FIELD_CORRELATION_H
#define FRACAS_SAMPLER_FIELD_CORRELATION_H

#include "base/own.h"
#include "sampler/strength.h"

typedef struct fracas_correlation fracas_correlation;

/* Field at n sites of these positions; `period` [m] > 0: x goes along a circle of this
 * circumference. The strength must name a covariance. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_correlation_create(const fracas_strength *strength, size_t n,
                                                     const double (*position)[3], double period,
                                                     fracas_correlation **correlation);
void fracas_correlation_destroy(fracas_correlation *correlation); /* NULL is allowed */
FRACAS_OWNER(fracas_correlation, fracas_correlation_destroy)

/* Independent normals of a realization, at least n: number k < n is for site k. */
size_t fracas_correlation_normals(const fracas_correlation *correlation);

/* z[n] = A w, w[fracas_correlation_normals]: A A^T has the diagonal 1, to 1e-12 + 2e-15 n.
 * FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_correlation_apply(const fracas_correlation *correlation,
                                                    const double *w, double *z);

/* As fracas_field_error. */
double fracas_correlation_error(const fracas_correlation *correlation);

#endif
