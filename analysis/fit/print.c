/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits for a terminal, and as JSON. */
#include "analysis/fit/family.h"
#include "analysis/fit/fits.h"
#include "analysis/summary/study.h"
#include "analysis/data/format.h"
#include "base/json.h"

#include <math.h>

static double value_of(const fracas_fits *fits, int64_t point, const char *family,
                       const char *quantity)
{
    const fracas_fits_row *row = fracas_fits_find(fits, point, family, quantity);
    return row ? row->value : NAN;
}

void fracas_fits_format_interval(const fracas_fits_row *row, double factor, char *text, size_t size)
{
    const double width = (row->high - row->low) * factor;
    const int decimals = (int)fmax(0, 1 - floor(log10(width / 2)));
    if (width > 1e-9 * fabs(row->value * factor)) /* else it is rounding */
        snprintf(text, size, "%.*f [%.*f, %.*f]", decimals, row->value * factor, decimals,
                 row->low * factor, decimals, row->high * factor);
    else fracas_format_digits(row->value * factor, 3, text, size);
}

void fracas_fits_format_p(const fracas_fits_row *row, char *text, size_t size)
{
    if (!row || !isfinite(row->value)) snprintf(text, size, "-");
    else if (row->resamples > 0 && row->value <= 1.5 / (double)(row->resamples + 1))
        snprintf(text, size, "<%.2g", 2.0 / (double)(row->resamples + 1));
    else snprintf(text, size, "%.2g", row->value);
}

void fracas_fits_format_parameters(const fracas_fits *fits, int64_t point,
                                   const fracas_family *family, char *text, size_t size)
{
    *text = '\0';
    for (size_t i = 0; i < family->nparameters; i++) {
        char name[32], value[96];
        FRACAS_PRINT(name, "%s%s", family->parameter[i].name,
                     family->parameter[i].length ? "/mean" : "");
        const fracas_fits_row *row = fracas_fits_find(fits, point, family->name, name);
        if (!row) continue;
        fracas_fits_format_interval(row, 1, value, sizeof value);
        fracas_append(text, size, "  ", "%s %s", name, value);
    }
}

bool fracas_fits_format_comparison(const fracas_fits *fits, int64_t point, char *text, size_t size)
{
    char p[16];
    const fracas_fits_row *row = fracas_fits_find(fits, point, "comparison", "p");
    if (!row) return false;
    fracas_fits_format_p(row, p, sizeof p);
    snprintf(text, size, "%s (p %s%s)", row->note, *p == '<' ? "" : "= ", p);
    return true;
}

static void print_interval(const fracas_fits_row *row, double factor, FILE *out)
{
    char text[96];
    fracas_fits_format_interval(row, factor, text, sizeof text);
    fputs(text, out);
}

static void print_family(const fracas_fits *fits, int64_t point, const fracas_family *family,
                         int rank, FILE *out)
{
    char ks_p[16], ad_p[16], delta[24], parameters[320];
    fracas_fits_format_p(fracas_fits_find(fits, point, family->name, "ks_p"), ks_p, sizeof ks_p);
    fracas_fits_format_p(fracas_fits_find(fits, point, family->name, "ad_p"), ad_p, sizeof ad_p);
    FRACAS_PRINT(delta, "%.1f", value_of(fits, point, family->name, "delta_aicc"));
    fprintf(out, "  %2d  %-18s %9s  %7.4f %7s  %9.4g %7s  ", rank, family->name, delta,
            value_of(fits, point, family->name, "ks"), ks_p,
            value_of(fits, point, family->name, "ad"), ad_p);
    fracas_fits_format_parameters(fits, point, family, parameters, sizeof parameters);
    fprintf(out, "%s\n", parameters);
}

static void print_failed(const fracas_fits *fits, int64_t point, const fracas_family *family,
                         FILE *out)
{
    const fracas_fits_row *row = fracas_fits_find(fits, point, family->name, "fitted");
    const double delta = value_of(fits, point, family->name, "delta_aicc");
    char text[24] = "-";
    if (!row || row->value != 0) return;
    if (isfinite(delta)) FRACAS_PRINT(text, "%.1f", delta);
    fprintf(out, "   -  %-18s %9s  no fit: %s\n", family->name, text, row->note);
}

static void print_whole(const fracas_fits *fits, int64_t point, FILE *out)
{
    const fracas_fits_row *whole = fracas_fits_find(fits, point, "data", "whole");
    if (whole && whole->value > 0) fprintf(out, "  warning: %.0f %s\n", whole->value, whole->note);
}

static void print_head(const fracas_fits *fits, const fracas_analysis *analysis, int64_t point,
                       FILE *out)
{
    char unit[8];
    const fracas_label label = fracas_analysis_label(analysis, (size_t)point);
    const fracas_fits_row *size = fracas_fits_find(fits, point, "data", "mean"),
                          *cv = fracas_fits_find(fits, point, "data", "cv");
    const fracas_prefix prefix = fracas_prefix_for(&size->value, 1);
    FRACAS_PRINT(unit, "%sm", prefix.symbol);
    fprintf(out,
            "\npoint %lld%s%s: %.0f of %.0f fragments of %.0f realizations, those above %s %s; "
            "mean size ",
            (long long)point, *label.text ? ", " : "", label.text,
            value_of(fits, point, "data", "above_cut"), value_of(fits, point, "data", "fragments"),
            value_of(fits, point, "data", "realizations"),
            fracas_digits(value_of(fits, point, "data", "cut") * prefix.factor, 4).text, unit);
    print_interval(size, prefix.factor, out);
    fprintf(out, " %s, deviation/mean ", unit);
    print_interval(cv, 1, out);
    fputc('\n', out);
    print_whole(fits, point, out);
}

static void print_point(const fracas_fits *fits, const fracas_analysis *analysis, int64_t point,
                        FILE *out)
{
    char comparison[256];
    if (!(value_of(fits, point, "data", "above_cut") > 0)) {
        const fracas_label label = fracas_analysis_label(analysis, (size_t)point);
        fprintf(out,
                "\npoint %lld%s%s: no fragment of a body that came apart is above the cut: nothing "
                "to fit\n",
                (long long)point, *label.text ? ", " : "", label.text);
        print_whole(fits, point, out);
        return;
    }
    print_head(fits, analysis, point, out);
    fprintf(out, "      %-18s %9s  %7s %7s  %9s %7s  %s\n", "family", "d AICc", "KS", "p", "AD",
            "p", "parameters [95 % interval]");
    for (int rank = 1; rank <= FRACAS_NFAMILIES; rank++) {
        const char *name = fracas_fits_ranked(fits, point, rank);
        const fracas_family *family = name ? fracas_family_find(name) : NULL;
        if (family) print_family(fits, point, family, rank, out);
    }
    for (size_t f = 0; f < FRACAS_NFAMILIES; f++)
        print_failed(fits, point, fracas_families[f], out);
    if (fracas_fits_format_comparison(fits, point, comparison, sizeof comparison))
        fprintf(out, "  %s\n", comparison);
}

void fracas_fits_print(const fracas_fits *fits, const fracas_analysis *analysis, FILE *out)
{
    fputs("Fits by maximum likelihood to the sizes above the cut. Intervals and p-values resample "
          "realizations, and hold from 50 of them on;\n"
          "p: how often data of the fitted law are as far from their own fit; below 0.05 the "
          "family does not describe the sizes.\n",
          out);
    for (size_t p = 0; p < analysis->table->npoints; p++)
        if (fracas_fits_find(fits, (int64_t)p, "data", "mean"))
            print_point(fits, analysis, (int64_t)p, out);
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
