#include "analysis/laws/weights.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* (estimators.25), (estimators.26). */
void fracas_mean_errors(const fracas_mean *mean, size_t n, fracas_mean_error *error)
{
    double squares = 0, freedom = 0;
    bool pooled = false;
    for (size_t i = 0; i < n; i++) {
        pooled = pooled || mean[i].replicas < FRACAS_REPLICAS_OWN;
        if (mean[i].replicas < 2) continue;
        squares += (double)(mean[i].replicas - 1) * mean[i].scatter * mean[i].scatter;
        freedom += (double)(mean[i].replicas - 1);
    }
    for (size_t i = 0; i < n; i++) {
        const double replicas = (double)mean[i].replicas, own = mean[i].replicas > 1 ? mean[i].scatter * mean[i].scatter : 0;
        const double one = pooled ? squares / freedom : own; /* of one replica; NaN if all means are of one */
        error[i] = (fracas_mean_error){.variance = one / replicas, .most = fmax(one, own) / replicas, .pooled = pooled,
                                       .freedom = pooled ? freedom : replicas - 1};
    }
}

void fracas_misfit_add(fracas_misfit *misfit, double leverage, const fracas_mean_error *error)
{
    if (error->pooled) misfit->shared = error->freedom;
    else misfit->doubt += (1 - leverage) * (1 - leverage) / error->freedom;
}

/* (estimators.27), of Fisher where the variance is pooled, of Johansen where each mean has its own. */
double fracas_misfit_probability(const fracas_misfit *misfit, double chi2, double freedom)
{
    const double doubt = misfit->doubt;
    if (!(freedom > 0) || isnan(chi2)) return NAN;
    if (misfit->shared > 0) return gsl_cdf_fdist_Q(chi2 / freedom, freedom, misfit->shared);
    if (!(doubt > 0)) return gsl_cdf_chisq_Q(chi2, freedom);
    return gsl_cdf_fdist_Q(chi2 / (freedom + 2 * doubt - 6 * doubt / (freedom + 2)), freedom, freedom * (freedom + 2) / (3 * doubt));
}
