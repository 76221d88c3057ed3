/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Means over replicas, and numbers of a part of them: how well they are known, and whether two
 * parts are alike. */
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

/* A number of some realizations alone. */
typedef struct {
    double value;    /* NaN: none */
    double n;        /* realizations */
    double variance; /* variance of one: n times the squared standard error of the value */
    double freedom;  /* degrees of freedom of the variance; 0: it is not known */
} fracas_part;

/* The mean of value[0], value[stride], ...: `count` values; values that are not finite are left
 * out. */
fracas_part fracas_part_of(const double *value, size_t stride, size_t count);

/* Two-sided p-value of the difference of two parts of equal realizations (estimators.22), by
 * Student's test with the variance of both together. Exact for means of normal values; with equal
 * numbers of realizations the difference is symmetric for any values. 1 for a difference of
 * rounding. Without scatter within the parts 2/C(n, n_a), from the permutations of all
 * realizations. NaN where a number or all variance is missing. */
double fracas_parts_alike(const fracas_part *a, const fracas_part *b);

#endif
