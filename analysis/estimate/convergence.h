/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The headline numbers of a point as its replicas grow, in their order. */
#ifndef FRACAS_ANALYSIS_ESTIMATE_CONVERGENCE_H
#define FRACAS_ANALYSIS_ESTIMATE_CONVERGENCE_H

#include "analysis/data/ensemble.h"
#include "analysis/data/field.h"
#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Means over replicas with Student's interval, then ratios of sums over realizations with intervals
 * of fracas_bootstrap. */
/* X(NAME, key, unit); the key is the one of fracas_statistics without ".mean" or ".value". */
#define FRACAS_HEADLINES(X)                 \
    X(COUNT, "count", "1")                  \
    X(SIZE, "size", "m")                    \
    X(DISSIPATED, "dissipated", "J")        \
    X(LARGEST_SHARE, "largest_share", "1")  \
    X(MEAN, "fragment.mean", "m")           \
    X(MASS_MEAN, "fragment.mass_mean", "m") \
    X(VARIATION, "fragment.variation", "1")

#define FRACAS_ENUMERATOR(name, key, unit) FRACAS_HEADLINE_##name,
typedef enum { FRACAS_HEADLINES(FRACAS_ENUMERATOR) FRACAS_NHEADLINES } fracas_headline;
#undef FRACAS_ENUMERATOR

extern const char *const fracas_headline_key[FRACAS_NHEADLINES];

typedef struct {
    double value, low, high; /* NaN where there is none */
} fracas_running_value;

/* All replicas gave the same: no scatter, but for rounding, to know the value by. */
bool fracas_running_alike(const fracas_running_value *number);

typedef struct {
    int64_t replicas; /* the first so many usable ones */
    fracas_running_value number[FRACAS_NHEADLINES];
} fracas_running;

/* replicas, then value, low, high of each headline. */
extern const fracas_fields fracas_running_fields;

typedef struct {
    size_t count;
    fracas_running *row; /* after FRACAS_CONVERGENCE_FIRST 2^k realizations, and after all */
    double alike[FRACAS_NHEADLINES];      /* p-value of the difference of halves; NaN: unknown */
    int64_t converged[FRACAS_NHEADLINES]; /* 1, or 0 */
    int64_t unconverged;                  /* existing numbers without convergence */
} fracas_replica_convergence;

/* (estimators.22): a number is converged if its half width w = (high - low)/2 is at most
 * FRACAS_CONVERGED_WIDTH |value| and the p-value of its halves (fracas_parts_alike) is above
 * FRACAS_CONVERGED_ALARM. */
#define FRACAS_CONVERGED_WIDTH 0.05
#define FRACAS_CONVERGED_ALARM (1.0 / 1600)
enum { FRACAS_CONVERGENCE_FIRST = 4 };

/* True if the halves differ: the number drifts. */
bool fracas_replica_convergence_drifts(const fracas_replica_convergence *convergence,
                                       fracas_headline headline);

/* From the realizations in the order of the study, which is the order of replicas. Cleared by the
 * caller, also after an error. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_replica_convergence_of(const fracas_ensemble *ensemble,
                                                         uint64_t seed,
                                                         fracas_replica_convergence *convergence);
void fracas_replica_convergence_clear(fracas_replica_convergence *convergence);

#endif
