/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of series: energies over time, convergence with replicas, slopes over the rates. */
#include "analysis/export/csv.h"

#include "analysis/scaling/slope.h"
#include "analysis/scaling/windows.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const fracas_field point_field = {"point", FRACAS_FIELD_INDEX, "1",
                                         "number of the point, from 0"};

/* ---- energies ---- */

static void energy_fields(const fracas_analysis *analysis, fracas_field_visit *visit, void *context)
{
    static const fracas_field time[] = {
        {"time", FRACAS_FIELD_NUMBER, "s", "time"},
        {"running", FRACAS_FIELD_INTEGER, "1",
         "realizations that had not ended before; the others count with what they had in the end"},
        {"realizations", FRACAS_FIELD_INTEGER, "1", "realizations that are taken"},
    };
    static const fracas_fields times = FRACAS_FIELDS(time);
    (void)analysis;
    visit(context, &point_field);
    fracas_fields_walk(&times, ".", visit, context);
    fracas_fields_walk(&fracas_energy_fields, ".", visit, context);
}

static fracas_err energy_rows(const fracas_analysis *analysis, FILE *out)
{
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_bands *bands = &analysis->point[p].bands;
        for (size_t j = 0; j < bands->count; j++) {
            fprintf(out, "%zu", p);
            fracas_csv_real(bands->time[j], out);
            fprintf(out, ",%" PRId64 ",%" PRId64, bands->running[j], bands->realizations);
            fracas_fields_csv(&fracas_energy_fields, bands->energy[j], out);
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

static void convergence_fields(const fracas_analysis *analysis, fracas_field_visit *visit,
                               void *context)
{
    (void)analysis;
    visit(context, &point_field);
    fracas_fields_walk(&fracas_running_fields, ".", visit, context);
}

static fracas_err convergence_rows(const fracas_analysis *analysis, FILE *out)
{
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_replica_convergence *of = &analysis->point[p].convergence;
        for (const fracas_running *row = of->row; row < of->row + of->count; row++) {
            fprintf(out, "%zu", p);
            fracas_fields_csv(&fracas_running_fields, row, out);
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

typedef struct {
    const char *kind;
    int64_t points;
    double rate[2], slope, standard_error, half_width, chi2, misfit, pooled;
} slope_row;

static const fracas_field slope_field[] = {
    {"kind", FRACAS_FIELD_TEXT, "",
     "line: through all points of the series; window: between two neighbouring rates",
     offsetof(slope_row, kind)},
    {"points", FRACAS_FIELD_INTEGER, "1", "points of the study that it is of",
     offsetof(slope_row, points)},
    {"from_rate", FRACAS_FIELD_NUMBER, "1/s", "the lower strain rate of a window",
     offsetof(slope_row, rate[0])},
    {"to_rate", FRACAS_FIELD_NUMBER, "1/s", "the higher strain rate of a window",
     offsetof(slope_row, rate[1])},
    {"slope", FRACAS_FIELD_NUMBER, "1", "d log(mean size)/d log(strain rate)",
     offsetof(slope_row, slope)},
    {"standard_error", FRACAS_FIELD_NUMBER, "1", "of the slope",
     offsetof(slope_row, standard_error)},
    {"half_width", FRACAS_FIELD_NUMBER, "1", "half width of its 95 % interval",
     offsetof(slope_row, half_width)},
    {"chi2", FRACAS_FIELD_NUMBER, "1", "squared residuals of a line, each over its variance",
     offsetof(slope_row, chi2)},
    {"misfit", FRACAS_FIELD_NUMBER, "1",
     "probability of such a chi2 or more if the points are on a line", offsetof(slope_row, misfit)},
    {"pooled_freedom", FRACAS_FIELD_NUMBER, "1",
     "degrees of freedom of the variance that points of a line share, if some do",
     offsetof(slope_row, pooled)},
};
static const fracas_fields slope = FRACAS_FIELDS(slope_field);

static void slope_fields(const fracas_analysis *analysis, fracas_field_visit *visit, void *context)
{
    (void)analysis;
    visit(context, &(fracas_field){"series", FRACAS_FIELD_TEXT, "",
                                   "points alike in all that does not make the strain rate"});
    fracas_fields_walk(&slope, ".", visit, context);
}

static void put_slope(const char *series, const slope_row *row, FILE *out)
{
    fracas_csv_text(series, out);
    fracas_fields_csv(&slope, row, out);
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
        put_slope(line[i].name,
                  &(slope_row){"line",
                               s->n,
                               {NAN, NAN},
                               s->slope,
                               s->standard_error,
                               s->half_width,
                               s->chi2,
                               s->misfit,
                               s->pooled},
                  out);
    }
    for (size_t i = 0; i < windows && !err; i++) {
        const fracas_size_window *w = &window[i];
        put_slope(w->name,
                  &(slope_row){"window",
                               2,
                               {w->rate[0], w->rate[1]},
                               w->window.slope,
                               w->window.standard_error,
                               w->window.half_width,
                               NAN,
                               NAN,
                               NAN},
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
