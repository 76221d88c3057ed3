/* Uniform distribution between two strengths. */
#include "sampler/distribution/distribution.h"

/* (sampling.4) */
static double uniform_quantile(const fracas_strength *strength, fracas_extent extent, fracas_probability p)
{
    (void)extent;
    return strength->minimum + (strength->maximum - strength->minimum) * p.below;
}

static double uniform_mean(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return strength->minimum + 0.5 * (strength->maximum - strength->minimum);
}

FRACAS_MUST_USE static fracas_err uniform_check(const fracas_strength *strength)
{
    if (strength->minimum < strength->maximum) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "strength.minimum is %.15g Pa and strength.maximum %.15g Pa; the maximum of a uniform "
                       "distribution must be the larger: swap them, or use the distribution constant",
                       strength->minimum, strength->maximum);
}

static const fracas_param params[] = {
    {"minimum", FRACAS_REAL, "Pa", "smallest strength", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, minimum)},
    {"maximum", FRACAS_REAL, "Pa", "largest strength", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, maximum)},
};
const fracas_distribution fracas_uniform = {
    .kind = {.name = "uniform", .doc = "every strength between two bounds equally likely", .params = params,
             .nparams = FRACAS_COUNT(params)},
    .quantile = uniform_quantile, .mean = uniform_mean, .check = uniform_check,
    .block = FRACAS_BLOCKS(fracas_uniform),
};
