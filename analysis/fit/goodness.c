/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/point.h"

#include "analysis/fit/sample.h"
#include "analysis/data/room.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <math.h>
#include <string.h>

/* (fits.9), (fits.10) */
fracas_fit_distance fracas_fit_distance_of(size_t ncells, const double *count,
                                           const double *probability)
{
    fracas_fit_distance distance = {0, 0};
    double total = 0, observed = 0, expected = 0;
    for (size_t k = 0; k < ncells; k++) total += count[k];
    for (size_t k = 0; k + 1 < ncells; k++) {
        observed += count[k] / total;
        expected += probability[k];
        const double apart = observed - expected, spread = expected * (1 - expected);
        distance.ks = fmax(distance.ks, fabs(apart));
        if (probability[k] > 0 && spread > 1e-12)
            distance.ad += probability[k] * apart * apart / spread;
    }
    return distance;
}

/* Which realization each fragment is of: cell by cell, in random order within each. */
static void order(const fracas_fit_sample *sample, gsl_rng *random, size_t *place, uint32_t *owner)
{
    size_t begin = 0;
    for (size_t k = 0; k < sample->ncells; k++) {
        place[k] = begin;
        begin += (size_t)sample->count[k];
    }
    for (size_t i = 0; i < sample->nrealizations; i++)
        for (size_t c = sample->first[i]; c < sample->first[i + 1]; c++)
            for (double t = 0; t < sample->times[c]; t++)
                owner[place[sample->cell[c]]++] = (uint32_t)i;
    for (size_t k = 0; k < sample->ncells; k++) {
        const size_t n = (size_t)sample->count[k];
        if (n > 1) gsl_ran_shuffle(random, owner + place[k] - n, n, sizeof *owner);
    }
}

/* Fragments in their order, each to the cell of its quantile; lists of realizations begin at
 * first[i] and end at end[i]. */
static void move(const fracas_fit_sample *sample, const double *probability, const uint32_t *owner,
                 size_t *end, fracas_fit_sample *carried)
{
    double below = 0;
    size_t to = 0;
    memcpy(end, carried->first, carried->nrealizations * sizeof *end);
    for (size_t r = 0; r < (size_t)sample->total; r++) {
        while (to + 1 < sample->ncells &&
               below + probability[to] < ((double)r + 0.5) / sample->total)
            below += probability[to++];
        const size_t i = owner[r], last = end[i];
        const bool again = last > carried->first[i] && carried->cell[last - 1] == to;
        if (!again) {
            carried->cell[last] = (uint32_t)to;
            carried->times[last] = 0;
            end[i]++;
        }
        carried->times[end[i] - 1] += 1;
        carried->count[to] += 1;
    }
}

/* Takes the room between the lists out. */
static void compact(const size_t *end, fracas_fit_sample *carried)
{
    size_t used = 0;
    for (size_t i = 0; i < carried->nrealizations; i++) {
        const size_t begin = carried->first[i];
        carried->first[i] = used;
        for (size_t c = begin; c < end[i]; c++, used++) {
            carried->cell[used] = carried->cell[c];
            carried->times[used] = carried->times[c];
        }
    }
    carried->first[carried->nrealizations] = used;
}

/* (fits.11) */
fracas_err fracas_fit_carry(const fracas_fit_sample *sample, const double *probability,
                            uint64_t seed, fracas_fit_sample *carried)
{
    const size_t n = sample->nrealizations, fragments = (size_t)sample->total;
    size_t place[FRACAS_FIT_CELLS];
    *carried = *sample;
    memset(carried->count, 0, sizeof carried->count);
    carried->kept = carried->sum = carried->squares = NULL;
    carried->room = (fracas_room){0};
    FRACAS_TAKE(&carried->room, carried->first, n);
    FRACAS_TAKE(&carried->room, carried->cell, fragments);
    FRACAS_TAKE(&carried->room, carried->times, fragments);
    uint32_t *owner;
    size_t *end;
    FRACAS_TAKE(&carried->room, owner, fragments);
    FRACAS_TAKE(&carried->room, end, n);
    OWN(gsl_rng) random = fracas_random(seed);
    if (!random || carried->room.lacking) return fracas_no_memory("a resample");
    for (size_t i = 0, begin = 0; i < n; i++) {
        carried->first[i] = begin;
        begin += (size_t)sample->kept[i];
    }
    order(sample, random, place, owner);
    move(sample, probability, owner, end, carried);
    compact(end, carried);
    return FRACAS_OK;
}

typedef struct {
    int64_t found, ks, ad; /* resamples, and those of them as far as the sample */
} tally;

/* One resample under the family. Distances of n realizations drawn from n are too small by sqrt((n
 * - 1)/n), their squares by the square of this. */
static void resample(const fracas_family *family, const fracas_fit_sample *carried,
                     const fracas_fit *fit, const uint32_t *weight,
                     const fracas_fit_distance *distance, tally *sum)
{
    double count[FRACAS_FIT_CELLS], probability[FRACAS_FIT_CELLS],
        parameter[FRACAS_FAMILY_PARAMETERS];
    fracas_fit_sample_count(carried, weight, count);
    if (!fracas_fit_again(family, carried, count, fit, parameter)) return;
    if (!fracas_fit_probabilities(family, carried, parameter, probability)) return;
    const fracas_fit_distance other = fracas_fit_distance_of(carried->ncells, count, probability);
    const double widen = (double)carried->nrealizations / (double)(carried->nrealizations - 1);
    sum->found++;
    sum->ks += sqrt(widen) * other.ks >= distance->ks;
    sum->ad += widen * other.ad >= distance->ad;
}

/* (fits.12) */
fracas_err fracas_fit_goodness_of(const fracas_family *family, const fracas_fit_sample *sample,
                                  const fracas_fit *fit, int64_t resamples, uint64_t seed,
                                  fracas_fit_goodness *goodness)
{
    double probability[FRACAS_FIT_CELLS];
    *goodness = (fracas_fit_goodness){{NAN, NAN}, NAN, NAN, 0};
    if (!fracas_fit_probabilities(family, sample, fit->parameter, probability)) return FRACAS_OK;
    goodness->distance = fracas_fit_distance_of(sample->ncells, sample->count, probability);
    if (sample->nrealizations < FRACAS_FIT_GOODNESS_LEAST) return FRACAS_OK;
    FRACAS_CLEARED(fracas_fit_sample) carried = {.ncells = 0};
    const size_t n = sample->nrealizations;
    OWN(gsl_rng) random = fracas_random(seed);
    OWNED uint32_t *weight = malloc(n * sizeof *weight);
    tally sum = {0};
    TRY(fracas_fit_carry(sample, probability, seed, &carried));
    if (!random || !weight) return fracas_no_memory("a resample");
    for (int64_t b = 0; b < resamples; b++) {
        fracas_resample(random, n, weight);
        resample(family, &carried, fit, weight, &goodness->distance, &sum);
    }
    goodness->resamples = sum.found;
    if (sum.found > 0) {
        goodness->ks_p = (double)(1 + sum.ks) / (double)(1 + sum.found);
        goodness->ad_p = (double)(1 + sum.ad) / (double)(1 + sum.found);
    }
    return FRACAS_OK;
}

/* ---- two families ---- */

/* (fits.14): realization i gives the sum over its fragments of log p_1 - log p_2. */
static void vuong(const fracas_fit_sample *sample, const fracas_family *const family[2],
                  const double probability[2][FRACAS_FIT_CELLS], fracas_fit_comparison *comparison)
{
    const double n = (double)sample->nrealizations;
    double ratio = 0, squares = 0;
    for (size_t i = 0; i < sample->nrealizations; i++) {
        double sum = 0;
        for (size_t c = sample->first[i]; c < sample->first[i + 1]; c++)
            sum += sample->times[c] *
                   log(probability[0][sample->cell[c]] / probability[1][sample->cell[c]]);
        ratio += sum;
        squares += sum * sum;
    }
    const double deviation = sqrt(fmax(squares - ratio * ratio / n, 0) / (n - 1));
    const double parameters = (double)family[0]->nparameters - (double)family[1]->nparameters;
    comparison->statistic = (ratio - parameters) / (sqrt(n) * deviation);
    comparison->p = n < FRACAS_FIT_GOODNESS_LEAST
                        ? NAN
                        : 2 * gsl_cdf_tdist_Q(fabs(comparison->statistic), n - 1);
}

/* Gain of the general family over the special one in a resample under the special one; NaN where a
 * refit does not arrive. */
static double gain_of(const fracas_fit_sample *carried, const uint32_t *weight,
                      const fracas_family *const family[2], const fracas_fit *const fit[2])
{
    double parameter[2][FRACAS_FAMILY_PARAMETERS], count[FRACAS_FIT_CELLS];
    fracas_fit_sample_count(carried, weight, count);
    for (int i = 0; i < 2; i++)
        if (!fracas_fit_again(family[i], carried, count, fit[i], parameter[i])) return NAN;
    return 2 * (fracas_fit_log_likelihood(family[1], carried, count, parameter[1]) -
                fracas_fit_log_likelihood(family[0], carried, count, parameter[0]));
}

/* (fits.15): family and fit of the special case, then of the general one. */
static fracas_err likelihood_ratio(const fracas_fit_sample *sample,
                                   const fracas_family *const family[2],
                                   const fracas_fit *const fit[2], const double *probability,
                                   int64_t resamples, uint64_t seed,
                                   fracas_fit_comparison *comparison)
{
    const size_t n = sample->nrealizations;
    const double widen = (double)n / (double)(n - 1);
    comparison->statistic = 2 * (fit[1]->log_likelihood - fit[0]->log_likelihood);
    if (n < FRACAS_FIT_GOODNESS_LEAST) return FRACAS_OK;
    FRACAS_CLEARED(fracas_fit_sample) carried = {.ncells = 0};
    OWN(gsl_rng) random = fracas_random(seed);
    OWNED uint32_t *weight = malloc(n * sizeof *weight);
    int64_t as_large = 0;
    TRY(fracas_fit_carry(sample, probability, seed, &carried));
    if (!random || !weight) return fracas_no_memory("a resample");
    for (int64_t b = 0; b < resamples; b++) {
        fracas_resample(random, n, weight);
        const double gain = gain_of(&carried, weight, family, fit);
        comparison->resamples += isfinite(gain);
        as_large += widen * gain >= comparison->statistic;
    }
    if (comparison->resamples > 0)
        comparison->p = (double)(1 + as_large) / (double)(1 + comparison->resamples);
    return FRACAS_OK;
}

fracas_err fracas_fit_compare(const fracas_fit_sample *sample, const fracas_family *const family[2],
                              const fracas_fit fit[2], int64_t resamples, uint64_t seed,
                              fracas_fit_comparison *comparison)
{
    double probability[2][FRACAS_FIT_CELLS];
    *comparison = (fracas_fit_comparison){.statistic = NAN, .p = NAN};
    for (int i = 0; i < 2; i++)
        if (!fracas_fit_probabilities(family[i], sample, fit[i].parameter, probability[i]))
            return FRACAS_OK;
    for (int special = 0; special < 2; special++) {
        const fracas_family *const ordered[2] = {family[special], family[!special]};
        const fracas_fit *const fitted[2] = {&fit[special], &fit[!special]};
        if (!fracas_family_within(ordered[0], ordered[1])) continue;
        comparison->nested = true;
        return likelihood_ratio(sample, ordered, fitted, probability[special], resamples, seed,
                                comparison);
    }
    vuong(sample, family, (const double(*)[FRACAS_FIT_CELLS])probability, comparison);
    return FRACAS_OK;
}
