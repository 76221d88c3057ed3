/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/bands.h"

#include <gsl/gsl_sort.h>
#include <stdlib.h>

static const fracas_field band_fields[] = {
    {"mean", FRACAS_FIELD_NUMBER, NULL, "%s", offsetof(fracas_band, mean)},
    {"low", FRACAS_FIELD_NUMBER, NULL, "lower end of its band or interval: %s",
     offsetof(fracas_band, low)},
    {"high", FRACAS_FIELD_NUMBER, NULL, "upper end of its band or interval: %s",
     offsetof(fracas_band, high)},
};
static const fracas_fields band_of_energy = FRACAS_FIELDS(band_fields);

#define BAND(key)                             \
    {#key,                                    \
     FRACAS_FIELD_OBJECT,                     \
     "J",                                     \
     "energy over realizations",              \
     FRACAS_BAND_##key * sizeof(fracas_band), \
     &band_of_energy},
#define BAND_FIELD(key, role, unit, meaning) FRACAS_HELD(BAND, key, role)
static const fracas_field energy_fields[] = {FRACAS_EACH_ENERGY(BAND_FIELD)};
const fracas_fields fracas_energy_fields = FRACAS_FIELDS(energy_fields);

static const double tail = 0.05;
enum { ROOM = 1 << 24 }; /* bytes of the tails */

/* Quantile p of n values is between numbers floor(p (n - 1)) and the next, from 0; only the first
 * of few. */
static size_t kept(size_t n)
{
    return n < FRACAS_BAND_LEAST ? 1 : (size_t)(tail * (double)(n - 1)) + 2;
}

/* As many realizations as have room, all if they do. */
static size_t taken(size_t realizations, size_t times)
{
    const size_t most = ROOM / (times * FRACAS_NBANDS * 2 * sizeof(double));
    if (kept(realizations) <= most) return realizations;
    const size_t n = most > 2 ? (size_t)((double)(most - 2) / tail) : 0;
    return n < FRACAS_BAND_LEAST ? FRACAS_BAND_LEAST - 1 : n;
}

static void sift_down(double *heap, size_t count)
{
    for (size_t at = 0, child = 1; child < count; at = child, child = 2 * at + 1) {
        if (child + 1 < count && heap[child + 1] > heap[child]) child++;
        if (heap[at] >= heap[child]) return;
        const double value = heap[at];
        heap[at] = heap[child];
        heap[child] = value;
    }
}

/* The heap has min(count, most) values. */
static void keep(double *heap, size_t most, size_t count, double value)
{
    if (count >= most) {
        if (!(value < heap[0])) return;
        heap[0] = value;
        sift_down(heap, most);
        return;
    }
    size_t at = count;
    for (; at > 0 && heap[(at - 1) / 2] < value; at = (at - 1) / 2) heap[at] = heap[(at - 1) / 2];
    heap[at] = value;
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
#define VALUE(key) now->key,
#define BAND_VALUE(key, role, unit, meaning) FRACAS_HELD(VALUE, key, role)
        const double energy[] = {FRACAS_EACH_ENERGY(BAND_VALUE)};
        if (now->time >= bands->time[j]) bands->running[j]++;
        for (int e = 0; e < FRACAS_NBANDS; e++) {
            const size_t heap = (j * FRACAS_NBANDS + (size_t)e) * of->most;
            bands->energy[j][e].mean += energy[e];
            keep(of->least + heap, of->most, of->count, energy[e]);
            keep(of->negative + heap, of->most, of->count, -energy[e]);
        }
    }
    of->count++;
}

/* (estimators.24) of the `most` least of n values. */
static double low_of(double *least, size_t most, size_t n)
{
    const size_t there = most < n ? most : n;
    gsl_sort(least, 1, there);
    if (n < FRACAS_BAND_LEAST) return least[0];
    const double at = tail * (double)(n - 1);
    const size_t below = (size_t)at;
    return least[below] + (at - (double)below) * (least[below + 1] - least[below]);
}

static void finish(fracas_bands_collector *of)
{
    const size_t n = of->count;
    fracas_bands *bands = of->bands;
    bands->realizations = (int64_t)n;
    bands->extremes = n < FRACAS_BAND_LEAST;
    for (size_t j = 0; j < of->times && n > 0 && bands->running[j] > 0; j++) {
        for (int e = 0; e < FRACAS_NBANDS; e++) {
            const size_t heap = (j * FRACAS_NBANDS + (size_t)e) * of->most;
            fracas_band *band = &bands->energy[j][e];
            band->mean /= (double)n;
            band->low = low_of(of->least + heap, of->most, n);
            band->high = -low_of(of->negative + heap, of->most, n);
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
    const size_t times = (size_t)intervals + 1, values = times * FRACAS_NBANDS;
    of->selected = taken(realizations, times);
    of->most = kept(of->selected);
    bands->time = malloc(times * sizeof *bands->time);
    bands->running = calloc(times, sizeof *bands->running);
    bands->energy = calloc(times, sizeof *bands->energy);
    of->least = malloc(values * of->most * sizeof *of->least);
    of->negative = malloc(values * of->most * sizeof *of->negative);
    if (!bands->time || !bands->running || !bands->energy || !of->least || !of->negative)
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
    free(of->least);
    free(of->negative);
    *of = (fracas_bands_collector){.bands = of->bands};
}

void fracas_bands_clear(fracas_bands *bands)
{
    free(bands->time);
    free(bands->running);
    free(bands->energy);
    *bands = (fracas_bands){0};
}
