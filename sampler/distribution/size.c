/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/distribution/size.h"

#include "base/elementary.h"
#include "sampler/special/exponential.h"

double fracas_size_of(const fracas_strength *strength, fracas_extent extent)
{
    if (strength->reference_volume > 0.0) return extent.volume / strength->reference_volume;
    if (strength->reference_area > 0.0) return extent.area / strength->reference_area;
    return 1.0;
}

/* The strength s [Pa] at which the reference has P(strength > s) = e^-t. */
static double strength_at(const fracas_strength *strength, double t)
{
    const fracas_distribution *distribution = fracas_distribution_of(strength);
    if (distribution->far && t >= distribution->far_from) return distribution->far(strength, t);
    return distribution->quantile(strength, (fracas_extent){0},
                                  (fracas_probability){-fracas_expm1(-t), fracas_exp(-t)});
}

/* (distributions.10) */
double fracas_size_quantile(const fracas_strength *strength, double size, fracas_probability p)
{
    return strength_at(strength, fracas_exponential_quantile(p) / size);
}

/* (distributions.13) integral_0^infinity F^-1(t/size) e^-t dt with t = exp(x - e^-x), whose ends
 * fall off doubly exponentially: the sum over x = -4, -4 + 1/16, ... 6.75, divided by its own sum
 * of weights, is the integral. */
fracas_moments fracas_size_moments(const fracas_strength *strength, double size)
{
    enum { NODES = 173 };
    const fracas_distribution *distribution = fracas_distribution_of(strength);
    if (distribution->weakest) return distribution->weakest(strength, size);
    double weight[NODES], at[NODES], sum = 0.0, mean = 0.0, variance = 0.0;
    for (int i = 0; i < NODES; i++) {
        const double x = -4.0 + 0.0625 * i, back = fracas_exp(-x), t = fracas_exp(x - back);
        weight[i] = t * (1.0 + back) * fracas_exp(-t);
        at[i] = strength_at(strength, t / size);
        if (!(weight[i] > 0.0)) continue; /* beyond t = 745; the strength may be infinite */
        sum += weight[i];
        mean += weight[i] * at[i];
    }
    mean /= sum;
    if (!isfinite(mean)) return (fracas_moments){INFINITY, INFINITY};
    for (int i = 0; i < NODES; i++)
        if (weight[i] > 0.0) variance += weight[i] * (at[i] - mean) * (at[i] - mean);
    return (fracas_moments){mean, sqrt(variance / sum)};
}
