/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured strengths, or a table of their distribution function, from a file. */
#include "sampler/distribution/distribution.h"

#include "base/elementary.h"
#include "base/units.h"
#include "sampler/distribution/lines.h"

#include <stdio.h>
#include <stdlib.h>

/* F at each strength, in ascending order. */
struct fracas_table {
    size_t n;
    double *strength; /* [n] Pa */
    double *below;    /* [n] in 0 ... 1; the last is 1 */
};

static const fracas_kind linear = {.name = "linear",
                                   .doc = "distribution function linear between the strengths"};
static const fracas_kind steps = {.name = "steps", .doc = "only the strengths of the file occur"};
static const fracas_kind *const interpolations[] = {&linear, &steps};

/* ---- the file ---- */

/* The numbers of a line, one or two. */
typedef struct {
    double strength, below; /* below: NaN of a line with one */
} row;

/* The next line; *found is false at the end of the file. */
FRACAS_MUST_USE static fracas_err next_row(fracas_lines *lines, row *next, bool *found)
{
    char field[FRACAS_FIELD];
    *found = fracas_lines_next_row(lines);
    if (!*found) return FRACAS_OK;
    TRY(fracas_lines_check_commas(lines, 2, "strength,probability"));
    fracas_lines_field(lines, field);
    if (fracas_number_read(field, &next->strength) ||
        !(next->strength > 0.0 && next->strength < INFINITY))
        return fracas_lines_refuse(lines, field,
                                   "a strength in Pa, a number greater than 0, without a unit");
    next->below = NAN;
    if (lines->start == lines->stop) return FRACAS_OK;
    fracas_lines_field(lines, field);
    if (fracas_number_read(field, &next->below) || !(next->below >= 0.0 && next->below <= 1.0))
        return fracas_lines_refuse(
            lines, field,
            "a probability from 0 to 1, of strengths up to the one before it, or a "
            "strength in Pa alone, without a unit");
    if (lines->start == lines->stop) return FRACAS_OK;
    fracas_lines_field(lines, field);
    return fracas_lines_refuse(lines, field,
                               "the end of the line: a strength, or a strength and a probability");
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* (distributions.16) Every strength is as likely as every other. */
static fracas_err spread(const fracas_strength *strength, struct fracas_table *table)
{
    const bool is_linear = strength->interpolation != &steps;
    if (is_linear && table->n < 2)
        return fracas_fail(FRACAS_USAGE,
                           "%s has one strength; a linear distribution function needs two: give "
                           "more, or take interpolation: steps",
                           strength->file->path);
    qsort(table->strength, table->n, sizeof *table->strength, ascending);
    for (size_t k = 0; k < table->n; k++)
        table->below[k] = is_linear ? (double)k / (double)(table->n - 1)
                                    : (double)(k + 1) / (double)table->n;
    return FRACAS_OK;
}

/* A row of a table must go on from the one before it. */
static fracas_err check_row(const fracas_strength *strength, const struct fracas_table *table,
                            const fracas_lines *lines, const row *next)
{
    char found[FRACAS_FIELD];
    const size_t k = table->n;
    const bool is_pair = !isnan(next->below);
    if (k == 0 && is_pair && strength->interpolation != &steps && next->below > 0.0) {
        snprintf(found, sizeof found, "%.15g", next->below);
        return fracas_lines_refuse(
            lines, found,
            "the probability 0: the table begins with the strength that nothing is below");
    }
    if (k == 0) return FRACAS_OK;
    if (isnan(table->below[k - 1]) != !is_pair)
        return fracas_lines_refuse(lines, is_pair ? "two numbers" : "one number",
                                   "as many as on the lines before");
    if (!is_pair || (next->strength > table->strength[k - 1] && next->below >= table->below[k - 1]))
        return FRACAS_OK;
    const bool weaker = !(next->strength > table->strength[k - 1]);
    snprintf(found, sizeof found, "%.15g", weaker ? next->strength : next->below);
    return fracas_lines_refuse(lines, found,
                               weaker ? "a strength above that of the line before"
                                      : "a probability not below that of the line before");
}

FRACAS_MUST_USE static fracas_err read_rows(const fracas_strength *strength,
                                            struct fracas_table *table)
{
    fracas_lines lines = fracas_lines_begin(strength->file);
    row next;
    for (bool found;; table->n++) {
        TRY(next_row(&lines, &next, &found));
        if (!found) break;
        TRY(check_row(strength, table, &lines, &next));
        table->strength[table->n] = next.strength;
        table->below[table->n] = next.below;
    }
    if (table->n == 0)
        return fracas_fail(FRACAS_USAGE, "%s has no strength; expected one in Pa on each line",
                           strength->file->path);
    const double last = table->below[table->n - 1];
    if (isnan(last)) return spread(strength, table);
    if (last == 1.0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s ends with the probability %.15g; expected 1 on the last line: the table "
                       "ends with the strength that nothing is above",
                       strength->file->path, last);
}

static void empirical_clear(fracas_strength *strength)
{
    if (!strength->table) return;
    free(strength->table->strength);
    free(strength->table->below);
    free(strength->table);
    strength->table = NULL;
}

FRACAS_MUST_USE static fracas_err empirical_init(fracas_strength *strength)
{
    size_t most = 1; /* lines */
    for (size_t c = 0; c < strength->file->size; c++) most += strength->file->text[c] == '\n';
    struct fracas_table *table = strength->table = calloc(1, sizeof *table);
    if (table) table->strength = malloc(most * sizeof *table->strength);
    if (table) table->below = malloc(most * sizeof *table->below);
    fracas_err err = table && table->strength && table->below
                         ? read_rows(strength, table)
                         : fracas_no_memory("the strengths of a file");
    if (err) empirical_clear(strength);
    return err;
}

/* ---- the distribution ---- */

/* (distributions.17) From the nearer end, which keeps both tails exact. */
static double empirical_quantile(const fracas_strength *strength, fracas_extent extent,
                                 fracas_probability p)
{
    (void)extent;
    const struct fracas_table *table = strength->table;
    const double *x = table->strength, *f = table->below;
    size_t before = 0, after = table->n - 1; /* the first `after` with p <= f[after] */
    if (p.below <= f[0]) return x[0];
    while (after - before > 1) {
        const size_t middle = before + (after - before) / 2;
        const bool within = p.below <= 0.5 ? p.below <= f[middle] : p.above >= 1.0 - f[middle];
        if (within) after = middle;
        else before = middle;
    }
    if (strength->interpolation == &steps) return x[after];
    const double width = f[after] - f[before], range = x[after] - x[before];
    if (p.below <= 0.5) return x[before] + range * ((p.below - f[before]) / width);
    return x[after] - range * ((p.above - (1.0 - f[after])) / width);
}

/* (1 - x)^power, 0 <= x <= 1 and power > 0: a body of many specimens raises the rounding error of 1
 * - x to a high power. */
static double survival(double x, double power)
{
    return x < 1.0 ? fracas_exp(power * fracas_log1p(-x)) : 0.0;
}

/* (distributions.18) Integrals over y in [0, 1] of (1 - delta y)^power and y (1 - delta y)^power;
 * delta from 0 to 1. */
static void decay(double delta, double power, double *plain, double *first)
{
    if (delta * fmax(power, 1.0) >= 0.5) {
        const double end = survival(delta, power + 1.0);
        *plain = (1.0 - end) / ((power + 1.0) * delta);
        *first = ((1.0 - end * (1.0 - delta)) / ((power + 2.0) * delta) - end) /
                 ((power + 1.0) * delta);
        return;
    }
    double term = 1.0;
    *plain = 1.0;
    *first = 0.5;
    for (double j = 1.0; j < 60.0; j += 1.0) {
        term *= -delta * (power - j + 1.0) / j;
        *plain += term / (j + 1.0);
        *first += term / (j + 2.0);
    }
}

/* (distributions.18) mean = x_1 + sum of range integral S^size, variance = (x_1 - mean)^2 + 2 sum
 * of integral (s - mean) S^size ds. */
static fracas_moments linear_moments(const struct fracas_table *table, double size)
{
    const double *x = table->strength;
    double mean = x[0], variance = 0.0;
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1) variance = (x[0] - mean) * (x[0] - mean);
        double rise = 0.0;
        for (size_t k = 1; k < table->n; k++) {
            const double survive = 1.0 - table->below[k - 1], range = x[k] - x[k - 1];
            if (!(survive > 0.0)) break;
            double plain, first;
            decay((table->below[k] - table->below[k - 1]) / survive, size, &plain, &first);
            const double weight = range * survival(table->below[k - 1], size);
            if (pass == 0) rise += weight * plain;
            else variance += 2.0 * weight * ((x[k - 1] - mean) * plain + range * first);
        }
        if (pass == 0) mean += rise;
    }
    return (fracas_moments){mean, sqrt(fmax(variance, 0.0))};
}

/* (distributions.19) */
static fracas_moments steps_moments(const struct fracas_table *table, double size)
{
    double mean = 0.0, variance = 0.0;
    for (int pass = 0; pass < 2; pass++) {
        double before = 1.0;
        for (size_t k = 0; k < table->n; k++) {
            const double after = survival(table->below[k], size), x = table->strength[k];
            if (pass == 0) mean += (before - after) * x;
            else variance += (before - after) * (x - mean) * (x - mean);
            before = after;
        }
    }
    return (fracas_moments){mean, sqrt(variance)};
}

static fracas_moments empirical_weakest(const fracas_strength *strength, double size)
{
    return strength->interpolation == &steps ? steps_moments(strength->table, size)
                                             : linear_moments(strength->table, size);
}

static fracas_moments empirical_moments(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    return empirical_weakest(strength, 1.0);
}

static const fracas_param params[] = {
    FRACAS_STRENGTH_FILE(
        "text with one number a line, measured strengths in Pa in any order, or two, a "
        "strength in Pa and the probability of strengths up to it; headings in the first line, "
        "empty lines and lines that start with # are skipped"),
    {
        FRACAS_ONE_OF("interpolation", interpolations, offsetof(fracas_strength, interpolation),
                      "what lies between two strengths of the file"),
    },
};
const fracas_distribution fracas_empirical = {
    .kind = {.name = "empirical",
             .doc = "drawn from measured strengths, or from a table of their distribution function",
             FRACAS_PARAMS(params)},
    .quantile = empirical_quantile,
    .moments = empirical_moments,
    .init = empirical_init,
    .clear = empirical_clear,
    .takes_reference = true,
    .weakest = empirical_weakest,
};
