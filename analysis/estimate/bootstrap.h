/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Intervals by resampling realizations: fragments of one realization are not independent,
 * realizations are. */
#ifndef FRACAS_ANALYSIS_ESTIMATE_BOOTSTRAP_H
#define FRACAS_ANALYSIS_ESTIMATE_BOOTSTRAP_H

#include "analysis/data/field.h"
#include "base/err.h"
#include "base/own.h"

#include <gsl/gsl_rng.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* `OWN(gsl_rng) random = fracas_random(seed);` Mersenne Twister (MT19937): equal seeds give equal
 * numbers. Freed by gsl_rng_free; NULL without memory. */
gsl_rng *fracas_random(uint64_t seed);
FRACAS_OWNER(gsl_rng, gsl_rng_free)

/* weight[n]: how often each of n realizations was drawn in n drawings. */
void fracas_resample(gsl_rng *random, size_t n, uint32_t *weight);

/* Values of a resample in which realization i was drawn weight[i] times (sum of weights n):
 * `nvalues` of them into *value; NaN where the resample gives none. */
typedef void fracas_resampled(void *context, const uint32_t *weight, double *value);

typedef struct {
    double value;          /* for the realizations as they are */
    double low, high;      /* NaN where there is no interval */
    double standard_error; /* deviation over resamples; of few realizations by fracas_jackknife */
    int64_t resamples;     /* resamples with a value */
} fracas_interval;

/* value, low, high; with the standard error. */
extern const fracas_fields fracas_interval_fields, fracas_interval_error_fields;

/* Quantile p of ascending values, as the definition of a bootstrap interval has it: value number p
 * (count + 1). */
double fracas_quantile(const double *ascending, size_t count, double p);

typedef struct {
    int64_t resamples; /* B; 0: 2000 */
    double confidence; /* 0: 0.95 */
    uint64_t seed;     /* equal seeds give equal intervals */
    bool plain;        /* not expanded: as Efron has them */
} fracas_bootstrap_options;

/* Bias-corrected and accelerated intervals (BCa; Efron 1987, Efron and Tibshirani 1993, chapter 14)
 * of `nvalues` values of n realizations, from B resamples with replacement; the acceleration from
 * the jackknife, over at most 200 groups of realizations. Normal quantiles z are replaced by
 * sqrt(n/(n - 1)) t_(n-1), as Hesterberg (The American Statistician 69, 371, 2015) expands
 * percentile intervals: resamples of n values vary less by (n - 1)/n, and their variance is itself
 * an estimate (estimators.18). Resamples of fewer than FRACAS_BOOTSTRAP_LEAST realizations do not
 * go far enough: the interval is then value -+ t_(n-1) e, e of fracas_jackknife (estimators.18),
 * `resamples` counts the realizations left out in turn, and `plain` has no effect. low and high are
 * NaN for n < 2, and for a value that does not exist without one of so few. interval[nvalues].
 * FRACAS_ENVIRONMENT without memory. */
enum { FRACAS_BOOTSTRAP_LEAST = 8 };
FRACAS_MUST_USE fracas_err fracas_bootstrap(size_t n, size_t nvalues, fracas_resampled *statistic,
                                            void *context, const fracas_bootstrap_options *options,
                                            fracas_interval *interval);

typedef struct {
    double value;          /* for the realizations as they are */
    double standard_error; /* NaN for n < 2 */
    size_t groups;         /* g, groups left out in turn: n of them, 200 at most */
} fracas_jackknifed;

/* e^2 = (g - 1)/g sum over groups of (value without the group - value)^2: of a mean over
 * realizations its variance/n. found[nvalues]. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_jackknife(size_t n, size_t nvalues, fracas_resampled *statistic,
                                            void *context, fracas_jackknifed *found);

#endif
