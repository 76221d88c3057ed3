/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The quantiles of blocks over lanes: a kernel. */
#include "base/elementary_lanes.h"
#include "sampler/distribution/blocks.h"
#include "sampler/special/normal.h"
#include "sampler/special/normal_terms.h"

/* (sampling.4) */
static void uniform(const fracas_strength *strength, size_t n, const double *u, double *sigma_c)
{
    const double minimum = strength->minimum, range = strength->maximum - strength->minimum;
    for (size_t i = 0; i < n; i += LANES)
        lanes_store(sigma_c + i, minimum + range * lanes_load(u + i));
}

/* (lanes.3) 1 - u is exact for a number of a stream. */
LANES_FUNCTION vd exponential_quantile(vd u)
{
    return -lanes_log(1.0 - u);
}

/* (sampling.5) */
static void weibull(const fracas_strength *strength, size_t n, const double *u, double *sigma_c)
{
    const double minimum = strength->minimum, scale = strength->scale, shape = strength->shape;
    for (size_t i = 0; i < n; i += LANES) {
        vd t = exponential_quantile(lanes_load(u + i));
        lanes_store(sigma_c + i, minimum + scale * lanes_exp(lanes_log(t) / shape));
    }
}

LANES_FUNCTION vd ratio(const double n[8], const double d[8], vd x)
{
    vd above = n[7] * x + n[6], below = d[7] * x + d[6];
    for (int i = 5; i >= 0; i--) {
        above = above * x + n[i];
        below = below * x + d[i];
    }
    return above / below;
}

static double normal_quantile_of(double u)
{
    return fracas_normal_quantile(fracas_probability_of(u));
}

/* (lanes.4) The tails are worked out only where one of the lanes is in them, far tails (r > 5) one
 * lane after the other. */
LANES_FUNCTION vd normal_quantile(vd u)
{
    const vd half = lanes_set(0.5), middle = lanes_set(0.425);
    vd q = u - half;
    vd z = q * ratio(normal_a, normal_b, 0.180625 - q * q);
    vmask central = lanes_and(lanes_le(-middle, q), lanes_le(q, middle));
    if (lanes_all(central)) return z;
    vmask lower = lanes_lt(u, half);
    vd r = lanes_sqrt(-lanes_log(lanes_select(lower, u, 1.0 - u)));
    if (lanes_any(lanes_lt(lanes_set(5.0), r))) return lanes_each(normal_quantile_of, u);
    vd tail = ratio(normal_c, normal_d, r - 1.6);
    return lanes_select(central, z, lanes_select(lower, -tail, tail));
}

/* (sampling.7) */
static void lognormal(const fracas_strength *strength, size_t n, const double *u, double *sigma_c)
{
    const double median = strength->median, sigma = strength->sigma;
    for (size_t i = 0; i < n; i += LANES)
        lanes_store(sigma_c + i, median * lanes_exp(sigma * normal_quantile(lanes_load(u + i))));
}

const fracas_block_kernel LANES_UNIT(fracas_blocks) = {
    .quantile = {[FRACAS_BLOCK_UNIFORM] = uniform,
                 [FRACAS_BLOCK_WEIBULL] = weibull,
                 [FRACAS_BLOCK_LOGNORMAL] = lognormal}};
