/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/point.h"

#include "analysis/fit/sample.h"
#include "base/own.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

enum { LEAST = FRACAS_FIT_GOODNESS_LEAST };

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
    comparison->p = n < LEAST ? NAN : 2 * gsl_cdf_tdist_Q(fabs(comparison->statistic), n - 1);
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
    if (n < LEAST) return FRACAS_OK;
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
