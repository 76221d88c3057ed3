/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gaussian fields on equally spaced sites: the square root of a circulant matrix, by Fourier
 * transforms. */
#ifndef FRACAS_SAMPLER_CIRCULANT_H
#define FRACAS_SAMPLER_CIRCULANT_H

#include "base/own.h"
#include "sampler/field/covariance.h"

typedef struct fracas_circulant fracas_circulant;

/* Field at n >= 3 sites on a circle of this radius, at equal angles; d is the chord.
 * FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_circulant_circle(const fracas_covariance *covariance, size_t n,
                                                   double radius, fracas_circulant **circulant);

/* Field at n >= 3 sites on a line, `spacing` [m] apart: a part of a circle of more sites. If no
 * circle in reach makes the covariance positive, the nearest one is taken, with variance 1.
 * FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_circulant_line(const fracas_covariance *covariance, size_t n,
                                                 double spacing, fracas_circulant **circulant);
void fracas_circulant_destroy(fracas_circulant *circulant); /* NULL is allowed */
FRACAS_OWNER(fracas_circulant, fracas_circulant_destroy)

/* Number of sites of the circle: independent normals of a realization. */
size_t fracas_circulant_normals(const fracas_circulant *circulant);

/* The largest difference between the field's correlation and the covariance, at any distance of two
 * sites. */
double fracas_circulant_error(const fracas_circulant *circulant);

/* z[0 ... n-1] = A w, A A^T the covariance of the circle, w[fracas_circulant_normals].
 * FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_circulant_apply(const fracas_circulant *circulant,
                                                  const double *w, double *z);

#endif
