/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exponential distribution, same bits on every CPU. */
#ifndef FRACAS_SAMPLER_EXPONENTIAL_H
#define FRACAS_SAMPLER_EXPONENTIAL_H

#include "sampler/probability.h"

/* -ln(p.above), accurate in both tails. */
double fracas_exponential_quantile(fracas_probability p);

#endif
