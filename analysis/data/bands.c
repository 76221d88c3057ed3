/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/bands.h"

#include <gsl/gsl_sort.h>
#include <stdlib.h>

static const fracas_field band_fields[] = {
    FRACAS_FIELD(fracas_band, NUMBER, "mean", NULL, "mean over realizations: %s", mean),
    FRACAS_FIELD(fracas_band, NUMBER, "low", NULL, "lower end of its band or interval: %s", low),
    FRACAS_FIELD(fracas_band, NUMBER, "high", NULL, "upper end of its band or interval: %s", high),
};
static const fracas_fields band_of_energy = FRACAS_FIELDS(band_fields);

#define BAND(key, role, unit, meaning)             \
    {                                              \
        #key,                                      \
        FRACAS_FIELD_OBJECT,                       \
        unit,                                      \
        meaning,                                   \
        FRACAS_ENERGY_##key * sizeof(fracas_band), \
        &band_of_energy},
static const fracas_field energy_fields[] = {FRACAS_EACH_ENERGY(BAND)};
const fracas_fields fracas_energy_fields = FRACAS_FIELDS(energy_fields);

static const double tail = 0.05;
enum { ROOM = 1 << 26 }; /* bytes of the values */
enum { CURVES = FRACAS_ENERGIES + 1 };

static double *values_of(const fracas_bands_collector *of, size_t time, int curve)
{
    return of->value + (time * CURVES + (size_t)curve) * of->selected;
}

static fracas_band *band_of(const fracas_bands *bands, size_t time, int curve)
{
    return curve < FRACAS_ENERGIES ? &bands->energy[time][curve] : &bands->fragments[time];
}

/* One realization: of each time the first row at or after it, which is its own, and the last row
 * beyond (estimators.23). */
static void take_in(const fracas_record *record, fracas_bands_collector *of)
{
    fracas_bands *bands = of->bands;
    size_t row = 0;
    for (size_t j = 0; j < of->times; j++) {
        while (row + 1 < record->nhistory && record->history[row].time < bands->time[j]) row++;
        const fracas_history_row *now = &record->history[row];
        if (now->time >= bands->time[j]) bands->running[j]++;
        for (int c = 0; c < CURVES; c++) {
            const double value = c < FRACAS_ENERGIES ? now->energy[c] : (double)now->fragments;
            band_of(bands, j, c)->mean += value;
            values_of(of, j, c)[of->count] = value;
        }
    }
    of->count++;
}

/* (estimators.24) of n sorted values, from the first on, or, with step -1, from the last on. */
static double end_of(const double *end, ptrdiff_t step, size_t n)
{
    if (n < FRACAS_BAND_LEAST) return *end;
    const double at = tail * (double)(n - 1);
    const size_t below = (size_t)at;
    end += step * (ptrdiff_t)below;
    return *end + (at - (double)below) * (end[step] - *end);
}

static void finish(fracas_bands_collector *of)
{
    const size_t n = of->count;
    fracas_bands *bands = of->bands;
    bands->realizations = (int64_t)n;
    bands->extremes = n < FRACAS_BAND_LEAST;
    for (size_t j = 0; j < of->times && n > 0 && bands->running[j] > 0; j++) {
        for (int c = 0; c < CURVES; c++) {
            fracas_band *band = band_of(bands, j, c);
            double *value = values_of(of, j, c);
            gsl_sort(value, 1, n);
            band->mean /= (double)n;
            band->low = end_of(value, 1, n);
            band->high = end_of(value + n - 1, -1, n);
        }
        bands->count = j + 1;
    }
}

fracas_err fracas_bands_begin(int64_t intervals, double end, size_t realizations,
                              fracas_bands *bands, fracas_bands_collector *of)
{
    *bands = (fracas_bands){0};
    *of = (fracas_bands_collector){.bands = bands, .all = realizations};
    if (intervals <= 0 || !(end > 0) || realizations == 0) return FRACAS_OK;
    const size_t times = (size_t)intervals + 1, values = times * CURVES;
    const size_t most = ROOM / (values * sizeof *of->value) + 1;
    of->selected = realizations < most ? realizations : most;
    bands->time = malloc(times * sizeof *bands->time);
    bands->running = calloc(times, sizeof *bands->running);
    bands->energy = calloc(times, sizeof *bands->energy);
    bands->fragments = calloc(times, sizeof *bands->fragments);
    of->value = malloc(values * of->selected * sizeof *of->value);
    if (!bands->time || !bands->running || !bands->energy || !bands->fragments || !of->value)
        return fracas_no_memory("the energies over time of a point");
    of->times = times;
    for (size_t j = 0; j < times; j++)
        bands->time[j] = (double)j * end / (double)(times - 1); /* rounded as the histories' are */
    return FRACAS_OK;
}

/* Number i of those taken is number floor(i all/selected). */
void fracas_bands_add(fracas_bands_collector *of, const fracas_record *record)
{
    if (!of->times || of->count >= of->selected) return;
    const size_t next = (size_t)((double)of->count / (double)of->selected * (double)of->all);
    if (of->met++ >= next && record->nhistory > 0) take_in(record, of);
}

void fracas_bands_end(fracas_bands_collector *of)
{
    finish(of);
    free(of->value);
    *of = (fracas_bands_collector){.bands = of->bands};
}

void fracas_bands_clear(fracas_bands *bands)
{
    free(bands->time);
    free(bands->running);
    free(bands->energy);
    free(bands->fragments);
    *bands = (fracas_bands){0};
}
