/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/sample/sample.h"

#include "base/json.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double parts[] = {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};
static const char *const part_keys[] = {"q01", "q05", "q25", "median", "q75", "q95", "q99"};
enum { PARTS = sizeof parts / sizeof *parts };

typedef struct {
    double mean, deviation, quantile[PARTS]; /* Pa */
    size_t weakest, strongest;
} summary;

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Linear between the order statistics, at (i + 1/2)/n. */
static double quantile_of(const double *sorted, size_t n, double part)
{
    const double at = fmin(fmax(part * (double)n - 0.5, 0), (double)(n - 1));
    const size_t below = (size_t)at, above = below + 1 < n ? below + 1 : below;
    return sorted[below] + (at - (double)below) * (sorted[above] - sorted[below]);
}

static fracas_err summarize(const fracas_sample *sample, summary *of)
{
    const size_t n = sample->n;
    double squares = 0;
    OWNED double *sorted = malloc(n * sizeof *sorted);
    *of = (summary){0};
    if (!sorted) return fracas_no_memory("the strengths of a realization");
    memcpy(sorted, sample->strength, n * sizeof *sorted);
    qsort(sorted, n, sizeof *sorted, by_value);
    for (size_t k = 0; k < n; k++) of->mean += sample->strength[k] / (double)n;
    for (size_t k = 0; k < n; k++) {
        const double off = sample->strength[k] - of->mean;
        squares += off * off;
        if (sample->strength[k] < sample->strength[of->weakest]) of->weakest = k;
        if (sample->strength[k] > sample->strength[of->strongest]) of->strongest = k;
    }
    of->deviation = n > 1 ? sqrt(squares / (double)(n - 1)) : NAN;
    for (int q = 0; q < PARTS; q++) of->quantile[q] = quantile_of(sorted, n, parts[q]);
    return FRACAS_OK;
}

static void print_extreme(const fracas_sample *sample, const char *name, size_t k, FILE *out)
{
    const double *x = sample->position[k];
    fprintf(out, "  %-20s %.6g MPa, interface %zu", name, 1e-6 * sample->strength[k],
            k / sample->points);
    if (sample->points > 1) fprintf(out, ", Gauss point %zu", k % sample->points);
    fprintf(out, ", at (%.6g, %.6g, %.6g) m\n", x[0], x[1], x[2]);
}

static void print_text(const fracas_sample *sample, const summary *of, double law, FILE *out)
{
    const fracas_strength *strength =
        &sample->realizer.campaign->point[sample->realizer.point].strength;
    fprintf(out, "Strengths of %s, point %zu, replica %" PRId64 "\n",
            sample->realizer.campaign->name, sample->realizer.point, sample->replica);
    fprintf(out, "  %-20s %s, mean %.6g MPa\n", "distribution", strength->distribution->name,
            1e-6 * law);
    fprintf(out, "  %-20s %zu%s\n", "strengths", sample->n,
            sample->points > 1 ? ", one a Gauss point" : ", one an interface");
    if (strength->covariance)
        fprintf(out, "  %-20s %s, length %.6g m; right to %.1e\n", "covariance",
                strength->covariance->name, strength->correlation_length, sample->error);
    if (strength->factor)
        fprintf(out, "  %-20s along %s, %s\n", "factor", strength->factor_along->name,
                strength->factor->path);
    fprintf(out, "  %-20s %.6g MPa\n  %-20s %.6g MPa\n", "mean", 1e-6 * of->mean,
            "standard deviation", 1e-6 * of->deviation);
    print_extreme(sample, "weakest", of->weakest, out);
    for (int q = 0; q < PARTS; q++) {
        char name[32];
        snprintf(name, sizeof name, "%g %%", 100 * parts[q]);
        fprintf(out, "  %-20s %.6g MPa\n", name, 1e-6 * of->quantile[q]);
    }
    print_extreme(sample, "strongest", of->strongest, out);
}

static void print_extreme_json(fracas_json *json, const fracas_sample *sample, const char *key,
                               size_t k)
{
    fracas_json_object(json, key);
    fracas_json_real(json, "strength", sample->strength[k]);
    fracas_json_integer(json, "interface", (int64_t)(k / sample->points));
    fracas_json_integer(json, "gauss_point", (int64_t)(k % sample->points));
    fracas_json_array(json, "position");
    for (int i = 0; i < 3; i++) fracas_json_real(json, NULL, sample->position[k][i]);
    fracas_json_close(json);
    fracas_json_close(json);
}

static void print_json(const fracas_sample *sample, const summary *of, double law, FILE *out)
{
    const fracas_point *point = &sample->realizer.campaign->point[sample->realizer.point];
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "campaign", sample->realizer.campaign->name);
    fracas_json_integer(&json, "point", (int64_t)sample->realizer.point);
    fracas_json_text(&json, "hash", fracas_hash_hex(&point->hash).text);
    fracas_json_integer(&json, "replica", sample->replica);
    fracas_json_text(&json, "distribution", point->strength.distribution->name);
    fracas_json_real(&json, "distribution_mean", law);
    fracas_json_text(&json, "covariance",
                     point->strength.covariance ? point->strength.covariance->name : NULL);
    fracas_json_real(&json, "covariance_error", sample->error);
    fracas_json_integer(&json, "strengths", (int64_t)sample->n);
    fracas_json_integer(&json, "gauss_points", (int64_t)sample->points);
    fracas_json_real(&json, "mean", of->mean);
    fracas_json_real(&json, "deviation", of->deviation);
    for (int q = 0; q < PARTS; q++) fracas_json_real(&json, part_keys[q], of->quantile[q]);
    print_extreme_json(&json, sample, "weakest", of->weakest);
    print_extreme_json(&json, sample, "strongest", of->strongest);
    fracas_json_end(&json);
}

fracas_err fracas_sample_summarize(const fracas_sample *sample, bool json, FILE *out)
{
    summary of;
    if (sample->n == 0)
        return fracas_fail(
            FRACAS_USAGE,
            "the body is one element: it has no interface, and so no strength; refine the mesh");
    TRY(summarize(sample, &of));
    const double law = fracas_strength_mean(
        &sample->realizer.campaign->point[sample->realizer.point].strength, sample->extent);
    if (json) print_json(sample, &of, law, out);
    else print_text(sample, &of, law, out);
    return FRACAS_OK;
}
