/* Lognormal distribution. */
#include "sampler/distribution/distribution.h"

#include "base/elementary.h"
#include "sampler/special/normal.h"

/* (sampling.7) */
static double lognormal_quantile(const fracas_strength *strength, fracas_extent extent, fracas_probability p)
{
    (void)extent;
    return strength->median * fracas_exp(strength->sigma * fracas_normal_quantile(p));
}

/* (sampling.8) */
static double lognormal_mean(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return strength->median * fracas_exp(0.5 * strength->sigma * strength->sigma);
}

static const fracas_param params[] = {
    {"median", FRACAS_REAL, "Pa", "median strength", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, median)},
    {"sigma", FRACAS_REAL, "1", "standard deviation of the logarithm of the strength", FRACAS_REQUIRED, 0, 10, true,
     offsetof(fracas_strength, sigma)},
};
const fracas_distribution fracas_lognormal = {
    .kind = {.name = "lognormal", .doc = "logarithm normally distributed: median exp(sigma z)", .params = params,
             .nparams = FRACAS_COUNT(params)},
    .quantile = lognormal_quantile, .mean = lognormal_mean,
    .block = FRACAS_BLOCKS(fracas_lognormal),
};
