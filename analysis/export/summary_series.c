/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys of a point beside its statistics: fits, convergence with replicas, energies over time. */
#include "analysis/export/summary.h"

#include "analysis/export/csv.h"
#include "base/param.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- fits ---- */

/* The rows of fits.csv of one point; they stand together. */
typedef struct {
    const fracas_fits_row *row;
    size_t count;
} point_rows;

static point_rows rows_of(const fracas_fits *fits, size_t point)
{
    point_rows of = {0};
    for (size_t i = 0; fits && i < fits->n; i++) {
        if (fits->row[i].point != (int64_t)point) continue;
        if (!of.row) of.row = &fits->row[i];
        of.count++;
    }
    return of;
}

static const fracas_fits_row *find(const point_rows *of, const char *family, const char *quantity)
{
    for (size_t i = 0; i < of->count; i++)
        if (!strcmp(of->row[i].family, family) && !strcmp(of->row[i].quantity, quantity))
            return &of->row[i];
    return NULL;
}

static void put_value(fracas_json *json, const point_rows *of, const char *family,
                      const char *quantity)
{
    const fracas_fits_row *row = find(of, family, quantity);
    fracas_json_real(json, quantity, row ? row->value : NAN);
}

static void put_interval(fracas_json *json, const fracas_fits_row *row)
{
    fracas_json_object(json, row->quantity);
    fracas_json_real(json, "value", row->value);
    fracas_json_real(json, "low", row->low);
    fracas_json_real(json, "high", row->high);
    fracas_json_text(json, "unit", row->unit);
    fracas_json_integer(json, "resamples", row->resamples);
    fracas_json_close_object(json);
}

static void put_data(fracas_json *json, const point_rows *of)
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
    fracas_json_close_object(json);
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

static void put_family(fracas_json *json, const point_rows *of, const fracas_family *family,
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
    for (size_t i = 0; i < of->count; i++)
        if (!strcmp(of->row[i].family, family->name) && is_parameter(family, of->row[i].quantity))
            put_interval(json, &of->row[i]);
    fracas_json_close_object(json);
    fracas_json_close_object(json);
}

static void put_comparison(fracas_json *json, const point_rows *of)
{
    const fracas_fits_row *p = find(of, "comparison", "p");
    if (!p) return;
    fracas_json_object(json, "comparison");
    put_value(json, of, "comparison", "vuong");
    put_value(json, of, "comparison", "likelihood_ratio");
    fracas_json_real(json, "p", p->value);
    fracas_json_integer(json, "resamples", p->resamples);
    fracas_json_text(json, "note", p->note);
    fracas_json_close_object(json);
}

static const char *preferred(const point_rows *of)
{
    for (size_t i = 0; i < of->count; i++)
        if (!strcmp(of->row[i].quantity, "rank") && of->row[i].value == 1) return of->row[i].family;
    return NULL;
}

void fracas_summary_put_fits(fracas_json *json, size_t point, const fracas_fits *fits)
{
    const point_rows of = rows_of(fits, point);
    if (of.count == 0) {
        fracas_json_text(json, "fits", NULL);
        return;
    }
    fracas_json_object(json, "fits");
    fracas_json_text(json, "preferred", preferred(&of));
    put_data(json, &of);
    fracas_json_array(json, "families");
    for (size_t f = 0; f < FRACAS_NFAMILIES; f++) {
        const fracas_fits_row *fitted = find(&of, fracas_families[f]->name, "fitted");
        if (fitted) put_family(json, &of, fracas_families[f], fitted);
    }
    fracas_json_close_array(json);
    put_comparison(json, &of);
    fracas_json_close_object(json);
}

/* ---- convergence ---- */

void fracas_summary_put_convergence(fracas_json *json, const fracas_analysis *analysis,
                                    size_t point)
{
    const fracas_replica_convergence *of = &analysis->point[point].convergence;
    fracas_json_array(json, "convergence");
    for (const fracas_running *row = of->row; row < of->row + of->count; row++)
        fracas_fields_json_object(json, NULL, &fracas_running_fields, row);
    fracas_json_close_array(json);
}

/* ---- energies ---- */

/* The bands themselves are a file of their own: with them a summary would be mostly energies, and
 * as long as somebody asks histories to be. */
void fracas_summary_put_energies(fracas_json *json, const fracas_analysis *analysis, size_t point)
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
    fracas_json_close_object(json);
    fracas_json_close_object(json);
}
