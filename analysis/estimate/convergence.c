/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/estimate/convergence.h"

#include "analysis/data/estimate.h"
#include "analysis/estimate/pooled.h"

#include <math.h>
#include <stdlib.h>

#define KEY(name, key, unit) key,
const char *const fracas_headline_key[FRACAS_NHEADLINES] = {FRACAS_HEADLINES(KEY)};

static const fracas_field running_value_field[] = {
    FRACAS_FIELD(fracas_running_value, NUMBER, "value", NULL, "%s", value),
    FRACAS_FIELD(fracas_running_value, NUMBER, "low", NULL, "lower end of its band or interval: %s",
                 low),
    FRACAS_FIELD(fracas_running_value, NUMBER, "high", NULL,
                 "upper end of its band or interval: %s", high),
};
static const fracas_fields running_value = FRACAS_FIELDS(running_value_field);

#define HEADLINE(name, key, unit)                              \
    {key,                                                      \
     FRACAS_FIELD_OBJECT,                                      \
     unit,                                                     \
     "as in points.csv, of these replicas",                    \
     offsetof(fracas_running, number[FRACAS_HEADLINE_##name]), \
     &running_value},
static const fracas_field running_fields[] = {
    FRACAS_FIELD(fracas_running, INTEGER, "replicas", "1", "the first so many usable ones",
                 replicas),
    FRACAS_HEADLINES(HEADLINE)};
const fracas_fields fracas_running_fields = FRACAS_FIELDS(running_fields);

/* Places of the headline numbers of a replica, those before the pooled ones. */
static const size_t place[FRACAS_HEADLINE_MEAN] = {
    [FRACAS_HEADLINE_COUNT] = offsetof(fracas_replica_values, count),
    [FRACAS_HEADLINE_SIZE] = offsetof(fracas_replica_values, size),
    [FRACAS_HEADLINE_DISSIPATED] = offsetof(fracas_replica_values, dissipated),
    [FRACAS_HEADLINE_LARGEST_SHARE] = offsetof(fracas_replica_values, largest_share),
};

static const double *values_of(const fracas_replica_values *first, int headline)
{
    return (const void *)((const char *)first + place[headline]);
}

/* From the first n realizations, n > 0. */
static fracas_err run(const fracas_ensemble *ensemble, size_t n, uint64_t seed,
                      fracas_running_value number[FRACAS_NHEADLINES])
{
    fracas_interval pooled[FRACAS_NPOOLED];
    for (int h = 0; h < FRACAS_HEADLINE_MEAN; h++) {
        const fracas_estimate of = fracas_estimate_of(values_of(ensemble->value, h),
                                                      FRACAS_REPLICA_STRIDE, n);
        number[h] = (fracas_running_value){of.mean, of.mean - of.half_width,
                                           of.mean + of.half_width};
    }
    TRY(fracas_pooled_first(ensemble, n, seed, pooled));
    for (int v = 0; v < FRACAS_NPOOLED; v++)
        number[FRACAS_HEADLINE_MEAN + v] = (fracas_running_value){pooled[v].value, pooled[v].low,
                                                                  pooled[v].high};
    return FRACAS_OK;
}

static fracas_err run_part(const fracas_ensemble *ensemble, size_t begin, size_t end,
                           fracas_part part[FRACAS_NHEADLINES])
{
    for (int h = 0; h < FRACAS_HEADLINE_MEAN; h++)
        part[h] = fracas_part_of(values_of(ensemble->value + begin, h), FRACAS_REPLICA_STRIDE,
                                 end - begin);
    return fracas_pooled_part(ensemble, begin, end, part + FRACAS_HEADLINE_MEAN);
}

static fracas_err compare_halves(const fracas_ensemble *ensemble,
                                 fracas_replica_convergence *convergence)
{
    const size_t n = ensemble->nrealizations;
    fracas_part first[FRACAS_NHEADLINES], second[FRACAS_NHEADLINES];
    TRY(run_part(ensemble, 0, n / 2, first));
    TRY(run_part(ensemble, n / 2, n, second));
    for (int h = 0; h < FRACAS_NHEADLINES; h++) {
        convergence->alike[h] = fracas_parts_alike(&first[h], &second[h]);
    }
    return FRACAS_OK;
}

bool fracas_replica_convergence_drifts(const fracas_replica_convergence *convergence,
                                       fracas_headline headline)
{
    return convergence->alike[headline] < FRACAS_CONVERGED_ALARM;
}

bool fracas_running_alike(const fracas_running_value *number)
{
    return number->high - number->low <= 2e-12 * fabs(number->value);
}

/* (estimators.22) */
static bool is_narrow(const fracas_running_value *number, size_t n)
{
    return (n >= FRACAS_BOOTSTRAP_LEAST || !fracas_running_alike(number)) &&
           0.5 * (number->high - number->low) <= FRACAS_CONVERGED_WIDTH * fabs(number->value);
}

fracas_err fracas_replica_convergence_of(const fracas_ensemble *ensemble, uint64_t seed,
                                         fracas_replica_convergence *convergence)
{
    const size_t n = ensemble->nrealizations;
    *convergence = (fracas_replica_convergence){0};
    for (int h = 0; h < FRACAS_NHEADLINES; h++) convergence->alike[h] = NAN;
    if (n == 0) return FRACAS_OK;
    size_t rows = 1;
    for (size_t first = FRACAS_CONVERGENCE_FIRST; first < n; first *= 2) rows++;
    convergence->row = malloc(rows * sizeof *convergence->row);
    if (!convergence->row) return fracas_no_memory("the convergence of a point");
    for (size_t first = FRACAS_CONVERGENCE_FIRST; convergence->count < rows; first *= 2) {
        fracas_running *row = &convergence->row[convergence->count++];
        row->replicas = (int64_t)(convergence->count == rows ? n : first);
        TRY(run(ensemble, (size_t)row->replicas, seed, row->number));
    }
    if (n >= 2) TRY(compare_halves(ensemble, convergence));
    for (int h = 0; h < FRACAS_NHEADLINES; h++) {
        const fracas_running_value *number = &convergence->row[rows - 1].number[h];
        const bool has = isfinite(number->value);
        convergence->converged[h] = has && is_narrow(number, n) &&
                                    !fracas_replica_convergence_drifts(convergence,
                                                                       (fracas_headline)h);
        convergence->unconverged += has && !convergence->converged[h];
    }
    return FRACAS_OK;
}

void fracas_replica_convergence_clear(fracas_replica_convergence *convergence)
{
    free(convergence->row);
    *convergence = (fracas_replica_convergence){0};
}
