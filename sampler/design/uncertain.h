/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions of uncertain parameters. */
#ifndef FRACAS_SAMPLER_UNCERTAIN_H
#define FRACAS_SAMPLER_UNCERTAIN_H

#include "base/err.h"
#include "base/param.h"
#include "sampler/probability.h"

#define FRACAS_OWN_UNIT "its own" /* in the tables of distributions: the unit of the parameter */

/* A distribution uses the members in its table; `minimum` and `maximum` are NaN where a normal
 * distribution is not cut. */
typedef struct {
    const fracas_kind *kind; /* the distribution */
    double minimum, maximum;
    double mean, deviation;
    double median, sigma;
    double scale, shape;
} fracas_uncertain;

/* Its kinds are the distributions; it is no section of a file. */
extern const fracas_section fracas_uncertain_section;

/* FRACAS_USAGE when values in range contradict each other. */
FRACAS_MUST_USE fracas_err fracas_uncertain_check(const fracas_uncertain *uncertain);

/* F^-1, same bits on every CPU. */
double fracas_uncertain_quantile(const fracas_uncertain *uncertain, fracas_probability p);

#endif
