/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How alike strengths are at a distance. */
#ifndef FRACAS_SAMPLER_COVARIANCE_H
#define FRACAS_SAMPLER_COVARIANCE_H

#include "base/own.h"
#include "sampler/strength.h"

extern const fracas_kind fracas_covariance_exponential;
extern const fracas_kind fracas_covariance_matern;
extern const fracas_kind fracas_covariance_gaussian;

/* FRACAS_USAGE when the keys of a correlation contradict each other, or stand with strengths that
 * are not drawn: from a file, or constant. */
FRACAS_MUST_USE fracas_err fracas_covariance_check(const fracas_strength *strength);

typedef struct fracas_covariance fracas_covariance;

/* The covariance of the strength, which must name one. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_covariance_create(const fracas_strength *strength,
                                                    fracas_covariance **covariance);
void fracas_covariance_destroy(fracas_covariance *covariance); /* NULL is allowed */
FRACAS_OWNER(fracas_covariance, fracas_covariance_destroy)

/* rho(d), d >= 0 [m]: 1 at 0, and falling; to 3e-14, same bits on every CPU. */
double fracas_covariance_at(const fracas_covariance *covariance, double distance);

#endif
