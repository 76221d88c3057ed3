/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The final count of a point's fragments, and how far it is from the count at the end
 * (docs/theory/settled.md). */
#ifndef FRACAS_ANALYSIS_ESTIMATE_FINAL_H
#define FRACAS_ANALYSIS_ESTIMATE_FINAL_H

#include "analysis/estimate/bootstrap.h"
#include "campaigns/store/datafile.h"

#include <stdbool.h>

typedef enum {
    FRACAS_FINAL_NONE,  /* nothing has broken */
    FRACAS_FINAL_YES,   /* as the rule `settled` asks of one realization, for the means */
    FRACAS_FINAL_NO,    /* more is to come */
    FRACAS_FINAL_CREEP, /* more is to come, beyond any practical time */
} fracas_finality;

/* Means over the usable realizations with a crack, held fragments left out. */
typedef struct {
    double realizations;
    double transits, growth;      /* k, Delta of the mean count */
    double rest, variance, bound; /* R, V, B; NaN of surfaces */
    double held;                  /* fragments on an edge that moves */
    double vibrating;             /* by the dissipated energy */
    double seen;                  /* N at the end */
    double elements;              /* as many fragments, at most; 0: unknown */
    double onset, end;            /* s */
    double reach;          /* s, 40 (surfaces 60) transits after the onset, or twice the time */
    fracas_interval count; /* N_final; NaN where nothing has broken */
    fracas_finality verdict;
} fracas_final;

/* The members, as fields. */
extern const fracas_fields fracas_final_fields;

/* All 0 at first; takes in a usable realization. */
void fracas_final_add(fracas_final *final, const fracas_record *record);
/* Sums to means, then the estimate and the verdict  (settled.8). */
void fracas_final_count(fracas_final *final);

#endif
