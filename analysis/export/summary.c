/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON summary. Its keys are those of fracas_statistics and of /point: they do not change. */
#include "analysis/export/summary.h"

#include "analysis/scaling/crossover.h"
#include "analysis/scaling/slope.h"
#include "analysis/scaling/windows.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void write_parameters(fracas_json *json, const fracas_point_table *table, size_t p)
{
    fracas_json_object(json, "parameters");
    for (size_t c = 0; c < table->ncolumns; c++) {
        const fracas_value *value = &table->point[p].value[c];
        if (table->column[c].text)
            fracas_json_text(json, table->column[c].path, *value->text ? value->text : NULL);
        else fracas_json_real(json, table->column[c].path, value->real);
    }
    fracas_json_close_object(json);
}

/* Of every number below "parameters" and "statistics", so that the document explains itself. */
static void write_units(fracas_json *json, const fracas_point_table *table)
{
    fracas_json_object(json, "units");
    fracas_json_object(json, "parameters");
    for (size_t c = 0; c < table->ncolumns; c++)
        if (!table->column[c].text)
            fracas_json_text(json, table->column[c].path, table->column[c].unit);
    fracas_json_close_object(json);
    fracas_json_object(json, "statistics");
    for (size_t i = 0; i < fracas_nstatistics; i++)
        fracas_json_text(json, fracas_statistics[i].key, fracas_statistics[i].unit);
    fracas_json_close_object(json);
    fracas_json_close_object(json);
}

static void write_statistics(fracas_json *json, const fracas_point_statistics *statistics)
{
    fracas_json_object(json, "statistics");
    for (size_t i = 0; i < fracas_nstatistics; i++) {
        const void *value = (const char *)statistics + fracas_statistics[i].offset;
        if (fracas_statistics[i].integer)
            fracas_json_integer(json, fracas_statistics[i].key, *(const int64_t *)value);
        else fracas_json_real(json, fracas_statistics[i].key, *(const double *)value);
    }
    fracas_json_close_object(json);
    fracas_json_object(json, "outcomes");
    for (int o = 0; o < FRACAS_NOUTCOMES; o++)
        fracas_json_integer(json, fracas_outcome_name(o), statistics->outcome[o]);
    fracas_json_close_object(json);
}

/* Why a statistic is null, by its key. */
static void write_reasons(fracas_json *json, const fracas_point_statistics *statistics)
{
    fracas_json_object(json, "reasons");
    if (statistics->without_mott) fracas_json_text(json, "law.mott", statistics->without_mott);
    fracas_json_close_object(json);
}

static void write_decision(fracas_json *json, const fracas_decision *last)
{
    if (!last) return;
    fracas_json_object(json, "decision");
    fracas_json_text(json, "quantity", fracas_analysis_quantity(last));
    fracas_json_integer(json, "rounds", last->round + 1);
    fracas_json_integer(json, "used", last->used);
    fracas_json_real(json, "mean", last->mean);
    fracas_json_real(json, "half_width", last->half_width);
    fracas_json_real(json, "relative_half_width", last->relative_half_width);
    fracas_json_real(json, "confidence", last->confidence);
    fracas_json_boolean(json, "at_maximum", last->stop == 2);
    fracas_json_close_object(json);
}

static void write_progress(fracas_json *json, const fracas_progress *progress)
{
    fracas_json_object(json, "progress");
    fracas_json_integer(json, "planned", progress->planned);
    fracas_json_integer(json, "done", progress->done);
    fracas_json_integer(json, "failed", progress->failed);
    fracas_json_integer(json, "missing", progress->missing);
    fracas_json_boolean(json, "complete", progress->complete);
    fracas_json_close_object(json);
}

static void write_point(fracas_json *json, const fracas_analysis *analysis, size_t p,
                        const fracas_fits *fits)
{
    char label[256], hash[FRACAS_HASH_HEX];
    fracas_analysis_label(analysis, p, label, sizeof label);
    fracas_hash_hex(&analysis->table->point[p].hash, hash);
    const fracas_progress progress = fracas_analysis_progress_of(analysis, p);
    fracas_json_object(json, NULL);
    fracas_json_text(json, "label", label);
    fracas_json_text(json, "hash", hash);
    fracas_json_integer(json, "replicas", analysis->table->point[p].replicas);
    write_progress(json, &progress);
    write_decision(json, fracas_analysis_decision(analysis, p));
    write_parameters(json, analysis->table, p);
    write_statistics(json, &analysis->point[p]);
    write_reasons(json, &analysis->point[p]);
    fracas_summary_put_convergence(json, analysis, p);
    fracas_summary_put_energies(json, analysis, p);
    fracas_summary_put_fits(json, p, fits);
    fracas_json_close_object(json);
}

static void write_warnings(fracas_json *json, const fracas_analysis *analysis)
{
    fracas_warning *warning = NULL;
    size_t count = 0;
    fracas_json_array(json, "warnings");
    if (fracas_analysis_warnings(analysis, &warning, &count))
        fracas_json_text(json, NULL, fracas_message());
    for (size_t i = 0; i < count; i++) {
        fracas_json_object(json, NULL);
        if (warning[i].point == SIZE_MAX) fracas_json_text(json, "point", NULL);
        else fracas_json_integer(json, "point", (int64_t)warning[i].point);
        fracas_json_text(json, "text", warning[i].text);
        fracas_json_close_object(json);
    }
    fracas_json_close_array(json);
    free(warning);
}

static void write_slopes(fracas_json *json, const fracas_analysis *analysis)
{
    fracas_size_slope *list = NULL;
    size_t count = 0;
    fracas_json_array(json, "slopes");
    if (fracas_size_slopes(analysis, &list, &count)) fracas_json_text(json, NULL, fracas_message());
    for (size_t i = 0; i < count; i++) {
        const fracas_slope *slope = &list[i].slope;
        fracas_json_object(json, NULL);
        fracas_json_text(json, "series", list[i].name);
        fracas_json_integer(json, "points", slope->n);
        fracas_json_real(json, "slope", slope->slope);
        fracas_json_real(json, "standard_error", slope->standard_error);
        fracas_json_real(json, "half_width", slope->half_width);
        fracas_json_real(json, "chi2", slope->chi2);
        fracas_json_real(json, "misfit", slope->misfit);
        fracas_json_real(json, "pooled_freedom", slope->pooled);
        fracas_json_real(json, "mott", FRACAS_SLOPE_MOTT);
        fracas_json_real(json, "grady", FRACAS_SLOPE_GRADY);
        fracas_json_close_object(json);
    }
    fracas_json_close_array(json);
    free(list);
}

static void write_windows(fracas_json *json, const fracas_analysis *analysis)
{
    fracas_size_window *list = NULL;
    size_t count = 0;
    fracas_json_array(json, "windows");
    if (fracas_size_windows(analysis, &list, &count))
        fracas_json_text(json, NULL, fracas_message());
    for (size_t i = 0; i < count; i++) {
        fracas_json_object(json, NULL);
        fracas_json_text(json, "series", list[i].name);
        fracas_json_integer(json, "from_point", (int64_t)list[i].point[0]);
        fracas_json_integer(json, "to_point", (int64_t)list[i].point[1]);
        fracas_json_real(json, "from_rate", list[i].rate[0]);
        fracas_json_real(json, "to_rate", list[i].rate[1]);
        fracas_json_real(json, "from_rate_normalised", list[i].rate[0] / list[i].scales.rate);
        fracas_json_real(json, "to_rate_normalised", list[i].rate[1] / list[i].scales.rate);
        fracas_json_real(json, "slope", list[i].window.slope);
        fracas_json_real(json, "standard_error", list[i].window.standard_error);
        fracas_json_real(json, "freedom", list[i].window.freedom);
        fracas_json_real(json, "half_width", list[i].window.half_width);
        fracas_json_close_object(json);
    }
    fracas_json_close_array(json);
    free(list);
}

static void write_interval(fracas_json *json, const char *key, const fracas_interval *interval,
                           double factor)
{
    fracas_json_object(json, key);
    fracas_json_real(json, "value", interval->value * factor);
    fracas_json_real(json, "low", interval->low * factor);
    fracas_json_real(json, "high", interval->high * factor);
    fracas_json_real(json, "standard_error", interval->standard_error * factor);
    fracas_json_close_object(json);
}

static void write_crossovers(fracas_json *json, const fracas_analysis *analysis)
{
    fracas_size_crossover *list = NULL;
    size_t count = 0;
    fracas_json_array(json, "crossovers");
    if (fracas_size_crossovers(analysis, true, &list, &count))
        fracas_json_text(json, NULL, fracas_message());
    for (size_t i = 0; i < count; i++) {
        fracas_json_object(json, NULL);
        fracas_json_text(json, "series", list[i].name);
        fracas_json_integer(json, "points", list[i].n);
        fracas_json_text(json, "reason", *list[i].reason ? list[i].reason : NULL);
        write_interval(json, "rate", &list[i].rate, 1);
        write_interval(json, "rate_normalised", &list[i].rate, 1 / list[i].scales.rate);
        write_interval(json, "size", &list[i].size, 1);
        write_interval(json, "size_normalised", &list[i].size, 1 / list[i].scales.size);
        fracas_json_real(json, "low_exponent", *list[i].reason ? NAN : 0);
        write_interval(json, "high_exponent", &list[i].exponent, 1);
        fracas_json_real(json, "chi2", list[i].chi2);
        fracas_json_real(json, "freedom", list[i].freedom);
        fracas_json_real(json, "misfit", list[i].misfit);
        fracas_json_real(json, "pooled_freedom", list[i].pooled);
        fracas_json_real(json, "inflation", list[i].inflation);
        fracas_json_integer(json, "resamples", list[i].rate.resamples);
        fracas_json_close_object(json);
    }
    fracas_json_close_array(json);
    free(list);
}

void fracas_analysis_reference(FILE *out)
{
    fputs("| key | type | unit | meaning |\n|---|---|---|---|\n", out);
    for (size_t i = 0; i < fracas_nstatistics; i++) {
        const fracas_statistic *what = &fracas_statistics[i];
        fprintf(out, "| `%s` | %s | %s | ", what->key, what->integer ? "integer" : "number",
                what->unit);
        for (const char *c = what->doc; *c; c++)
            fprintf(out, *c == '|' ? "\\%c" : "%c", *c); /* |residual| is no column */
        fputs(" |\n", out);
    }
}

void fracas_summary_write(const fracas_analysis *analysis, const fracas_fits *fits, size_t stale,
                          FILE *out)
{
    char hash[FRACAS_HASH_HEX], seed[24];
    fracas_hash_hex(&analysis->header.campaign, hash);
    snprintf(seed, sizeof seed, "%" PRIu64, analysis->header.seed);
    const fracas_progress progress = fracas_analysis_progress(analysis);
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_object(&json, NULL);
    fracas_json_text(&json, "name", analysis->name);
    fracas_json_text(&json, "campaign", hash);
    fracas_json_text(&json, "seed",
                     seed); /* text: a 64-bit number is more than every JSON reader keeps */
    fracas_json_text(&json, "version", analysis->header.version);
    fracas_json_boolean(&json, "complete", analysis->header.complete);
    fracas_json_boolean(&json, "partial", fracas_results_partial(analysis->results));
    write_progress(&json, &progress);
    fracas_json_integer(&json, "stale_fits", (int64_t)stale);
    fracas_json_array(&json, "varying");
    for (size_t i = 0; i < analysis->shown.count; i++)
        fracas_json_text(&json, NULL, analysis->table->column[analysis->shown.column[i]].path);
    fracas_json_close_array(&json);
    write_units(&json, analysis->table);
    fracas_json_array(&json, "points");
    for (size_t p = 0; p < analysis->table->npoints; p++) write_point(&json, analysis, p, fits);
    fracas_json_close_array(&json);
    write_slopes(&json, analysis);
    write_windows(&json, analysis);
    write_crossovers(&json, analysis);
    write_warnings(&json, analysis);
    fracas_json_close_object(&json);
    fracas_json_end(&json);
}

fracas_err fracas_analysis_write_json(const fracas_analysis *analysis, const char *study, FILE *out)
{
    fracas_fits *fits;
    size_t stale = 0;
    TRY(fracas_fits_read(study, &fits));
    if (fits) fracas_fits_keep(fits, analysis, &stale);
    fracas_summary_write(analysis, fits, stale, out);
    fracas_fits_destroy(fits);
    return FRACAS_OK;
}
