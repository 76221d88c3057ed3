/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of a point by their keys: for figures of the report beside mean size and count. */
#ifndef FRACAS_ANALYSIS_SUMMARY_ORDINATES_H
#define FRACAS_ANALYSIS_SUMMARY_ORDINATES_H

#include "analysis/summary/statistics.h"

struct fracas_analysis;

enum { FRACAS_MOST_ORDINATES = 12 };

/* A statistic with its interval, where it has one. */
typedef struct {
    char key[64];    /* in the summary, without ".mean" or ".value" */
    char words[192]; /* "part of bending in the dissipated energy" */
    char unit[16];   /* SI */
    bool whole;      /* int64_t; else double */
    bool over;       /* a mean over realizations, with Student's interval */
    size_t value;    /* places in fracas_point_statistics; SIZE_MAX: none */
    size_t half_width;
    size_t low, high;
} fracas_ordinate;

/* The mean of a number over realizations. */
fracas_ordinate fracas_ordinate_of(const fracas_number *number);

/* The statistic of a key of `length` characters, with or without ".mean" or ".value". False: none
 * has it. */
bool fracas_ordinate_find(const char *key, size_t length, fracas_ordinate *to);

/* Value at a point, NaN: none, and the ends of its 95 % interval, NaN: none. */
double fracas_ordinate_at(const fracas_ordinate *ordinate, const fracas_point_statistics *point,
                          double *low, double *high);

/* The statistics of a list of keys, "aspect,fragment.mass_mean"; NULL: all numbers with `drawn`
 * that are above 0 somewhere. FRACAS_USAGE, with the part that is wrong, for an unknown or empty
 * key, for `count` and `size`, which are drawn anyhow, and for more than FRACAS_MOST_ORDINATES. */
FRACAS_MUST_USE fracas_err fracas_ordinates_find(const struct fracas_analysis *analysis,
                                                 const char *list,
                                                 fracas_ordinate found[FRACAS_MOST_ORDINATES],
                                                 size_t *count);

#endif
