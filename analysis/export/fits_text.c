/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits as tables and as JSON. */
#include "analysis/export/tables.h"
#include "analysis/data/format.h"
#include "base/json.h"
#include "base/sheet.h"

#include <math.h>

static void format_interval(const fracas_fits_row *row, double factor, char *text, size_t size)
{
    const double width = (row->high - row->low) * factor;
    const int decimals = (int)fmax(0, 1 - floor(log10(width / 2)));
    if (width > 1e-9 * fabs(row->value * factor)) /* else it is rounding */
        snprintf(text, size, "%.*f [%.*f, %.*f]", decimals, row->value * factor, decimals,
                 row->low * factor, decimals, row->high * factor);
    else fracas_format_digits(row->value * factor, 3, text, size);
}

static void format_p(const fracas_fits_row *row, char *text, size_t size)
{
    if (!row || !isfinite(row->value)) snprintf(text, size, "-");
    else if (row->resamples > 0 && row->value <= 1.5 / (double)(row->resamples + 1))
        snprintf(text, size, "<%.2g", 2.0 / (double)(row->resamples + 1));
    else snprintf(text, size, "%.2g", row->value);
}

static void format_parameters(const fracas_fits *fits, int64_t point, const fracas_family *family,
                              char *text, size_t size)
{
    *text = '\0';
    for (size_t i = 0; i < family->nparameters; i++) {
        char name[32], value[96];
        FRACAS_PRINT(name, "%s%s", family->parameter[i].name,
                     family->parameter[i].length ? "/mean" : "");
        const fracas_fits_row *row = fracas_fits_find(fits, point, family->name, name);
        if (!row) continue;
        format_interval(row, 1, value, sizeof value);
        fracas_append(text, size, "  ", "%s %s", name, value);
    }
}

bool fracas_fits_format_comparison(const fracas_fits *fits, int64_t point, char *text, size_t size)
{
    char p[16];
    const fracas_fits_row *row = fracas_fits_find(fits, point, "comparison", "p");
    if (!row) return false;
    format_p(row, p, sizeof p);
    snprintf(text, size, "%s (p %s%s)", row->note, *p == '<' ? "" : "= ", p);
    return true;
}

const char *const fracas_fit_table_legend[] = {
    "\u0394AICc: above that of the best family; of families within some 4 of each other the data "
    "prefer none, but for what is said below the table.",
    "KS, AD: distance of the fragments from the family, Kolmogorov and Smirnov\u2019s and Anderson "
    "and Darling\u2019s; p: how often data of the",
    "fitted law are as far from their own fit, by resampling realizations: below 0.05 the family "
    "does not describe the sizes.",
    "Parameters with 95 % intervals that resample realizations, lengths over the mean of the sizes "
    "above the cut. Intervals and p hold from 50 realizations on.",
    NULL,
};

enum { RANK, FAMILY, DELTA, KS, KS_P, AD, AD_P, PARAMETERS, NCOLUMNS };

/* rank: 0 of a family without a fit. */
static void fill_family(const fracas_fits *fits, int64_t point, const char *label,
                        const fracas_family *family, int rank, char (*cell)[FRACAS_CELL])
{
    const char *name = family->name;
    const double delta = fracas_fits_value(fits, point, name, "delta_aicc");
    snprintf(cell[RANK], FRACAS_CELL, rank ? "%d" : "-", rank);
    snprintf(cell[FAMILY], FRACAS_CELL, "%.79s%s%s", label, *label ? ": " : "", name);
    snprintf(cell[DELTA], FRACAS_CELL, isfinite(delta) ? "%.1f" : "-", delta);
    if (rank == 0) {
        snprintf(cell[PARAMETERS], FRACAS_CELL, "no fit: %.100s",
                 fracas_fits_find(fits, point, name, "fitted")->note);
        return;
    }
    fracas_format_digits(fracas_fits_value(fits, point, name, "ks"), 3, cell[KS], FRACAS_CELL);
    format_p(fracas_fits_find(fits, point, name, "ks_p"), cell[KS_P], FRACAS_CELL);
    fracas_format_digits(fracas_fits_value(fits, point, name, "ad"), 3, cell[AD], FRACAS_CELL);
    format_p(fracas_fits_find(fits, point, name, "ad_p"), cell[AD_P], FRACAS_CELL);
    format_parameters(fits, point, family, cell[PARAMETERS], FRACAS_CELL);
}

/* The families of a point by rank, in the rows from *line on, which goes on. */
static void fill_ranked(const fracas_fits *fits, int64_t point, const char *label, size_t *line,
                        const fracas_result_table *table)
{
    for (int rank = 1; rank <= FRACAS_NFAMILIES; rank++) {
        const char *name = fracas_fits_ranked(fits, point, rank);
        const fracas_family *family = name ? fracas_family_find(name) : NULL;
        if (family)
            fill_family(fits, point, label, family, rank, &table->cell[(*line)++ * NCOLUMNS]);
    }
}

static fracas_err empty_table(size_t points, const char *delta, fracas_result_table *table)
{
    const char *const name[NCOLUMNS] = {"rank", "family", delta, "KS",
                                        "p",    "AD",     "p",   "parameters [95 % interval]"};
    return fracas_table_empty(points * FRACAS_NFAMILIES, NCOLUMNS, name, table);
}

fracas_err fracas_fit_table_create(const fracas_analysis *analysis, const fracas_fits *fits,
                                   fracas_result_table *table)
{
    size_t line = FRACAS_RESULT_TABLE_HEAD;
    TRY(empty_table(fracas_analysis_ndrawn(analysis), "\u0394AICc", table));
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (fracas_analysis_draws(analysis, p))
            fill_ranked(fits, (int64_t)p, fracas_analysis_label(analysis, p).text, &line, table);
    table->rows = line;
    return FRACAS_OK;
}

/* ---- for a terminal ---- */

static void print_table(const fracas_fits *fits, int64_t point, int columns, FILE *out)
{
    size_t line = FRACAS_RESULT_TABLE_HEAD;
    fracas_result_table table;
    if (empty_table(1, "d AICc", &table)) {
        fprintf(out, "%s\n", fracas_message());
        return;
    }
    fill_ranked(fits, point, "", &line, &table);
    for (size_t f = 0; f < FRACAS_NFAMILIES; f++)
        if (fracas_fits_value(fits, point, fracas_families[f]->name, "fitted") == 0)
            fill_family(fits, point, "", fracas_families[f], 0, &table.cell[line++ * NCOLUMNS]);
    table.rows = line;
    table.keys = FAMILY + 1;
    fracas_table_print(&table, "  ", 1U << FAMILY | 1U << PARAMETERS, false, columns, out);
    fracas_result_table_clear(&table);
}

static void print_whole(const fracas_fits *fits, int64_t point, FILE *out)
{
    const fracas_fits_row *whole = fracas_fits_find(fits, point, "data", "whole");
    if (whole && whole->value > 0) fprintf(out, "  warning: %.0f %s\n", whole->value, whole->note);
}

static void print_point(const fracas_fits *fits, const fracas_analysis *analysis, int64_t point,
                        int columns, FILE *out)
{
    char comparison[256], mean[96], cv[96];
    const fracas_label label = fracas_analysis_label(analysis, (size_t)point);
    const fracas_fits_row *size = fracas_fits_find(fits, point, "data", "mean");
    const fracas_prefix prefix = fracas_prefix_for(&size->value, 1);
    const double above = fracas_fits_value(fits, point, "data", "above_cut");
    fprintf(out, "\npoint %lld%s%s: ", (long long)point, *label.text ? ", " : "", label.text);
    if (!(above > 0)) {
        fputs("no fragment of a body that came apart is above the cut: nothing to fit\n", out);
        print_whole(fits, point, out);
        return;
    }
    format_interval(size, prefix.factor, mean, sizeof mean);
    format_interval(fracas_fits_find(fits, point, "data", "cv"), 1, cv, sizeof cv);
    fprintf(out,
            "%.0f of %.0f fragments of %.0f realizations, those above %s %sm; mean size %s %sm, "
            "deviation/mean %s\n",
            above, fracas_fits_value(fits, point, "data", "fragments"),
            fracas_fits_value(fits, point, "data", "realizations"),
            fracas_digits(fracas_fits_value(fits, point, "data", "cut") * prefix.factor, 4).text,
            prefix.symbol, mean, prefix.symbol, cv);
    print_whole(fits, point, out);
    print_table(fits, point, columns, out);
    if (fracas_fits_format_comparison(fits, point, comparison, sizeof comparison))
        fprintf(out, "  %s\n", comparison);
}

void fracas_fits_print(const fracas_fits *fits, const fracas_analysis *analysis, int columns,
                       FILE *out)
{
    static const char *const legend[] = {
        "Fits by maximum likelihood to the sizes above the cut. Intervals and p-values resample "
        "realizations, and hold from 50 of them on;",
        "p: how often data of the fitted law are as far from their own fit; below 0.05 the "
        "family does not describe the sizes.",
        NULL};
    fracas_sheet_legend(legend, columns, out);
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (fracas_fits_find(fits, (int64_t)p, "data", "mean"))
            print_point(fits, analysis, (int64_t)p, columns, out);
}

#define FIELD(key, type) FRACAS_FIELD(fracas_fits_row, type, #key, "", "", key)
static const fracas_field row_field[] = {
    FIELD(point, INTEGER),     FIELD(hash, CHARS),   FIELD(family, CHARS), FIELD(quantity, CHARS),
    FIELD(unit, CHARS),        FIELD(value, NUMBER), FIELD(low, NUMBER),   FIELD(high, NUMBER),
    FIELD(resamples, INTEGER), FIELD(note, CHARS),
};
static const fracas_fields row_fields = FRACAS_FIELDS(row_field);

void fracas_fits_write_json(const fracas_fits *fits, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "campaign", fits->campaign);
    fracas_json_array(&json, "fits");
    for (const fracas_fits_row *row = fits->row; row < fits->row + fits->n; row++)
        fracas_fields_json_object(&json, NULL, &row_fields, row);
    fracas_json_end(&json);
}
