#include "analysis/fit/goodness.h"

#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* (fits.9), (fits.10) */
fracas_fit_distance fracas_fit_distance_of(size_t ncells, const double *count, const double *probability)
{
    fracas_fit_distance distance = {0, 0};
    double total = 0, observed = 0, expected = 0;
    for (size_t k = 0; k < ncells; k++) total += count[k];
    for (size_t k = 0; k + 1 < ncells; k++) {
        observed += count[k] / total;
        expected += probability[k];
        const double apart = observed - expected, spread = expected * (1 - expected);
        distance.ks = fmax(distance.ks, fabs(apart));
        if (probability[k] > 0 && spread > 1e-12) distance.ad += probability[k] * apart * apart / spread;
    }
    return distance;
}

/* (fits.11) */
void fracas_fit_transport_of(const fracas_fit_sample *sample, const double *probability, fracas_fit_transport *transport)
{
    double below = 0, law_below = 0; /* shares below the cells */
    size_t to = 0;
    transport->n = 0;
    for (size_t from = 0; from < sample->ncells; from++) {
        const double share = sample->count[from] / sample->total, end = below + share;
        double left = share;
        while (share > 0 && left > 0) {
            const double law_end = law_below + probability[to];
            const bool last = to + 1 == sample->ncells || law_end >= end;
            const double part = last ? left : fmin(fmax(law_end - fmax(below, law_below), 0), left);
            if (part > 0) transport->step[transport->n++] = (fracas_fit_carriage){(uint32_t)from, (uint32_t)to, part / share};
            left -= part;
            if (last) break;
            law_below = law_end;
            to++;
        }
        below = end;
    }
}

void fracas_fit_transport_apply(const fracas_fit_transport *transport, size_t ncells, const double *count, double *carried)
{
    memset(carried, 0, ncells * sizeof *carried);
    for (const fracas_fit_carriage *step = transport->step; step < transport->step + transport->n; step++)
        carried[step->to] += step->share * count[step->from];
}

typedef struct {
    int64_t found, ks, ad; /* resamples, and those of them as far as the sample */
} tally;

/* One resample under the law. Distances of n realizations drawn from n are too small by sqrt((n - 1)/n), their squares by the square of
 * that. */
static void resample(const fracas_family *family, const fracas_fit_sample *sample, const fracas_fit *fit, const fracas_fit_transport *transport,
                     const uint32_t *weight, const fracas_fit_distance *distance, tally *sum)
{
    double count[FRACAS_FIT_CELLS], carried[FRACAS_FIT_CELLS], probability[FRACAS_FIT_CELLS], parameter[FRACAS_FAMILY_PARAMETERS], mean, cv;
    fracas_fit_sample_weigh(sample, weight, count, &mean, &cv);
    fracas_fit_transport_apply(transport, sample->ncells, count, carried);
    if (!fracas_fit_again(family, sample, carried, fit, parameter)) return;
    if (!fracas_fit_probabilities(family, sample, parameter, probability)) return;
    const fracas_fit_distance other = fracas_fit_distance_of(sample->ncells, carried, probability);
    const double widen = (double)sample->nrealizations / (double)(sample->nrealizations - 1);
    sum->found++;
    sum->ks += sqrt(widen) * other.ks >= distance->ks;
    sum->ad += widen * other.ad >= distance->ad;
}

/* (fits.12) */
fracas_err fracas_fit_goodness_of(const fracas_family *family, const fracas_fit_sample *sample, const fracas_fit *fit, int64_t resamples,
                                  uint64_t seed, fracas_fit_goodness *goodness)
{
    double probability[FRACAS_FIT_CELLS];
    const size_t n = sample->nrealizations;
    *goodness = (fracas_fit_goodness){{NAN, NAN}, NAN, NAN, 0};
    if (!fracas_fit_probabilities(family, sample, fit->parameter, probability)) return FRACAS_OK;
    goodness->distance = fracas_fit_distance_of(sample->ncells, sample->count, probability);
    if (n < FRACAS_FIT_GOODNESS_LEAST) return FRACAS_OK;
    uint32_t *weight = malloc(n * sizeof *weight);
    fracas_fit_transport *transport = malloc(sizeof *transport);
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    const bool room = weight && transport && random;
    tally sum = {0};
    if (room) {
        gsl_rng_set(random, (unsigned long)(seed ^ seed >> 32)); /* it takes 32 bits */
        fracas_fit_transport_of(sample, probability, transport);
        for (int64_t b = 0; b < resamples; b++) {
            memset(weight, 0, n * sizeof *weight);
            for (size_t i = 0; i < n; i++) weight[gsl_rng_uniform_int(random, n)]++;
            resample(family, sample, fit, transport, weight, &goodness->distance, &sum);
        }
        goodness->resamples = sum.found;
        if (sum.found > 0) {
            goodness->ks_p = (double)(1 + sum.ks) / (double)(1 + sum.found);
            goodness->ad_p = (double)(1 + sum.ad) / (double)(1 + sum.found);
        }
    }
    free(weight);
    free(transport);
    if (random) gsl_rng_free(random);
    return room ? FRACAS_OK : fracas_no_memory("a goodness of fit");
}
