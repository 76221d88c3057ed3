/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Maximum likelihood of counts in cells (docs/theory/fits.md). GSL's error handler must be off. */
#ifndef FRACAS_ANALYSIS_FIT_LIKELIHOOD_H
#define FRACAS_ANALYSIS_FIT_LIKELIHOOD_H

#include "analysis/fit/sample.h"

typedef struct {
    double parameter[FRACAS_FAMILY_PARAMETERS]; /* lengths over the mean of the sample */
    double log_likelihood;
    char why[96]; /* "" for a valid fit */
} fracas_fit;

enum { FRACAS_FIT_LEAST = 30 }; /* least fragments above the cut for a fit */

/* p_k = (P(x > edge[k]) - P(x > edge[k + 1]))/P(x > cut) of every cell  (fits.6); false for invalid
 * parameters. */
bool fracas_fit_probabilities(const fracas_family *family, const fracas_fit_sample *sample,
                              const double *parameter, double *probability);

/* sum over cells of count log p  (fits.7); -INFINITY for a count in an impossible cell. */
double fracas_fit_log_likelihood(const fracas_family *family, const fracas_fit_sample *sample,
                                 const double *count, const double *parameter);

/* The largest likelihood of the sample's counts: from each start of the family by simplex (GSL's
 * nmsimplex2), then by scoring; the best of them. fit->why names an obstacle: too few fragments, no
 * convergence, a parameter at its bound. */
void fracas_fit_of(const fracas_family *family, const fracas_fit_sample *sample, fracas_fit *fit);

/* The same for other counts in these cells, close to those of `near`: from there by scoring, by
 * simplex where scoring does not arrive. Parameters at a bound stay there. False, and no
 * *parameter, where neither does. */
bool fracas_fit_again(const fracas_family *family, const fracas_fit_sample *sample,
                      const double *count, const fracas_fit *near, double *parameter);

#endif
