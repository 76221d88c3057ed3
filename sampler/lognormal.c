/* Lognormal distribution. */
#include "sampler/distribution.h"

#include "base/elementary.h"
#include "sampler/normal.h"

/* (sampling.7) */
static double lognormal_quantile(const fracas_strength *strength, double volume, double u)
{
    (void)volume;
    return strength->median * fracas_exp(strength->sigma * fracas_normal_quantile(u));
}

/* (sampling.8) */
static double lognormal_mean(const fracas_strength *strength, double volume)
{
    (void)volume;
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
};
