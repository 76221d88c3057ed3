/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uniform distribution between two strengths. */
#include "sampler/distribution/distribution.h"

#include "sampler/distribution/pairs.h"

/* (sampling.4) */
static double uniform_quantile(const fracas_strength *strength, fracas_extent extent,
                               fracas_probability p)
{
    (void)extent;
    return strength->minimum + (strength->maximum - strength->minimum) * p.below;
}

/* (distributions.7) */
static fracas_moments uniform_moments(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    const double half = 0.5 * (strength->maximum - strength->minimum);
    return (fracas_moments){strength->minimum + half, half / sqrt(3.0)};
}

/* (distributions.12) */
static fracas_moments uniform_weakest(const fracas_strength *strength, double size)
{
    const double above = (strength->maximum - strength->minimum) / (size + 1.0);
    return (fracas_moments){strength->minimum + above, above * sqrt(size / (size + 2.0))};
}

static const fracas_param params[] = {
    {"minimum", FRACAS_REAL, "Pa", "smallest strength", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, minimum), .optional = true},
    {"maximum", FRACAS_REAL, "Pa", "largest strength", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_strength, maximum), .optional = true},
    FRACAS_STRENGTH_MOMENTS("minimum and maximum"),
};

/* (distributions.7) */
FRACAS_MUST_USE static fracas_err uniform_init(fracas_strength *strength)
{
    bool by_moments;
    TRY(fracas_pairs_choose(strength, params, &by_moments));
    if (by_moments) {
        TRY(fracas_pairs_check(strength, "deviation/mean", strength->deviation / strength->mean,
                               1e-9, 0.5773));
        strength->minimum = strength->mean - sqrt(3.0) * strength->deviation;
        strength->maximum = strength->mean + sqrt(3.0) * strength->deviation;
    }
    if (strength->minimum < strength->maximum) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "strength.minimum is %.15g Pa and strength.maximum %.15g Pa; the maximum of a uniform "
        "distribution must be the larger: swap them, or use the distribution constant",
        strength->minimum, strength->maximum);
}

const fracas_distribution fracas_uniform = {
    .kind = {.name = "uniform",
             .doc = "every strength between two bounds equally likely",
             FRACAS_PARAMS(params)},
    .quantile = uniform_quantile,
    .moments = uniform_moments,
    .init = uniform_init,
    .takes_reference = true,
    .weakest = uniform_weakest,
    .block = FRACAS_BLOCK_UNIFORM,
};
