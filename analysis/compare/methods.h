/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of a comparison: points matched, means and distributions compared
 * (docs/theory/compare.md). */
#ifndef FRACAS_ANALYSIS_COMPARE_METHODS_H
#define FRACAS_ANALYSIS_COMPARE_METHODS_H

#include "analysis/compare/compare.h"
#include "base/err.h"
#include "campaigns/points.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Matches points of equal hash, then points with equal values in the columns `by`, such as
 * "loading.rate,strength.shape". NULL: all columns that vary in both studies; where one has a
 * single point, those that vary in the other. partner[a->npoints]: the point of b, SIZE_MAX without
 * one. how: the columns used, "" if hashes were enough. Two studies of one point each are matched
 * without columns ("being the only ones"). FRACAS_USAGE for a column missing in a study, and where
 * two points of a study are equal in the columns. */
FRACAS_MUST_USE fracas_err fracas_match_points(const fracas_point_table *a,
                                               const fracas_point_table *b, const char *by,
                                               size_t *partner, char *how, size_t size);

/* "mesh.elements 2500 | 5000, time.end 3e-07 | 6e-07": the differences of two points, "" for none.
 * Derived columns are left out. */
void fracas_match_differs(const fracas_point_table *a, size_t p, const fracas_point_table *b,
                          size_t q, char *text, size_t size);

/* (compare.1), (compare.2), (compare.3). a[stride i], b[stride j]: na and nb values; values that
 * are not finite are left out. Sets all but p. */
void fracas_difference_of(const double *a, size_t na, const double *b, size_t nb, size_t stride,
                          fracas_compared_value *value);
/* (compare.4), (compare.5). Value i of a belongs to value i of b; a pair of which one is not finite
 * is left out. */
void fracas_difference_of_pairs(const double *a, const double *b, size_t n, size_t stride,
                                fracas_compared_value *value);

/* (compare.10): p of `count` tests, p[stride i], corrected by Holm into corrected[stride i]; NaN
 * are no tests. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_holm(const double *p, size_t count, size_t stride,
                                       double *corrected);

typedef struct {
    size_t na, nb; /* realizations; of pairs na = nb, and i of a belongs to i of b */
    bool paired;
    size_t nvalues;
    const double *value; /* (na + nb) x nvalues, a first; NaN is left out */
    size_t ncuts;
    const double *below;     /* (na + nb) x ncuts: fragments up to each cut, ascending */
    const double *fragments; /* one each realization */
} fracas_two_samples;

typedef struct {
    double p;        /* NaN: no test */
    double distance; /* largest difference of the distribution functions of sizes, at cuts */
} fracas_permuted;

/* result[nvalues] of equal means, and one more behind them of equal distributions of sizes. Means
 * are studentized by Welch's standard error (compare.6), of pairs by the signs of the differences
 * (compare.8); sizes by (compare.9). All assignments are counted where they are at most
 * `permutations` + 1 (*exact), else `permutations` random ones and the observed one; *count: how
 * many. A sample with fewer than two values has no p. Equal seeds give equal p. */
FRACAS_MUST_USE fracas_err fracas_permutation_test(const fracas_two_samples *samples,
                                                   int64_t permutations, uint64_t seed,
                                                   fracas_permuted *result, int64_t *count,
                                                   bool *exact);

#endif
