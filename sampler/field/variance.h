/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A field drawn from coarse to fine, and its variances. */
#ifndef FRACAS_SAMPLER_VARIANCE_H
#define FRACAS_SAMPLER_VARIANCE_H

#include "sampler/field/dense_factor.h"
#include "sampler/field/sparse_factor.h"

/* value[k], by place in the order of drawing: of the first `coarse` places L w, with the dense
 * factor; of each further one sum_a weight[a] value[near[a]] + rest w_k, a < FRACAS_NEAR_SITES. */
typedef struct {
    size_t n, coarse;
    fracas_dense_factor dense;
    uint32_t *near; /* [(n - coarse)*FRACAS_NEAR_SITES] places */
    double *weight; /* [(n - coarse)*FRACAS_NEAR_SITES] */
    double *rest;   /* [n - coarse] */
} fracas_unscaled_factor;

/* variance[k], k < n, exactly but for rounding; site order[k] is at place k. FRACAS_ENVIRONMENT
 * without memory. */
FRACAS_MUST_USE fracas_err fracas_unscaled_variances(const fracas_unscaled_factor *field,
                                                     const uint32_t *order,
                                                     const double (*position)[3], double *variance);

#endif
