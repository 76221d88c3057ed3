/* Weibull distribution with two or three parameters. */
#include "sampler/distribution/distribution.h"

#include "base/elementary.h"
#include "sampler/special/exponential.h"

/* (sampling.5) As exp(ln(t)/shape): a power with the rounded exponent 1/shape would be no more accurate. */
static double weibull_quantile(const fracas_strength *strength, fracas_extent extent, fracas_probability p)
{
    (void)extent;
    double power = fracas_exp(fracas_log(fracas_exponential_quantile(p)) / strength->shape);
    return strength->minimum + strength->scale * power;
}

/* (sampling.6) */
static double weibull_mean(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return strength->minimum + strength->scale * fracas_gamma(1.0 + 1.0 / strength->shape);
}

static const fracas_param params[] = {
    {"minimum", FRACAS_REAL, "Pa", "strength that every interface has at least", 0, 0, INFINITY, false,
     offsetof(fracas_strength, minimum)},
    {"scale", FRACAS_REAL, "Pa", "scale above the minimum: 63.2 % of all strengths are below their sum",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_strength, scale)},
    {"shape", FRACAS_REAL, "1", "Weibull modulus m; the larger, the narrower", FRACAS_REQUIRED, 0.1, 1000, false,
     offsetof(fracas_strength, shape)},
};
const fracas_distribution fracas_weibull = {
    .kind = {.name = "weibull", .doc = "weakest of many flaws: minimum + scale (-ln(1 - u))^(1/shape)",
             .params = params, .nparams = FRACAS_COUNT(params)},
    .quantile = weibull_quantile, .mean = weibull_mean,
    .block = FRACAS_BLOCKS(fracas_weibull),
};
