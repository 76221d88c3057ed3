/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON summary. Its keys are those of fracas_statistics and of /point: they do not change. */
#include "analysis/export/csv.h"
#include "analysis/export/tables.h"
#include "analysis/scaling/scaling.h"
#include "analysis/summary/effects.h"
#include "base/own.h"
#include "base/param.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- fits ---- */

static fracas_fits rows_of(const fracas_fits *fits, size_t point)
{
    fracas_fits of = {.n = 0};
    for (size_t i = 0; fits && i < fits->n; i++) {
        if (fits->row[i].point != (int64_t)point) continue;
        if (!of.row) of.row = &fits->row[i];
        of.n++;
    }
    return of;
}

static const fracas_fits_row *find(const fracas_fits *of, const char *family, const char *quantity)
{
    return fracas_fits_find(of, of->row->point, family, quantity);
}

static void put_value(fracas_json *json, const fracas_fits *of, const char *family,
                      const char *quantity)
{
    fracas_json_real(json, quantity, fracas_fits_value(of, of->row->point, family, quantity));
}

static void put_interval(fracas_json *json, const fracas_fits_row *row)
{
    fracas_json_object(json, row->quantity);
    fracas_json_real(json, "value", row->value);
    fracas_json_real(json, "low", row->low);
    fracas_json_real(json, "high", row->high);
    fracas_json_text(json, "unit", row->unit);
    fracas_json_integer(json, "resamples", row->resamples);
    fracas_json_close(json);
}

static void put_data(fracas_json *json, const fracas_fits *of)
{
    static const char *const plain[] = {"realizations", "whole",   "fragments", "above_cut",
                                        "cut",          "lattice", "cells"},
                             *const ends[] = {"mean", "cv"};
    fracas_json_object(json, "data");
    fracas_json_text(json, "fingerprint",
                     find(of, "data", "fingerprint")->note); /* it was compared: fracas_fits_keep */
    for (size_t i = 0; i < FRACAS_COUNT(plain); i++) put_value(json, of, "data", plain[i]);
    for (size_t i = 0; i < FRACAS_COUNT(ends); i++) {
        const fracas_fits_row *row = find(of, "data", ends[i]);
        if (row) put_interval(json, row);
    }
    fracas_json_close(json);
}

/* True of "x0" and "x0/mean" of a family with a parameter x0. */
static bool is_parameter(const fracas_family *family, const char *quantity)
{
    const size_t length = strcspn(quantity, "/");
    for (size_t i = 0; i < family->nparameters; i++)
        if (strlen(family->parameter[i].name) == length &&
            !strncmp(family->parameter[i].name, quantity, length))
            return true;
    return false;
}

static void put_family(fracas_json *json, const fracas_fits *of, const fracas_family *family,
                       const fracas_fits_row *fitted)
{
    static const char *const plain[] = {"rank", "log_likelihood", "aicc", "delta_aicc", "bic",
                                        "ks",   "ks_p",           "ad",   "ad_p"};
    const fracas_fits_row *p = find(of, family->name, "ks_p");
    fracas_json_object(json, NULL);
    fracas_json_text(json, "family", family->name);
    fracas_json_boolean(json, "fitted", fitted->value == 1);
    fracas_json_text(json, "reason", *fitted->note ? fitted->note : NULL);
    for (size_t i = 0; i < FRACAS_COUNT(plain); i++) put_value(json, of, family->name, plain[i]);
    fracas_json_integer(json, "resamples", p ? p->resamples : 0);
    fracas_json_object(json, "parameters");
    for (size_t i = 0; i < of->n; i++)
        if (!strcmp(of->row[i].family, family->name) && is_parameter(family, of->row[i].quantity))
            put_interval(json, &of->row[i]);
    fracas_json_close(json);
    fracas_json_close(json);
}

static void put_comparison(fracas_json *json, const fracas_fits *of)
{
    const fracas_fits_row *p = find(of, "comparison", "p");
    if (!p) return;
    fracas_json_object(json, "comparison");
    put_value(json, of, "comparison", "vuong");
    put_value(json, of, "comparison", "likelihood_ratio");
    fracas_json_real(json, "p", p->value);
    fracas_json_integer(json, "resamples", p->resamples);
    fracas_json_text(json, "note", p->note);
    fracas_json_close(json);
}

static void put_fits(fracas_json *json, size_t point, const fracas_fits *fits)
{
    const fracas_fits of = rows_of(fits, point);
    if (of.n == 0) {
        fracas_json_text(json, "fits", NULL);
        return;
    }
    fracas_json_object(json, "fits");
    fracas_json_text(json, "preferred", fracas_fits_ranked(&of, (int64_t)point, 1));
    put_data(json, &of);
    fracas_json_array(json, "families");
    for (size_t f = 0; f < FRACAS_NFAMILIES; f++) {
        const fracas_fits_row *fitted = find(&of, fracas_families[f]->name, "fitted");
        if (fitted) put_family(json, &of, fracas_families[f], fitted);
    }
    fracas_json_close(json);
    put_comparison(json, &of);
    fracas_json_close(json);
}

/* ---- convergence ---- */

static void put_convergence(fracas_json *json, const fracas_analysis *analysis, size_t point)
{
    const fracas_replica_convergence *of = &analysis->point[point].convergence;
    fracas_json_array(json, "convergence");
    for (const fracas_running *row = of->row; row < of->row + of->count; row++)
        fracas_fields_json_object(json, NULL, &fracas_running_fields, row);
    fracas_json_close(json);
}

/* ---- energies ---- */

/* The bands themselves are a file of their own: with them a summary would be mostly energies, and
 * as long as somebody asks histories to be. */
static void put_energies(fracas_json *json, const fracas_analysis *analysis, size_t point)
{
    const fracas_bands *bands = &analysis->point[point].bands;
    char file[64];
    if (bands->count == 0) {
        fracas_json_text(json, "energies", NULL);
        return;
    }
    const size_t last = bands->count - 1;
    FRACAS_PRINT(file, "%s.csv", fracas_csv_table_energies.name);
    fracas_json_object(json, "energies");
    fracas_json_text(json, "file", file);
    fracas_json_integer(json, "times", (int64_t)bands->count);
    fracas_json_integer(json, "realizations", bands->realizations);
    fracas_json_text(json, "band",
                     bands->extremes ? "least to greatest" : "quantiles 0.05 to 0.95");
    fracas_json_object(json, "end");
    fracas_json_real(json, "time", bands->time[last]);
    fracas_json_integer(json, "running", bands->running[last]);
    fracas_fields_json(json, &fracas_energy_fields, bands->energy[last]);
    fracas_json_close(json);
    fracas_json_close(json);
}

/* Whether a parameter, derived or not, differs at some points: one a column, freed by the caller;
 * NULL without memory. */
static bool *find_varying(const fracas_point_table *table)
{
    bool *varies = calloc(table->ncolumns + 1, sizeof *varies);
    for (size_t c = 0; varies && c < table->ncolumns; c++)
        for (size_t p = 1; p < table->npoints && !varies[c]; p++)
            varies[c] = !fracas_value_same(&table->point[0].value[c], &table->point[p].value[c]);
    return varies;
}

/* Parameters of the point whose entry of `varies` is `varying`; all without it. */
static void write_parameters(fracas_json *json, const fracas_point_table *table, size_t p,
                             const bool *varies, bool varying)
{
    fracas_json_object(json, "parameters");
    for (size_t c = 0; c < table->ncolumns; c++) {
        const fracas_value *value = &table->point[p].value[c];
        if (varies && varies[c] != varying) continue;
        if (table->column[c].text)
            fracas_json_text(json, table->column[c].path, *value->text ? value->text : NULL);
        else fracas_json_real(json, table->column[c].path, value->real);
    }
    fracas_json_close(json);
}

static void write_unit(void *json, const fracas_field *leaf)
{
    fracas_json_text(json, leaf->key, leaf->unit);
}

/* Units of every number below "parameters" and "statistics": the document explains itself. */
static void write_units(fracas_json *json, const fracas_point_table *table)
{
    fracas_json_object(json, "units");
    fracas_json_object(json, "parameters");
    for (size_t c = 0; c < table->ncolumns; c++)
        if (!table->column[c].text)
            fracas_json_text(json, table->column[c].path, table->column[c].unit);
    fracas_json_close(json);
    fracas_json_object(json, "statistics");
    fracas_fields_walk(&fracas_statistics, ".", write_unit, json);
    fracas_json_close(json);
    fracas_json_close(json);
}

static void write_statistics(fracas_json *json, const fracas_point_statistics *statistics)
{
    fracas_json_object(json, "statistics");
    fracas_fields_json_flat(json, &fracas_statistics, statistics);
    fracas_json_close(json);
    fracas_json_object(json, "outcomes");
    for (int o = 0; o < FRACAS_NOUTCOMES; o++)
        fracas_json_integer(json, fracas_outcome_name(o), statistics->outcome[o]);
    fracas_json_close(json);
}

/* The last decision on the replicas of a point, for print. */
typedef struct {
    const char *quantity;
    int64_t rounds;
    fracas_decision last;
    bool at_maximum;
} decision_row;

static const fracas_field decision_field[] = {
    FRACAS_FIELD(decision_row, TEXT, "quantity", "", "number that the rule looks at", quantity),
    FRACAS_FIELD(decision_row, INTEGER, "rounds", "1", "rounds so far", rounds),
    FRACAS_FIELD(decision_row, INTEGER, "used", "1", "realizations in the mean", last.used),
    FRACAS_FIELD(decision_row, NUMBER, "mean", "", "mean of the quantity, in its unit", last.mean),
    FRACAS_FIELD(decision_row, NUMBER, "half_width", "", "half width of the interval of the mean",
                 last.half_width),
    FRACAS_FIELD(decision_row, NUMBER, "relative_half_width", "1",
                 "the rule's limit of half width / mean", last.relative_half_width),
    FRACAS_FIELD(decision_row, NUMBER, "confidence", "1", "confidence of the interval",
                 last.confidence),
    FRACAS_FIELD(decision_row, BOOLEAN, "at_maximum", "",
                 "true if the rule stopped at the most replicas", at_maximum),
};
static const fracas_fields decision_fields = FRACAS_FIELDS(decision_field);

static void write_decision(fracas_json *json, const fracas_decision *last)
{
    if (!last) return;
    const decision_row row = {fracas_analysis_quantity(last), last->round + 1, *last,
                              last->stop == 2};
    fracas_fields_json_object(json, "decision", &decision_fields, &row);
}

/* The headline statistics: of estimates by the beginnings of their keys. */
static bool is_headline(const char *key)
{
    static const char *const keys[] = {"realizations", "usable",    "count.",   "count_large.",
                                       "size.",        "created",   "elements", "dissipated.",
                                       "residual",     "dust_share"};
    for (size_t i = 0; i < FRACAS_COUNT(keys); i++) {
        const size_t length = strlen(keys[i]);
        if (keys[i][length - 1] == '.' ? !strncmp(key, keys[i], length) : !strcmp(key, keys[i]))
            return true;
    }
    return false;
}

typedef struct {
    fracas_json *json;
    const fracas_point_statistics *statistics;
} headlines;

static void write_headline(void *context, const fracas_field *leaf)
{
    const headlines *to = context;
    const fracas_fields one = {leaf, 1};
    if (is_headline(leaf->key)) fracas_fields_json(to->json, &one, to->statistics);
}

static void write_brief_point(fracas_json *json, const fracas_analysis *analysis, size_t p,
                              const bool *varies)
{
    const fracas_label label = fracas_analysis_label(analysis, p);
    headlines to = {json, &analysis->point[p]};
    fracas_json_object(json, NULL);
    fracas_json_text(json, "label", label.text);
    fracas_json_text(json, "hash", fracas_hash_hex(&analysis->table->point[p].hash).text);
    fracas_json_integer(json, "replicas", analysis->table->point[p].replicas);
    write_parameters(json, analysis->table, p, varies, true);
    fracas_json_object(json, "statistics");
    fracas_fields_walk(&fracas_statistics, ".", write_headline, &to);
    fracas_json_close(json);
    fracas_json_close(json);
}

static void write_point(fracas_json *json, const fracas_analysis *analysis, size_t p,
                        const fracas_fits *fits)
{
    const fracas_label label = fracas_analysis_label(analysis, p);
    const fracas_progress progress = fracas_analysis_progress_of(analysis, p);
    fracas_json_object(json, NULL);
    fracas_json_text(json, "label", label.text);
    fracas_json_text(json, "hash", fracas_hash_hex(&analysis->table->point[p].hash).text);
    fracas_json_integer(json, "replicas", analysis->table->point[p].replicas);
    fracas_fields_json_object(json, "progress", &fracas_progress_fields, &progress);
    write_decision(json, fracas_analysis_decision(analysis, p));
    write_parameters(json, analysis->table, p, NULL, false);
    write_statistics(json, &analysis->point[p]);
    fracas_json_object(json, "reasons");
    if (analysis->point[p].without_mott)
        fracas_json_text(json, "law.mott", analysis->point[p].without_mott);
    fracas_json_close(json);
    put_convergence(json, analysis, p);
    put_energies(json, analysis, p);
    put_fits(json, p, fits);
    fracas_json_close(json);
}

/* A list of `count` structs of `size` bytes, freed; where it could not be made, the message. */
static void write_list(fracas_json *json, const char *key, const fracas_fields *fields,
                       fracas_err made, void *list, size_t count, size_t size)
{
    fracas_json_array(json, key);
    if (made) fracas_json_text(json, NULL, fracas_message());
    for (size_t i = 0; i < count && !made; i++)
        fracas_fields_json_object(json, NULL, fields, (const char *)list + i * size);
    fracas_json_close(json);
    if (!made) free(list);
}

/* Without rows of single settings, which effects.csv has. */
static void write_effects(fracas_json *json, const fracas_analysis *analysis)
{
    OWNED fracas_effect *effect = NULL;
    size_t count = 0;
    fracas_json_array(json, "effects");
    if (fracas_effects(analysis, &effect, &count)) fracas_json_text(json, NULL, fracas_message());
    for (size_t i = 0; i < count; i++)
        if (!*effect[i].at)
            fracas_fields_json_object(json, NULL, &fracas_effect_fields, &effect[i]);
    fracas_json_close(json);
}

static void write_lists(fracas_json *json, const fracas_analysis *analysis)
{
    fracas_size_slope *slope;
    fracas_size_window *window;
    fracas_size_crossover *crossover;
    fracas_warning *warning;
    size_t count = 0;
    fracas_err made = fracas_size_slopes(analysis, &slope, &count);
    write_list(json, "slopes", &fracas_slope_fields, made, slope, count, sizeof *slope);
    made = fracas_count_slopes(analysis, true, &slope, &count);
    write_list(json, "count_slopes", &fracas_slope_fields, made, slope, count, sizeof *slope);
    made = fracas_count_slopes(analysis, false, &slope, &count);
    write_list(json, "count_large_slopes", &fracas_slope_fields, made, slope, count, sizeof *slope);
    made = fracas_size_windows(analysis, &window, &count);
    write_list(json, "windows", &fracas_window_fields, made, window, count, sizeof *window);
    made = fracas_size_crossovers(analysis, true, &crossover, &count);
    write_list(json, "crossovers", &fracas_crossover_fields, made, crossover, count,
               sizeof *crossover);
    write_effects(json, analysis);
    made = fracas_analysis_warnings(analysis, &warning, &count);
    write_list(json, "warnings", &fracas_warning_fields, made, warning, count, sizeof *warning);
}

void fracas_analysis_reference(FILE *out)
{
    static const struct {
        const char *title;
        const fracas_fields *fields;
    } section[] = {
        {"`progress`, of the study and of a point", &fracas_progress_fields},
        {"`decision` of a point", &decision_fields},
        {"A row of `convergence`", &fracas_running_fields},
        {"Energies in `energies.end`", &fracas_energy_fields},
        {"A row of `slopes`, `count_slopes` and `count_large_slopes`", &fracas_slope_fields},
        {"A row of `windows`", &fracas_window_fields},
        {"A row of `crossovers`", &fracas_crossover_fields},
        {"A row of `effects`", &fracas_effect_fields},
        {"A row of `warnings`", &fracas_warning_fields},
        {"`statistics`", &fracas_statistics},
    };
    for (size_t i = 0; i < sizeof section / sizeof *section; i++) {
        fprintf(out, "%s### %s\n\n", i ? "\n" : "", section[i].title);
        fracas_fields_reference(section[i].fields, section[i].fields != &fracas_statistics, out);
    }
}

static void write_points(fracas_json *json, const fracas_analysis *analysis,
                         const fracas_fits *fits, bool brief, const bool *varies)
{
    fracas_json_array(json, "points");
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        if (brief) write_brief_point(json, analysis, p, varies);
        else write_point(json, analysis, p, fits);
    }
    fracas_json_close(json);
}

static void write_columns(fracas_json *json, const char *key, const fracas_point_table *table,
                          const fracas_columns *columns)
{
    fracas_json_array(json, key);
    for (size_t i = 0; i < columns->count; i++)
        fracas_json_text(json, NULL, table->column[columns->column[i]].path);
    fracas_json_close(json);
}

static void write_axes(fracas_json *json, const fracas_analysis *analysis)
{
    const fracas_means_axes *axes = &analysis->axes;
    fracas_json_object(json, "axes");
    fracas_json_text(json, "x", *axes->key ? axes->key : NULL);
    write_columns(json, "series", analysis->table, &axes->series);
    write_columns(json, "panels", analysis->table, &axes->panels);
    write_columns(json, "drawings", analysis->table, &axes->drawings);
    fracas_json_close(json);
}

void fracas_summary_write(const fracas_analysis *analysis, const fracas_shown_fits *shown,
                          bool brief, FILE *out)
{
    char seed[24];
    FRACAS_PRINT(seed, "%" PRIu64, analysis->header.seed);
    const fracas_progress progress = fracas_analysis_progress(analysis);
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "name", analysis->name);
    fracas_json_text(&json, "campaign", fracas_hash_hex(&analysis->header.campaign).text);
    fracas_json_text(&json, "seed", seed); /* text: of 64 bits */
    fracas_json_text(&json, "version", analysis->header.version);
    fracas_json_text(&json, "form", brief ? "brief" : "whole");
    fracas_json_boolean(&json, "complete", analysis->header.complete);
    fracas_json_boolean(&json, "partial", fracas_results_partial(analysis->results));
    fracas_fields_json_object(&json, "progress", &fracas_progress_fields, &progress);
    fracas_json_integer(&json, "stale_fits", (int64_t)shown->stale);
    fracas_json_text(&json, "fits_left_out", shown->left_out);
    write_columns(&json, "varying", analysis->table, &analysis->shown);
    write_axes(&json, analysis);
    write_units(&json, analysis->table);
    OWNED bool *varies = brief ? find_varying(analysis->table) : NULL;
    if (brief) write_parameters(&json, analysis->table, 0, varies, false);
    write_points(&json, analysis, shown->fits, brief, varies);
    write_lists(&json, analysis);
    fracas_json_end(&json);
}

fracas_err fracas_analysis_write_json(const fracas_analysis *analysis, const char *study, FILE *out)
{
    FRACAS_CLEARED(fracas_shown_fits) shown = {0};
    TRY(fracas_shown_fits_read(study, analysis, &shown));
    fracas_summary_write(analysis, &shown, false, out);
    return FRACAS_OK;
}
