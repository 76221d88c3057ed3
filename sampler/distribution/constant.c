/* One strength for every interface. */
#include "sampler/distribution/distribution.h"

static double constant_quantile(const fracas_strength *strength, fracas_extent extent, fracas_probability p)
{
    (void)extent;
    (void)p;
    return strength->value;
}

static double constant_mean(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return strength->value;
}

static const fracas_param params[] = {
    {"value", FRACAS_REAL, "Pa", "strength of every interface", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, value)},
};
const fracas_distribution fracas_constant = {
    .kind = {.name = "constant", .doc = "the same strength for every interface", .params = params,
             .nparams = FRACAS_COUNT(params)},
    .quantile = constant_quantile, .mean = constant_mean,
};
