/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lognormal distribution. */
#include "sampler/distribution/distribution.h"

#include "base/elementary.h"
#include "sampler/distribution/pairs.h"
#include "sampler/special/normal.h"

/* (sampling.7) */
static double lognormal_quantile(const fracas_strength *strength, fracas_extent extent,
                                 fracas_probability p)
{
    (void)extent;
    return strength->median * fracas_exp(strength->sigma * fracas_normal_quantile(p));
}

static double lognormal_far(const fracas_strength *strength, double t)
{
    return strength->median * fracas_exp(strength->sigma * fracas_normal_far(t));
}

/* (sampling.8), (distributions.5) */
static fracas_moments lognormal_moments(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    const double mean = strength->median * fracas_exp(0.5 * strength->sigma * strength->sigma);
    return (fracas_moments){mean, mean * sqrt(fracas_expm1(strength->sigma * strength->sigma))};
}

static const fracas_param params[] = {
    {"median", FRACAS_REAL, "Pa", "median strength", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, median), .optional = true},
    {"sigma", FRACAS_REAL, "1", "standard deviation of the logarithm of the strength",
     FRACAS_REQUIRED, 0, 10, true, offsetof(fracas_strength, sigma), .optional = true},
    FRACAS_STRENGTH_MOMENTS("median and sigma"),
};

/* (distributions.5) */
FRACAS_MUST_USE static fracas_err lognormal_init(fracas_strength *strength)
{
    bool by_moments;
    TRY(fracas_pairs_choose(strength, params, &by_moments));
    if (!by_moments) return FRACAS_OK;
    const double ratio = strength->deviation / strength->mean;
    TRY(fracas_pairs_check(strength, "deviation/mean", ratio, 1e-9, 1e9));
    strength->sigma = sqrt(fracas_log1p(ratio * ratio));
    strength->median = strength->mean / sqrt(1.0 + ratio * ratio);
    return FRACAS_OK;
}

const fracas_distribution fracas_lognormal = {
    .kind = {.name = "lognormal",
             .doc = "logarithm normally distributed: median exp(sigma z)",
             FRACAS_PARAMS(params)},
    .quantile = lognormal_quantile,
    .moments = lognormal_moments,
    .init = lognormal_init,
    .takes_reference = true,
    .far = lognormal_far,
    .far_from = 700.0,
    .block = FRACAS_BLOCK_LOGNORMAL,
};
