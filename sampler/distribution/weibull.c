/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weibull distribution with two or three parameters. */
#include "sampler/distribution/distribution.h"

#include "base/elementary.h"
#include "sampler/distribution/pairs.h"
#include "sampler/special/exponential.h"
#include "sampler/special/weibull_shape.h"

static const double smallest_shape = 0.1, largest_shape = 1000.0;

/* (distributions.11) Any t. As exp(ln(t)/shape): a power with the rounded exponent 1/shape would be
 * no more accurate. */
static double weibull_far(const fracas_strength *strength, double t)
{
    return strength->minimum + strength->scale * fracas_exp(fracas_log(t) / strength->shape);
}

/* (sampling.5) */
static double weibull_quantile(const fracas_strength *strength, fracas_extent extent,
                               fracas_probability p)
{
    (void)extent;
    return weibull_far(strength, fracas_exponential_quantile(p));
}

/* (sampling.6), (distributions.3) */
static fracas_moments weibull_moments(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    const double x = 1.0 / strength->shape, above = strength->scale * fracas_gamma(1.0 + x);
    return (fracas_moments){strength->minimum + above, above * sqrt(fracas_weibull_variation(x))};
}

static double weibull_tail(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return strength->shape;
}

/* (distributions.11) The weakest follows the same distribution with another scale. */
static fracas_moments weibull_weakest(const fracas_strength *strength, double size)
{
    fracas_strength weakest = *strength;
    weakest.scale *= fracas_exp(-fracas_log(size) / strength->shape);
    return weibull_moments(&weakest, (fracas_extent){0});
}

static const fracas_param params[] = {
    {"minimum", FRACAS_REAL, "Pa", "strength that every interface has at least", 0, 0, INFINITY,
     false, offsetof(fracas_strength, minimum)},
    {"scale", FRACAS_REAL, "Pa",
     "scale above the minimum: 63.2 % of all strengths are below their sum", FRACAS_REQUIRED, 0,
     INFINITY, true, offsetof(fracas_strength, scale), .optional = true},
    {"shape", FRACAS_REAL, "1", "Weibull modulus m; the larger, the narrower", FRACAS_REQUIRED, 0.1,
     1000, false, offsetof(fracas_strength, shape), .optional = true},
    FRACAS_STRENGTH_MOMENTS("scale and shape; mean and shape will do as well"),
};

/* (distributions.4) */
FRACAS_MUST_USE static fracas_err weibull_init(fracas_strength *strength)
{
    const bool by_shape = strength->mean > 0 && strength->shape > 0 && !(strength->scale > 0) &&
                          !(strength->deviation > 0);
    bool by_moments = false;
    if (!by_shape) TRY(fracas_pairs_choose(strength, params + 1, &by_moments));
    if (!by_shape && !by_moments) return FRACAS_OK;
    const double above = strength->mean - strength->minimum;
    if (!(above > 0.0))
        return fracas_fail(FRACAS_USAGE,
                           "strength.mean is %.15g Pa and strength.minimum %.15g Pa; the mean is "
                           "above the minimum: raise it, or lower the minimum",
                           strength->mean, strength->minimum);
    if (by_shape) {
        strength->scale = above / fracas_gamma(1.0 + 1.0 / strength->shape);
        return FRACAS_OK;
    }
    const double least = 1.0 / largest_shape, most = 1.0 / smallest_shape,
                 ratio = strength->deviation / above;
    TRY(fracas_pairs_check(strength, "deviation/(mean - minimum)", ratio,
                           sqrt(fracas_weibull_variation(least)),
                           sqrt(fracas_weibull_variation(most))));
    const double x = fracas_weibull_shape_inverse(ratio * ratio, least, most);
    strength->shape = 1.0 / x;
    strength->scale = above / fracas_gamma(1.0 + x);
    return FRACAS_OK;
}

const fracas_distribution fracas_weibull = {
    .kind = {.name = "weibull",
             .doc = "weakest of many flaws: minimum + scale (-ln(1 - u))^(1/shape)",
             FRACAS_PARAMS(params)},
    .quantile = weibull_quantile,
    .moments = weibull_moments,
    .tail = weibull_tail,
    .init = weibull_init,
    .takes_reference = true,
    .far = weibull_far,
    .far_from = 0.0,
    .weakest = weibull_weakest,
    .block = FRACAS_BLOCK_WEIBULL,
};
