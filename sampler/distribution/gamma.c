/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gamma distribution. */
#include "sampler/distribution/distribution.h"

#include "sampler/distribution/pairs.h"
#include "sampler/special/incomplete_gamma.h"

/* (sampling.20) */
static double gamma_quantile(const fracas_strength *strength, fracas_extent extent,
                             fracas_probability p)
{
    (void)extent;
    return strength->scale * fracas_incomplete_gamma_inverse(strength->shape, p);
}

static double gamma_far(const fracas_strength *strength, double t)
{
    return strength->scale * fracas_incomplete_gamma_far(strength->shape, t);
}

/* (sampling.20), (distributions.6) */
static fracas_moments gamma_moments(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return (fracas_moments){strength->scale * strength->shape,
                            strength->scale * sqrt(strength->shape)};
}

static const fracas_param params[] = {
    {"shape", FRACAS_REAL, "1", "shape k: the coefficient of variation is 1/sqrt(k)",
     FRACAS_REQUIRED, 0.1, 1e6, false, offsetof(fracas_strength, shape), .optional = true},
    {"scale", FRACAS_REAL, "Pa", "scale theta: the mean is k theta", FRACAS_REQUIRED, 0, INFINITY,
     true, offsetof(fracas_strength, scale), .optional = true},
    FRACAS_STRENGTH_MOMENTS("shape and scale"),
};

/* (distributions.6) */
FRACAS_MUST_USE static fracas_err gamma_init(fracas_strength *strength)
{
    bool by_moments;
    TRY(fracas_pairs_choose(strength, params, &by_moments));
    if (!by_moments) return FRACAS_OK;
    const double ratio = strength->deviation / strength->mean;
    TRY(fracas_pairs_check(strength, "deviation/mean", ratio, 1e-3, sqrt(10.0)));
    strength->shape = 1.0 / (ratio * ratio);
    strength->scale = strength->deviation * ratio;
    return FRACAS_OK;
}

const fracas_distribution fracas_gamma_distribution = {
    .kind = {.name = "gamma",
             .doc = "gamma: mean shape scale, variance shape scale^2",
             FRACAS_PARAMS(params)},
    .quantile = gamma_quantile,
    .moments = gamma_moments,
    .init = gamma_init,
    .takes_reference = true,
    .far = gamma_far,
    .far_from = 700.0,
};
