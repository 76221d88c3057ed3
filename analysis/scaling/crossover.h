/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where mean size goes over from the quasi-static to the dynamic regime
 * (docs/theory/scaling-laws.md).
 */
#ifndef FRACAS_ANALYSIS_SCALING_CROSSOVER_H
#define FRACAS_ANALYSIS_SCALING_CROSSOVER_H

#include "analysis/estimate/bootstrap.h"
#include "analysis/scaling/series.h"
#include "analysis/estimate/weights.h"

enum { FRACAS_CROSSOVER_RATES = 5 }; /* two more than the form has constants */

/* s = s_q/(1 + (edot/edot_c)^k): s_q at low rates, exponent 0, and s_q (edot/edot_c)^(-k) at high
 * ones. Some draws run away, so intervals have quantiles alone: standard_error is half the width
 * between the quantiles 0.1587 and 0.8413, bias the median less the value. */
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
