/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A convergence as text, JSON and CSV. */
#include "analysis/converge/rows.h"
#include "analysis/data/field.h"
#include "analysis/data/format.h"
#include "analysis/data/output.h"
#include "analysis/export/tables.h"
#include "base/file.h"
#include "base/json.h"
#include "base/own.h"
#include "base/sheet.h"
#include "base/text.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { NCOLUMNS = 8, KEYS = 3 };

/* "mesh, radial 12 m/s: 7 of 10 realizations ..." */
static void note_line(const fracas_convergence *convergence, const fracas_convergence_note *note,
                      char *text, size_t size)
{
    const fracas_label label = fracas_analysis_label(convergence->study, note->point);
    snprintf(text, size, "%s%s%s: %s", note->refinement, *label.text ? ", " : "", label.text,
             note->text);
}

/* One prefix for all values of a number. */
static fracas_prefix prefix_of(const fracas_convergence *convergence, const fracas_number *number)
{
    double ends[2] = {INFINITY, 0};
    for (size_t i = 0; i < convergence->nrows; i++) {
        const fracas_convergence_row *row = &convergence->row[i];
        if (row->number != number || !(row->value.a.mean > 0)) continue;
        ends[0] = fmin(ends[0], row->value.a.mean);
        ends[1] = fmax(ends[1], row->value.a.mean);
    }
    return fracas_prefix_in(number->unit, ends, 2);
}

/* "+0.8 +- 2.0": in per cent of the number as it is. Round-off has no digits worth a reader's time.
 */
static void format_change(const fracas_compared_value *value, const char *sign, char *text,
                          size_t size)
{
    const fracas_estimate change = {
        .n = value->a.n,
        .mean = 100 * value->relative,
        .half_width = 50 * (value->relative_high - value->relative_low)};
    char plain[FRACAS_CELL - 1];
    if (fabs(change.mean) + change.half_width < 1e-3) {
        snprintf(text, size, change.mean == 0 && change.half_width == 0 ? "0" : "below 0.001");
        return;
    }
    fracas_format_estimate(&change, 1, sign, plain, sizeof plain);
    snprintf(text, size, "%s%s", change.mean > 0 ? "+" : "", plain);
}

static void fill_row(const fracas_convergence *convergence, size_t i, bool unicode,
                     const fracas_result_table *table)
{
    const fracas_convergence_row *row = &convergence->row[i];
    const fracas_compared_value *value = &row->value;
    const fracas_prefix prefix = prefix_of(convergence, row->number);
    const bool pure = !strcmp(row->number->unit, "1");
    const char *sign = unicode ? "\u00b1" : "+-";
    char *cell[NCOLUMNS];
    for (size_t c = 0; c < NCOLUMNS; c++)
        cell[c] = fracas_result_table_cell(table, FRACAS_RESULT_TABLE_HEAD + i, c);
    snprintf(cell[0], FRACAS_CELL, "%s", row->refinement);
    fracas_cell_label(convergence->study, row->point, NULL, cell[1]);
    if (pure) snprintf(cell[2], FRACAS_CELL, "%s", row->number->key);
    else
        snprintf(cell[2], FRACAS_CELL, "%s [%s%s]", row->number->key,
                 unicode ? prefix.sign : prefix.symbol, row->number->unit);
    fracas_format_estimate(&value->a, prefix.factor, sign, cell[3], FRACAS_CELL);
    fracas_format_estimate(&value->b, prefix.factor, sign, cell[4], FRACAS_CELL);
    format_change(value, sign, cell[5], FRACAS_CELL);
    fracas_format_digits(value->difference / value->a.half_width, 2, cell[6], FRACAS_CELL);
    snprintf(cell[7], FRACAS_CELL, "%s", fracas_number_verdict_name[row->verdict]);
}

fracas_err fracas_convergence_table_create(const fracas_convergence *convergence, bool unicode,
                                           fracas_result_table *table)
{
    static const char *const head[NCOLUMNS] = {"",        "point",      "number",      "as it is",
                                               "refined", "change [%]", "half widths", ""};
    TRY(fracas_table_empty(convergence->nrows, NCOLUMNS, head, table));
    for (size_t i = 0; i < convergence->nrows; i++) fill_row(convergence, i, unicode, table);
    return FRACAS_OK;
}

/* ---- text ---- */

/* "mesh: of 8 numbers 2 moved, ..." */
static void format_counts(const fracas_convergence *convergence, const char *refinement, char *text,
                          size_t size)
{
    size_t all = 0, of[FRACAS_NUMBER_VERDICTS] = {0};
    for (size_t i = 0; i < convergence->nrows; i++) {
        if (strcmp(convergence->row[i].refinement, refinement) != 0) continue;
        all++;
        of[convergence->row[i].verdict]++;
    }
    const int used = snprintf(
        text, size,
        "%s: of %zu numbers %zu moved, %zu shifted and %zu hold within %g %%, %zu unclear",
        refinement, all, of[FRACAS_NUMBER_MOVED], of[FRACAS_NUMBER_SHIFTED],
        of[FRACAS_NUMBER_HOLDS], 100 * convergence->tolerance, of[FRACAS_NUMBER_UNCLEAR]);
    if (of[FRACAS_NUMBER_UNKNOWN] && used < (int)size)
        snprintf(text + used, size - (size_t)used,
                 ", %zu without an interval (fewer than two usable realizations)",
                 of[FRACAS_NUMBER_UNKNOWN]);
}

/* Number of replicas that would decide the unclear numbers, from those whose change is known to 50
 * % by now. For the others a forecast would be a guess. */
static void conclude_replicas(const fracas_convergence *convergence, fracas_convergence_line *line,
                              void *context)
{
    const double known = 0.5;
    double replicas = 0;
    size_t unclear = 0, vague = 0;
    char text[320], others[128] = "";
    for (size_t i = 0; i < convergence->nrows; i++) {
        const fracas_convergence_row *row = &convergence->row[i];
        if (row->verdict != FRACAS_NUMBER_UNCLEAR) continue;
        const double reach = 0.5 * (row->value.relative_high - row->value.relative_low);
        unclear++;
        if (reach <= known)
            replicas = fmax(replicas, fracas_convergence_replicas(convergence, row));
        else vague++; /* or in parts of 0 */
    }
    if (unclear == 0) return;
    const double digits = pow(10, fmax(0, floor(log10(fmax(1, replicas))) - 1)); /* two */
    replicas = ceil(replicas / digits) * digits;
    if (vague > 0)
        FRACAS_PRINT(
            others, "%zu of the %zu unclear changes %s known no better than to 50 %% of the number",
            vague, unclear, vague == 1 ? "is" : "are");
    if (vague == unclear)
        FRACAS_PRINT(
            text, "No change that is unclear is known better than to 50 %% of the number: how many "
                  "replicas would tell cannot be said.");
    else if (vague > 0)
        FRACAS_PRINT(text,
                     "About %.0f replicas of each point would tell of %zu that are unclear; %s.",
                     replicas, unclear - vague, others);
    else
        FRACAS_PRINT(text, "About %.0f replicas of each point would tell of all that are unclear.",
                     replicas);
    line(context, text);
}

void fracas_convergence_conclude(const fracas_convergence *convergence,
                                 fracas_convergence_line *line, void *context)
{
    char text[800];
    for (size_t l = 0; l < convergence->nlevels; l++) {
        format_counts(convergence, convergence->level[l], text, sizeof text);
        line(context, text);
    }
    for (size_t i = 0; i < convergence->nleft; i++) {
        FRACAS_PRINT(text, "%s: %zu point%s left out: %s", convergence->left[i].refinement,
                     convergence->left[i].points, convergence->left[i].points == 1 ? "" : "s",
                     convergence->left[i].why);
        line(context, text);
    }
    for (size_t i = 0; i < convergence->nnotes; i++) {
        int used = FRACAS_PRINT(text, "warning: ");
        note_line(convergence, &convergence->note[i], text + used, sizeof text - (size_t)used);
        line(context, text);
    }
    conclude_replicas(convergence, line, context);
}

typedef struct {
    FILE *out;
    int columns;
} printing;

static void print_line(void *context, const char *text)
{
    const printing *to = context;
    fracas_text_wrap(text, 0, to->columns, to->out);
}

fracas_err fracas_convergence_print(const fracas_convergence *convergence, int columns, FILE *out)
{
    fracas_result_table table = {0};
    printing to = {out, columns};
    char second[192], third[128];
    const char *const legend[] = {
        "change: of the mean, with the half width of its 95 % interval: of pairs with the same "
        "strengths but for mesh, there by",
        second, third, NULL};
    FRACAS_PRINT(second,
                 "Welch; half widths: in those of the number as it is. moved: Holm's p among all "
                 "%zu numbers is below 0.05, and the interval is",
                 convergence->nrows);
    FRACAS_PRINT(third,
                 "not within %g %%; shifted: it is; holds: it is, and p is not; unclear: neither.",
                 100 * convergence->tolerance);
    TRY(fracas_convergence_table_create(convergence, false, &table));
    table.keys = KEYS;
    fracas_table_print(&table, "", 0x87, false, columns, out); /* words to the left */
    fracas_result_table_clear(&table);
    putc('\n', out);
    fracas_sheet_legend(legend, columns, out);
    putc('\n', out);
    fracas_convergence_conclude(convergence, print_line, &to);
    if (!ferror(out)) return FRACAS_OK;
    return fracas_fail_system(errno, "cannot write the table");
}

/* ---- JSON and CSV ---- */

typedef struct {
    const char *refinement;
    size_t point;
    char hash[FRACAS_HASH_HEX];
    fracas_label label;
    const char *number, *unit, *method, *verdict;
    fracas_compared_value value;
    double half_widths;
} printed;

static printed print_of(const fracas_convergence *convergence, const fracas_convergence_row *row)
{
    printed to = {.refinement = row->refinement,
                  .point = row->point,
                  .label = fracas_analysis_label(convergence->study, row->point),
                  .number = row->number->key,
                  .unit = row->number->unit,
                  .method = row->paired ? "pairs" : "welch",
                  .verdict = fracas_number_verdict_name[row->verdict],
                  .value = row->value,
                  .half_widths = row->value.difference / row->value.a.half_width};
    memcpy(to.hash, fracas_hash_hex(&convergence->study->table->point[row->point].hash).text,
           FRACAS_HASH_HEX);
    return to;
}

static const fracas_field mean_field[] = {
    FRACAS_FIELD(fracas_estimate, INTEGER, "n", "1", "%s", n),
    FRACAS_FIELD(fracas_estimate, NUMBER, "mean", NULL, "%s", mean),
    FRACAS_FIELD(fracas_estimate, NUMBER, "half_width", NULL, "%s", half_width),
};
static const fracas_fields mean_fields = FRACAS_FIELDS(mean_field);

#define FIELD(key, type, member) FRACAS_FIELD(printed, type, key, "", "", member)
#define NUMBER(key) FIELD(#key, NUMBER, value.key)
static const fracas_field place_field[] = {
    FIELD("refinement", TEXT, refinement),
    FIELD("point", INDEX, point),
    FIELD("hash", CHARS, hash),
};
static const fracas_field label_field[] = {FIELD("label", CHARS, label)}; /* not in CSV */
static const fracas_field change_field[] = {
    FIELD("number", TEXT, number),
    FIELD("unit", TEXT, unit),
    {"base", FRACAS_FIELD_OBJECT, "", "", offsetof(printed, value.a), &mean_fields},
    {"refined", FRACAS_FIELD_OBJECT, "", "", offsetof(printed, value.b), &mean_fields},
    NUMBER(difference),
    NUMBER(low),
    NUMBER(high),
    NUMBER(relative),
    NUMBER(relative_low),
    NUMBER(relative_high),
    NUMBER(p),
    NUMBER(p_holm),
    FIELD("half_widths", NUMBER, half_widths),
    FIELD("method", TEXT, method),
    FIELD("verdict", TEXT, verdict),
};
#define TABLE "converge.csv"

static const fracas_fields place_fields = FRACAS_FIELDS(place_field),
                           label_fields = FRACAS_FIELDS(label_field),
                           change_fields = FRACAS_FIELDS(change_field);

static size_t count_of(const fracas_convergence *convergence, fracas_number_verdict verdict)
{
    size_t count = 0;
    for (size_t i = 0; i < convergence->nrows; i++) count += convergence->row[i].verdict == verdict;
    return count;
}

static void write_left(const fracas_convergence *convergence, fracas_json *json)
{
    fracas_json_array(json, "left_out");
    for (size_t i = 0; i < convergence->nleft; i++) {
        fracas_json_object(json, NULL);
        fracas_json_text(json, "refinement", convergence->left[i].refinement);
        fracas_json_integer(json, "points", (int64_t)convergence->left[i].points);
        fracas_json_text(json, "why", convergence->left[i].why);
        fracas_json_close(json);
    }
    fracas_json_close(json);
}

static void write_notes(const fracas_convergence *convergence, fracas_json *json)
{
    char text[800];
    fracas_json_array(json, "warnings");
    for (size_t i = 0; i < convergence->nnotes; i++) {
        const fracas_convergence_note *note = &convergence->note[i];
        note_line(convergence, note, text, sizeof text);
        fracas_json_object(json, NULL);
        fracas_json_text(json, "refinement", note->refinement);
        if (note->point == SIZE_MAX) fracas_json_text(json, "point", NULL);
        else fracas_json_integer(json, "point", (int64_t)note->point);
        fracas_json_text(json, "text", text);
        fracas_json_close(json);
    }
    fracas_json_close(json);
}

void fracas_convergence_write_json(const fracas_convergence *convergence, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_real(&json, "tolerance", convergence->tolerance);
    for (int v = 0; v < FRACAS_NUMBER_VERDICTS; v++)
        fracas_json_integer(&json, fracas_number_verdict_name[v],
                            (int64_t)count_of(convergence, (fracas_number_verdict)v));
    write_left(convergence, &json);
    write_notes(convergence, &json);
    fracas_json_array(&json, "numbers");
    for (size_t i = 0; i < convergence->nrows; i++) {
        const printed row = print_of(convergence, &convergence->row[i]);
        fracas_json_object(&json, NULL);
        fracas_fields_json(&json, &place_fields, &row);
        fracas_fields_json(&json, &label_fields, &row);
        fracas_fields_json(&json, &change_fields, &row);
        fracas_json_close(&json);
    }
    fracas_json_end(&json);
}

static void put_name(void *out, const fracas_field *leaf)
{
    fprintf(out, "%s%s", leaf->offset ? "," : "", leaf->key);
}

fracas_err fracas_convergence_write_csv(const fracas_convergence *convergence, const char *folder)
{
    fracas_output_file output;
    TRY(fracas_output_open(folder, TABLE, &output));
    fracas_fields_walk(&place_fields, "_", put_name, output.file);
    fracas_fields_walk(&change_fields, "_", put_name, output.file);
    putc('\n', output.file);
    for (size_t i = 0; i < convergence->nrows; i++) {
        const printed row = print_of(convergence, &convergence->row[i]);
        fprintf(output.file, "%s,%zu,%s", row.refinement, row.point, row.hash);
        fracas_fields_csv(&change_fields, &row, output.file);
        putc('\n', output.file);
    }
    return fracas_output_close(&output, FRACAS_OK);
}

fracas_err fracas_convergence_keeps(const char *folder)
{
    OWNED char *table = NULL;
    OWNED char *report = NULL;
    TRY(fracas_path(&table, "%s/" TABLE, folder));
    TRY(fracas_path(&report, "%s/report", folder));
    if (!fracas_file_begins(table, "refinement,"))
        return fracas_fail(FRACAS_USAGE,
                           "%s is there already, and is no table of fracas converge: move it away, "
                           "or choose another --study",
                           table);
    return fracas_output_empty(report);
}
