/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sizes of a point's fragments in cells, by realization: the data of a fit
 * (docs/theory/fits.md). */
#ifndef FRACAS_ANALYSIS_FIT_SAMPLE_H
#define FRACAS_ANALYSIS_FIT_SAMPLE_H

#include "analysis/data/ensemble.h"
#include "analysis/fit/family.h"
#include "analysis/data/room.h"
#include "base/err.h"

#include <stddef.h>
#include <stdint.h>

enum { FRACAS_FIT_CELLS = 320 }; /* at most */

typedef struct {
    fracas_room room;
    size_t ncells;
    double edge[FRACAS_FIT_CELLS + 1]; /* over the mean, ascending: the cut first, INFINITY last */
    double count[FRACAS_FIT_CELLS];    /* fragments in each cell, (edge[k], edge[k + 1]] */
    size_t nrealizations;              /* broken ones: bodies of one piece are left out */
    size_t whole;                      /* for one piece */
    size_t *first; /* the occupied cells of realization i: first[i] to first[i + 1] - 1 */
    uint32_t *cell;
    double *times; /* fragments in each */
    double *kept, *sum,
        *squares;        /* each: fragments above the cut, sizes less mean [m], squares [m2] */
    size_t fragments;    /* for all realizations, dust and whole bodies included */
    double total;        /* above the cut */
    double mean, cv;     /* for those [m], [1] */
    double cut, lattice; /* m */
    fracas_family_moments moments;
} fracas_fit_sample;

/* A fragment alone in its realization is the body itself, made by no distribution of sizes: it is
 * not counted, nor is its realization (docs/theory/fits.md). Cells of about equal width in log
 * size, none narrower than two neighbouring sizes of a lattice are apart. Cleared by the caller,
 * after an error too. */
FRACAS_MUST_USE fracas_err fracas_fit_sample_create(const fracas_ensemble *ensemble,
                                                    fracas_fit_sample *sample);
void fracas_fit_sample_clear(fracas_fit_sample *sample);

/* For a resample with realization i weight[i] times: counts, count[ncells]; the mean of its sizes
 * [m] and their coefficient of variation. */
void fracas_fit_sample_count(const fracas_fit_sample *sample, const uint32_t *weight,
                             double *count);
void fracas_fit_sample_moments(const fracas_fit_sample *sample, const uint32_t *weight,
                               double *mean, double *cv);

#endif
