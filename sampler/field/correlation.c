/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/field/correlation.h"

#include "base/elementary.h"
#include "sampler/field/circulant.h"
#include "sampler/field/dense_factor.h"
#include "sampler/field/sparse_factor.h"

#include <math.h>
#include <stdlib.h>

/* Sites this near, by their spacing, to equally spaced places are on them. */
#define NEAR 1e-8
struct fracas_correlation {
    size_t n;
    fracas_circulant *circulant; /* one of them */
    fracas_sparse_factor *sparse;
};

static bool is_at(const double a[3], double x, double y, double z, double tolerance)
{
    return fracas_distance(a, (const double[3]){x, y, z}) <= tolerance;
}

/* True if site i is at x_0 + i (x_(n-1) - x_0)/(n - 1); the spacing. */
static bool is_line(size_t n, const double (*x)[3], double *spacing)
{
    const double *first = x[0], *last = x[n - 1];
    *spacing = fracas_distance(first, last) / (double)(n - 1);
    for (size_t i = 0; i < n; i++) {
        const double s = (double)i / (double)(n - 1);
        if (!is_at(x[i], first[0] + s * (last[0] - first[0]), first[1] + s * (last[1] - first[1]),
                   first[2] + s * (last[2] - first[2]), NEAR * *spacing))
            return false;
    }
    return *spacing > 0.0;
}

/* True if site i is at c + r (cos(2 pi i/n) a + sin(2 pi i/n) b), with c the mean of all, r a from
 * there to site 0 and b from a site a quarter of the circle on; the radius. */
static bool is_circle(size_t n, const double (*x)[3], double *radius)
{
    double c[3] = {0}, a[3], b[3];
    const size_t quarter = (n + 1) / 4;
    const double along = fracas_cospi(2.0 * (double)quarter / (double)n),
                 across = fracas_sinpi(2.0 * (double)quarter / (double)n);
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) c[k] += x[i][k] / (double)n;
    *radius = fracas_distance(x[0], c);
    for (int k = 0; k < 3; k++) {
        a[k] = x[0][k] - c[k];
        b[k] = (x[quarter][k] - c[k] - along * a[k]) / across;
    }
    const double tolerance = NEAR * 2.0 * *radius * fracas_sinpi(1.0 / (double)n);
    const double skew = a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
                 length = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    if (!(*radius > 0.0) || fabs(length - *radius) > tolerance || fabs(skew) > tolerance * *radius)
        return false;
    for (size_t i = 0; i < n; i++) {
        const double s = fracas_cospi(2.0 * (double)i / (double)n),
                     t = fracas_sinpi(2.0 * (double)i / (double)n);
        if (!is_at(x[i], c[0] + s * a[0] + t * b[0], c[1] + s * a[1] + t * b[1],
                   c[2] + s * a[2] + t * b[2], tolerance))
            return false;
    }
    return true;
}

static fracas_err choose_factor(fracas_correlation *correlation,
                                const fracas_covariance *covariance, const double (*x)[3])
{
    const size_t n = correlation->n;
    double size;
    if (n >= 3 && is_circle(n, x, &size))
        return fracas_circulant_circle(covariance, n, size, &correlation->circulant);
    if (n >= 3 && is_line(n, x, &size)) {
        TRY(fracas_circulant_line(covariance, n, size, &correlation->circulant));
        if (n > FRACAS_DENSE_SITES || fracas_circulant_error(correlation->circulant) < 1e-12)
            return FRACAS_OK;
        fracas_circulant_destroy(correlation->circulant); /* no circle fits: few sites do without */
        correlation->circulant = NULL;
    }
    return fracas_sparse_factor_create(covariance, n, x, &correlation->sparse);
}

/* (fields.5) x [m] along a circle of this circumference. */
static fracas_err closed_factor(fracas_correlation *correlation,
                                const fracas_covariance *covariance, const double (*position)[3],
                                double period)
{
    OWNED double(*x)[3] = malloc((correlation->n + 1) * sizeof *x);
    if (!x) return fracas_no_memory("a correlated field");
    for (size_t i = 0; i < correlation->n; i++) {
        const double turn = 2.0 * (position[i][0] / period), radius = period / (2.0 * FRACAS_PI);
        x[i][0] = radius * fracas_cospi(turn);
        x[i][1] = radius * fracas_sinpi(turn);
        x[i][2] = 0.0;
    }
    return choose_factor(correlation, covariance, (const double(*)[3])x);
}

fracas_err fracas_correlation_create(const fracas_strength *strength, size_t n,
                                     const double (*position)[3], double period,
                                     fracas_correlation **correlation)
{
    OWN(fracas_covariance) covariance = NULL;
    OWN(fracas_correlation) made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a correlated field");
    made->n = n;
    TRY(fracas_covariance_create(strength, &covariance));
    TRY(period > 0.0 ? closed_factor(made, covariance, position, period)
                     : choose_factor(made, covariance, position));
    *correlation = made;
    made = NULL;
    return FRACAS_OK;
}

void fracas_correlation_destroy(fracas_correlation *correlation)
{
    if (!correlation) return;
    fracas_circulant_destroy(correlation->circulant);
    fracas_sparse_factor_destroy(correlation->sparse);
    free(correlation);
}

size_t fracas_correlation_normals(const fracas_correlation *correlation)
{
    return correlation->circulant ? fracas_circulant_normals(correlation->circulant)
                                  : correlation->n;
}

fracas_err fracas_correlation_apply(const fracas_correlation *correlation, const double *w,
                                    double *z)
{
    if (correlation->circulant) return fracas_circulant_apply(correlation->circulant, w, z);
    return fracas_sparse_factor_apply(correlation->sparse, w, z);
}

double fracas_correlation_error(const fracas_correlation *correlation)
{
    return correlation->circulant ? fracas_circulant_error(correlation->circulant)
                                  : fracas_sparse_factor_error(correlation->sparse);
}
