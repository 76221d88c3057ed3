/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the headline numbers of a point settle as its replicas grow, in their order. */
#ifndef FRACAS_ANALYSIS_ESTIMATE_CONVERGENCE_H
#define FRACAS_ANALYSIS_ESTIMATE_CONVERGENCE_H

#include "analysis/data/ensemble.h"
#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Means over replicas with Student's interval, then ratios of sums over realizations with that of
 * fracas_bootstrap. */
typedef enum {
    FRACAS_HEADLINE_COUNT,
    FRACAS_HEADLINE_SIZE,
    FRACAS_HEADLINE_DISSIPATED,
    FRACAS_HEADLINE_LARGEST_SHARE,
    FRACAS_HEADLINE_MEAN,
    FRACAS_HEADLINE_MASS_MEAN,
    FRACAS_HEADLINE_VARIATION,
} fracas_headline;

#define FRACAS_NHEADLINES 7

extern const char *const fracas_headline_key[FRACAS_NHEADLINES]; /* as in fracas_statistics, without
                                                                    ".mean" or ".value" */

typedef struct {
    double value, low, high; /* NaN where there is none */
} fracas_settling;

/* All replicas gave the same: no scatter, but for rounding, to know the value by. */
bool fracas_settling_alike(const fracas_settling *number);

typedef struct {
    int64_t replicas; /* the first so many usable ones */
    fracas_settling number[FRACAS_NHEADLINES];
} fracas_running;

typedef struct {
    size_t count;
    fracas_running *row; /* after FRACAS_CONVERGENCE_FIRST 2^k realizations, and after all */
    double half[FRACAS_NHEADLINES],
        rest[FRACAS_NHEADLINES]; /* of the first half of the realizations alone, and of the others;
                                    NaN of fewer than two */
    double alike[FRACAS_NHEADLINES];      /* probability that halves of like realizations are as far
                                             apart; NaN: nothing says how far they may be */
    int64_t converged[FRACAS_NHEADLINES]; /* 1, or 0 */
    int64_t unconverged;                  /* numbers that are not, of those that the point has */
} fracas_replica_convergence;

/* (estimators.22): a number is converged if its half width w = (high - low)/2 is at most
 * FRACAS_CONVERGED_WIDTH |value| and its halves are not such as replicas that are alike have but
 * once in 1/FRACAS_CONVERGED_ALARM times (fracas_parts_alike). */
#define FRACAS_CONVERGED_WIDTH 0.05
#define FRACAS_CONVERGED_ALARM (1.0 / 1600)
enum { FRACAS_CONVERGENCE_FIRST = 4 };

/* True if halves say that replicas are not alike: the number drifts. */
bool fracas_replica_convergence_drifts(const fracas_replica_convergence *convergence,
                                       fracas_headline headline);

/* Of the realizations in the order of the study, which is that of replicas. Cleared by the caller,
 * also after an error. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_replica_convergence_of(const fracas_ensemble *ensemble,
                                                         uint64_t seed,
                                                         fracas_replica_convergence *convergence);
void fracas_replica_convergence_clear(fracas_replica_convergence *convergence);

#endif
