/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A comparison as people and programs read it. */
#include "analysis/compare/compare.h"

#include "analysis/summary/study.h"
#include "analysis/export/table.h"
#include "analysis/data/format.h"
#include "base/json.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- for a terminal ---- */

enum { WHAT, MEAN_A, MEAN_B, DIFFERENCE, RELATIVE, P, P_HOLM, NCOLUMNS };

/* "4e-4", "0.34": more digits would claim more than 9999 permutations know. */
static void format_p(double p, char *text)
{
    if (p > 0 && p < 0.01) fracas_format_digits(p, 1, text, FRACAS_CELL);
    else fracas_format_digits(p, 2, text, FRACAS_CELL);
}

static void format_difference(double value, double low, double high, double factor,
                              const char *unit, char *text)
{
    const fracas_estimate estimate = {.n = 2, .mean = value, .half_width = (high - low) / 2};
    char number[FRACAS_CELL];
    fracas_format_estimate(&estimate, factor, "+-", number, sizeof number);
    snprintf(text, FRACAS_CELL, "%.100s%s%s", number, strcmp(number, "-") && *unit ? " " : "",
             strcmp(number, "-") ? unit : "");
}

static void paint_value(const fracas_compared_value *value,
                        const fracas_compared_quantity *quantity, fracas_result_table *table,
                        size_t row)
{
    char *cell[NCOLUMNS], unit[32] = "";
    const double means[] = {fabs(value->a.mean), fabs(value->b.mean)};
    fracas_prefix prefix = {1, "", ""};
    for (size_t c = 0; c < NCOLUMNS; c++) cell[c] = fracas_result_table_cell(table, row, c);
    if (strcmp(quantity->unit, "1")) {
        prefix = fracas_prefix_for(means, 2);
        snprintf(unit, sizeof unit, "%s%s", prefix.symbol, quantity->unit);
    }
    snprintf(cell[WHAT], FRACAS_CELL, "%s%s%s%s", quantity->key, *unit ? " [" : "", unit,
             *unit ? "]" : "");
    fracas_format_estimate(&value->a, prefix.factor, "+-", cell[MEAN_A], FRACAS_CELL);
    fracas_format_estimate(&value->b, prefix.factor, "+-", cell[MEAN_B], FRACAS_CELL);
    format_difference(value->difference, value->low, value->high, prefix.factor, "",
                      cell[DIFFERENCE]);
    format_difference(value->relative, value->relative_low, value->relative_high, 100, "%",
                      cell[RELATIVE]);
    format_p(value->p, cell[P]);
    format_p(value->p_holm, cell[P_HOLM]);
}

static void print_head(const fracas_compared_point *point, FILE *out)
{
    fprintf(out,
            "\n%s%spoint %zu of A and %zu of B, %" PRId64 " and %" PRId64
            " realizations%s%s; p from %s%" PRId64 " assignments\n",
            point->label, *point->label ? ": " : "", point->a, point->b, point->used_a,
            point->used_b, point->paired ? ", paired by replica" : "",
            point->used_a && point->used_b ? "" : " (no test)", point->exact ? "all " : "",
            point->permutations);
    if (*point->differs) fprintf(out, "  they differ in %s\n", point->differs);
}

static fracas_err print_point(const fracas_compared_point *point, FILE *out)
{
    static const char *const name[NCOLUMNS] = {"", "A", "B", "B - A", "relative", "p", "p (Holm)"};
    fracas_result_table table;
    size_t rows = FRACAS_RESULT_TABLE_HEAD;
    TRY(fracas_table_empty(FRACAS_COMPARED_VALUES + 1, NCOLUMNS, name, &table));
    for (size_t v = 0; v < FRACAS_COMPARED_VALUES; v++) {
        const fracas_compared_value *value = &point->value[v];
        const bool nothing = value->a.n == 0 && value->b.n == 0,
                   zero = value->a.mean == 0 && value->b.mean == 0 && value->difference == 0;
        if (!nothing && !zero) paint_value(value, &fracas_compared_quantities[v], &table, rows++);
    }
    snprintf(fracas_result_table_cell(&table, rows, WHAT), FRACAS_CELL, "distribution of sizes");
    fracas_format_digits(point->distance, 2, fracas_result_table_cell(&table, rows, DIFFERENCE),
                         FRACAS_CELL);
    format_p(point->p, fracas_result_table_cell(&table, rows, P));
    format_p(point->p_holm, fracas_result_table_cell(&table, rows, P_HOLM));
    print_head(point, out);
    table.rows = rows + 1;
    fracas_table_print(&table, "  ", 1U << WHAT, false, out);
    fracas_result_table_clear(&table);
    return FRACAS_OK;
}

static void print_alone(const char *which, const fracas_analysis *analysis, const size_t *point,
                        size_t count, FILE *out)
{
    for (size_t i = 0; i < count; i++) {
        char label[256];
        fracas_analysis_label(analysis, point[i], label, sizeof label);
        fprintf(out, "only in %s: point %zu%s%s%s\n", which, point[i], *label ? " (" : "", label,
                *label ? ")" : "");
    }
}

fracas_err fracas_comparison_print(const fracas_comparison *comparison, const fracas_analysis *a,
                                   const fracas_analysis *b, FILE *out)
{
    fprintf(out, "A: %s, %zu points; B: %s, %zu points; %zu in both, matched by %s\n", a->name,
            a->table->npoints, b->name, b->table->npoints, comparison->npoints,
            *comparison->how ? comparison->how : "all their parameters");
    for (size_t i = 0; i < comparison->npoints; i++) TRY(print_point(&comparison->point[i], out));
    putc('\n', out);
    print_alone("A", a, comparison->only_a, comparison->nonly_a, out);
    print_alone("B", b, comparison->only_b, comparison->nonly_b, out);
    if (comparison->npoints == 0)
        fputs("no point of A is one of B: name by --by the columns to match by, as --by "
              "derived.strain_rate\n",
              out);
    else
        fputs("After the means and the differences: half widths of their 95 % intervals (Student's "
              "t; of the difference Welch's, or of the paired\n"
              "differences). p: by permutation of whole realizations, of pairs by exchange within "
              "them; Holm: corrected over the points, each number\n"
              "by itself. distribution of sizes: largest difference of the distribution functions "
              "of all fragments.\n",
              out);
    if (strcmp(a->header.version, b->header.version))
        fprintf(out, "A is by fracas %s, B by fracas %s\n", a->header.version, b->header.version);
    return FRACAS_OK;
}

/* ---- JSON ---- */

static void write_estimate(fracas_json *json, const char *key, const fracas_estimate *estimate)
{
    fracas_json_object(json, key);
    fracas_json_integer(json, "n", estimate->n);
    fracas_json_real(json, "mean", estimate->mean);
    fracas_json_real(json, "deviation", estimate->deviation);
    fracas_json_real(json, "half_width", estimate->half_width);
    fracas_json_close_object(json);
}

static void write_value(fracas_json *json, const fracas_compared_value *value,
                        const fracas_compared_quantity *quantity)
{
    fracas_json_object(json, quantity->key);
    fracas_json_text(json, "unit", quantity->unit);
    write_estimate(json, "a", &value->a);
    write_estimate(json, "b", &value->b);
    fracas_json_real(json, "difference", value->difference);
    fracas_json_real(json, "low", value->low);
    fracas_json_real(json, "high", value->high);
    fracas_json_real(json, "relative", value->relative);
    fracas_json_real(json, "relative_low", value->relative_low);
    fracas_json_real(json, "relative_high", value->relative_high);
    fracas_json_real(json, "freedom", value->freedom);
    fracas_json_real(json, "p", value->p);
    fracas_json_real(json, "p_holm", value->p_holm);
    fracas_json_close_object(json);
}

static void write_point(fracas_json *json, const fracas_compared_point *point)
{
    fracas_json_object(json, NULL);
    fracas_json_integer(json, "point_a", (int64_t)point->a);
    fracas_json_integer(json, "point_b", (int64_t)point->b);
    fracas_json_text(json, "label", point->label);
    fracas_json_text(json, "differs", *point->differs ? point->differs : NULL);
    fracas_json_boolean(json, "paired", point->paired);
    fracas_json_integer(json, "realizations_a", point->used_a);
    fracas_json_integer(json, "realizations_b", point->used_b);
    fracas_json_integer(json, "assignments", point->permutations);
    fracas_json_boolean(json, "exact", point->exact);
    fracas_json_object(json, "values");
    for (size_t v = 0; v < FRACAS_COMPARED_VALUES; v++)
        if (point->value[v].a.n > 0 || point->value[v].b.n > 0)
            write_value(json, &point->value[v], &fracas_compared_quantities[v]);
    fracas_json_close_object(json);
    fracas_json_object(json, "size_distribution");
    fracas_json_real(json, "distance", point->distance);
    fracas_json_real(json, "p", point->p);
    fracas_json_real(json, "p_holm", point->p_holm);
    fracas_json_close_object(json);
    fracas_json_close_object(json);
}

static void write_study(fracas_json *json, const char *key, const fracas_analysis *analysis,
                        const size_t *only, size_t count)
{
    char hash[FRACAS_HASH_HEX], seed[24];
    fracas_hash_hex(&analysis->header.campaign, hash);
    snprintf(seed, sizeof seed, "%" PRIu64, analysis->header.seed);
    fracas_json_object(json, key);
    fracas_json_text(json, "name", analysis->name);
    fracas_json_text(json, "campaign", hash);
    fracas_json_text(json, "seed", seed);
    fracas_json_text(json, "version", analysis->header.version);
    fracas_json_array(json, "unmatched");
    for (size_t i = 0; i < count; i++) fracas_json_integer(json, NULL, (int64_t)only[i]);
    fracas_json_close_array(json);
    fracas_json_close_object(json);
}

void fracas_comparison_write_json(const fracas_comparison *comparison, const fracas_analysis *a,
                                  const fracas_analysis *b, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_object(&json, NULL);
    write_study(&json, "a", a, comparison->only_a, comparison->nonly_a);
    write_study(&json, "b", b, comparison->only_b, comparison->nonly_b);
    fracas_json_text(&json, "matched_by", *comparison->how ? comparison->how : NULL);
    fracas_json_array(&json, "points");
    for (size_t i = 0; i < comparison->npoints; i++) write_point(&json, &comparison->point[i]);
    fracas_json_close_array(&json);
    fracas_json_close_object(&json);
    fracas_json_end(&json);
}
