/* Intervals by resampling realizations: fragments of one realization are not independent, realizations are. */
#ifndef FRACAS_ANALYSIS_ESTIMATE_BOOTSTRAP_H
#define FRACAS_ANALYSIS_ESTIMATE_BOOTSTRAP_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Values of a resample in which realization i was drawn weight[i] times (sum of weights n): `nvalues` of them into *value; NaN where the
 * resample gives none. */
typedef void fracas_resampled(void *context, const uint32_t *weight, double *value);

typedef struct {
    double value;          /* of the realizations as they are */
    double low, high;      /* NaN where there is no interval */
    double standard_error; /* standard deviation over resamples */
    double bias;           /* mean over resamples - value */
    int64_t resamples;     /* that gave a value */
} fracas_interval;

typedef struct {
    int64_t resamples;  /* B; 0: 2000 */
    double confidence;  /* 0: 0.95 */
    uint64_t seed;      /* equal seeds give equal intervals */
    bool plain;         /* not expanded: as Efron has them */
} fracas_bootstrap_options;

/* Bias-corrected and accelerated intervals (BCa; Efron 1987, Efron and Tibshirani 1993, chapter 14) of `nvalues` values of n realizations,
 * from B resamples of n realizations with replacement; the acceleration from the jackknife, over at most 200 groups of realizations where
 * there are more. Normal quantiles z in them are replaced by sqrt(n/(n - 1)) t_(n-1), as Hesterberg (The American Statistician 69, 371, 2015) expands
 * percentile intervals: resamples of n values vary less by (n - 1)/n, and what they vary by is itself an estimate (estimators.18). interval[nvalues]. Below n = FRACAS_BOOTSTRAP_LEAST low and high are NaN. FRACAS_ENVIRONMENT without memory. */
enum { FRACAS_BOOTSTRAP_LEAST = 4 };
FRACAS_MUST_USE fracas_err fracas_bootstrap(size_t n, size_t nvalues, fracas_resampled *statistic, void *context,
                                            const fracas_bootstrap_options *options, fracas_interval *interval);

#endif
