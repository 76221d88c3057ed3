/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sequential sampling: the values of a point's replicas decide how many more it gets, in fixed
 * rounds (docs/theory/sequential.md). Pure functions: equal values give equal decisions, bit for
 * bit. */
#ifndef FRACAS_SAMPLER_SEQUENTIAL_H
#define FRACAS_SAMPLER_SEQUENTIAL_H

#include <stddef.h>
#include <stdint.h>

/* The quantity of a rule, one value a realization. */
typedef enum {
    FRACAS_MEAN_COUNT, /* number of fragments, dust included */
    FRACAS_MEAN_SIZE,  /* mean size of its fragments [m] */
    FRACAS_DISSIPATED, /* dissipated energy [J] */
    FRACAS_NQUANTITIES
} fracas_quantity;

extern const char *const fracas_quantity_name[FRACAS_NQUANTITIES]; /* as a campaign file has them */

/* Replicas are added until the interval of the mean at `confidence` is as narrow as asked for, or
 * at `maximum`. */
typedef struct {
    int64_t minimum, maximum; /* FRACAS_ROUND_FIRST <= minimum <= maximum */
    fracas_quantity quantity;
    double relative_half_width; /* > 0: share of the mean's absolute value */
    double confidence;          /* the interval's, between 0 and 1 */
} fracas_sequential_rule;

enum { FRACAS_ROUND_FIRST = 8 }; /* least replicas of a first round: fewer give no deviation */

typedef enum { FRACAS_GO_ON, FRACAS_PRECISE, FRACAS_AT_MAXIMUM } fracas_sequential_stop;

extern const char *const fracas_sequential_stop_name[3];

typedef struct {
    int64_t used;            /* values in the mean */
    double mean, half_width; /* NaN with fewer than one value, or two */
    fracas_sequential_stop stop;
} fracas_sequential_decision;

/* Replicas of the round after the one of `replicas` (0: of the first one); never above
 * rule->maximum. */
int64_t fracas_sequential_next(const fracas_sequential_rule *rule, int64_t replicas);

/* The decision of the round of `replicas` replicas, one of fracas_sequential_next: value[r] belongs
 * to replica r, NaN if it does not count. */
fracas_sequential_decision fracas_sequential_decide(const fracas_sequential_rule *rule,
                                                    const double *value, int64_t replicas);

#endif
