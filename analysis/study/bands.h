/* Energies over time of all realizations of a point: their mean and the band that most of them stay in. */
#ifndef FRACAS_ANALYSIS_STUDY_BANDS_H
#define FRACAS_ANALYSIS_STUDY_BANDS_H

#include "analysis/study/ensemble.h"
#include "base/err.h"
#include "campaigns/store/store.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum { FRACAS_ENERGY_KINETIC, FRACAS_ENERGY_ELASTIC, FRACAS_ENERGY_COHESIVE, FRACAS_ENERGY_DISSIPATED } fracas_energy;

#define FRACAS_NENERGIES 4

typedef struct {
    double mean, low, high; /* J */
} fracas_band;

/* At the times t_j = j time.end/intervals of the histories (estimators.23), (estimators.24), until all realizations have ended. */
typedef struct {
    size_t count;         /* times, 0 of a study without histories */
    double *time;         /* s */
    int64_t *running;     /* realizations that had not ended before that time; the others count with what they had in the end */
    fracas_band (*energy)[FRACAS_NENERGIES];
    int64_t realizations; /* that were taken: all usable ones, or as many, evenly spread over them, as fit in 16 MiB */
    bool extremes;        /* low and high are the least and the greatest, of fewer than FRACAS_BAND_LEAST; else the quantiles 0.05 and 0.95 */
} fracas_bands;

enum { FRACAS_BAND_LEAST = 20 };

/* Reads the histories of the realizations of `ensemble` one after the other; `end` is the time.end of their point [s]. At most 16 MiB beside
 * the bands, whatever the realizations. FRACAS_DAMAGED or FRACAS_ENVIRONMENT as fracas_reader_record. Cleared by the caller, also after an error. */
FRACAS_MUST_USE fracas_err fracas_bands_read(fracas_reader *reader, const fracas_ensemble *ensemble, double end, fracas_bands *bands);
void fracas_bands_clear(fracas_bands *bands);

#endif
