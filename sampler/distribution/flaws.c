/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flaws scattered in the body at random; an interface is as strong as the weakest of them in its
 * volume. */
#include "sampler/distribution/distribution.h"

#include "base/elementary.h"
#include "sampler/special/exponential.h"
#include "sampler/special/incomplete_gamma.h"

/* Own numbers: mean number of flaws per volume [1/m3], exponent of the power law of strengths. */
enum { DENSITY, EXPONENT };

/* (sampling.21) `weaker`, the fraction of weaker flaws, is -ln(1 - u)/(mean number of flaws); from
 * 1 on there is no flaw. The strength is a power of the fraction, so the minimum is added last. */
static double flaws_quantile(const fracas_strength *strength, fracas_extent extent,
                             fracas_probability p)
{
    double share = fracas_exponential_quantile(p) / (strength->own[DENSITY] * extent.volume);
    if (share >= 1.0) return strength->maximum;
    double range = strength->maximum - strength->minimum;
    return strength->minimum + range * fracas_exp(fracas_log(share) / strength->own[EXPONENT]);
}

/* (sampling.22), (distributions.8) */
static fracas_moments flaws_moments(const fracas_strength *strength, fracas_extent extent)
{
    const double range = strength->maximum - strength->minimum,
                 mu = strength->own[DENSITY] * extent.volume;
    const double first = fracas_stretched_exponential(mu, strength->own[EXPONENT]);
    const double second = fracas_stretched_exponential(mu, 0.5 * strength->own[EXPONENT]);
    return (fracas_moments){strength->minimum + range * first,
                            range * sqrt(fmax(second - first * first, 0.0))};
}

/* P(no flaw in an interface) = exp(-density V) is 1/2 at density V = ln 2. */
static double flaws_tail(const fracas_strength *strength, fracas_extent extent)
{
    const double ln_2 = 0x1.62e42fefa39efp-1;
    return strength->own[DENSITY] * extent.volume > ln_2 ? strength->own[EXPONENT] : NAN;
}

FRACAS_MUST_USE static fracas_err flaws_init(fracas_strength *strength)
{
    if (strength->minimum < strength->maximum) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "strength.minimum is %.15g Pa and strength.maximum %.15g Pa; the maximum, the strength "
        "without a flaw, must be the larger: swap them, or use the distribution constant",
        strength->minimum, strength->maximum);
}

static const fracas_param params[] = {
    {"flaw_density", FRACAS_REAL, "1/m3", "mean number of flaws per volume of the body",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_strength, own[DENSITY])},
    {"minimum", FRACAS_REAL, "Pa", "strength of the largest flaws", 0, 0, INFINITY, false,
     offsetof(fracas_strength, minimum)},
    {"maximum", FRACAS_REAL, "Pa",
     "strength of the smallest flaws, and of an interface without a flaw", FRACAS_REQUIRED, 0,
     INFINITY, true, offsetof(fracas_strength, maximum)},
    {"exponent", FRACAS_REAL, "1",
     "power law of the flaws: ((s - minimum)/(maximum - minimum))^exponent of them are weaker than "
     "s",
     FRACAS_REQUIRED, 0.5, 1000, false, offsetof(fracas_strength, own[EXPONENT])},
};
const fracas_distribution fracas_flaws = {
    .kind = {.name = "flaws",
             .doc = "weakest flaw in the volume of an interface; flaws at random in the body, "
                    "their strengths by a power law",
             FRACAS_PARAMS(params)},
    .quantile = flaws_quantile,
    .moments = flaws_moments,
    .tail = flaws_tail,
    .init = flaws_init,
    .size_effect = true,
    .scatter_remedy = ", here by a higher flaw_density",
};
