/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions of rules for the number of replicas. */
#ifndef FRACAS_CAMPAIGNS_STORE_DECISION_H
#define FRACAS_CAMPAIGNS_STORE_DECISION_H

#include "base/hash.h"
#include "campaigns/store/summary.h"

#include <stdbool.h>
#include <stdint.h>

/* One round of a point whose replicas a rule decides (docs/theory/sequential.md): decision, data,
 * rule. X(key, type, stored, meaning), from which struct, comparison and `/decision` are made. */
#define FRACAS_EACH_DECISION(X)                                                                    \
    X(point, INTEGER, INT32, "row of the point in /point")                                         \
    X(round, INTEGER, INT32, "round of the point, from 0")                                         \
    X(replicas, INTEGER, INT64, "replicas that the point had, 0 to this - 1, when it was decided") \
    X(used, INTEGER, INT64,                                                                        \
      "of those, realizations in the mean: FRAGMENTED, INTACT and TIME_LIMIT")                     \
    X(mean, REAL, FLOAT64, "mean of the quantity over them: 1, m or J by the quantity")            \
    X(half_width, REAL, FLOAT64, "half width of the t interval of the mean, in the same unit")     \
    X(stop, INTEGER, INT8, "0 goes on to the next round, 1 precise enough, 2 at the maximum")      \
    X(quantity, INTEGER, INT8, "the rule: 0 mean-count, 1 mean-size, 2 dissipated")                \
    X(minimum, INTEGER, INT64, "the rule: replicas of the first round")                            \
    X(maximum, INTEGER, INT64, "the rule: most replicas")                                          \
    X(relative_half_width, REAL, FLOAT64, "the rule: half width asked for, as part of the mean")   \
    X(confidence, REAL, FLOAT64, "the rule: confidence of the interval")

#define FRACAS_DECISION_MEMBER(key, type, stored, meaning) fracas_sql_##type key;
typedef struct {
    FRACAS_EACH_DECISION(FRACAS_DECISION_MEMBER)
} fracas_decision;

/* True if round, replicas, used, stop and quantity are in range. */
bool fracas_decision_valid(const fracas_decision *decision);

/* half_width/|mean|; 0 if half_width is 0. NaN of fewer than two values. */
double fracas_decision_relative(const fracas_decision *decision);

/* True if all members are equal, NaN equal to NaN. */
bool fracas_decision_same(const fracas_decision *a, const fracas_decision *b);

#endif
