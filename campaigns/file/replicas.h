/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `replicas` of a campaign file or a case: a whole number, or a rule for decisions during the run.
 */
#ifndef FRACAS_CAMPAIGNS_FILE_REPLICAS_H
#define FRACAS_CAMPAIGNS_FILE_REPLICAS_H

#include "campaigns/file/setting.h"
#include "sampler/sequential/sequential.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    int64_t count;               /* with a rule, of the first round; 0: not given */
    fracas_sequential_rule rule; /* maximum 0: none */
} fracas_replicas;

/* Notes an error, naming the place, of anything but a whole number from 1 to 1e9 or
 *   {minimum: N, maximum: M, until: {quantity: Q, relative-half-width: W, confidence: C}}
 * with 8 <= N <= M <= 1e9, 0 < W < 1, 0.5 <= C <= 0.999 (0.95 if it is not given); the count is
 * then 1. */
FRACAS_MUST_USE fracas_err fracas_replicas_read(const fracas_file *file, const fracas_node *node,
                                                fracas_replicas *replicas);

/* The same as text on one line, as in the campaign's hash. */
void fracas_replicas_write(const fracas_point *point, FILE *out);

bool fracas_replicas_same(const fracas_point *a, const fracas_point *b);

/* FRACAS_OK if a study of `before` can become one of `now`: at least as many replicas, and a rule
 * without earlier stops. Else FRACAS_DAMAGED naming the first difference. `b`:
 * number of the point in `before`. */
FRACAS_MUST_USE fracas_err fracas_replicas_extend(const fracas_point *now,
                                                  const fracas_point *before, size_t b);

#endif
