/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/estimate/weights.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

typedef struct {
    double variance, freedom; /* relative, of one replica; NaN of no freedom */
} pool;

/* Over the means of less than `below` replicas. */
static pool pool_of(const fracas_mean *mean, size_t n, int64_t below)
{
    double squares = 0, freedom = 0;
    for (size_t i = 0; i < n; i++) {
        if (mean[i].replicas < 2 || mean[i].replicas >= below) continue;
        squares += (double)(mean[i].replicas - 1) * mean[i].scatter * mean[i].scatter;
        freedom += (double)(mean[i].replicas - 1);
    }
    return (pool){squares / freedom, freedom};
}

/* Errors shared by means of less than FRACAS_REPLICAS_OWN replicas. A variance with few degrees of
 * freedom may be small by chance, and is not less than the variance of all; without one, its
 * freedom is that of all as well. */
static pool shared_of(const fracas_mean *mean, size_t n)
{
    enum { LEAST = 4 };
    const pool few = pool_of(mean, n, FRACAS_REPLICAS_OWN), all = pool_of(mean, n, INT64_MAX);
    return (pool){few.freedom >= LEAST && few.variance > 0 ? few.variance
                                                           : fmax(few.variance, all.variance),
                  few.freedom > 0 ? few.freedom : all.freedom};
}

/* (estimators.25), (estimators.26). */
void fracas_mean_errors(const fracas_mean *mean, size_t n, fracas_mean_error *error)
{
    const pool shared = shared_of(mean, n);
    for (size_t i = 0; i < n; i++) {
        const double replicas = (double)mean[i].replicas,
                     own = mean[i].replicas > 1 ? mean[i].scatter * mean[i].scatter : 0;
        const bool pooled = mean[i].replicas < FRACAS_REPLICAS_OWN;
        const double one = pooled ? shared.variance : own; /* one replica; NaN if all are */
        error[i] = (fracas_mean_error){.variance = one / replicas,
                                       .most = fmax(one, own) / replicas,
                                       .pooled = pooled,
                                       .freedom = pooled ? shared.freedom : replicas - 1};
    }
}

void fracas_misfit_add(fracas_misfit *misfit, double leverage, const fracas_mean_error *error)
{
    const double kept = 1 - leverage;
    if (error->pooled) {
        misfit->shared = error->freedom;
        misfit->kept += kept;
        misfit->squares += kept * kept;
    } else {
        misfit->others = true;
        misfit->doubt += kept * kept / error->freedom;
    }
}

/* (estimators.27), of Fisher where all share the pooled variance, of Johansen where some mean has
 * its own. */
double fracas_misfit_probability(const fracas_misfit *misfit, double chi2, double freedom)
{
    if (!(freedom > 0) || isnan(chi2)) return NAN;
    if (misfit->shared > 0 && !misfit->others)
        return gsl_cdf_fdist_Q(chi2 / freedom, freedom, misfit->shared);
    const double together = misfit->kept * misfit->kept + misfit->squares;
    const double doubt = misfit->doubt + (misfit->shared > 0 ? together / (2 * misfit->shared) : 0);
    if (!(doubt > 0)) return gsl_cdf_chisq_Q(chi2, freedom);
    return gsl_cdf_fdist_Q(chi2 / (freedom + 2 * doubt - 6 * doubt / (freedom + 2)), freedom,
                           freedom * (freedom + 2) / (3 * doubt));
}
