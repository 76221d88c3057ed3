/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/compare/compare.h"

#include "analysis/summary/study.h"
#include "analysis/export/tables.h"
#include "analysis/data/format.h"
#include "base/json.h"
#include "base/sheet.h"
#include "base/text.h"

#include <inttypes.h>
#include <math.h>
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

static void paint_value(const fracas_compared_value *value, const fracas_number *quantity,
                        fracas_result_table *table, size_t row)
{
    char *cell[NCOLUMNS], unit[32] = "";
    const double means[] = {fabs(value->a.mean), fabs(value->b.mean)};
    const fracas_prefix prefix = fracas_prefix_in(quantity->unit, means, 2);
    for (size_t c = 0; c < NCOLUMNS; c++) cell[c] = fracas_result_table_cell(table, row, c);
    if (strcmp(quantity->unit, "1")) FRACAS_PRINT(unit, "%s%s", prefix.symbol, quantity->unit);
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

static void print_head(const fracas_compared_point *point, int columns, FILE *out)
{
    char text[640];
    FRACAS_PRINT(text,
                 "%s%spoint %zu of A and %zu of B, %" PRId64 " and %" PRId64
                 " realizations%s%s; p from %s%" PRId64 " assignments",
                 point->label.text, *point->label.text ? ": " : "", point->a, point->b,
                 point->used_a, point->used_b, point->paired ? ", paired by replica" : "",
                 point->used_a && point->used_b ? "" : " (no test)", point->exact ? "all " : "",
                 point->permutations);
    putc('\n', out);
    fracas_text_wrap(text, 0, columns, out);
    if (*point->differs) fprintf(out, "  they differ in %s\n", point->differs);
}

static fracas_err print_point(const fracas_compared_point *point, int columns, FILE *out)
{
    static const char *const name[NCOLUMNS] = {"", "A", "B", "B - A", "relative", "p", "p (Holm)"};
    fracas_result_table table;
    size_t rows = FRACAS_RESULT_TABLE_HEAD;
    TRY(fracas_table_empty(FRACAS_COMPARED_VALUES + 1, NCOLUMNS, name, &table));
    for (size_t v = 0; v < FRACAS_COMPARED_VALUES; v++) {
        const fracas_compared_value *value = &point->value[v];
        const bool nothing = value->a.n == 0 && value->b.n == 0,
                   zero = value->a.mean == 0 && value->b.mean == 0 && value->difference == 0;
        if (!nothing && !zero) paint_value(value, &fracas_realization_numbers[v], &table, rows++);
    }
    snprintf(fracas_result_table_cell(&table, rows, WHAT), FRACAS_CELL, "distribution of sizes");
    fracas_format_digits(point->distance, 2, fracas_result_table_cell(&table, rows, DIFFERENCE),
                         FRACAS_CELL);
    format_p(point->p, fracas_result_table_cell(&table, rows, P));
    format_p(point->p_holm, fracas_result_table_cell(&table, rows, P_HOLM));
    print_head(point, columns, out);
    table.rows = rows + 1;
    fracas_table_print(&table, "  ", 1U << WHAT, false, columns, out);
    fracas_result_table_clear(&table);
    return FRACAS_OK;
}

static void print_alone(const char *which, const fracas_analysis *analysis, const size_t *point,
                        size_t count, FILE *out)
{
    for (size_t i = 0; i < count; i++) {
        const fracas_label label = fracas_analysis_label(analysis, point[i]);
        fprintf(out, "only in %s: point %zu%s%s%s\n", which, point[i], *label.text ? " (" : "",
                label.text, *label.text ? ")" : "");
    }
}

fracas_err fracas_comparison_print(const fracas_comparison *comparison, const fracas_analysis *a,
                                   const fracas_analysis *b, int columns, FILE *out)
{
    static const char *const legend[] = {
        "After the means and the differences: half widths of their 95 % intervals (Student's t; "
        "of the difference Welch's, or of the paired",
        "differences). p: by permutation of whole realizations, of pairs by exchange within "
        "them; Holm: corrected over the points, each number",
        "by itself. distribution of sizes: largest difference of the distribution functions of "
        "all fragments.",
        NULL};
    if (comparison->listed) fprintf(out, "A and B: points %s of %s\n", comparison->how, a->name);
    else
        fprintf(out, "A: %s, %zu points; B: %s, %zu points; %zu in both, matched by %s\n", a->name,
                a->table->npoints, b->name, b->table->npoints, comparison->npoints,
                *comparison->how ? comparison->how : "all their parameters");
    for (size_t i = 0; i < comparison->npoints; i++)
        TRY(print_point(&comparison->point[i], columns, out));
    putc('\n', out);
    print_alone("A", a, comparison->only_a, comparison->nonly_a, out);
    print_alone("B", b, comparison->only_b, comparison->nonly_b, out);
    if (comparison->npoints == 0)
        fputs("no point of A is one of B: name by --by the columns to match by, as --by "
              "derived.strain_rate\n",
              out);
    else fracas_sheet_legend(legend, columns, out);
    if (strcmp(a->header.version, b->header.version))
        fprintf(out, "A is by fracas %s, B by fracas %s\n", a->header.version, b->header.version);
    return FRACAS_OK;
}

/* ---- JSON ---- */

#define NUMBER(key, doc) FRACAS_FIELD(fracas_compared_value, NUMBER, #key, "", doc, key)
static const fracas_field value_field[] = {
    {"a", FRACAS_FIELD_OBJECT, "", "number in A", offsetof(fracas_compared_value, a),
     &fracas_estimate_fields},
    {"b", FRACAS_FIELD_OBJECT, "", "number in B", offsetof(fracas_compared_value, b),
     &fracas_estimate_fields},
    NUMBER(difference, "mean of B - mean of A"),
    NUMBER(low, "lower end of the 95 % interval of the difference"),
    NUMBER(high, "upper end of the 95 % interval of the difference"),
    NUMBER(relative, "difference / mean of A"),
    NUMBER(relative_low, "lower end of its 95 % interval"),
    NUMBER(relative_high, "upper end of its 95 % interval"),
    NUMBER(freedom, "degrees of freedom of both intervals"),
    NUMBER(p, "by permutation"),
    NUMBER(p_holm, "p corrected over the points"),
};
static const fracas_fields value_fields = FRACAS_FIELDS(value_field);
#undef NUMBER

#define POINT(key, type, doc, member) \
    FRACAS_FIELD(fracas_compared_point, type, key, "", doc, member)
static const fracas_field point_field[] = {
    POINT("point_a", INDEX, "number of the point in A", a),
    POINT("point_b", INDEX, "number of the point in B", b),
    POINT("label", CHARS, "the point by what it differs in", label),
    POINT("differs", REASON, "other parameters in which both differ", differs),
    POINT("paired", BOOLEAN, "realizations have the same random numbers", paired),
    POINT("realizations_a", INTEGER, "realizations compared", used_a),
    POINT("realizations_b", INTEGER, "realizations compared", used_b),
    POINT("assignments", INTEGER, "permutations, the observed one among them", permutations),
    POINT("exact", BOOLEAN, "these are all permutations", exact),
};
static const fracas_field distribution_field[] = {
    POINT("distance", NUMBER, "largest difference of the distribution functions", distance),
    POINT("p", NUMBER, "by permutation", p),
    POINT("p_holm", NUMBER, "p corrected over the points", p_holm),
};
static const fracas_fields point_fields = FRACAS_FIELDS(point_field),
                           distribution_fields = FRACAS_FIELDS(distribution_field);

static void write_point(fracas_json *json, const fracas_compared_point *point)
{
    fracas_json_object(json, NULL);
    fracas_fields_json(json, &point_fields, point);
    fracas_json_object(json, "values");
    for (size_t v = 0; v < FRACAS_COMPARED_VALUES; v++) {
        if (point->value[v].a.n == 0 && point->value[v].b.n == 0) continue;
        fracas_json_object(json, fracas_realization_numbers[v].key);
        fracas_json_text(json, "unit", fracas_realization_numbers[v].unit);
        fracas_fields_json(json, &value_fields, &point->value[v]);
        fracas_json_close(json);
    }
    fracas_json_close(json);
    fracas_fields_json_object(json, "size_distribution", &distribution_fields, point);
    fracas_json_close(json);
}

static void write_study(fracas_json *json, const char *key, const fracas_analysis *analysis,
                        const size_t *only, size_t count)
{
    char seed[24];
    FRACAS_PRINT(seed, "%" PRIu64, analysis->header.seed);
    fracas_json_object(json, key);
    fracas_json_text(json, "name", analysis->name);
    fracas_json_text(json, "campaign", fracas_hash_hex(&analysis->header.campaign).text);
    fracas_json_text(json, "seed", seed);
    fracas_json_text(json, "version", analysis->header.version);
    fracas_json_array(json, "unmatched");
    for (size_t i = 0; i < count; i++) fracas_json_integer(json, NULL, (int64_t)only[i]);
    fracas_json_close(json);
    fracas_json_close(json);
}

void fracas_comparison_write_json(const fracas_comparison *comparison, const fracas_analysis *a,
                                  const fracas_analysis *b, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    write_study(&json, "a", a, comparison->only_a, comparison->nonly_a);
    write_study(&json, "b", b, comparison->only_b, comparison->nonly_b);
    fracas_json_text(&json, "matched_by",
                     *comparison->how && !comparison->listed ? comparison->how : NULL);
    if (comparison->listed) fracas_json_text(&json, "listed", comparison->how);
    fracas_json_array(&json, "points");
    for (size_t i = 0; i < comparison->npoints; i++) write_point(&json, &comparison->point[i]);
    fracas_json_end(&json);
}
