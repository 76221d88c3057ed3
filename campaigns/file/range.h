/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `{from, to, points, spacing}`: values at equal differences or equal ratios. */
#ifndef FRACAS_CAMPAIGNS_FILE_RANGE_H
#define FRACAS_CAMPAIGNS_FILE_RANGE_H

#include "campaigns/file/setting.h"

typedef struct {
    double from, to;
    size_t points; /* at least 2 */
    bool logarithmic, whole;
} fracas_range;

/* Reads the map `node` as a range of the leaf, a number. */
FRACAS_MUST_USE fracas_err fracas_range_read(const fracas_file *file, const fracas_leaf *leaf,
                                             const fracas_node *node, fracas_range *range);

/* Value i of 0 .. n-1 with p = i/(n-1): from (1-p) + to p, or from^(1-p) to^p, rounded to 15
 * digits, or to the nearest whole number; exactly `from` and `to` at the ends. The same on every
 * CPU. */
double fracas_range_value(const fracas_range *range, size_t i);

#endif
