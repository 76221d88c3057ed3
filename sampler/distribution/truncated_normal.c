/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Normal distribution, cut off at strength 0. */
#include "sampler/distribution/distribution.h"

#include "base/elementary.h"
#include "sampler/distribution/pairs.h"
#include "sampler/special/normal.h"

enum { KEPT_MEAN, KEPT_DEVIATION }; /* own numbers, Pa: after strengths below 0 are cut off */

/* The density of a standard normal variable. */
static double normal_density(double z)
{
    const double one_over_sqrt_two_pi = 0x1.9884533d43651p-2;
    return one_over_sqrt_two_pi * fracas_exp(-0.5 * z * z);
}

/* H(y) = integral_0^y exp(k t - t^2/2) dt, 0 <= y <= 1, k >= 0, by its Taylor series: the
 * derivatives of the integrand at 0 are Hermite polynomials in k, g_(n+1) = k g_n - n g_(n-1). Here
 * as h_n = g_n y^n/n!. */
static double area_from_zero(double k, double y)
{
    double before = 0.0, term = 1.0, sum = 1.0;
    for (double n = 1.0; n < 400.0; n += 1.0) {
        double next = (k * y * term - y * y * before) / n;
        before = term;
        term = next;
        sum += term / (n + 1.0);
        if (fabs(term) + fabs(before) < 0x1p-56 * fabs(sum)) break;
    }
    return y * sum;
}

/* (sampling.18) The y = strength/deviation with H(y) = c, for small y, where mean + deviation z
 * would cancel: Newton on ln H in y, concave, from the solution without t^2. */
static double solve_near_zero(double k, double c)
{
    double y = k * c < 1e-3 ? c : fracas_log(1.0 + k * c) / k;
    for (int i = 0; i < 20; i++) {
        double area = area_from_zero(k, y);
        double step = (area - c) * fracas_exp(y * (0.5 * y - k));
        y = fmax(0.5 * y, y - step);
        if (fabs(step) < 1e-9 * y) break; /* the next one would be below 1e-17 */
    }
    return y;
}

/* (sampling.16) The upper half of the uncut distribution from 1 - u, the lower one from u: both
 * tails are exact. */
static double normal_quantile(const fracas_strength *strength, fracas_extent extent,
                              fracas_probability p)
{
    (void)extent;
    const double near_zero = 0.5;
    double k = strength->mean / strength->deviation;
    double kept = fracas_normal_upper(-k);
    double above = p.above * kept, below = fracas_normal_upper(k) + p.below * kept;
    double z = above < 0.5 ? -fracas_normal_quantile(fracas_probability_of(above))
                           : fracas_normal_quantile(fracas_probability_of(below));
    if (k + z > near_zero) return strength->mean + strength->deviation * z;
    return strength->deviation * solve_near_zero(k, p.below * kept / normal_density(k));
}

/* Far above the mean the kept probability only moves t. */
static double normal_far(const fracas_strength *strength, double t)
{
    const double kept = fracas_normal_upper(-strength->mean / strength->deviation);
    return strength->mean + strength->deviation * fracas_normal_far(t - fracas_log(kept));
}

/* Standard deviation of a standard normal variable cut off below -k. */
static double kept_deviation(double k)
{
    const double h = normal_density(k) / fracas_normal_upper(-k);
    return sqrt(1.0 - k * h - h * h);
}

/* (sampling.19) */
static fracas_moments normal_moments(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    double k = strength->mean / strength->deviation;
    const double mean = strength->mean +
                        strength->deviation * (normal_density(k) / fracas_normal_upper(-k));
    return (fracas_moments){mean, strength->deviation * kept_deviation(k)};
}

static const fracas_param params[] = {
    {"mean", FRACAS_REAL, "Pa", "mean before strengths below 0 are cut off", FRACAS_REQUIRED, 0,
     INFINITY, true, offsetof(fracas_strength, mean), .optional = true},
    {"deviation", FRACAS_REAL, "Pa", "standard deviation before strengths below 0 are cut off",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_strength, deviation), .optional = true},
    {"kept_mean", FRACAS_REAL, "Pa",
     "mean of the strengths above 0 that are kept, given with kept_deviation instead of mean and "
     "deviation",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_strength, own[KEPT_MEAN]),
     .optional = true},
    {"kept_deviation", FRACAS_REAL, "Pa",
     "standard deviation of the strengths above 0 that are kept, given with kept_mean",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_strength, own[KEPT_DEVIATION]),
     .optional = true},
};

/* (distributions.9) The ratio of the moments falls as k grows, and is below 1/k. */
FRACAS_MUST_USE static fracas_err normal_init(fracas_strength *strength)
{
    bool by_moments;
    TRY(fracas_pairs_choose(strength, params, &by_moments));
    if (!by_moments) return FRACAS_OK;
    const double ratio = strength->own[KEPT_DEVIATION] / strength->own[KEPT_MEAN];
    TRY(fracas_pairs_check(strength, "kept_deviation/kept_mean", ratio, 1e-9, 0.7555));
    double least = 0.0, most = 1.0 / ratio, k;
    while ((k = 0.5 * (least + most)) > least && k < most) {
        if (kept_deviation(k) > ratio * (k + normal_density(k) / fracas_normal_upper(-k)))
            least = k;
        else most = k;
    }
    strength->deviation = strength->own[KEPT_DEVIATION] / kept_deviation(k);
    strength->mean = k * strength->deviation;
    return FRACAS_OK;
}

const fracas_distribution fracas_normal = {
    .kind = {.name = "normal",
             .doc = "normal, cut off at 0: strengths are positive",
             FRACAS_PARAMS(params)},
    .quantile = normal_quantile,
    .moments = normal_moments,
    .init = normal_init,
    .takes_reference = true,
    .far = normal_far,
    .far_from = 700.0,
};
