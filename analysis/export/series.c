/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of series: energies over time, convergence with replicas, slopes over the rates. */
#include "analysis/export/csv.h"

#include "analysis/scaling/slope.h"
#include "analysis/scaling/windows.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_fields(const fracas_field *field, size_t count, fracas_field_sink *sink,
                       void *context)
{
    for (size_t f = 0; f < count; f++) sink(context, &field[f]);
}

/* KEY.value, KEY.low, KEY.high; `middle` is what the first is called. */
static void put_three(const char *key, const char *middle, const char *unit, const char *doc,
                      fracas_field_sink *sink, void *context)
{
    const char *const name[3] = {middle, "low", "high"}, *const of[3] = {
                                                             "",
                                                             "lower end of its band or interval: ",
                                                             "upper end of its band or interval: "};
    for (int i = 0; i < 3; i++) {
        char full[64], text[160];
        snprintf(full, sizeof full, "%s.%s", key, name[i]);
        snprintf(text, sizeof text, "%s%s", of[i], doc);
        sink(context, &(fracas_field){full, FRACAS_FIELD_NUMBER, unit, text, false});
    }
}

/* ---- energies ---- */

static void energy_fields(const fracas_analysis *analysis, fracas_field_sink *sink, void *context)
{
    (void)analysis;
    static const fracas_field field[] = {
        {"point", FRACAS_FIELD_INTEGER, "1", "number of the point, from 0", false},
        {"time", FRACAS_FIELD_NUMBER, "s", "time", false},
        {"running", FRACAS_FIELD_INTEGER, "1",
         "realizations that had not ended before; the others count with what they had in the end",
         false},
        {"realizations", FRACAS_FIELD_INTEGER, "1", "realizations that are taken", false},
    };
    put_fields(field, sizeof field / sizeof *field, sink, context);
    for (int e = 0; e < FRACAS_NENERGIES; e++)
        put_three(fracas_energy_key[e], "mean", "J", "energy over realizations", sink, context);
}

static fracas_err energy_rows(const fracas_analysis *analysis, FILE *out)
{
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_bands *bands = &analysis->point[p].bands;
        for (size_t j = 0; j < bands->count; j++) {
            fprintf(out, "%zu", p);
            fracas_csv_real(bands->time[j], out);
            fprintf(out, ",%" PRId64 ",%" PRId64, bands->running[j], bands->realizations);
            for (int e = 0; e < FRACAS_NENERGIES; e++) {
                fracas_csv_real(bands->energy[j][e].mean, out);
                fracas_csv_real(bands->energy[j][e].low, out);
                fracas_csv_real(bands->energy[j][e].high, out);
            }
            putc('\n', out);
        }
    }
    return FRACAS_OK;
}

const fracas_csv_table fracas_csv_table_energies = {
    .name = "energies",
    .doc = "A line a time of a point: its energies over realizations, mean and band",
    .key = {"point", "time"},
    .parent = &fracas_csv_table_points,
    .fields = energy_fields,
    .rows = energy_rows,
};

/* ---- convergence ---- */

static const char *unit_of(const char *key)
{
    char full[2][64];
    snprintf(full[0], sizeof full[0], "%s.mean", key);
    snprintf(full[1], sizeof full[1], "%s.value", key);
    for (size_t i = 0; i < fracas_nstatistics; i++)
        if (!strcmp(fracas_statistics[i].key, full[0]) ||
            !strcmp(fracas_statistics[i].key, full[1]))
            return fracas_statistics[i].unit;
    return "1";
}

static void convergence_fields(const fracas_analysis *analysis, fracas_field_sink *sink,
                               void *context)
{
    (void)analysis;
    static const fracas_field field[] = {
        {"point", FRACAS_FIELD_INTEGER, "1", "number of the point, from 0", false},
        {"replicas", FRACAS_FIELD_INTEGER, "1", "the first so many usable ones", false},
    };
    put_fields(field, sizeof field / sizeof *field, sink, context);
    for (int h = 0; h < FRACAS_NHEADLINES; h++)
        put_three(fracas_headline_key[h], "value", unit_of(fracas_headline_key[h]),
                  "as in points.csv, of these replicas", sink, context);
}

static fracas_err convergence_rows(const fracas_analysis *analysis, FILE *out)
{
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_replica_convergence *of = &analysis->point[p].convergence;
        for (const fracas_running *row = of->row; row < of->row + of->count; row++) {
            fprintf(out, "%zu,%" PRId64, p, row->replicas);
            for (int h = 0; h < FRACAS_NHEADLINES; h++) {
                fracas_csv_real(row->number[h].value, out);
                fracas_csv_real(row->number[h].low, out);
                fracas_csv_real(row->number[h].high, out);
            }
            putc('\n', out);
        }
    }
    return FRACAS_OK;
}

const fracas_csv_table fracas_csv_table_convergence = {
    .name = "convergence",
    .doc = "A line a number of replicas: the headline numbers of a point from its first 4, 8, 16, "
           "... replicas and from all",
    .key = {"point", "replicas"},
    .parent = &fracas_csv_table_points,
    .fields = convergence_fields,
    .rows = convergence_rows,
};

/* ---- slopes ---- */

static void slope_fields(const fracas_analysis *analysis, fracas_field_sink *sink, void *context)
{
    (void)analysis;
    static const fracas_field field[] = {
        {"series", FRACAS_FIELD_TEXT, "", "points alike in all that does not make the strain rate",
         false},
        {"kind", FRACAS_FIELD_TEXT, "",
         "line: through all points of the series; window: between two neighbouring rates", false},
        {"points", FRACAS_FIELD_INTEGER, "1", "points of the study that it is of", false},
        {"from_rate", FRACAS_FIELD_NUMBER, "1/s", "the lower strain rate of a window", false},
        {"to_rate", FRACAS_FIELD_NUMBER, "1/s", "the higher strain rate of a window", false},
        {"slope", FRACAS_FIELD_NUMBER, "1", "d log(mean size)/d log(strain rate)", false},
        {"standard_error", FRACAS_FIELD_NUMBER, "1", "of the slope", false},
        {"half_width", FRACAS_FIELD_NUMBER, "1", "half width of its 95 % interval", false},
        {"chi2", FRACAS_FIELD_NUMBER, "1", "squared residuals of a line, each over its variance",
         false},
        {"misfit", FRACAS_FIELD_NUMBER, "1",
         "probability of such a chi2 or more if the points are on a line", false},
        {"pooled_freedom", FRACAS_FIELD_NUMBER, "1",
         "degrees of freedom of the variance that points of a line share, if some do", false},
    };
    put_fields(field, sizeof field / sizeof *field, sink, context);
}

static void put_slope(const char *series, const char *kind, int64_t points, const double value[8],
                      FILE *out)
{
    fracas_csv_text(series, out);
    fprintf(out, ",%s,%" PRId64, kind, points);
    for (size_t v = 0; v < 8; v++) fracas_csv_real(value[v], out);
    putc('\n', out);
}

static fracas_err slope_rows(const fracas_analysis *analysis, FILE *out)
{
    fracas_size_slope *line;
    fracas_size_window *window = NULL;
    size_t lines, windows = 0;
    TRY(fracas_size_slopes(analysis, &line, &lines));
    fracas_err err = fracas_size_windows(analysis, &window, &windows);
    for (size_t i = 0; i < lines && !err; i++) {
        const fracas_slope *s = &line[i].slope;
        put_slope(line[i].name, "line", s->n,
                  (double[8]){NAN, NAN, s->slope, s->standard_error, s->half_width, s->chi2,
                              s->misfit, s->pooled},
                  out);
    }
    for (size_t i = 0; i < windows && !err; i++) {
        const fracas_size_window *w = &window[i];
        put_slope(w->name, "window", 2,
                  (double[8]){w->rate[0], w->rate[1], w->window.slope, w->window.standard_error,
                              w->window.half_width, NAN, NAN, NAN},
                  out);
    }
    free(line);
    if (!err) free(window);
    return err;
}

const fracas_csv_table fracas_csv_table_slopes = {
    .name = "slopes",
    .doc = "A line a slope of mean size against strain rate",
    .key = {"series", "kind", "from_rate"},
    .fields = slope_fields,
    .rows = slope_rows,
};
