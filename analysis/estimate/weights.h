/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of the means on a line or a curve, and a test of the fit (docs/theory/estimators.md). */
#ifndef FRACAS_ANALYSIS_ESTIMATE_WEIGHTS_H
#define FRACAS_ANALYSIS_ESTIMATE_WEIGHTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A mean over replicas. */
typedef struct {
    int64_t replicas;
    double scatter; /* standard deviation of one replica/mean; not looked at for one replica */
} fracas_mean;

typedef struct {
    double variance; /* for log(mean); not positive or not finite: unknown */
    double most;     /* the greater of the shared and the own one, a lower bound for draws */
    double freedom;  /* degrees of freedom behind it; infinite: it is given, not estimated */
    bool pooled;     /* one relative variance for this mean and others */
} fracas_mean_error;

enum { FRACAS_REPLICAS_OWN = 8 }; /* least replicas to weigh a mean by their own scatter */

/* (estimators.25), (estimators.26): the errors of the `n` means of one line or curve, error[n].
 * Means of less than FRACAS_REPLICAS_OWN replicas share one relative variance, from their own
 * replicas, also for a mean of one replica; with less than 4 degrees of freedom together, or
 * without scatter, it is not less than the variance pooled over all means. Each other mean has its
 * own, unknown where its scatter is 0. All are unknown if all have one replica, or all scatter is
 * 0. */
void fracas_mean_errors(const fracas_mean *mean, size_t n, fracas_mean_error *error);

/* Data for the test of a line from its means; {0} before the first. */
typedef struct {
    double shared;        /* degrees of freedom of the pooled variance; 0: there is none */
    double kept, squares; /* sums of 1 - leverage and of its square over the means that share it */
    double doubt;         /* sum of (1 - leverage)^2/freedom of the others */
    bool others;          /* there are such */
} fracas_misfit;

/* leverage: d(fitted value)/d(value) of the mean, 0 to 1. */
void fracas_misfit_add(fracas_misfit *misfit, double leverage, const fracas_mean_error *error);

/* (estimators.27): p-value of `chi2` for means on the line. freedom: number of means less the
 * number of fitted constants. NaN if chi2 is, or freedom is not above 0. */
double fracas_misfit_probability(const fracas_misfit *misfit, double chi2, double freedom);

#define FRACAS_MISFIT_LIMIT 0.01 /* means whose probability is below are not on one line */

#endif
