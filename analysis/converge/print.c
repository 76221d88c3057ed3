/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A convergence as text, JSON and CSV. */
#include "analysis/converge/rows.h"

#include "analysis/export/csv.h"
#include "analysis/data/output.h"
#include "base/json.h"
#include "base/param.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

/* How many replicas would tell of what is unclear: of the numbers whose change is known to 50 % by
 * now. Of the others that would be a guess at what does not end. */
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
    if (vague > 0)
        snprintf(others, sizeof others,
                 "%zu of the %zu unclear changes %s known no better than to 50 %% of the number",
                 vague, unclear, vague == 1 ? "is" : "are");
    if (vague == unclear)
        snprintf(text, sizeof text,
                 "No change that is unclear is known better than to 50 %% of the number: how many "
                 "replicas would tell cannot be said.");
    else if (vague > 0)
        snprintf(text, sizeof text,
                 "About %.0f replicas of each point would tell of %zu that are unclear; %s.",
                 replicas, unclear - vague, others);
    else
        snprintf(text, sizeof text,
                 "About %.0f replicas of each point would tell of all that are unclear.", replicas);
    line(context, text);
}

void fracas_convergence_conclude(const fracas_convergence *convergence,
                                 fracas_convergence_line *line, void *context)
{
    char text[800];
    for (size_t i = 0; i < convergence->nrows; i++) {
        const fracas_convergence_row *row = &convergence->row[i];
        if (i > 0 && strcmp(row->refinement, row[-1].refinement) == 0) continue;
        format_counts(convergence, row->refinement, text, sizeof text);
        line(context, text);
    }
    for (size_t i = 0; i < convergence->nleft; i++) {
        snprintf(text, sizeof text, "%s: %zu point%s left out: %s", convergence->left[i].refinement,
                 convergence->left[i].points, convergence->left[i].points == 1 ? "" : "s",
                 convergence->left[i].why);
        line(context, text);
    }
    for (size_t i = 0; i < convergence->nnotes; i++) {
        int used = snprintf(text, sizeof text, "warning: ");
        fracas_convergence_note_line(convergence, &convergence->note[i], text + used,
                                     sizeof text - (size_t)used);
        line(context, text);
    }
    conclude_replicas(convergence, line, context);
}

static void print_line(void *out, const char *text)
{
    fprintf(out, "%s\n", text);
}

fracas_err fracas_convergence_print(const fracas_convergence *convergence, FILE *out)
{
    fracas_result_table table = {0};
    TRY(fracas_convergence_table_create(convergence, false, &table));
    fracas_table_print(&table, "", 0x87, false, out); /* words to the left */
    fracas_result_table_clear(&table);
    fprintf(out,
            "\nchange: of the mean, with the half width of its 95 %% interval: of pairs with the "
            "same strengths for step and beta, by Welch\n"
            "for mesh; half widths: in those of the number as it is. moved: Holm's p among all %zu "
            "numbers is below 0.05, and the interval is\n"
            "not within %g %%; shifted: it is; holds: it is, and p is not; unclear: neither.\n\n",
            convergence->nrows, 100 * convergence->tolerance);
    fracas_convergence_conclude(convergence, print_line, out);
    if (!ferror(out)) return FRACAS_OK;
    return fracas_fail_system(errno, "cannot write the table");
}

/* ---- JSON ---- */

/* What JSON and CSV have of a difference. */
static const struct {
    const char *name;
    size_t offset;
} columns[] = {
    {"difference", offsetof(fracas_compared_value, difference)},
    {"low", offsetof(fracas_compared_value, low)},
    {"high", offsetof(fracas_compared_value, high)},
    {"relative", offsetof(fracas_compared_value, relative)},
    {"relative_low", offsetof(fracas_compared_value, relative_low)},
    {"relative_high", offsetof(fracas_compared_value, relative_high)},
    {"p", offsetof(fracas_compared_value, p)},
    {"p_holm", offsetof(fracas_compared_value, p_holm)},
};

static const double *column_at(const fracas_convergence_row *row, size_t c)
{
    return (const double *)(const void *)((const char *)&row->value + columns[c].offset);
}

static void write_estimate(fracas_json *json, const char *key, const fracas_estimate *estimate)
{
    fracas_json_object(json, key);
    fracas_json_integer(json, "n", estimate->n);
    fracas_json_real(json, "mean", estimate->mean);
    fracas_json_real(json, "half_width", estimate->half_width);
    fracas_json_close_object(json);
}

static void write_row(const fracas_convergence *convergence, const fracas_convergence_row *row,
                      fracas_json *json)
{
    char label[256], hash[FRACAS_HASH_HEX];
    fracas_analysis_label(convergence->study, row->point, label, sizeof label);
    fracas_hash_hex(&convergence->study->table->point[row->point].hash, hash);
    fracas_json_object(json, NULL);
    fracas_json_text(json, "refinement", row->refinement);
    fracas_json_integer(json, "point", (int64_t)row->point);
    fracas_json_text(json, "hash", hash);
    fracas_json_text(json, "label", label);
    fracas_json_text(json, "number", row->number->key);
    fracas_json_text(json, "unit", row->number->unit);
    write_estimate(json, "base", &row->value.a);
    write_estimate(json, "refined", &row->value.b);
    for (size_t c = 0; c < FRACAS_COUNT(columns); c++)
        fracas_json_real(json, columns[c].name, *column_at(row, c));
    fracas_json_real(json, "half_widths", row->value.difference / row->value.a.half_width);
    fracas_json_text(json, "method", row->paired ? "pairs" : "welch");
    fracas_json_text(json, "verdict", fracas_number_verdict_name[row->verdict]);
    fracas_json_close_object(json);
}

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
        fracas_json_close_object(json);
    }
    fracas_json_close_array(json);
}

static void write_notes(const fracas_convergence *convergence, fracas_json *json)
{
    char text[800];
    fracas_json_array(json, "warnings");
    for (size_t i = 0; i < convergence->nnotes; i++) {
        const fracas_convergence_note *note = &convergence->note[i];
        fracas_json_object(json, NULL);
        fracas_json_text(json, "refinement", note->refinement);
        if (note->point == SIZE_MAX) fracas_json_text(json, "point", NULL);
        else fracas_json_integer(json, "point", (int64_t)note->point);
        fracas_convergence_note_line(convergence, note, text, sizeof text);
        fracas_json_text(json, "text", text);
        fracas_json_close_object(json);
    }
    fracas_json_close_array(json);
}

void fracas_convergence_write_json(const fracas_convergence *convergence, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_object(&json, NULL);
    fracas_json_real(&json, "tolerance", convergence->tolerance);
    for (int v = 0; v < FRACAS_NUMBER_VERDICTS; v++)
        fracas_json_integer(&json, fracas_number_verdict_name[v],
                            (int64_t)count_of(convergence, (fracas_number_verdict)v));
    write_left(convergence, &json);
    write_notes(convergence, &json);
    fracas_json_array(&json, "numbers");
    for (size_t i = 0; i < convergence->nrows; i++)
        write_row(convergence, &convergence->row[i], &json);
    fracas_json_close_array(&json);
    fracas_json_close_object(&json);
    fracas_json_end(&json);
}

/* ---- CSV ---- */

static void csv_estimate(const fracas_estimate *estimate, FILE *out)
{
    fprintf(out, ",%" PRId64, estimate->n);
    fracas_csv_real(estimate->mean, out);
    fracas_csv_real(estimate->half_width, out);
}

static void csv_row(const fracas_convergence *convergence, const fracas_convergence_row *row,
                    FILE *out)
{
    char hash[FRACAS_HASH_HEX];
    fracas_hash_hex(&convergence->study->table->point[row->point].hash, hash);
    fprintf(out, "%s,%zu,%s,%s,%s", row->refinement, row->point, hash, row->number->key,
            row->number->unit);
    csv_estimate(&row->value.a, out);
    csv_estimate(&row->value.b, out);
    for (size_t c = 0; c < FRACAS_COUNT(columns); c++) fracas_csv_real(*column_at(row, c), out);
    fracas_csv_real(row->value.difference / row->value.a.half_width, out);
    fprintf(out, ",%s,%s\n", row->paired ? "pairs" : "welch",
            fracas_number_verdict_name[row->verdict]);
}

fracas_err fracas_convergence_write_csv(const fracas_convergence *convergence, const char *folder)
{
    fracas_output_file output;
    TRY(fracas_output_open(folder, "converge.csv", &output));
    fputs("refinement,point,hash,number,unit,base_n,base_mean,base_half_width,refined_n,refined_"
          "mean,refined_half_width",
          output.file);
    for (size_t c = 0; c < FRACAS_COUNT(columns); c++) fprintf(output.file, ",%s", columns[c].name);
    fputs(",half_widths,method,verdict\n", output.file);
    for (size_t i = 0; i < convergence->nrows; i++)
        csv_row(convergence, &convergence->row[i], output.file);
    return fracas_output_close(&output, FRACAS_OK);
}
