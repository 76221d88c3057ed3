/* Gamma distribution. */
#include "sampler/distribution.h"

#include "sampler/incomplete_gamma.h"

/* (sampling.20) */
static double gamma_quantile(const fracas_strength *strength, double volume, double u)
{
    (void)volume;
    return strength->scale * fracas_incomplete_gamma_inverse(strength->shape, u);
}

/* (sampling.20) */
static double gamma_mean(const fracas_strength *strength, double volume)
{
    (void)volume;
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
