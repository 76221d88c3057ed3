/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/special/bessel.h"

#include "base/elementary.h"

#include <math.h>

/* (fields.4) The integrand is analytic in |Im t| < pi/2 and falls faster than any exponential: the
 * trapezoidal rule converges as exp(-pi^2/step). Around t = 0 it is as wide as 1/sqrt(x), where x
 * is large. */
double fracas_bessel_k_scaled(double nu, double x)
{
    const double step = 0.125 / sqrt(1.0 + 0.1 * x);
    double sum = 0.5, term = 1.0;
    for (int k = 1; term > 1e-19 * sum; k++) {
        const double t = k * step, half = fracas_exp(0.5 * t);
        const double sinh2 = half - 1.0 / half;      /* 2 sinh(t/2) */
        const double fall = 0.5 * x * sinh2 * sinh2; /* x (cosh t - 1) */
        term = 0.5 * (fracas_exp(nu * t - fall) + fracas_exp(-nu * t - fall));
        sum += term;
    }
    return step * sum;
}
