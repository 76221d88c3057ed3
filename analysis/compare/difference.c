/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/compare/methods.h"
#include "analysis/data/room.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>

static void put_intervals(double error, double relative_error, fracas_compared_value *value)
{
    const bool known = error > 0 && value->freedom > 0;
    const double t = known ? gsl_cdf_tdist_Pinv(0.975, value->freedom) : error == 0 ? 0 : NAN;
    value->low = value->difference - t * error;
    value->high = value->difference + t * error;
    value->relative_low = value->relative - t * relative_error;
    value->relative_high = value->relative + t * relative_error;
}

/* (compare.1), (compare.2), (compare.3) */
void fracas_difference_of(const double *a, size_t na, const double *b, size_t nb, size_t stride,
                          fracas_compared_value *value)
{
    value->a = fracas_estimate_of(a, stride, na);
    value->b = fracas_estimate_of(b, stride, nb);
    const double n = (double)value->a.n, m = (double)value->b.n;
    const double u = value->a.deviation * value->a.deviation / n,
                 v = value->b.deviation * value->b.deviation / m;
    const double mean = value->a.mean, ratio = value->b.mean / mean;
    value->difference = value->b.mean - mean;
    value->relative = mean != 0 ? value->difference / fabs(mean) : NAN;
    value->freedom = (u + v) * (u + v) / (u * u / (n - 1) + v * v / (m - 1));
    put_intervals(sqrt(u + v), sqrt(v + ratio * ratio * u) / fabs(mean), value);
}

/* (compare.4), (compare.5) */
void fracas_difference_of_pairs(const double *a, const double *b, size_t n, size_t stride,
                                fracas_compared_value *value)
{
    double sum_a = 0, sum_b = 0, squares_a = 0, squares_b = 0, squares = 0, ratios = 0;
    int64_t pairs = 0;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(a[i * stride]) || !isfinite(b[i * stride])) continue;
        sum_a += a[i * stride];
        sum_b += b[i * stride];
        pairs++;
    }
    const double count = (double)pairs, mean_a = sum_a / count, mean_b = sum_b / count,
                 ratio = mean_b / mean_a;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(a[i * stride]) || !isfinite(b[i * stride])) continue;
        const double x = a[i * stride] - mean_a, y = b[i * stride] - mean_b;
        squares_a += x * x;
        squares_b += y * y;
        squares += (y - x) * (y - x);
        ratios += (y - ratio * x) * (y - ratio * x);
    }
    const double freedom = count - 1, t = pairs > 1 ? gsl_cdf_tdist_Pinv(0.975, freedom) : NAN;
    const double deviation_a = pairs > 1 ? sqrt(squares_a / freedom) : NAN,
                 deviation_b = pairs > 1 ? sqrt(squares_b / freedom) : NAN;
    value->a = (fracas_estimate){pairs, mean_a, deviation_a, t * deviation_a / sqrt(count)};
    value->b = (fracas_estimate){pairs, mean_b, deviation_b, t * deviation_b / sqrt(count)};
    value->difference = mean_b - mean_a;
    value->relative = mean_a != 0 ? value->difference / fabs(mean_a) : NAN;
    value->freedom = freedom;
    put_intervals(pairs > 1 ? sqrt(squares / freedom / count) : NAN,
                  sqrt(ratios / freedom / count) / fabs(mean_a), value);
}

/* (compare.10) */
fracas_err fracas_holm(const double *p, size_t count, size_t stride, double *corrected)
{
    FRACAS_CLEARED(fracas_room) room = {0};
    double *value, most = 0;
    size_t *order, tests = 0;
    FRACAS_TAKE(&room, value, count);
    FRACAS_TAKE(&room, order, count);
    TRY(fracas_room_check(&room, "the corrections of p"));
    for (size_t i = 0; i < count; i++) {
        corrected[i * stride] = NAN;
        value[i] = isfinite(p[i * stride]) ? p[i * stride] : 2; /* behind all tests */
        tests += isfinite(p[i * stride]);
    }
    gsl_sort_index(order, value, 1, count);
    for (size_t k = 0; k < tests; k++) {
        most = fmax(most, fmin(1, (double)(tests - k) * value[order[k]]));
        corrected[order[k] * stride] = most;
    }
    return FRACAS_OK;
}
