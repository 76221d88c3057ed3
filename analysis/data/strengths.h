/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strengths of a point, by the columns of its study. */
#ifndef FRACAS_ANALYSIS_DATA_STRENGTHS_H
#define FRACAS_ANALYSIS_DATA_STRENGTHS_H

#include "campaigns/points.h"

#include <stdbool.h>

/* True if they are uniform between two bounds. */
bool fracas_strengths_uniform(const fracas_point_table *table, size_t point);

/* Least strength [Pa], as given, or by mean - sqrt(3) deviation of uniform ones; NaN: not given. */
double fracas_strengths_least(const fracas_point_table *table, size_t point);

/* deviation/mean of the strengths of interfaces; NaN: equal, of a file, or not known. */
double fracas_strengths_scatter(const fracas_point_table *table, size_t point);

#endif
