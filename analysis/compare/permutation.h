/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two samples of realizations by permutation: whole realizations change sides, never fragments
 * (docs/theory/compare.md). */
#ifndef FRACAS_ANALYSIS_COMPARE_PERMUTATION_H
#define FRACAS_ANALYSIS_COMPARE_PERMUTATION_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    size_t na, nb; /* realizations; of pairs na = nb, and i of a belongs to i of b */
    bool paired;
    size_t nvalues;
    const double *value; /* (na + nb) x nvalues, realization by realization, those of a first; NaN
                            is left out */
    size_t ncuts;
    const double *below; /* (na + nb) x ncuts: fragments of each realization of at most the size of
                            the cut, ascending */
    const double *fragments; /* one each realization */
} fracas_two_samples;

typedef struct {
    double p; /* NaN: no test */
    double
        distance; /* largest difference of the two distribution functions of sizes, at the cuts */
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
