/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The difference of two means, and how well it is known. */
#ifndef FRACAS_ANALYSIS_COMPARE_DIFFERENCE_H
#define FRACAS_ANALYSIS_COMPARE_DIFFERENCE_H

#include "analysis/compare/compare.h"

/* (compare.1), (compare.2), (compare.3). a[stride i], b[stride j]: na and nb values; values that
 * are not finite are left out. Sets all but p. */
void fracas_difference_of(const double *a, size_t na, const double *b, size_t nb, size_t stride,
                          fracas_compared_value *value);
/* (compare.4), (compare.5). Value i of a belongs to value i of b; a pair of which one is not finite
 * is left out. */
void fracas_difference_of_pairs(const double *a, const double *b, size_t n, size_t stride,
                                fracas_compared_value *value);

/* (compare.10): p of `count` tests, p[stride i], corrected by Holm into corrected[stride i]; NaN
 * are no tests. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_holm(const double *p, size_t count, size_t stride,
                                       double *corrected);

#endif
