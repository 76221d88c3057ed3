/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/estimate.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>

static const fracas_field estimate_fields[] = {
    FRACAS_FIELD(fracas_estimate, INTEGER, "n", "1", "replicas in the mean %s", n),
    FRACAS_FIELD(fracas_estimate, NUMBER, "mean", NULL, "mean over replicas of the %s", mean),
    FRACAS_FIELD(fracas_estimate, NUMBER, "deviation", NULL,
                 "standard deviation over replicas of the %s", deviation),
    FRACAS_FIELD(fracas_estimate, NUMBER, "half_width", NULL,
                 "half width of the 95 % interval of the mean %s", half_width),
};
const fracas_fields fracas_estimate_fields = FRACAS_FIELDS(estimate_fields);

fracas_estimate fracas_estimate_of(const double *value, size_t stride, size_t count)
{
    int64_t n = 0;
    double first = NAN, sum = 0; /* differences to the first: equal values have no deviation */
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i * stride])) continue;
        if (n++ == 0) first = value[i * stride];
        sum += value[i * stride] - first;
    }
    fracas_estimate estimate = {
        .n = n, .mean = first + sum / (double)n, .deviation = NAN, .half_width = NAN};
    if (n < 2) return estimate;
    double squares = 0;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i * stride])) continue;
        double difference = value[i * stride] - estimate.mean;
        squares += difference * difference;
    }
    estimate.deviation = sqrt(squares / (double)(n - 1));
    estimate.half_width = gsl_cdf_tdist_Pinv(0.975, (double)(n - 1)) * estimate.deviation /
                          sqrt((double)n);
    return estimate;
}

/* Two sums of the same numbers in other groups differ by roundings; physics does not repeat itself
 * so well. */
static const double rounding = 1e-12;

fracas_part fracas_part_of(const double *value, size_t stride, size_t count)
{
    const fracas_estimate of = fracas_estimate_of(value, stride, count);
    return (fracas_part){of.mean, (double)of.n, of.deviation * of.deviation,
                         of.n > 1 ? (double)(of.n - 1) : 0};
}

/* p-value without scatter within the parts, as of counts of few fragments: 2 of the C(n, m)
 * permutations of n realizations into m and n - m separate them like this. */
static double permuted_p(double n, double m)
{
    return fmin(1, exp(log(2) - gsl_sf_lnchoose((unsigned)n, (unsigned)m)));
}

/* (estimators.22) */
double fracas_parts_alike(const fracas_part *a, const fracas_part *b)
{
    const double apart = fabs(a->value - b->value), freedom = a->freedom + b->freedom,
                 hair = rounding * fmax(fabs(a->value), fabs(b->value));
    if (!isfinite(apart) || !(freedom > 0)) return NAN;
    if (apart <= hair) return 1;
    const double variance = ((a->freedom > 0 ? a->freedom * a->variance : 0) +
                             (b->freedom > 0 ? b->freedom * b->variance : 0)) /
                            freedom;
    if (sqrt(variance) <= hair) return permuted_p(a->n + b->n, a->n);
    return 2 * gsl_cdf_tdist_Q(apart / sqrt(variance * (1 / a->n + 1 / b->n)), freedom);
}
