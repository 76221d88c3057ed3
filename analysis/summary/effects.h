/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much a number changes from one value of a parameter to the next, all else being equal. */
#ifndef FRACAS_ANALYSIS_SUMMARY_EFFECTS_H
#define FRACAS_ANALYSIS_SUMMARY_EFFECTS_H

#include "analysis/summary/study.h"

enum { FRACAS_MOST_LEVELS = 12 }; /* more values are for a figure */

/* Relative changes; NaN: none. */
typedef struct {
    double value;       /* over the settings: geometric mean of to/from, less 1 */
    double low, high;   /* ends of its 95 % interval */
    double least, most; /* in one setting */
} fracas_change;

typedef struct {
    char key[64];    /* path of the parameter */
    char words[192]; /* "Weibull modulus"; "rate, with fracture energy" of a zipped sweep */
    char from[128], to[128];
    char at[640];     /* setting: the other parameters in which points differ; "": all of them */
    bool headline;    /* from the first to the last value; of texts from each to the next */
    int64_t settings; /* pairs of points that differ in nothing else */
    fracas_change count, size;
} fracas_effect;

extern const fracas_fields fracas_effect_fields;

/* For each parameter by which the points are named, from each of its values to the next, and of
 * numbers from the first to the last: the row of all settings, and behind it, where there are
 * several, a row for each. A setting is two points
 * alike in all other parameters but those that change with this one at all points (`words` names
 * them), and mesh and time where these name no points; a value that one of both has not is no
 * difference. Numbers ascend, texts are in the order in which they come first; parameters of more
 * than FRACAS_MOST_LEVELS values are left out, and settings without both means above 0
 * (estimators.29), (estimators.30). *effect freed by the caller with free(). */
FRACAS_MUST_USE fracas_err fracas_effects(const fracas_analysis *analysis, fracas_effect **effect,
                                          size_t *count);

/* True where effects say more than slopes: points differ in more than the strain rate. */
bool fracas_effects_shown(const fracas_analysis *analysis);

#endif
