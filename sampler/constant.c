/* One strength for every interface. */
#include "sampler/distribution.h"

static double constant_quantile(const fracas_strength *strength, double volume, double u)
{
    (void)volume;
    (void)u;
    return strength->value;
}

static double constant_mean(const fracas_strength *strength, double volume)
{
    (void)volume;
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
