/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distance of counts from a family, and its p-value by resampling under the family
 * (docs/theory/fits.md). */
#ifndef FRACAS_ANALYSIS_FIT_GOODNESS_H
#define FRACAS_ANALYSIS_FIT_GOODNESS_H

#include "analysis/fit/likelihood.h"

typedef struct {
    double ks, ad; /* D  (fits.9), A2/N  (fits.10), on cells */
} fracas_fit_distance;

typedef struct {
    fracas_fit_distance distance;
    double ks_p, ad_p; /* (fits.12); NaN below FRACAS_FIT_GOODNESS_LEAST realizations */
    int64_t resamples; /* whose refits arrived */
} fracas_fit_goodness;

enum { FRACAS_FIT_GOODNESS_LEAST = 4 };

fracas_fit_distance fracas_fit_distance_of(size_t ncells, const double *count,
                                           const double *probability);

/* The sample with every fragment moved to its cell under a family: the fragment of rank r of N (by
 * size, in random order within a cell) to the cell of the quantile (r - 1/2)/N  (fits.11). Together
 * the fragments have this distribution; realizations keep their numbers of fragments and the
 * dependence of these on each other. Has no sizes, only cells. Cleared by the caller. */
FRACAS_MUST_USE fracas_err fracas_fit_carry(const fracas_fit_sample *sample,
                                            const double *probability, uint64_t seed,
                                            fracas_fit_sample *carried);

/* D and A2 of a fit and their p-values from `resamples` resamples of realizations, carried over to
 * the fitted law and fitted again. */
FRACAS_MUST_USE fracas_err fracas_fit_goodness_of(const fracas_family *family,
                                                  const fracas_fit_sample *sample,
                                                  const fracas_fit *fit, int64_t resamples,
                                                  uint64_t seed, fracas_fit_goodness *goodness);

#endif
