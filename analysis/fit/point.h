/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every family fitted to the fragments of one point, and judged (docs/theory/fits.md). */
#ifndef FRACAS_ANALYSIS_FIT_POINT_H
#define FRACAS_ANALYSIS_FIT_POINT_H

#include "analysis/estimate/bootstrap.h"
#include "analysis/fit/sample.h"

/* ---- maximum likelihood of counts in cells: GSL's error handler must be off ---- */

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

/* ---- judgement ---- */

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
 * dependence of these on each other. Has no sizes, only cells. Cleared by the caller, also after an
 * error. */
FRACAS_MUST_USE fracas_err fracas_fit_carry(const fracas_fit_sample *sample,
                                            const double *probability, uint64_t seed,
                                            fracas_fit_sample *carried);

/* D and A2 of a fit and their p-values from `resamples` resamples of realizations, carried over to
 * the fitted law and fitted again. */
FRACAS_MUST_USE fracas_err fracas_fit_goodness_of(const fracas_family *family,
                                                  const fracas_fit_sample *sample,
                                                  const fracas_fit *fit, int64_t resamples,
                                                  uint64_t seed, fracas_fit_goodness *goodness);

typedef struct {
    bool nested;      /* one family is a special case of the other */
    double statistic; /* Vuong's z (fits.14), positive: the first is better; nested: (fits.15) */
    double p; /* p of so much though neither is better, or the special case holds; NaN: unknown */
    int64_t resamples; /* for a nested one, number of refits that arrived */
} fracas_fit_comparison;

/* The variance is taken over realizations. Fewer than 4 realizations: no p. */
FRACAS_MUST_USE fracas_err fracas_fit_compare(const fracas_fit_sample *sample,
                                              const fracas_family *const family[2],
                                              const fracas_fit fit[2], int64_t resamples,
                                              uint64_t seed, fracas_fit_comparison *comparison);

typedef struct {
    fracas_fit fit;
    double aicc, bic; /* (fits.13) */
    double delta;     /* aicc - the least of all valid fits */
    int rank;         /* by aicc from 1; 0: it is no fit */
    fracas_fit_goodness goodness;
    fracas_interval parameter[FRACAS_FAMILY_PARAMETERS]; /* lengths in m */
    fracas_interval relative[FRACAS_FAMILY_PARAMETERS];  /* lengths over the mean above the cut */
} fracas_family_fit;

typedef struct {
    fracas_fit_sample sample;
    const fracas_family *const *families; /* nfamilies of them */
    size_t nfamilies;
    fracas_family_fit family[FRACAS_NFAMILIES]; /* in their order */
    fracas_interval mean, cv;                   /* for the sizes above the cut [m], [1] */
    size_t nfits;                               /* number of valid fits */
    size_t best[2];                   /* families of rank 1 and 2, where there are so many */
    fracas_fit_comparison comparison; /* for these two */
} fracas_point_fits;

/* The families for sizes: all; for surfaces, whose sizes are square roots of areas, all but Mott's,
 * which is exponential in them. */
const fracas_family *const *fracas_point_families(bool surface, size_t *nfamilies);

/* Fits at most FRACAS_NFAMILIES families, which must outlive *fits. Equal seeds give equal fits.
 * Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_point_fits_of(const fracas_ensemble *ensemble,
                                                const fracas_family *const *families,
                                                size_t nfamilies, int64_t resamples, uint64_t seed,
                                                fracas_point_fits *fits);
void fracas_point_fits_clear(fracas_point_fits *fits);

#endif
