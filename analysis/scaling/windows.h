/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exponent of mean size against strain rate from rate to rate (docs/theory/scaling-laws.md). */
#ifndef FRACAS_ANALYSIS_SCALING_WINDOWS_H
#define FRACAS_ANALYSIS_SCALING_WINDOWS_H

#include "analysis/data/field.h"
#include "analysis/scaling/series.h"

/* d log s/d log edot between two neighbouring rates. */
typedef struct {
    double slope;
    double standard_error; /* from those of the two means */
    double freedom;    /* degrees of freedom of the standard error, by Welch and Satterthwaite */
    double half_width; /* half width of the 95 % interval; NaN if a mean is of one replica, or of
                          less than FRACAS_REPLICAS_OWN where neither scatters */
} fracas_window;

/* (scaling-laws.11), (scaling-laws.12), (scaling-laws.13). NaN if the rates differ by rounding
 * alone (1e-9).
 */
fracas_window fracas_window_of(const fracas_size_point *low, const fracas_size_point *high);

typedef struct {
    char name[128];       /* for the series */
    size_t point[2];      /* for the study */
    double rate[2];       /* 1/s, ascending */
    double normalised[2]; /* rates over edot0 of the series */
    fracas_window window;
} fracas_size_window;

/* series, from_point, to_point, ... */
extern const fracas_fields fracas_window_fields;

/* Windows between every two neighbouring rates of every series at which some body came apart,
 * series by series, ascending. *list freed by the caller with free(). */
FRACAS_MUST_USE fracas_err fracas_size_windows(const struct fracas_analysis *analysis,
                                               fracas_size_window **list, size_t *count);

#endif
