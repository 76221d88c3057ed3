/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One strength for every interface. */
#include "sampler/distribution/distribution.h"

static double constant_quantile(const fracas_strength *strength, fracas_extent extent,
                                fracas_probability p)
{
    (void)extent;
    (void)p;
    return strength->value;
}

static fracas_moments constant_moments(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return (fracas_moments){strength->value, 0.0};
}

static const fracas_param params[] = {
    {"value", FRACAS_REAL, "Pa", "strength of every interface", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, value)},
};
const fracas_distribution fracas_constant = {
    .kind = {.name = "constant",
             .doc = "the same strength for every interface",
             FRACAS_PARAMS(params)},
    .quantile = constant_quantile,
    .moments = constant_moments,
};
