/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exponent of mean size against strain rate (docs/theory/estimators.md). */
#ifndef FRACAS_ANALYSIS_SCALING_SLOPE_H
#define FRACAS_ANALYSIS_SCALING_SLOPE_H

#include "analysis/data/field.h"
#include "analysis/estimate/weights.h"
#include "base/err.h"

#include <stddef.h>
#include <stdint.h>

struct fracas_analysis;

enum { FRACAS_SLOPE_POINTS = 3 }; /* a line through fewer has no residual to judge it by */

/* A straight line through (x_i, y_i) by weighted least squares. */
typedef struct {
    int64_t n; /* values used */
    double slope, intercept;
    double chi2;   /* sum of squared residuals, each over its variance; NaN if the variances are not
                      known */
    double misfit; /* probability of such a chi2 or more if the values are on a line; NaN as chi2 */
    double pooled; /* degrees of freedom of the variance shared by values; NaN: each has its own, or
                      it is not known */
    double standard_error; /* for the slope, inflated where chi2/(n - 2) > 1 */
    double half_width;     /* half width of the 95 % interval of the slope: t_(0.975, n-2)
                              standard_error */
    double freedom;        /* n - 2 */
} fracas_slope;

/* (estimators.1), (estimators.2), (estimators.3). x, y, error (of y): n values each. A variance
 * that is not positive or not finite is unknown: its value is left out, unless none is known; then
 * all weigh the same, and the residuals alone make the interval. Values that are not finite are
 * left out. With fewer than FRACAS_SLOPE_POINTS left, or all at one x, everything but n is NaN. */
fracas_slope fracas_slope_of(const double *x, const double *y, const fracas_mean_error *error,
                             size_t n);

/* log(mean size) against log(strain rate) over some points of a study. */
typedef struct {
    char name[128]; /* for the series, "all points" for the first */
    fracas_slope slope;
    double mott, grady; /* exponents of the theories: FRACAS_SLOPE_MOTT, FRACAS_SLOPE_GRADY */
} fracas_size_slope;

/* series, points, slope, ... */
extern const fracas_fields fracas_slope_fields;

/* Slope of all points together, and, if there are several series (points equal in all parameters
 * but those that make the rate), of each series with FRACAS_SLOPE_POINTS usable points or more;
 * without enough points altogether, none. *list freed by the caller with free(). */
FRACAS_MUST_USE fracas_err fracas_size_slopes(const struct fracas_analysis *analysis,
                                              fracas_size_slope **list, size_t *count);

/* Exponents of theories with a power of the rate. */
#define FRACAS_SLOPE_MOTT (-1.0)
#define FRACAS_SLOPE_GRADY (-2.0 / 3)

#endif
