/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which point of one study is which of another. */
#ifndef FRACAS_ANALYSIS_COMPARE_MATCH_H
#define FRACAS_ANALYSIS_COMPARE_MATCH_H

#include "base/err.h"
#include "campaigns/points.h"

/* Points of equal hash; of the others those with equal values in the columns `by`
 * ("loading.rate,strength.shape"; NULL: in all columns that vary in both studies, where one has a
 * single point those that vary in the other). partner[a->npoints]: the point of b, SIZE_MAX if it
 * has none. how: which columns that were, "" if hashes were enough. With one point each and nothing
 * to match by, these two ("being the only ones"). FRACAS_USAGE for a column that a study lacks, and
 * where two points of a study are alike in the columns. */
FRACAS_MUST_USE fracas_err fracas_match_points(const fracas_point_table *a,
                                               const fracas_point_table *b, const char *by,
                                               size_t *partner, char *how, size_t size);

/* "mesh.elements 2500 | 5000, time.end 3e-07 | 6e-07": what two points differ in, "" for nothing.
 * Derived columns are left out. */
void fracas_match_differs(const fracas_point_table *a, size_t p, const fracas_point_table *b,
                          size_t q, char *text, size_t size);

#endif
