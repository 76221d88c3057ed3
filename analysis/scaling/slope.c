/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/scaling/scaling.h"

#include "analysis/summary/study.h"
#include "analysis/data/room.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

#define NUMBER(key, doc, member) FRACAS_FIELD(fracas_size_slope, NUMBER, key, "1", doc, member)
static const fracas_field fields[] = {
    FRACAS_FIELD(fracas_size_slope, CHARS, "series", "", "name of the series, or all points", name),
    FRACAS_FIELD(fracas_size_slope, INTEGER, "points", "1", "points on the line", slope.n),
    NUMBER("slope", "d log(mean size)/d log(strain rate)", slope.slope),
    NUMBER("standard_error", "standard error of the slope", slope.standard_error),
    NUMBER("half_width", "half width of the 95 % interval of the slope", slope.half_width),
    NUMBER("chi2", "squared residuals of the line, each over its variance", slope.chi2),
    NUMBER("misfit", "probability of such a chi2 or more if the points are on a line",
           slope.misfit),
    NUMBER("pooled_freedom",
           "degrees of freedom of the relative variance that points of fewer than eight replicas "
           "share; null where each has its own",
           slope.pooled),
    NUMBER("mott", "exponent of Mott's theory, to compare with", mott),
    NUMBER("grady", "exponent of Grady's theory, to compare with", grady),
};
const fracas_fields fracas_slope_fields = FRACAS_FIELDS(fields);

static bool known(double variance)
{
    return isfinite(variance) && variance > 0;
}

static double weight_of(const double *x, const double *y, const fracas_mean_error *error,
                        bool weighted, size_t i)
{
    if (!isfinite(x[i]) || !isfinite(y[i])) return 0;
    if (!weighted) return 1;
    return known(error[i].variance) ? 1 / error[i].variance : 0;
}

typedef struct {
    double weight, x, xx; /* sum w, weighted mean, sum w (x - mean)^2, 0 to rounding */
} moments;

/* Slope and intercept by (estimators.1). */
static moments fit(const double *x, const double *y, const fracas_mean_error *error, bool weighted,
                   size_t n, fracas_slope *line)
{
    moments of = {0};
    double mean_y = 0, xy = 0;
    for (size_t i = 0; i < n; i++) {
        double w = weight_of(x, y, error, weighted, i);
        if (!(w > 0)) continue;
        line->n++;
        of.weight += w;
        of.x += (x[i] - of.x) * w / of.weight; /* running means: no sum of values far from 0 */
        mean_y += (y[i] - mean_y) * w / of.weight;
    }
    for (size_t i = 0; i < n; i++) {
        double w = weight_of(x, y, error, weighted, i);
        if (!(w > 0)) continue;
        of.xx += w * (x[i] - of.x) * (x[i] - of.x);
        xy += w * (x[i] - of.x) * (y[i] - mean_y);
    }
    if (of.xx <= of.weight * 1e-20 * of.x * of.x) of.xx = 0;
    line->slope = xy / of.xx;
    line->intercept = mean_y - line->slope * of.x;
    return of;
}

/* (estimators.2), (estimators.3). */
fracas_slope fracas_slope_of(const double *x, const double *y, const fracas_mean_error *error,
                             size_t n)
{
    fracas_slope line = {.pooled = NAN}, none = {0, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    bool weighted = false;
    for (size_t i = 0; i < n; i++)
        weighted = weighted || (known(error[i].variance) && isfinite(x[i]) && isfinite(y[i]));
    const moments of = fit(x, y, error, weighted, n, &line);
    none.n = line.n;
    if (line.n < FRACAS_SLOPE_POINTS || !(of.xx > 0)) return none;
    double squares = 0;
    const double freedom = line.freedom = (double)(line.n - 2);
    fracas_misfit misfit = {0};
    for (size_t i = 0; i < n; i++) {
        double w = weight_of(x, y, error, weighted, i),
               residual = y[i] - line.intercept - line.slope * x[i];
        if (!(w > 0)) continue;
        squares += w * residual * residual;
        fracas_misfit_add(&misfit, w * (1 / of.weight + (x[i] - of.x) * (x[i] - of.x) / of.xx),
                          &error[i]);
    }
    double inflation = squares / freedom;
    if (weighted) inflation = fmax(1, inflation);
    line.chi2 = weighted ? squares : NAN;
    line.misfit = fracas_misfit_probability(&misfit, line.chi2, freedom);
    if (weighted && misfit.shared > 0) line.pooled = misfit.shared;
    line.standard_error = sqrt(inflation / of.xx);
    line.half_width = gsl_cdf_tdist_Pinv(0.975, freedom) * line.standard_error;
    return line;
}

/* ---- series of a study ---- */

typedef struct {
    const fracas_analysis *analysis;
    const fracas_columns *others; /* columns that make series */
    double *x, *y;                /* a value a point */
    fracas_mean *mean;
    fracas_mean_error *error;
} fitter;

/* The line through the points of the series of `first`, all of them if `first` is SIZE_MAX. */
static fracas_slope fit_series(const fitter *of, size_t first)
{
    size_t n = 0;
    for (size_t p = 0; p < of->analysis->table->npoints; p++) {
        if (first != SIZE_MAX && !fracas_columns_same(of->analysis->table, of->others, p, first))
            continue;
        const fracas_point_statistics *statistics = &of->analysis->point[p];
        if (!fracas_size_counts(of->analysis, p) || fracas_size_whole(of->analysis, p)) continue;
        of->x[n] = log(statistics->rate);
        of->y[n] = log(statistics->size.mean);
        of->mean[n++] = (fracas_mean){statistics->size.n,
                                      statistics->size.deviation / statistics->size.mean};
    }
    fracas_mean_errors(of->mean, n, of->error);
    return fracas_slope_of(of->x, of->y, of->error, n);
}

static bool begins_series(const fitter *of, size_t p)
{
    for (size_t q = 0; q < p; q++)
        if (fracas_columns_same(of->analysis->table, of->others, p, q)) return false;
    return true;
}

static void fit_all(const fitter *of, fracas_size_slope *list, size_t *count)
{
    size_t npoints = of->analysis->table->npoints, series = 0;
    fracas_slope all = fit_series(of, SIZE_MAX);
    if (!isfinite(all.slope)) return;
    list[(*count)++] = (fracas_size_slope){"all points", all, FRACAS_SLOPE_MOTT,
                                           FRACAS_SLOPE_GRADY};
    for (size_t p = 0; p < npoints; p++) series += begins_series(of, p);
    for (size_t p = 0; p < npoints && series > 1; p++) {
        if (!begins_series(of, p)) continue;
        fracas_size_slope *next = &list[*count];
        *next = (fracas_size_slope){"", fit_series(of, p), FRACAS_SLOPE_MOTT, FRACAS_SLOPE_GRADY};
        if (!isfinite(next->slope.slope)) continue;
        fracas_columns_label(of->analysis->table, of->others, p, next->name, sizeof next->name);
        (*count)++;
    }
}

fracas_err fracas_size_slopes(const fracas_analysis *analysis, fracas_size_slope **list,
                              size_t *count)
{
    size_t npoints = analysis->table->npoints;
    *count = 0;
    *list = NULL;
    FRACAS_CLEARED(fracas_columns) others = {0};
    TRY(fracas_columns_without_rate(analysis->table, &analysis->shown, &others));
    FRACAS_CLEARED(fracas_room) room = {0};
    fitter of = {.analysis = analysis, .others = &others};
    FRACAS_TAKE(&room, of.x, npoints);
    FRACAS_TAKE(&room, of.y, npoints);
    FRACAS_TAKE(&room, of.mean, npoints);
    FRACAS_TAKE(&room, of.error, npoints);
    TRY(fracas_room_check(&room, "the slopes of the study"));
    *list = calloc(npoints + 2, sizeof **list);
    if (!*list) return fracas_no_memory("the slopes of the study");
    fit_all(&of, *list, count);
    return FRACAS_OK;
}
