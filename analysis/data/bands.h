/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energies and fragments over time of all realizations of a point: mean, and band of most of them.
 */
#ifndef FRACAS_ANALYSIS_DATA_BANDS_H
#define FRACAS_ANALYSIS_DATA_BANDS_H

#include "analysis/data/ensemble.h"
#include "analysis/data/field.h"
#include "base/err.h"
#include "campaigns/store/datafile.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The bands of one time, fracas_band[FRACAS_ENERGIES]: of each energy mean, low, high. */
extern const fracas_fields fracas_energy_fields;

typedef struct {
    double mean, low, high; /* J, or fragments */
} fracas_band;

/* At the times t_j = j time.end/intervals of the histories (estimators.23), (estimators.24), until
 * all realizations have ended. */
typedef struct {
    size_t count;     /* times, 0 of a study without histories */
    double *time;     /* s */
    int64_t *running; /* still running at this time; the others count with their last values */
    fracas_band (*energy)[FRACAS_ENERGIES];
    fracas_band *fragments;
    int64_t realizations; /* taken: the usable ones, or, evenly spread, as many as fit in 64 MiB */
    bool extremes; /* fewer than FRACAS_BAND_LEAST: low and high are extremes, not quantiles */
} fracas_bands;

enum { FRACAS_BAND_LEAST = 20 };

/* Takes in one realization after the other, at most 64 MiB beside the bands, whatever their number.
 */
typedef struct {
    fracas_bands *bands;
    size_t times;         /* 0: there are no histories */
    size_t all, selected; /* usable realizations; to take of them, evenly */
    size_t met, count;    /* met and taken so far */
    double *value;        /* [time][energy, at last fragments][selected] */
} fracas_bands_collector;

/* Begins the bands of `realizations` usable ones, whose histories have `intervals` (>= 0) equal
 * intervals of time.end `end` [s]. The caller clears both, also after an error; fracas_bands_end
 * frees the memory of the collector. */
FRACAS_MUST_USE fracas_err fracas_bands_begin(int64_t intervals, double end, size_t realizations,
                                              fracas_bands *bands,
                                              fracas_bands_collector *collector);
/* The history of the next usable realization, in the order of the study. */
void fracas_bands_add(fracas_bands_collector *collector, const fracas_record *record);
void fracas_bands_end(fracas_bands_collector *collector);
void fracas_bands_clear(fracas_bands *bands);

#endif
