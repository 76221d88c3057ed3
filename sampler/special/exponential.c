/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/special/exponential.h"

#include "base/elementary.h"

/* (sampling.10) `lost` is the rounding error of p.above near 1: 0 for the u of a stream. */
double fracas_exponential_quantile(fracas_probability p)
{
    if (p.below > 0.5) return -fracas_log(p.above);
    double lost = (1.0 - p.above) - p.below;
    return -(fracas_log(p.above) + lost / p.above);
}
