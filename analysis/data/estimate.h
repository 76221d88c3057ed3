/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mean over replicas and how well it is known. */
#ifndef FRACAS_ANALYSIS_DATA_ESTIMATE_H
#define FRACAS_ANALYSIS_DATA_ESTIMATE_H

#include "analysis/data/field.h"

#include <stddef.h>
#include <stdint.h>

typedef struct {
    int64_t n;         /* values used */
    double mean;       /* NaN for n = 0 */
    double deviation;  /* standard deviation with n - 1; NaN for n < 2 */
    double half_width; /* for the 95 % interval of the mean; NaN for n < 2 */
} fracas_estimate;

/* n, mean, deviation, half_width. */
extern const fracas_fields fracas_estimate_fields;

/* m = sum x_i/n, s^2 = sum (x_i - m)^2/(n - 1), half width t_(0.975, n-1) s/sqrt(n): Student's
 * interval over independent replicas. value[0], value[stride], ... : `count` values; values that
 * are not finite are left out. */
fracas_estimate fracas_estimate_of(const double *value, size_t stride, size_t count);

#endif
