/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distances of sites. */
#ifndef FRACAS_SAMPLER_DISTANCE_H
#define FRACAS_SAMPLER_DISTANCE_H

#include <math.h>

/* |a - b| [m] */
static inline double fracas_distance(const double a[3], const double b[3])
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

#endif
