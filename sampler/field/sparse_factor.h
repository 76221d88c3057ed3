/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gaussian fields on scattered sites: a sparse factor of the inverse of their covariance. */
#ifndef FRACAS_SAMPLER_SPARSE_FACTOR_H
#define FRACAS_SAMPLER_SPARSE_FACTOR_H

#include "base/own.h"
#include "sampler/field/covariance.h"

enum {
    FRACAS_DENSE_SITES = 1000, /* the coarsest sites, whose covariance is factorised as a whole */
    FRACAS_NEAR_SITES = 50,    /* coarser sites from which each of the others is drawn */
};

typedef struct fracas_sparse_factor fracas_sparse_factor;

/* Field at n sites anywhere. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_sparse_factor_create(const fracas_covariance *covariance,
                                                       size_t n, const double (*position)[3],
                                                       fracas_sparse_factor **factor);
void fracas_sparse_factor_destroy(fracas_sparse_factor *factor); /* NULL is allowed */
FRACAS_OWNER(fracas_sparse_factor, fracas_sparse_factor_destroy)

/* The largest difference between the field's correlation and the covariance: of all pairs of up to
 * FRACAS_DENSE_SITES sites; of more, of the pairs of 128 sites with all. */
double fracas_sparse_factor_error(const fracas_sparse_factor *factor);

/* z = A w, of n normals w; the diagonal of A A^T is 1. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_sparse_factor_apply(const fracas_sparse_factor *factor,
                                                      const double *w, double *z);

/* correlation[i] = (A A^T)[site][i]. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_sparse_factor_correlation(const fracas_sparse_factor *factor,
                                                            size_t site, double *correlation);

#endif
