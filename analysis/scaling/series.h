/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mean sizes of a study as series against the strain rate, for slopes of windows and
 * crossovers. */
#ifndef FRACAS_ANALYSIS_SCALING_SERIES_H
#define FRACAS_ANALYSIS_SCALING_SERIES_H

#include "analysis/estimate/scales.h"
#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct fracas_analysis;

typedef struct {
    size_t point;     /* for the study */
    int64_t replicas; /* in the mean */
    double rate;      /* 1/s, > 0 */
    double size;      /* m, mean over replicas, > 0 */
    double
        error; /* standard error of log(size) by its own replicas; 0: all alike, NaN: one replica */
    bool whole; /* fracas_size_whole */
} fracas_size_point;

typedef struct {
    char name[128];       /* "all points" if there is one series */
    fracas_scales scales; /* NaN where the points have not the same */
    size_t n;
    fracas_size_point *point; /* ascending in rate */
} fracas_size_series;

/* Whether a point has a rate and a mean size within the theories: surfaces have none. */
bool fracas_size_counts(const struct fracas_analysis *analysis, size_t point);
/* Whether no body of the point came apart: each is of one fragment. */
bool fracas_size_whole(const struct fracas_analysis *analysis, size_t point);

/* Points equal in all parameters but those that make the rate are a series; points that do not
 * count are left out. A series without any point is left out. *list freed by
 * fracas_size_series_free. */
FRACAS_MUST_USE fracas_err fracas_size_series_create(const struct fracas_analysis *analysis,
                                                     fracas_size_series **list, size_t *count);
void fracas_size_series_free(fracas_size_series *list, size_t count);

#endif
