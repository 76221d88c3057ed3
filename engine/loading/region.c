/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/loading/region.h"

#include <math.h>

double fracas_region_beside(const fracas_region *region, const double x[3])
{
    double square = 0, beside = 0;
    for (int i = 0; i < 3; i++) {
        const double apart = x[i] - region->at[i];
        square += apart * apart;
        beside = fmax(beside, fmax(region->from[i] - x[i], x[i] - region->to[i])); /* NaN: none */
    }
    return region->within > 0 ? fmax(beside, sqrt(square) - region->within) : beside;
}

bool fracas_region_has(const fracas_region *region, const double x[3])
{
    const double slack = 1e-9 * (fabs(x[0]) + fabs(x[1]) + fabs(x[2])); /* round-off of nodes */
    return fracas_region_beside(region, x) <= slack;
}
