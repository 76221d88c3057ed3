/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates from the fragments of all realizations of a point together (docs/theory/estimators.md).
 */
#ifndef FRACAS_ANALYSIS_ESTIMATE_POOLED_H
#define FRACAS_ANALYSIS_ESTIMATE_POOLED_H

#include "analysis/data/ensemble.h"
#include "analysis/estimate/bootstrap.h"
#include "analysis/data/estimate.h"
#include "base/err.h"

enum { FRACAS_NQUANTILES = 5 };

/* Sizes s of some fragments, of masses m. All are ratios of sums over realizations, or quantiles of
 * those: NaN without a fragment. */
typedef struct {
    fracas_interval mean;                        /* m, sum s/number */
    fracas_interval mass_mean;                   /* m, sum m s/sum m */
    fracas_interval variation;                   /* standard deviation (divisor: number)/mean */
    fracas_interval quantile[FRACAS_NQUANTILES]; /* m, by number: 0.05, 0.25, 0.5, 0.75, 0.95 */
    fracas_interval mass_quantile[FRACAS_NQUANTILES]; /* m, by mass */
} fracas_sizes;

/* Variance of sizes within and between realizations, groups of unequal numbers: one-way analysis of
 * variance with random effects. */
typedef struct {
    fracas_interval within, between; /* m2; an estimate of the latter may be negative */
    fracas_interval intraclass;      /* between/(within + between); from -1/(group - 1) to 1 */
    fracas_interval design_effect;   /* 1 + (group - 1) intraclass */
    double group;                    /* m0, fragments of a typical realization */
    double effective; /* fragments/design effect: independent ones that tell as much */
} fracas_variance;

typedef struct {
    double cut;                                  /* m, fracas_ensemble_cut */
    int64_t number, resolved;                    /* fragments, and those above the cut */
    fracas_sizes all, above;                     /* for all fragments, and of those above the cut */
    fracas_interval unresolved, unresolved_mass; /* share of the rest, by number and by mass */
    fracas_variance variance;                    /* over all */
} fracas_pooled;

/* Units of resampling: realizations, of more than 1000 of them 500 groups of as many neighbours. */
size_t fracas_pooled_units(size_t realizations);
/* The unit of realization i. */
size_t fracas_pooled_unit(size_t i, size_t realizations);

/* (estimators.15) to (estimators.21), with 95 % intervals by fracas_bootstrap from 2000 resamples
 * of units. Equal seeds give equal intervals. FRACAS_ENVIRONMENT without memory: 32 bytes a
 * fragment and 4 kB a unit. */
FRACAS_MUST_USE fracas_err fracas_pooled_of(const fracas_ensemble *ensemble, uint64_t seed,
                                            fracas_pooled *pooled);

/* Estimates from sums alone: mean, mass_mean, variation of all fragments of the first
 * `realizations` realizations. */
enum { FRACAS_POOLED_MEAN, FRACAS_POOLED_MASS_MEAN, FRACAS_POOLED_VARIATION, FRACAS_NPOOLED };
FRACAS_MUST_USE fracas_err fracas_pooled_first(const fracas_ensemble *ensemble, size_t realizations,
                                               uint64_t seed,
                                               fracas_interval interval[FRACAS_NPOOLED]);
/* The same of realizations begin to end - 1 alone, with variances from leaving out units in turn
 * (fracas_jackknife). */
FRACAS_MUST_USE fracas_err fracas_pooled_part(const fracas_ensemble *ensemble, size_t begin,
                                              size_t end, fracas_part part[FRACAS_NPOOLED]);

/* Fills the quantiles of pooled->all, and of the fragments above `cut` those of pooled->above
 * (estimators.16). */
FRACAS_MUST_USE fracas_err fracas_quantiles_of(const fracas_ensemble *ensemble, double cut,
                                               uint64_t seed, fracas_pooled *pooled);

#endif
