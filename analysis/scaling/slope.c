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
    size_t *series; /* for each point that came apart: its series; SIZE_MAX: it did not */
    double *x, *y;  /* a value a point */
    fracas_mean *mean;
    fracas_mean_error *error;
} fitter;

/* The line through the points of a series, of all of them if it is SIZE_MAX. */
static fracas_slope fit_series(const fitter *of, size_t series)
{
    size_t n = 0;
    for (size_t p = 0; p < of->analysis->table->npoints; p++) {
        const fracas_point_statistics *statistics = &of->analysis->point[p];
        if (of->series[p] == SIZE_MAX || (series != SIZE_MAX && of->series[p] != series)) continue;
        of->x[n] = log(statistics->rate);
        of->y[n] = log(statistics->size.mean);
        of->mean[n++] = (fracas_mean){statistics->size.n,
                                      statistics->size.deviation / statistics->size.mean};
    }
    fracas_mean_errors(of->mean, n, of->error);
    return fracas_slope_of(of->x, of->y, of->error, n);
}

static void add_slope(const fitter *of, size_t series, const char *name, fracas_size_slope *list,
                      size_t *count)
{
    fracas_size_slope *next = &list[*count];
    *next = (fracas_size_slope){"", fit_series(of, series), FRACAS_SLOPE_MOTT, FRACAS_SLOPE_GRADY};
    FRACAS_PRINT(next->name, "%s", name);
    *count += isfinite(next->slope.slope);
}

fracas_err fracas_size_slopes(const fracas_analysis *analysis, fracas_size_slope **list,
                              size_t *count)
{
    const size_t npoints = analysis->table->npoints;
    FRACAS_CLEARED(fracas_room) room = {0};
    fitter of = {.analysis = analysis};
    fracas_size_series *series;
    size_t nseries;
    *count = 0;
    *list = NULL;
    FRACAS_TAKE(&room, of.series, npoints);
    FRACAS_TAKE(&room, of.x, npoints);
    FRACAS_TAKE(&room, of.y, npoints);
    FRACAS_TAKE(&room, of.mean, npoints);
    FRACAS_TAKE(&room, of.error, npoints);
    TRY(fracas_room_check(&room, "the slopes of the study"));
    TRY(fracas_size_series_create(analysis, &series, &nseries));
    *list = calloc(nseries + 1, sizeof **list);
    for (size_t p = 0; p < npoints; p++) of.series[p] = SIZE_MAX;
    for (size_t s = 0; s < nseries; s++)
        for (const fracas_size_point *at = series[s].point; at < series[s].point + series[s].n;
             at++)
            if (!at->whole) of.series[at->point] = s;
    if (*list) add_slope(&of, SIZE_MAX, "all points", *list, count);
    for (size_t s = 0; s < nseries && nseries > 1 && *count > 0; s++)
        add_slope(&of, s, series[s].name, *list, count);
    fracas_size_series_free(series, nseries);
    return *list ? FRACAS_OK : fracas_no_memory("the slopes of the study");
}
