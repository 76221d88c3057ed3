/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Realizations whose fragments are of a known law, and depend on each other within a realization.
 */
#ifndef FRACAS_TESTS_SUPPORT_FIT_SAMPLE_H
#define FRACAS_TESTS_SUPPORT_FIT_SAMPLE_H

#include "analysis/fit/family.h"
#include "analysis/data/ensemble.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

/* How the fragments of a realization depend on each other. Every one has the law's distribution
 * exactly: its normal score is standard. RING: neighbours of score (e_j - e_(j+1))/sqrt(2),
 * correlation -1/2, which sum to 0 round the ring, as sizes do that fill a length. SHARED: a tenth
 * of the variance is the realization's own; STRONG: half of it. */
typedef enum { INDEPENDENT, RING_SCORES, SHARED, STRONG, NDEPENDENCES } dependence;

typedef struct {
    const fracas_family *family;
    double parameter[FRACAS_FAMILY_PARAMETERS]; /* lengths in m */
    double from;                                /* m, sizes up to it do not occur; of a power law */
    double lattice; /* m, sizes are rounded to its multiples; 0: they are not */
    size_t realizations;
    double fragments; /* of a realization, in the mean: Poisson, at least 2 */
    dependence how;
} synthetic;

/* Shift, scale and shape of a family that is a Weibull law; shape 0 of any other. */
static inline void synthetic_weibull(const synthetic *what, double law[3])
{
    const fracas_family *family = what->family;
    const bool shifted = family->parameter[0].shift, rayleigh = strstr(family->name, "rayleigh");
    const double *p = what->parameter + shifted;
    law[0] = shifted ? what->parameter[0] : 0;
    law[1] = rayleigh ? M_SQRT2 * p[0] : p[0];
    law[2] = rayleigh                               ? 2
             : family == &fracas_family_exponential ? 1
             : family == &fracas_family_mott        ? 0.5
             : strstr(family->name, "weibull")      ? p[1]
                                                    : 0;
}

/* x with P(size > x) = above. */
static inline double synthetic_quantile(const synthetic *what, double above)
{
    const fracas_family *family = what->family;
    const double *p = what->parameter;
    double weibull[3];
    synthetic_weibull(what, weibull);
    if (weibull[2] > 0) return weibull[0] + weibull[1] * pow(-log(above), 1 / weibull[2]);
    if (family == &fracas_family_gamma) return gsl_cdf_gamma_Qinv(above, p[1], p[0]);
    if (family == &fracas_family_lognormal) return p[0] * exp(p[1] * gsl_cdf_ugaussian_Qinv(above));
    if (family == &fracas_family_generalised_gamma)
        return p[0] *
               pow(p[2] * p[2] * gsl_cdf_gamma_Qinv(above, 1 / (p[2] * p[2]), 1), p[1] / p[2]);
    double low = log(what->from), high = log(what->from + 700 * p[1]); /* of a power law */
    for (int i = 0; i < 60; i++) {
        double below, rest;
        family->tails(p, what->from, exp(0.5 * (low + high)), &below, &rest);
        *(rest > above ? &low : &high) = 0.5 * (low + high);
    }
    return exp(0.5 * (low + high));
}

static inline double synthetic_size(const synthetic *what, double score)
{
    const double size = synthetic_quantile(what, gsl_cdf_ugaussian_Q(score));
    return what->lattice > 0 ? what->lattice * ceil(size / what->lattice - 0.5) : size;
}

/* One realization; sizes of less than half an element are no fragments. */
static inline void synthetic_realization(const synthetic *what, gsl_rng *random,
                                         fracas_record *record)
{
    const size_t n = 2 + gsl_ran_poisson(random, what->fragments - 2);
    const double part = what->how == SHARED ? 0.1 : what->how == STRONG ? 0.5 : 0;
    const double shared = gsl_ran_ugaussian(random), first = gsl_ran_ugaussian(random);
    double last = first;
    fracas_record_init(record);
    record->fragment = calloc(n, sizeof *record->fragment);
    for (size_t j = 0; record->fragment && j < n; j++) {
        const double next = what->how == RING_SCORES && j + 1 == n ? first
                                                                   : gsl_ran_ugaussian(random);
        const double score = what->how == RING_SCORES ? (last - next) / M_SQRT2
                                                      : sqrt(part) * shared + sqrt(1 - part) * next;
        const double size = synthetic_size(what, score);
        last = next;
        if (!(size > 0)) continue;
        const int64_t elements = what->lattice > 0 ? (int64_t)(size / what->lattice + 0.5) : 100;
        record->fragment[record->nfragment++] = (fracas_fragment){.size = size,
                                                                  .mass = size,
                                                                  .elements = elements,
                                                                  .dust = what->lattice > 0 &&
                                                                          elements == 1};
    }
    record->fragments = (int64_t)record->nfragment;
}

/* Cleared by the caller. */
static inline fracas_err synthetic_ensemble(const synthetic *what, gsl_rng *random,
                                            fracas_ensemble *ensemble)
{
    const fracas_replica_values value = {0};
    fracas_ensemble_init(ensemble, what->lattice);
    ensemble->surface = !(what->lattice > 0);
    fracas_err err = FRACAS_OK;
    for (size_t i = 0; i < what->realizations && !err; i++) {
        FRACAS_CLEARED(fracas_record) record;
        synthetic_realization(what, random, &record);
        err = fracas_ensemble_add(ensemble, i, (int64_t)i, &value, &record);
    }
    return err;
}

#endif
