/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mean size and count against strain rate: series, slopes, windows, crossovers
 * (docs/theory/scaling-laws.md, docs/theory/estimators.md). */
#ifndef FRACAS_ANALYSIS_SCALING_SCALING_H
#define FRACAS_ANALYSIS_SCALING_SCALING_H

#include "analysis/data/field.h"
#include "analysis/data/format.h"
#include "analysis/estimate/bootstrap.h"
#include "analysis/estimate/scales.h"
#include "analysis/estimate/weights.h"
#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct fracas_analysis;

typedef struct {
    size_t point;     /* for the study */
    int64_t replicas; /* in the mean */
    double rate;      /* 1/s, > 0 */
    double size;      /* m, mean over replicas, > 0 */
    double error;     /* log(size), by its own replicas; 0: all alike, NaN: one replica */
    bool whole;       /* fracas_size_whole */
} fracas_size_point;

typedef struct {
    char name[128];       /* "all points" if there is one series */
    fracas_scales scales; /* NaN where the points have not the same */
    size_t n;
    fracas_size_point *point; /* ascending in rate */
} fracas_size_series;

/* Whether a point has a strain rate and a mean size. */
bool fracas_size_counts(const struct fracas_analysis *analysis, size_t point);
/* Whether no body of the point came apart: each is of one fragment. */
bool fracas_size_whole(const struct fracas_analysis *analysis, size_t point);

/* Points equal in all parameters but those that make the rate are a series; points that do not
 * count are left out. A series without any point is left out. *list freed by
 * fracas_size_series_free. */
FRACAS_MUST_USE fracas_err fracas_size_series_create(const struct fracas_analysis *analysis,
                                                     fracas_size_series **list, size_t *count);
void fracas_size_series_free(fracas_size_series *list, size_t count);

enum { FRACAS_SLOPE_POINTS = 3 }; /* a line through fewer has no residual to judge it by */

/* A straight line through (x_i, y_i) by weighted least squares. */
typedef struct {
    int64_t n; /* values used */
    double slope, intercept;
    double chi2;   /* sum of squared residuals, each over its variance; NaN: unknown variances */
    double misfit; /* probability of such a chi2 or more if the values are on a line; NaN as chi2 */
    double pooled; /* degrees of freedom of the shared variance; NaN: none is shared, or known */
    double standard_error; /* for the slope, inflated where chi2/(n - 2) > 1 */
    double half_width;     /* half width of the 95 % interval: t_(0.975, n-2) standard_error */
    double freedom;        /* n - 2 */
} fracas_slope;

/* (estimators.1), (estimators.2), (estimators.3). x, y, error (of y): n values each. A variance
 * that is not positive or not finite is unknown: its value is left out, unless none is known; then
 * all weigh the same, and the residuals alone make the interval. Values that are not finite are
 * left out. With fewer than FRACAS_SLOPE_POINTS left, or all at one x, everything but n is NaN. */
fracas_slope fracas_slope_of(const double *x, const double *y, const fracas_mean_error *error,
                             size_t n);

/* log(mean size), or log(mean count), against log(strain rate) over some points of a study. */
typedef struct {
    char name[128]; /* for the series, or "all points", "all points, 3 series mixed" */
    int64_t mixes;  /* series that the points are of: above 1 they differ in more than the rate */
    fracas_slope slope;
    double mott, grady; /* exponents of the theories: for sizes FRACAS_SLOPE_MOTT and
                         * FRACAS_SLOPE_GRADY, for counts minus these; NaN with surfaces */
} fracas_size_slope;

/* series, points, slope, ... */
extern const fracas_fields fracas_slope_fields;

/* Slope of each series (points equal in all parameters but those that make the rate) with
 * FRACAS_SLOPE_POINTS usable points or more, if there are several, and last of all points together;
 * without enough points altogether, none. *list freed by the caller with free(). */
FRACAS_MUST_USE fracas_err fracas_size_slopes(const struct fracas_analysis *analysis,
                                              fracas_size_slope **list, size_t *count);
/* The same for the mean count; not `dust`: without dust, and none without much of it
 * (fracas_analysis_much_dust). */
FRACAS_MUST_USE fracas_err fracas_count_slopes(const struct fracas_analysis *analysis, bool dust,
                                               fracas_size_slope **list, size_t *count);
/* The value on the line at a rate: a size [m], or a count. */
double fracas_slope_at(const fracas_slope *slope, double rate);
/* "-0.546 \u00b1 0.012" */
fracas_number_text fracas_slope_text(const fracas_slope *slope);

/* Exponents of theories with a power of the rate. */
#define FRACAS_SLOPE_MOTT (-1.0)
#define FRACAS_SLOPE_GRADY (-2.0 / 3)

/* d log s/d log edot between two neighbouring rates. */
typedef struct {
    double slope;
    double standard_error; /* from those of the two means */
    double freedom;    /* degrees of freedom of the standard error, by Welch and Satterthwaite */
    double half_width; /* 95 %; NaN: one replica, or few (FRACAS_REPLICAS_OWN) without scatter */
} fracas_window;

/* (scaling-laws.11), (scaling-laws.12), (scaling-laws.13). NaN if the rates differ by rounding
 * alone (1e-9).
 */
fracas_window fracas_window_of(const fracas_size_point *low, const fracas_size_point *high);

typedef struct {
    char name[128];       /* for the series */
    size_t point[2];      /* for the study */
    double rate[2];       /* 1/s, ascending */
    double normalised[2]; /* rates over edot0 of the series */
    fracas_window window;
} fracas_size_window;

/* series, from_point, to_point, ... */
extern const fracas_fields fracas_window_fields;

/* Windows between every two neighbouring rates of every series at which some body came apart,
 * series by series, ascending. *list freed by the caller with free(). */
FRACAS_MUST_USE fracas_err fracas_size_windows(const struct fracas_analysis *analysis,
                                               fracas_size_window **list, size_t *count);

enum { FRACAS_CROSSOVER_RATES = 5 }; /* two more than the form has constants */

/* s = s_q/(1 + (edot/edot_c)^k): s_q at low rates, exponent 0, and s_q (edot/edot_c)^(-k) at high
 * ones. Some draws run away, so intervals have quantiles alone: standard_error is half the width
 * between the quantiles 0.1587 and 0.8413. */
typedef struct {
    char name[128];                                   /* for the series */
    char reason[160];                                 /* why there is no fit; "": there is one */
    int64_t n;                                        /* points used */
    fracas_scales scales;                             /* for the series */
    fracas_interval size;                             /* s_q [m] */
    fracas_interval rate;                             /* edot_c [1/s] */
    fracas_interval rate_normalised, size_normalised; /* over edot0, over s0 */
    double low_exponent;                              /* 0; NaN without a fit */
    fracas_interval exponent; /* -k, at high rates; the exponent at low ones is 0 by the form */
    double chi2;              /* sum of squared residuals of log s, each over its standard error */
    double freedom;           /* n - 3 */
    double misfit; /* probability of such a chi2 or more if the means are on such a curve */
    double pooled; /* degrees of freedom of the variance shared by means; NaN: each has its own */
    double inflation; /* for the standard errors, in the intervals: max(1, sqrt(chi2/freedom)) */
} fracas_size_crossover;

/* series, points, reason, ... */
extern const fracas_fields fracas_crossover_fields;

/* (scaling-laws.14), (scaling-laws.15), (scaling-laws.16): weighted least squares of log s over the
 * points that came apart and have a known standard error (fracas_mean_errors), and 95 % intervals
 * from `resamples` draws of their means (0: no intervals; NaN). Numbers are NaN and `reason` says
 * why for fewer than FRACAS_CROSSOVER_RATES rates, or without a bend between them. Equal seeds give
 * equal intervals. */
FRACAS_MUST_USE fracas_err fracas_crossover_fit(const fracas_size_series *series, int64_t resamples,
                                                uint64_t seed, fracas_size_crossover *crossover);

/* s at a rate [m]. */
double fracas_crossover_at(const fracas_size_crossover *crossover, double rate);

enum { FRACAS_CROSSOVER_RESAMPLES = 999 };

/* Crossovers of every series; with `intervals` FRACAS_CROSSOVER_RESAMPLES draws. *list freed by the
 * caller with free(). */
FRACAS_MUST_USE fracas_err fracas_size_crossovers(const struct fracas_analysis *analysis,
                                                  bool intervals, fracas_size_crossover **list,
                                                  size_t *count);

#endif
