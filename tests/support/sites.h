/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sites of correlated fields, for tests. */
#ifndef FRACAS_TESTS_SUPPORT_SITES_H
#define FRACAS_TESTS_SUPPORT_SITES_H

#include "sampler/field/covariance.h"
#include "tests/support/laws.h"

/* Lognormal strengths of sigma 1 and median 1 Pa: their logarithms are the normal field. */
static inline fracas_strength correlated(const fracas_kind *covariance, double length,
                                         double smoothness)
{
    return STRENGTH("lognormal", .median = 1, .sigma = 1, .covariance = covariance,
                    .correlation_length = length, .smoothness = smoothness);
}

/* Along a circle that lies askew in space, far from the origin. */
static inline void sites_on_circle(size_t n, double radius, double (*x)[3])
{
    for (size_t i = 0; i < n; i++) {
        const double angle = 2 * M_PI * (double)i / (double)n + 0.3, u = radius * cos(angle),
                     v = radius * sin(angle);
        x[i][0] = 1 + 0.6 * u;
        x[i][1] = 2 + 0.8 * u;
        x[i][2] = v;
    }
}

/* Along a line of this length, which lies askew in space. */
static inline void sites_on_line(size_t n, double length, double (*x)[3])
{
    for (size_t i = 0; i < n; i++) {
        const double s = length * (double)i / (double)(n > 1 ? n - 1 : 1);
        x[i][0] = 0.6 * s;
        x[i][1] = 1 - 0.48 * s;
        x[i][2] = 0.64 * s;
    }
}

/* All over a unit square, unevenly (a Kronecker sequence). */
static inline void sites_scattered(size_t n, double (*x)[3])
{
    for (size_t i = 0; i < n; i++) {
        x[i][0] = fmod(0.7548776662466927 * (double)(i + 1), 1.0);
        x[i][1] = fmod(0.5698402909980532 * (double)(i + 1), 1.0);
        x[i][2] = 0;
    }
}

#endif
