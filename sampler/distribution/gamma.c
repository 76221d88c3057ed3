/* Gamma distribution. */
#include "sampler/distribution/distribution.h"

#include "sampler/special/incomplete_gamma.h"

/* (sampling.20) */
static double gamma_quantile(const fracas_strength *strength, fracas_extent extent, fracas_probability p)
{
    (void)extent;
    return strength->scale * fracas_incomplete_gamma_inverse(strength->shape, p);
}

/* (sampling.20) */
static double gamma_mean(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return strength->scale * strength->shape;
}

static const fracas_param params[] = {
    {"shape", FRACAS_REAL, "1", "shape k: the coefficient of variation is 1/sqrt(k)", FRACAS_REQUIRED, 0.1, 1e6, false,
     offsetof(fracas_strength, shape)},
    {"scale", FRACAS_REAL, "Pa", "scale theta: the mean is k theta", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, scale)},
};
const fracas_distribution fracas_gamma_law = {
    .kind = {.name = "gamma", .doc = "gamma: mean shape scale, variance shape scale^2", .params = params,
             .nparams = FRACAS_COUNT(params)},
    .quantile = gamma_quantile, .mean = gamma_mean,
};
