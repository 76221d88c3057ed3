/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns of the point table derived from the values of a point. No hash depends on them.
 *
 * A new one is one line of the table in derived.c, and its function. */
#ifndef FRACAS_CAMPAIGNS_FILE_DERIVED_H
#define FRACAS_CAMPAIGNS_FILE_DERIVED_H

#include "campaigns/campaign.h"

/* A point, the mean extent of its interfaces (0 where no strength needs it), the mean of its
 * strengths there [Pa]. */
typedef struct {
    const fracas_point *point;
    fracas_extent extent;
    double strength;
} fracas_derivation;

typedef struct {
    fracas_column column;
    double (*value)(const fracas_derivation *of); /* NaN where the point has none */
} fracas_derived;

enum { FRACAS_DERIVED = 8 };
extern const fracas_derived fracas_derived_columns[FRACAS_DERIVED];

#endif
