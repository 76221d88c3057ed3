/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of series: energies over time, convergence with replicas, slopes over the rates. */
#include "analysis/export/csv.h"

#include "analysis/scaling/scaling.h"
#include "analysis/summary/effects.h"
#include "base/own.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#define POINT                                                           \
    {                                                                   \
        "point", FRACAS_FIELD_INDEX, "1", "number of the point, from 0" \
    }

/* ---- energies ---- */

static const fracas_field time_field[] = {
    POINT,
    {"time", FRACAS_FIELD_NUMBER, "s", "time"},
    {"running", FRACAS_FIELD_INTEGER, "1",
     "realizations that had not ended before; the others count with what they had in the end"},
    {"realizations", FRACAS_FIELD_INTEGER, "1", "realizations that are taken"},
};
static const fracas_fields time_fields = FRACAS_FIELDS(time_field);

static fracas_err energy_rows(const fracas_csv_table *table, const fracas_analysis *analysis,
                              FILE *out)
{
    (void)table;
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
    .columns = {&time_fields, &fracas_energy_fields},
    .rows = energy_rows,
};

/* ---- convergence ---- */

static const fracas_field point_field[] = {POINT};
static const fracas_fields point_fields = FRACAS_FIELDS(point_field);

static fracas_err convergence_rows(const fracas_csv_table *table, const fracas_analysis *analysis,
                                   FILE *out)
{
    (void)table;
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
    .columns = {&point_fields, &fracas_running_fields},
    .rows = convergence_rows,
};

/* ---- slopes ---- */

typedef struct {
    const char *series, *kind;
    double rate[2];
    fracas_slope slope;
} slope_row;

static const fracas_field slope_field[] = {
    FRACAS_FIELD(slope_row, TEXT, "series", "",
                 "points alike in all that does not make the strain rate", series),
    FRACAS_FIELD(slope_row, TEXT, "kind", "",
                 "line: through all points of the series; count, count_large: such "
                 "lines of these means; window: between two neighbouring rates",
                 kind),
    FRACAS_FIELD(slope_row, INTEGER, "points", "1", "points of the study that it is of", slope.n),
    FRACAS_FIELD(slope_row, NUMBER, "from_rate", "1/s", "the lower strain rate of a window",
                 rate[0]),
    FRACAS_FIELD(slope_row, NUMBER, "to_rate", "1/s", "the higher strain rate of a window",
                 rate[1]),
    FRACAS_FIELD(slope_row, NUMBER, "slope", "1",
                 "d log(mean size)/d log(strain rate), of a count d log(mean count)", slope.slope),
    FRACAS_FIELD(slope_row, NUMBER, "standard_error", "1", "of the slope", slope.standard_error),
    FRACAS_FIELD(slope_row, NUMBER, "half_width", "1", "half width of its 95 % interval",
                 slope.half_width),
    FRACAS_FIELD(slope_row, NUMBER, "chi2", "1",
                 "squared residuals of a line, each over its variance", slope.chi2),
    FRACAS_FIELD(slope_row, NUMBER, "misfit", "1",
                 "probability of such a chi2 or more if the points are on a line", slope.misfit),
    FRACAS_FIELD(slope_row, NUMBER, "pooled_freedom", "1",
                 "degrees of freedom of the variance that points of a line share, if some do",
                 slope.pooled),
};
static const fracas_fields slope = FRACAS_FIELDS(slope_field);

static void put_slope(const slope_row *row, FILE *out)
{
    const fracas_fields rest = {slope.field + 1, slope.count - 1};
    fracas_csv_text(row->series, out);
    fracas_fields_csv(&rest, row, out);
    putc('\n', out);
}

static void put_lines(const char *kind, const fracas_size_slope *line, size_t count, FILE *out)
{
    for (size_t i = 0; i < count; i++)
        put_slope(&(slope_row){line[i].name, kind, {NAN, NAN}, line[i].slope}, out);
}

static fracas_err slope_rows(const fracas_csv_table *table, const fracas_analysis *analysis,
                             FILE *out)
{
    OWNED fracas_size_slope *line = NULL, *of_all = NULL, *of_large = NULL;
    OWNED fracas_size_window *window = NULL;
    size_t lines, all, large, windows = 0;
    (void)table;
    TRY(fracas_size_slopes(analysis, &line, &lines));
    TRY(fracas_count_slopes(analysis, true, &of_all, &all));
    TRY(fracas_count_slopes(analysis, false, &of_large, &large));
    TRY(fracas_size_windows(analysis, &window, &windows));
    put_lines("line", line, lines, out);
    for (size_t i = 0; i < windows; i++) {
        const fracas_size_window *w = &window[i];
        const fracas_slope between = {.n = 2,
                                      .slope = w->window.slope,
                                      .standard_error = w->window.standard_error,
                                      .half_width = w->window.half_width,
                                      .chi2 = NAN,
                                      .misfit = NAN,
                                      .pooled = NAN};
        put_slope(&(slope_row){w->name, "window", {w->rate[0], w->rate[1]}, between}, out);
    }
    put_lines("count", of_all, all, out);
    put_lines("count_large", of_large, large, out);
    return FRACAS_OK;
}

const fracas_csv_table fracas_csv_table_slopes = {
    .name = "slopes",
    .doc = "A line a slope of mean size, or mean count, against strain rate",
    .key = {"series", "kind", "from_rate"},
    .columns = {&slope},
    .rows = slope_rows,
};

/* ---- effects ---- */

static fracas_err effect_rows(const fracas_csv_table *table, const fracas_analysis *analysis,
                              FILE *out)
{
    OWNED fracas_effect *effect = NULL;
    size_t count;
    (void)table;
    TRY(fracas_effects(analysis, &effect, &count));
    for (size_t i = 0; i < count; i++) {
        const fracas_field *first = fracas_effect_fields.field;
        const fracas_fields rest = {first + 1, fracas_effect_fields.count - 1};
        fracas_field_csv(first, &effect[i], out);
        fracas_fields_csv(&rest, &effect[i], out);
        putc('\n', out);
    }
    return FRACAS_OK;
}

const fracas_csv_table fracas_csv_table_effects = {
    .name = "effects",
    .doc = "A line a change of mean count and size from one value of a parameter to the next",
    .key = {"parameter", "from", "at"},
    .columns = {&fracas_effect_fields},
    .rows = effect_rows,
};
