/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/estimate.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

static const fracas_field estimate_fields[] = {
    {"n", FRACAS_FIELD_INTEGER, "1", "replicas in the mean %s", offsetof(fracas_estimate, n)},
    {"mean", FRACAS_FIELD_NUMBER, NULL, "mean over replicas of the %s",
     offsetof(fracas_estimate, mean)},
    {"deviation", FRACAS_FIELD_NUMBER, NULL, "standard deviation over replicas of the %s",
     offsetof(fracas_estimate, deviation)},
    {"half_width", FRACAS_FIELD_NUMBER, NULL, "half width of the 95 % interval of the mean %s",
     offsetof(fracas_estimate, half_width)},
};
const fracas_fields fracas_estimate_fields = FRACAS_FIELDS(estimate_fields);

fracas_estimate fracas_estimate_of(const double *value, size_t stride, size_t count)
{
    int64_t n = 0;
    double first = NAN,
           sum = 0; /* differences to the first value: equal values have a deviation of exactly 0 */
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
