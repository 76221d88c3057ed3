/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/cracks.h"

#include <gsl/gsl_poly.h>
#include <math.h>

/* (cracks.4) squared: x^3 - 8 x^2 + (24 - 16 k) x - 16 (1 - k) = 0 has one root in (0, 1). */
double fracas_rayleigh_speed(double young, double density, double poisson)
{
    const double shear = sqrt(young / (2 * (1 + poisson) * density));
    const double k = (1 - poisson) / 2; /* (c_s/c_p)^2 in plane stress */
    double root[3];
    if (!(shear > 0)) return NAN;
    const int count = gsl_poly_solve_cubic(-8, 24 - 16 * k, -16 * (1 - k), &root[0], &root[1],
                                           &root[2]);
    for (int i = 0; i < count; i++)
        if (root[i] > 0 && root[i] < 1) return shear * sqrt(root[i]);
    return NAN;
}
