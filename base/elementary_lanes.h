/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fracas_log and fracas_exp over lanes, with the same bits for every argument.
 *
 * The usual arguments take the operations of base/elementary.c in the same order, without a branch.
 * Lanes of which one has another argument (below) take the scalar function in turn. */
#ifndef FRACAS_BASE_ELEMENTARY_LANES_H
#define FRACAS_BASE_ELEMENTARY_LANES_H

#include "base/elementary.h"
#include "base/elementary_terms.h"
#include "base/lanes.h"

#include <float.h>

LANES_FUNCTION vd lanes_poly4(const double *c, vd x)
{
    return (c[0] + c[1] * x) + (x * x) * (c[2] + c[3] * x);
}

LANES_FUNCTION vd lanes_poly8(const double *c, vd x)
{
    vd x2 = x * x;
    return lanes_poly4(c, x) + (x2 * x2) * lanes_poly4(c + 4, x);
}

/* One lane after the other. */
__attribute__((unused, noinline, cold)) static vd lanes_each(double (*function)(double), vd x)
{
    double lane[LANES] __attribute__((aligned(64)));
    lanes_store(lane, x);
    for (int l = 0; l < LANES; l++) lane[l] = function(lane[l]);
    return lanes_load(lane);
}

/* (lanes.1) Usual: a normal positive number. */
LANES_FUNCTION vd lanes_log(vd x)
{
    const uint64_t one = 0x3ff0000000000000, two_52 = 0x4330000000000000;
    if (!lanes_all(lanes_and(lanes_le(lanes_set(DBL_MIN), x), lanes_le(x, lanes_set(DBL_MAX)))))
        return lanes_each(fracas_log, x);
    vu place = lanes_bits(x) + (one - sqrt_half);
    vd k = lanes_double((place >> 52) | two_52) - (0x1p52 + 1023.0);
    vd f = lanes_double(lanes_bits(x) - (place & ~(uint64_t)0 << 52) + one) - 1.0;
    vd s = f / (2.0 + f);
    vd z = s * s;
    vd half_square = 0.5 * f * f;
    return k * ln2_hi -
           ((half_square - (s * (half_square + z * lanes_poly8(log_rest, z)) + k * ln2_lo)) - f);
}

/* (lanes.2) Usual: |x| <= 708, where 2^k y is a normal number: k is added to the exponent of y. */
LANES_FUNCTION vd lanes_exp(vd x)
{
    if (!lanes_all(lanes_and(lanes_le(lanes_set(-708.0), x), lanes_le(x, lanes_set(708.0)))))
        return lanes_each(fracas_exp, x);
    vd shifted = x * log2_e + to_integer;
    vd kd = shifted - to_integer;
    vd exact = x - kd * ln2_hi;
    vd rest = kd * ln2_lo;
    vd r = exact - rest;
    vd r_lo = (exact - r) - rest;
    vd r2 = r * r;
    vd r8 = (r2 * r2) * (r2 * r2);
    vd sum = 1.0 + r;
    vd sum_lo = ((1.0 - sum) + r) + r_lo;
    vd y = sum + (sum_lo + r2 * (lanes_poly8(exp_rest, r) + r8 * lanes_poly4(exp_rest + 8, r)));
    return lanes_double(lanes_bits(y) + (lanes_bits(shifted) << 52));
}

#endif
