/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strengths given by a file, not drawn: the common part of such distributions, which differ in
 * their `read`. */
#ifndef FRACAS_SAMPLER_GIVEN_H
#define FRACAS_SAMPLER_GIVEN_H

#include "sampler/distribution/distribution.h"

/* As the members of fracas_distribution: the smallest strength of the file where p.below < 1/2,
 * else the largest; mean and deviation of all. FRACAS_USAGE for a line without a strength, or if
 * there is no line. */
double fracas_given_quantile(const fracas_strength *strength, fracas_extent extent,
                             fracas_probability p);
fracas_moments fracas_given_moments(const fracas_strength *strength, fracas_extent extent);
FRACAS_MUST_USE fracas_err fracas_given_init(fracas_strength *strength);

/* Strengths in the file. */
size_t fracas_given_count(const fracas_strength *strength);

#endif
