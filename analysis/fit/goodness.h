/* How far counts are from a law, and how often a resample under that law is as far (docs/theory/fits.md). */
#ifndef FRACAS_ANALYSIS_FIT_GOODNESS_H
#define FRACAS_ANALYSIS_FIT_GOODNESS_H

#include "analysis/fit/likelihood.h"

typedef struct {
    double ks, ad;         /* D  (fits.9), A2/N  (fits.10), on cells */
} fracas_fit_distance;

typedef struct {
    fracas_fit_distance distance;
    double ks_p, ad_p;     /* (fits.12); NaN below FRACAS_FIT_GOODNESS_LEAST realizations */
    int64_t resamples;     /* whose refits arrived */
} fracas_fit_goodness;

enum { FRACAS_FIT_GOODNESS_LEAST = 4 };

fracas_fit_distance fracas_fit_distance_of(size_t ncells, const double *count, const double *probability);

/* Carries counts over cells with the sample's shares to cells with the shares of a law, in the order of sizes  (fits.11). */
typedef struct {
    uint32_t from, to;
    double share;
} fracas_fit_carriage;

typedef struct {
    size_t n;
    fracas_fit_carriage step[2 * FRACAS_FIT_CELLS + 1];
} fracas_fit_transport;

void fracas_fit_transport_of(const fracas_fit_sample *sample, const double *probability, fracas_fit_transport *transport);
void fracas_fit_transport_apply(const fracas_fit_transport *transport, size_t ncells, const double *count, double *carried);

/* D and A2 of a fit and their p-values from `resamples` resamples of realizations, carried over to the fitted law and fitted again. */
FRACAS_MUST_USE fracas_err fracas_fit_goodness_of(const fracas_family *family, const fracas_fit_sample *sample, const fracas_fit *fit,
                                                  int64_t resamples, uint64_t seed, fracas_fit_goodness *goodness);

#endif
