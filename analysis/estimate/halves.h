/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether two parts of a point's realizations say the same. */
#ifndef FRACAS_ANALYSIS_ESTIMATE_HALVES_H
#define FRACAS_ANALYSIS_ESTIMATE_HALVES_H

#include <stddef.h>

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
