/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether two parts of a point's realizations say the same. */
#ifndef FRACAS_ANALYSIS_ESTIMATE_HALVES_H
#define FRACAS_ANALYSIS_ESTIMATE_HALVES_H

#include <stddef.h>

/* A number of some realizations alone. */
typedef struct {
    double value;    /* NaN: none */
    double n;        /* realizations */
    double variance; /* of one: n times the squared standard error of the value */
    double freedom;  /* degrees of freedom of the variance; 0: it is not known */
} fracas_part;

/* The mean of value[0], value[stride], ...: `count` values, those that are not finite left out. */
fracas_part fracas_part_of(const double *value, size_t stride, size_t count);

/* How often realizations that are alike have two such parts, of their own each, whose numbers are
 * at least as far apart (estimators.22): two-sided, by Student's test with the variance of both
 * together. It is exact for means of normal values; where the parts have as many realizations their
 * difference is symmetric whatever the values are. 1 for a difference of rounding; without any
 * scatter within the parts the share of deals of these realizations that part them so, 2/C(n, n_a);
 * NaN where a number or all variance is missing. */
double fracas_parts_alike(const fracas_part *a, const fracas_part *b);

#endif
