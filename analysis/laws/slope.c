#include "analysis/laws/slope.h"

#include "analysis/study/study.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static bool known(double variance)
{
    return isfinite(variance) && variance > 0;
}

static double weight_of(const double *x, const double *y, const double *variance, bool weighted, size_t i)
{
    if (!isfinite(x[i]) || !isfinite(y[i])) return 0;
    if (!weighted) return 1;
    return known(variance[i]) ? 1 / variance[i] : 0;
}

/* Slope and intercept by (estimators.1); returns sum w (x - mean x)^2, 0 if the x differ by rounding alone. */
static double fit(const double *x, const double *y, const double *variance, bool weighted, size_t n, fracas_slope *line)
{
    double sum = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < n; i++) {
        double w = weight_of(x, y, variance, weighted, i);
        if (!(w > 0)) continue;
        line->n++;
        sum += w;
        mean_x += (x[i] - mean_x) * w / sum; /* running means: no sum of values that are far from 0 */
        mean_y += (y[i] - mean_y) * w / sum;
    }
    for (size_t i = 0; i < n; i++) {
        double w = weight_of(x, y, variance, weighted, i);
        if (!(w > 0)) continue;
        xx += w * (x[i] - mean_x) * (x[i] - mean_x);
        xy += w * (x[i] - mean_x) * (y[i] - mean_y);
    }
    if (xx <= sum * 1e-20 * mean_x * mean_x) return 0;
    line->slope = xy / xx;
    line->intercept = mean_y - line->slope * mean_x;
    return xx;
}

/* (estimators.2), (estimators.3). */
fracas_slope fracas_slope_of(const double *x, const double *y, const double *variance, size_t n)
{
    fracas_slope line = {0}, none = {0, NAN, NAN, NAN, NAN, NAN};
    bool weighted = false;
    for (size_t i = 0; i < n; i++) weighted = weighted || (known(variance[i]) && isfinite(x[i]) && isfinite(y[i]));
    double xx = fit(x, y, variance, weighted, n, &line);
    none.n = line.n;
    if (line.n < FRACAS_SLOPE_POINTS || !(xx > 0)) return none;
    double squares = 0, freedom = (double)(line.n - 2);
    for (size_t i = 0; i < n; i++) {
        double w = weight_of(x, y, variance, weighted, i), residual = y[i] - line.intercept - line.slope * x[i];
        if (w > 0) squares += w * residual * residual;
    }
    double inflation = squares / freedom;
    if (weighted) inflation = fmax(1, inflation);
    line.chi2 = weighted ? squares : NAN;
    line.standard_error = sqrt(inflation / xx);
    line.half_width = gsl_cdf_tdist_Pinv(0.975, freedom) * line.standard_error;
    return line;
}

/* ---- series of a study ---- */

typedef struct {
    const fracas_analysis *analysis;
    const fracas_columns *others; /* columns that make series */
    double *x, *y, *variance;     /* a value a point */
} fitter;

/* The line through the points that are of the series of `first`, all of them if that is SIZE_MAX. */
static fracas_slope fit_series(const fitter *of, size_t first)
{
    size_t n = 0;
    for (size_t p = 0; p < of->analysis->table->npoints; p++) {
        if (first != SIZE_MAX && !fracas_columns_same(of->analysis->table, of->others, p, first)) continue;
        const fracas_point_statistics *statistics = &of->analysis->point[p];
        double error = statistics->size.deviation / (sqrt((double)statistics->size.n) * statistics->size.mean);
        of->x[n] = statistics->rate > 0 && !statistics->surface ? log(statistics->rate) : NAN; /* the theories are of one dimension */
        of->y[n] = log(statistics->size.mean);
        of->variance[n++] = error * error;
    }
    return fracas_slope_of(of->x, of->y, of->variance, n);
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
    list[(*count)++] = (fracas_size_slope){.name = "all points", .slope = all};
    for (size_t p = 0; p < npoints; p++) series += begins_series(of, p);
    for (size_t p = 0; p < npoints && series > 1; p++) {
        if (!begins_series(of, p)) continue;
        fracas_size_slope *next = &list[*count];
        *next = (fracas_size_slope){.slope = fit_series(of, p)};
        if (!isfinite(next->slope.slope)) continue;
        fracas_columns_label(of->analysis->table, of->others, p, next->name, sizeof next->name);
        (*count)++;
    }
}

fracas_err fracas_size_slopes(const fracas_analysis *analysis, fracas_size_slope **list, size_t *count)
{
    size_t npoints = analysis->table->npoints;
    *count = 0;
    *list = NULL;
    fracas_columns others;
    TRY(fracas_columns_without_rate(analysis->table, &analysis->shown, &others));
    double *value = calloc(3 * npoints + 1, sizeof *value);
    fracas_size_slope *made = calloc(npoints + 2, sizeof *made);
    if (value && made) {
        fitter of = {analysis, &others, value, value + npoints, value + 2 * npoints};
        fit_all(&of, made, count);
    }
    fracas_columns_clear(&others);
    free(value);
    if (value && made) *list = made;
    else free(made);
    return *list ? FRACAS_OK : fracas_no_memory("the slopes of the study");
}
