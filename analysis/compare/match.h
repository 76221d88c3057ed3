/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which point of one study is which of another. */
#ifndef FRACAS_ANALYSIS_COMPARE_MATCH_H
#define FRACAS_ANALYSIS_COMPARE_MATCH_H

#include "base/err.h"
#include "campaigns/points.h"

/* Matches points of equal hash, then points with equal values in the columns `by`, such as
 * "loading.rate,strength.shape". NULL: all columns that vary in both studies; where one has a
 * single point, those that vary in the other. partner[a->npoints]: the point of b, SIZE_MAX without
 * one. how: the columns used, "" if hashes were enough. Two studies of one point each are matched
 * without columns ("being the only ones"). FRACAS_USAGE for a column missing in a study, and where
 * two points of a study are equal in the columns. */
FRACAS_MUST_USE fracas_err fracas_match_points(const fracas_point_table *a,
                                               const fracas_point_table *b, const char *by,
                                               size_t *partner, char *how, size_t size);

/* "mesh.elements 2500 | 5000, time.end 3e-07 | 6e-07": the differences of two points, "" for none.
 * Derived columns are left out. */
void fracas_match_differs(const fracas_point_table *a, size_t p, const fracas_point_table *b,
                          size_t q, char *text, size_t size);

#endif
