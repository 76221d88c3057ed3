/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/sample.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Grid of log sizes; the cell beyond the last is open. */
enum { GRID = 300 };
static const double BEYOND = 2; /* largest sizes to the end of the grid: resamples may be larger */

static fracas_err make_room(const fracas_ensemble *ensemble, fracas_fit_sample *sample)
{
    fracas_room *room = &sample->room;
    FRACAS_TAKE(room, sample->first, ensemble->nrealizations);
    FRACAS_TAKE(room, sample->kept, ensemble->nrealizations);
    FRACAS_TAKE(room, sample->sum, ensemble->nrealizations);
    FRACAS_TAKE(room, sample->squares, ensemble->nrealizations);
    FRACAS_TAKE(room, sample->cell, ensemble->nfragments);
    FRACAS_TAKE(room, sample->times, ensemble->nfragments);
    return fracas_room_check(room, "the fragments of a fit");
}

void fracas_fit_sample_clear(fracas_fit_sample *sample)
{
    fracas_room_clear(&sample->room);
    *sample = (fracas_fit_sample){0};
}

static bool is_whole(const fracas_ensemble *ensemble, size_t i)
{
    return ensemble->first[i + 1] - ensemble->first[i] == 1;
}

static void count_up(const fracas_ensemble *ensemble, fracas_fit_sample *sample, double *smallest,
                     double *largest)
{
    double sum = 0;
    *smallest = INFINITY;
    *largest = 0;
    for (size_t i = 0; i < ensemble->nrealizations; i++) {
        if (is_whole(ensemble, i)) {
            sample->whole++;
            continue;
        }
        for (size_t f = ensemble->first[i]; f < ensemble->first[i + 1]; f++) {
            const double size = ensemble->size[f];
            if (!(size > sample->cut)) continue;
            sample->kept[sample->nrealizations] += 1;
            sum += size;
            *smallest = fmin(*smallest, size);
            *largest = fmax(*largest, size);
        }
        sample->total += sample->kept[sample->nrealizations++];
    }
    sample->mean = sum / sample->total;
}

/* Sums of sizes less their mean, whose squares do not cancel where sizes are nearly alike. */
static void add_up(const fracas_ensemble *ensemble, fracas_fit_sample *sample, double smallest)
{
    double sum = 0, squares = 0;
    for (size_t i = 0, k = 0; i < ensemble->nrealizations; i++) {
        if (is_whole(ensemble, i)) continue;
        for (size_t f = ensemble->first[i]; f < ensemble->first[i + 1]; f++) {
            if (!(ensemble->size[f] > sample->cut)) continue;
            const double size = ensemble->size[f] - sample->mean;
            sample->sum[k] += size;
            sample->squares[k] += size * size;
        }
        sum += sample->sum[k];
        squares += sample->squares[k++];
    }
    const double rest = sum / sample->total;
    sample->cv = sqrt(fmax(squares / sample->total - rest * rest, 0)) / sample->mean;
    sample->moments = (fracas_family_moments){sample->cv, smallest / sample->mean};
}

/* Between two sizes of the lattice, in units of the mean; as it is where there is no lattice. */
static double on_lattice(const fracas_fit_sample *sample, double edge)
{
    if (!(sample->lattice > 0)) return edge;
    const double step = sample->lattice / sample->mean;
    return (floor(edge / step) + 0.5) * step;
}

static void make_cells(fracas_fit_sample *sample, double smallest, double largest)
{
    const double low = fmax(sample->cut, 0.99 * smallest) / sample->mean,
                 high = BEYOND * largest / sample->mean;
    size_t n = 0;
    sample->edge[n++] = sample->cut / sample->mean;
    for (int i = 0; i <= GRID; i++) {
        const double edge = on_lattice(sample, low * pow(high / low, (double)i / GRID));
        if (edge > sample->edge[n - 1] * (1 + 1e-9)) sample->edge[n++] = edge;
    }
    sample->edge[n] = INFINITY;
    sample->ncells = n;
}

/* The cell of a size over the mean above the cut. */
static uint32_t cell_of(const fracas_fit_sample *sample, double size)
{
    size_t low = 0, high = sample->ncells;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(size > sample->edge[middle] ? &low : &high) = middle;
    }
    return (uint32_t)low;
}

static void sort_into_cells(const fracas_ensemble *ensemble, fracas_fit_sample *sample)
{
    double of_one[FRACAS_FIT_CELLS] = {0};
    size_t used = 0;
    for (size_t i = 0, realization = 0; i < ensemble->nrealizations; i++) {
        if (is_whole(ensemble, i)) continue;
        for (size_t f = ensemble->first[i]; f < ensemble->first[i + 1]; f++)
            if (ensemble->size[f] > sample->cut)
                of_one[cell_of(sample, ensemble->size[f] / sample->mean)] += 1;
        for (size_t k = 0; k < sample->ncells; k++) {
            if (!(of_one[k] > 0)) continue;
            sample->cell[used] = (uint32_t)k;
            sample->times[used++] = of_one[k];
            sample->count[k] += of_one[k];
            of_one[k] = 0;
        }
        sample->first[++realization] = used;
    }
}

fracas_err fracas_fit_sample_create(const fracas_ensemble *ensemble, fracas_fit_sample *sample)
{
    double smallest, largest;
    *sample = (fracas_fit_sample){.fragments = ensemble->nfragments,
                                  .lattice = ensemble->lattice,
                                  .cut = fracas_ensemble_cut(ensemble)};
    TRY(make_room(ensemble, sample));
    count_up(ensemble, sample, &smallest, &largest);
    add_up(ensemble, sample, smallest);
    if (!(sample->total > 0)) return FRACAS_OK;
    make_cells(sample, smallest, largest);
    sort_into_cells(ensemble, sample);
    return FRACAS_OK;
}

void fracas_fit_sample_count(const fracas_fit_sample *sample, const uint32_t *weight, double *count)
{
    memset(count, 0, sample->ncells * sizeof *count);
    for (size_t i = 0; i < sample->nrealizations; i++)
        for (size_t c = sample->first[i]; weight[i] && c < sample->first[i + 1]; c++)
            count[sample->cell[c]] += weight[i] * sample->times[c];
}

void fracas_fit_sample_moments(const fracas_fit_sample *sample, const uint32_t *weight,
                               double *mean, double *cv)
{
    double total = 0, sum = 0, squares = 0;
    for (size_t i = 0; i < sample->nrealizations; i++) {
        total += weight[i] * sample->kept[i];
        sum += weight[i] * sample->sum[i];
        squares += weight[i] * sample->squares[i];
    }
    const double rest = sum / total;
    *mean = sample->mean + rest;
    *cv = sqrt(fmax(squares / total - rest * rest, 0)) / *mean;
}
