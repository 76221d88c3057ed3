/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/estimate/bootstrap.h"

#include "analysis/data/room.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <string.h>

static const fracas_field interval_fields[] = {
    FRACAS_FIELD(fracas_interval, NUMBER, "value", NULL, "%s", value),
    FRACAS_FIELD(fracas_interval, NUMBER, "low", NULL, "lower end of the 95 % interval of: %s",
                 low),
    FRACAS_FIELD(fracas_interval, NUMBER, "high", NULL, "upper end of the 95 % interval of: %s",
                 high),
    FRACAS_FIELD(fracas_interval, NUMBER, "standard_error", NULL, "standard error of: %s",
                 standard_error),
};
const fracas_fields fracas_interval_fields = {interval_fields, 3},
                    fracas_interval_error_fields = FRACAS_FIELDS(interval_fields);

enum { RESAMPLES = 2000, GROUPS = 200 };

typedef struct {
    fracas_room room;
    size_t n, nvalues;
    fracas_resampled *statistic;
    void *context;
    uint32_t *weight; /* n */
    double *found;    /* nvalues x most: of each resample, value by value */
    double *left_out; /* nvalues x groups: without each group of realizations */
    size_t most, groups;
} resampling;

gsl_rng *fracas_random(uint64_t seed)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    if (random) gsl_rng_set(random, (unsigned long)(seed ^ seed >> 32)); /* it takes 32 bits */
    return random;
}

void fracas_resample(gsl_rng *random, size_t n, uint32_t *weight)
{
    memset(weight, 0, n * sizeof *weight);
    for (size_t i = 0; i < n; i++) weight[gsl_rng_uniform_int(random, n)]++;
}

static void put(const resampling *r, const double *value, double *table, size_t columns,
                size_t column)
{
    for (size_t v = 0; v < r->nvalues; v++) table[v * columns + column] = value[v];
}

/* Without the realizations g, g + groups, g + 2 groups, ... */
static void leave_out(resampling *r, double *value)
{
    for (size_t g = 0; g < r->groups; g++) {
        for (size_t i = 0; i < r->n; i++) r->weight[i] = i % r->groups != g;
        r->statistic(r->context, r->weight, value);
        put(r, value, r->left_out, r->groups, g);
    }
}

/* a = sum d^3/(6 (sum d^2)^(3/2)), d = mean - value without group g; 0 where a group has none. */
static double acceleration(const double *value, size_t count)
{
    double mean = 0, squares = 0, cubes = 0;
    for (size_t g = 0; g < count; g++) mean += value[g] / (double)count;
    for (size_t g = 0; g < count; g++) {
        const double d = mean - value[g];
        squares += d * d;
        cubes += d * d * d;
    }
    const double a = cubes / (6 * pow(squares, 1.5));
    return isfinite(a) ? a : 0;
}

double fracas_quantile(const double *ascending, size_t count, double p)
{
    const double at = p * (double)(count + 1) - 1;
    if (at <= 0) return ascending[0];
    if (at >= (double)(count - 1)) return ascending[count - 1];
    const size_t below = (size_t)at;
    return ascending[below] + (at - (double)below) * (ascending[below + 1] - ascending[below]);
}

static double upper_share(const fracas_bootstrap_options *options)
{
    return 0.5 + 0.5 * (options->confidence > 0 ? options->confidence : 0.95);
}

/* Upper quantile of the confidence (estimators.18) */
static double upper(size_t n, const fracas_bootstrap_options *options)
{
    const double p = upper_share(options);
    if (options->plain) return gsl_cdf_ugaussian_Pinv(p);
    return sqrt((double)n / (double)(n - 1)) * gsl_cdf_tdist_Pinv(p, (double)(n - 1));
}

static void summarise(double *found, size_t most, const double *left_out, size_t groups,
                      double quantile_up, fracas_interval *interval)
{
    size_t count = 0;
    double below = 0, sum = 0, squares = 0;
    for (size_t b = 0; b < most; b++)
        if (isfinite(found[b])) found[count++] = found[b];
    interval->resamples = (int64_t)count;
    if (count < 2 || !isfinite(interval->value)) return;
    for (size_t b = 0; b < count; b++) {
        sum += found[b] - interval->value;
        below += found[b] < interval->value    ? 1
                 : found[b] == interval->value ? 0.5
                                               : 0; /* half of the ties, for lattice values */
    }
    const double bias = sum / (double)count;
    for (size_t b = 0; b < count; b++) {
        const double d = found[b] - interval->value - bias;
        squares += d * d;
    }
    interval->standard_error = sqrt(squares / (double)(count - 1));
    gsl_sort(found, 1, count);
    const double share = fmin(fmax(below, 0.5), (double)count - 0.5) / (double)count;
    const double z0 = gsl_cdf_ugaussian_Pinv(share), a = acceleration(left_out, groups);
    for (int side = 0; side < 2; side++) {
        const double z = z0 + (side ? quantile_up : -quantile_up);
        const double p = gsl_cdf_ugaussian_P(a * z < 1 ? z0 + z / (1 - a * z)
                                                       : copysign(INFINITY, z));
        *(side ? &interval->high : &interval->low) = fracas_quantile(found, count, p);
    }
}

/* value[] of all realizations, then without each group; its standard error is of deviations from
 * the value itself, not from the mean without groups: where a value is biased, longer. */
static void jackknife(resampling *r, double *value, fracas_jackknifed *found)
{
    for (size_t i = 0; i < r->n; i++) r->weight[i] = 1;
    r->statistic(r->context, r->weight, value);
    for (size_t v = 0; v < r->nvalues; v++)
        found[v] = (fracas_jackknifed){value[v], NAN, r->groups};
    if (r->n < 2) return;
    const double g = (double)r->groups;
    leave_out(r, value);
    for (size_t v = 0; v < r->nvalues; v++) {
        double squares = 0;
        for (size_t k = 0; k < r->groups; k++) {
            const double d = r->left_out[v * r->groups + k] - found[v].value;
            squares += d * d;
        }
        found[v].standard_error = sqrt((g - 1) / g * squares);
    }
}

/* (estimators.18) */
static void student(const resampling *r, const fracas_bootstrap_options *options,
                    const fracas_jackknifed *found, fracas_interval *interval)
{
    const double t = r->n > 1 ? gsl_cdf_tdist_Pinv(upper_share(options), (double)(r->n - 1)) : NAN;
    for (size_t v = 0; v < r->nvalues; v++) {
        const double half = t * found[v].standard_error;
        interval[v] = (fracas_interval){found[v].value, found[v].value - half,
                                        found[v].value + half, found[v].standard_error,
                                        isfinite(half) ? (int64_t)r->groups : 0};
    }
}

static fracas_err resample(resampling *r, const fracas_bootstrap_options *options,
                           fracas_interval *interval, double *value)
{
    OWN(gsl_rng) random = fracas_random(options->seed);
    if (!random) return fracas_no_memory("a bootstrap");
    for (size_t b = 0; b < r->most; b++) {
        fracas_resample(random, r->n, r->weight);
        r->statistic(r->context, r->weight, value);
        put(r, value, r->found, r->most, b);
    }
    for (size_t v = 0; v < r->nvalues; v++)
        summarise(r->found + v * r->most, r->most, r->left_out + v * r->groups, r->groups,
                  upper(r->n, options), &interval[v]);
    return FRACAS_OK;
}

/* Room for `most` resamples, of which there may be none. */
static fracas_err make_room(resampling *r, double **value)
{
    FRACAS_TAKE(&r->room, r->weight, r->n);
    FRACAS_TAKE(&r->room, r->found, r->nvalues * r->most);
    FRACAS_TAKE(&r->room, r->left_out, r->nvalues * r->groups);
    FRACAS_TAKE(&r->room, *value, r->nvalues);
    return fracas_room_check(&r->room, "a bootstrap");
}

fracas_err fracas_bootstrap(size_t n, size_t nvalues, fracas_resampled *statistic, void *context,
                            const fracas_bootstrap_options *options, fracas_interval *interval)
{
    resampling r = {.n = n,
                    .nvalues = nvalues,
                    .statistic = statistic,
                    .context = context,
                    .groups = n < GROUPS ? n : GROUPS};
    double *value;
    fracas_jackknifed *found;
    FRACAS_TAKE(&r.room, found, nvalues);
    if (n >= FRACAS_BOOTSTRAP_LEAST)
        r.most = options->resamples > 0 ? (size_t)options->resamples : RESAMPLES;
    for (size_t v = 0; v < nvalues; v++) interval[v] = (fracas_interval){NAN, NAN, NAN, NAN, 0};
    fracas_err err = make_room(&r, &value);
    if (!err && n) {
        jackknife(&r, value, found);
        if (r.most) {
            for (size_t v = 0; v < nvalues; v++) interval[v].value = found[v].value;
            err = resample(&r, options, interval, value);
        } else student(&r, options, found, interval);
    }
    fracas_room_clear(&r.room);
    return err;
}

fracas_err fracas_jackknife(size_t n, size_t nvalues, fracas_resampled *statistic, void *context,
                            fracas_jackknifed *found)
{
    resampling r = {.n = n,
                    .nvalues = nvalues,
                    .statistic = statistic,
                    .context = context,
                    .groups = n < GROUPS ? n : GROUPS};
    double *value;
    for (size_t v = 0; v < nvalues; v++) found[v] = (fracas_jackknifed){NAN, NAN, 0};
    fracas_err err = make_room(&r, &value);
    if (!err && n) jackknife(&r, value, found);
    fracas_room_clear(&r.room);
    return err;
}
