/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/design/correlation.h"

#include "sampler/special/normal.h"

#include <math.h>

/* (designs.4) */
bool fracas_correlation_factor(size_t n, const double *correlation, double *factor, size_t *at,
                               double *rest)
{
    const double least = 1e-9; /* share of the variance: less is rounding */
    for (size_t j = 0; j < n; j++) {
        double left = 1.0;
        for (size_t k = 0; k < j; k++) {
            double sum = correlation[j * n + k];
            for (size_t i = 0; i < k; i++) sum -= factor[j * n + i] * factor[k * n + i];
            factor[j * n + k] = sum / factor[k * n + k];
            left -= factor[j * n + k] * factor[j * n + k];
        }
        if (!(left > least)) {
            *at = j;
            *rest = left;
            return false;
        }
        factor[j * n + j] = sqrt(left);
        for (size_t k = j + 1; k < n; k++) factor[j * n + k] = 0.0;
    }
    return true;
}

/* (designs.5) */
void fracas_correlate(size_t n, const double *factor, double *z, fracas_probability *p)
{
    for (size_t j = 0; j < n; j++) {
        z[j] = fracas_normal_quantile(p[j]);
        double score = factor[j * n + j] * z[j];
        bool tied = false;
        for (size_t k = 0; k < j; k++) {
            score += factor[j * n + k] * z[k];
            tied = tied || factor[j * n + k] != 0.0;
        }
        if (tied)
            p[j] = (fracas_probability){fracas_normal_upper(-score), fracas_normal_upper(score)};
    }
}
