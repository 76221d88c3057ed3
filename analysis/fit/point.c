/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/point.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <math.h>

static const fracas_interval NO_INTERVAL = {NAN, NAN, NAN, NAN, 0};

/* (fits.13) */
static void criteria(const fracas_family *family, const fracas_fit_sample *sample,
                     fracas_family_fit *fit)
{
    const double k = (double)family->nparameters, n = sample->total;
    fit->aicc = 2 * k - 2 * fit->fit.log_likelihood + 2 * k * (k + 1) / (n - k - 1);
    fit->bic = k * log(n) - 2 * fit->fit.log_likelihood;
}

static void fit_all(fracas_point_fits *fits)
{
    for (size_t f = 0; f < fits->nfamilies; f++) {
        fracas_family_fit *fit = &fits->family[f];
        *fit = (fracas_family_fit){.fit = {.parameter = {NAN, NAN, NAN}, .log_likelihood = NAN},
                                   .aicc = NAN,
                                   .bic = NAN,
                                   .delta = NAN,
                                   .goodness = {{NAN, NAN}, NAN, NAN, 0}};
        for (size_t i = 0; i < FRACAS_FAMILY_PARAMETERS; i++)
            fit->parameter[i] = fit->relative[i] = NO_INTERVAL;
        fracas_fit_of(fits->families[f], &fits->sample, &fit->fit);
        criteria(fits->families[f], &fits->sample, fit);
    }
}

static void rank_all(fracas_point_fits *fits)
{
    double least = INFINITY;
    for (size_t f = 0; f < fits->nfamilies; f++)
        if (!*fits->family[f].fit.why) least = fmin(least, fits->family[f].aicc);
    for (size_t f = 0; f < fits->nfamilies; f++) {
        fracas_family_fit *fit = &fits->family[f];
        fit->delta = isfinite(least) ? fit->aicc - least : NAN;
        if (*fit->fit.why) continue;
        fits->nfits++;
        fit->rank = 1;
        for (size_t other = 0; other < fits->nfamilies; other++) {
            if (*fits->family[other].fit.why) continue;
            const double apart = fits->family[other].aicc - fit->aicc;
            fit->rank += apart < 0 || (apart == 0 && other < f);
        }
        if (fit->rank <= 2) fits->best[fit->rank - 1] = f;
    }
}

/* Values resampled by fracas_bootstrap: mean, cv, then of every fit its parameters, a length
 * followed by itself over the mean. */
static void values_of(void *context, const uint32_t *weight, double *value)
{
    const fracas_point_fits *fits = context;
    double count[FRACAS_FIT_CELLS], parameter[FRACAS_FAMILY_PARAMETERS], *mean = value++,
                                                                         *cv = value++;
    fracas_fit_sample_moments(&fits->sample, weight, mean, cv);
    fracas_fit_sample_count(&fits->sample, weight, count);
    for (size_t f = 0; f < fits->nfamilies; f++) {
        if (*fits->family[f].fit.why) continue;
        const fracas_family *family = fits->families[f];
        const bool found = fracas_fit_again(family, &fits->sample, count, &fits->family[f].fit,
                                            parameter);
        for (size_t i = 0; i < family->nparameters; i++) {
            const double unit = family->parameter[i].length ? fits->sample.mean : 1;
            *value++ = found ? parameter[i] * unit : NAN;
            if (family->parameter[i].length) *value++ = found ? parameter[i] * unit / *mean : NAN;
        }
    }
}

static void hand_out(fracas_point_fits *fits, const fracas_interval *interval)
{
    fits->mean = *interval++;
    fits->cv = *interval++;
    for (size_t f = 0; f < fits->nfamilies; f++) {
        if (*fits->family[f].fit.why) continue;
        for (size_t i = 0; i < fits->families[f]->nparameters; i++) {
            fits->family[f].parameter[i] = *interval++;
            if (fits->families[f]->parameter[i].length) fits->family[f].relative[i] = *interval++;
        }
    }
}

static fracas_err intervals(fracas_point_fits *fits, int64_t resamples, uint64_t seed)
{
    enum { MOST = 2 + FRACAS_NFAMILIES * 2 * FRACAS_FAMILY_PARAMETERS };
    fracas_interval interval[MOST];
    size_t nvalues = 2;
    for (size_t f = 0; f < fits->nfamilies; f++)
        for (size_t i = 0; !*fits->family[f].fit.why && i < fits->families[f]->nparameters; i++)
            nvalues += fits->families[f]->parameter[i].length ? 2 : 1;
    const fracas_bootstrap_options options = {.resamples = resamples, .seed = seed};
    TRY(fracas_bootstrap(fits->sample.nrealizations, nvalues, values_of, fits, &options, interval));
    hand_out(fits, interval);
    return FRACAS_OK;
}

static fracas_err judge(fracas_point_fits *fits, int64_t resamples, uint64_t seed)
{
    for (size_t f = 0; f < fits->nfamilies; f++) {
        if (*fits->family[f].fit.why) continue;
        TRY(fracas_fit_goodness_of(fits->families[f], &fits->sample, &fits->family[f].fit,
                                   resamples, seed + 1, &fits->family[f].goodness));
    }
    if (fits->nfits >= 2) {
        const fracas_family *const family[2] = {fits->families[fits->best[0]],
                                                fits->families[fits->best[1]]};
        const fracas_fit fit[2] = {fits->family[fits->best[0]].fit,
                                   fits->family[fits->best[1]].fit};
        TRY(fracas_fit_compare(&fits->sample, family, fit, resamples, seed + 2, &fits->comparison));
    }
    return intervals(fits, resamples, seed);
}

const fracas_family *const *fracas_point_families(bool surface, size_t *nfamilies)
{
    *nfamilies = surface ? FRACAS_NFAMILIES - 1 : FRACAS_NFAMILIES; /* Mott's is the last */
    return fracas_families;
}

fracas_err fracas_point_fits_of(const fracas_ensemble *ensemble,
                                const fracas_family *const *families, size_t nfamilies,
                                int64_t resamples, uint64_t seed, fracas_point_fits *fits)
{
    *fits = (fracas_point_fits){.families = families,
                                .nfamilies = nfamilies,
                                .mean = NO_INTERVAL,
                                .cv = NO_INTERVAL,
                                .comparison = {.statistic = NAN, .p = NAN}};
    TRY(fracas_fit_sample_create(ensemble, &fits->sample));
    gsl_error_handler_t *before = gsl_set_error_handler_off(); /* underflow is 0 */
    fit_all(fits);
    rank_all(fits);
    fracas_err err = fits->sample.total > 0 ? judge(fits, resamples, seed) : FRACAS_OK;
    gsl_set_error_handler(before);
    return err;
}

void fracas_point_fits_clear(fracas_point_fits *fits)
{
    fracas_fit_sample_clear(&fits->sample);
}
