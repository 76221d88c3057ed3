/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every family fitted to the fragments of one point, and judged. */
#ifndef FRACAS_ANALYSIS_FIT_POINT_H
#define FRACAS_ANALYSIS_FIT_POINT_H

#include "analysis/estimate/bootstrap.h"
#include "analysis/fit/compare.h"
#include "analysis/fit/goodness.h"

typedef struct {
    fracas_fit fit;
    double aicc, bic; /* (fits.13) */
    double delta;     /* aicc - the least of all valid fits */
    int rank;         /* by aicc from 1; 0: it is no fit */
    fracas_fit_goodness goodness;
    fracas_interval parameter[FRACAS_FAMILY_PARAMETERS]; /* lengths in m */
    fracas_interval relative[FRACAS_FAMILY_PARAMETERS];  /* for a length: over the mean of the sizes
                                                            above the cut, resample by resample */
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
 * Cleared by the caller. */
FRACAS_MUST_USE fracas_err fracas_point_fits_of(const fracas_ensemble *ensemble,
                                                const fracas_family *const *families,
                                                size_t nfamilies, int64_t resamples, uint64_t seed,
                                                fracas_point_fits *fits);
void fracas_point_fits_clear(fracas_point_fits *fits);

#endif
