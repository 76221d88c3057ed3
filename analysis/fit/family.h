/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Families of distributions of a fragment's size (docs/theory/fits.md). The table drives fits,
 * files, tables and tests. */
#ifndef FRACAS_ANALYSIS_FIT_FAMILY_H
#define FRACAS_ANALYSIS_FIT_FAMILY_H

#include <stdbool.h>
#include <stddef.h>

enum { FRACAS_FAMILY_PARAMETERS = 3, FRACAS_FAMILY_STARTS = 3 };

typedef struct {
    const char *name;
    bool length;         /* in the unit of the size; else a pure number */
    bool shift;          /* no fragment is smaller: its upper bound is the smallest one */
    bool linear;         /* searched for itself; else its logarithm, and lower > 0 */
    double lower, upper; /* for a length over the mean size */
    const char *doc;
} fracas_family_parameter;

/* Moments for the starts of a search: sizes over their mean. */
typedef struct {
    double cv;       /* deviation/mean */
    double smallest; /* size/mean */
} fracas_family_moments;

/* Sizes and lengths in any one unit. `from` is the cut of the data: only a power law, which has no
 * probability below, looks at it. */
typedef struct {
    const char *name;
    size_t nparameters;
    fracas_family_parameter parameter[FRACAS_FAMILY_PARAMETERS];
    /* P(size <= x) and P(size > x), each to full relative precision; NaN for invalid parameters. */
    void (*tails)(const double *parameter, double from, double x, double *below, double *above);
    /* Where search number `which` of FRACAS_FAMILY_STARTS begins, lengths over the mean. */
    void (*start)(const fracas_family_moments *moments, int which, double *parameter);
    const char *general; /* names of the families of which it is a special case, spaces between */
} fracas_family;

enum { FRACAS_NFAMILIES = 10 };
extern const fracas_family
    *const fracas_families[FRACAS_NFAMILIES]; /* Mott's, which is of masses, last */

/* NULL for an unknown name. */
const fracas_family *fracas_family_find(const char *name);
/* True if `special` is `general` with some parameters fixed. */
bool fracas_family_within(const fracas_family *special, const fracas_family *general);

extern const fracas_family fracas_family_exponential, fracas_family_mott, fracas_family_rayleigh,
    fracas_family_shifted_rayleigh, fracas_family_weibull, fracas_family_weibull3,
    fracas_family_lognormal, fracas_family_gamma, fracas_family_generalised_gamma,
    fracas_family_power_law;

#endif
