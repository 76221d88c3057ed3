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
    FRACAS_FIELD(fracas_size_slope, INTEGER, "mixes", "1",
                 "series that the points are of; above 1 they differ in more than the rate", mixes),
    FRACAS_FIELD(fracas_size_slope, INTEGER, "points", "1", "points on the line", slope.n),
    NUMBER("slope", "d log(mean size)/d log(strain rate), in the others of the mean count",
           slope.slope),
    NUMBER("standard_error", "standard error of the slope", slope.standard_error),
    NUMBER("half_width", "half width of the 95 % interval of the slope", slope.half_width),
    NUMBER("chi2", "squared residuals of the line, each over its variance", slope.chi2),
    NUMBER("misfit", "probability of such a chi2 or more if the points are on a line",
           slope.misfit),
    NUMBER("pooled_freedom",
           "degrees of freedom of the relative variance that points of fewer than eight replicas "
           "share; null where each has its own",
           slope.pooled),
    NUMBER("mott", "exponent of Mott's theory, to compare with; null of surfaces", mott),
    NUMBER("grady", "exponent of Grady's theory, to compare with; null of surfaces", grady),
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
    size_t quantity; /* place of the mean in a point's statistics */
    double power;    /* exponent of it by that of the size, in the theories */
    size_t *series;  /* for each point that came apart: its series; SIZE_MAX: it did not */
    double *x, *y;   /* a value a point */
    fracas_mean *mean;
    fracas_mean_error *error;
} fitter;

/* Whether the point is on the line of a series, of all of them if it is SIZE_MAX. */
static bool takes(const fitter *of, size_t series, size_t p)
{
    return of->series[p] != SIZE_MAX && (series == SIZE_MAX || of->series[p] == series);
}

/* The line through the points of a series, of all of them if it is SIZE_MAX. */
static fracas_slope fit_series(const fitter *of, size_t series)
{
    size_t n = 0;
    for (size_t p = 0; p < of->analysis->table->npoints; p++) {
        const fracas_point_statistics *statistics = &of->analysis->point[p];
        const fracas_estimate *mean = (const void *)((const char *)statistics + of->quantity);
        if (!takes(of, series, p) || !(mean->mean > 0)) continue; /* none but dust */
        of->x[n] = log(statistics->rate);
        of->y[n] = log(mean->mean);
        of->mean[n++] = (fracas_mean){mean->n, mean->deviation / mean->mean};
    }
    fracas_mean_errors(of->mean, n, of->error);
    return fracas_slope_of(of->x, of->y, of->error, n);
}

/* The theories are of bodies with a length alone. */
static bool has_theories(const fitter *of, size_t series)
{
    for (size_t p = 0; p < of->analysis->table->npoints; p++)
        if (takes(of, series, p) && !isfinite(of->analysis->point[p].length)) return false;
    return true;
}

static void add_slope(const fitter *of, size_t series, const char *name, int64_t mixes,
                      fracas_size_slope *list, size_t *count)
{
    fracas_size_slope *next = &list[*count];
    const double power = has_theories(of, series) ? of->power : NAN;
    *next = (fracas_size_slope){"", mixes, fit_series(of, series), power * FRACAS_SLOPE_MOTT,
                                power * FRACAS_SLOPE_GRADY};
    FRACAS_PRINT(next->name, "%s", name);
    *count += isfinite(next->slope.slope);
}

static void add_slopes(const fitter *of, const fracas_size_series *series, size_t nseries,
                       fracas_size_slope *list, size_t *count)
{
    int64_t mixes = 0;
    char name[64] = "all points";
    for (size_t s = 0; s < nseries; s++) {
        bool broke = false;
        for (size_t i = 0; i < series[s].n; i++) broke = broke || !series[s].point[i].whole;
        mixes += broke;
        if (nseries > 1) add_slope(of, s, series[s].name, 1, list, count);
    }
    if (mixes > 1) FRACAS_PRINT(name, "all points, %lld series mixed", (long long)mixes);
    const size_t before = *count;
    add_slope(of, SIZE_MAX, name, mixes, list, count);
    if (*count == before) *count = 0;
}

static fracas_err list_slopes(const fracas_analysis *analysis, fitter of, fracas_size_slope **list,
                              size_t *count)
{
    const size_t npoints = analysis->table->npoints;
    FRACAS_CLEARED(fracas_room) room = {0};
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
    *list = calloc(nseries + 2, sizeof **list);
    for (size_t p = 0; p < npoints; p++) of.series[p] = SIZE_MAX;
    for (size_t s = 0; s < nseries; s++)
        for (const fracas_size_point *at = series[s].point; at < series[s].point + series[s].n;
             at++)
            if (!at->whole) of.series[at->point] = s;
    if (*list) add_slopes(&of, series, nseries, *list, count);
    fracas_size_series_free(series, nseries);
    return *list ? FRACAS_OK : fracas_no_memory("the slopes of the study");
}

fracas_err fracas_size_slopes(const fracas_analysis *analysis, fracas_size_slope **list,
                              size_t *count)
{
    const fitter size = {
        .analysis = analysis, .quantity = offsetof(fracas_point_statistics, size), .power = 1};
    return list_slopes(analysis, size, list, count);
}

fracas_err fracas_count_slopes(const fracas_analysis *analysis, bool dust, fracas_size_slope **list,
                               size_t *count)
{
    const fitter counts = {.analysis = analysis,
                           .quantity = dust ? offsetof(fracas_point_statistics, count)
                                            : offsetof(fracas_point_statistics, count_large),
                           .power = -1};
    *list = NULL;
    *count = 0;
    return dust || fracas_analysis_much_dust(analysis) ? list_slopes(analysis, counts, list, count)
                                                       : FRACAS_OK;
}

fracas_number_text fracas_slope_text(const fracas_slope *slope)
{
    const fracas_estimate k = {
        .n = slope->n, .mean = slope->slope, .half_width = slope->half_width};
    fracas_number_text made;
    fracas_format_estimate(&k, 1, "\u00b1", made.text, sizeof made.text);
    return made;
}

double fracas_slope_at(const fracas_slope *slope, double rate)
{
    return exp(slope->intercept + slope->slope * log(rate));
}

/* ---- windows ---- */

#undef NUMBER
#define NUMBER(key, unit, doc, member) \
    FRACAS_FIELD(fracas_size_window, NUMBER, key, unit, doc, member)
static const fracas_field window_field[] = {
    FRACAS_FIELD(fracas_size_window, CHARS, "series", "", "name of the series", name),
    FRACAS_FIELD(fracas_size_window, INDEX, "from_point", "1", "point of the lower rate", point[0]),
    FRACAS_FIELD(fracas_size_window, INDEX, "to_point", "1", "point of the higher rate", point[1]),
    NUMBER("from_rate", "1/s", "lower strain rate", rate[0]),
    NUMBER("to_rate", "1/s", "higher strain rate", rate[1]),
    NUMBER("from_rate_normalised", "1", "lower strain rate / edot0", normalised[0]),
    NUMBER("to_rate_normalised", "1", "higher strain rate / edot0", normalised[1]),
    NUMBER("slope", "1", "d log(mean size)/d log(strain rate) between the two", window.slope),
    NUMBER("standard_error", "1", "standard error of the slope", window.standard_error),
    NUMBER("freedom", "1", "degrees of freedom of the standard error", window.freedom),
    NUMBER("half_width", "1",
           "half width of the 95 % interval of the slope; null if neither mean scatters and one is "
           "of fewer than eight replicas",
           window.half_width),
};
const fracas_fields fracas_window_fields = FRACAS_FIELDS(window_field);

/* (scaling-laws.11), (scaling-laws.12), (scaling-laws.13). */
fracas_window fracas_window_of(const fracas_size_point *low, const fracas_size_point *high)
{
    const double x = log(high->rate / low->rate);
    if (!(fabs(x) > 1e-9)) return (fracas_window){NAN, NAN, NAN, NAN};
    const double a = low->error * low->error, b = high->error * high->error;
    fracas_window window = {.slope = log(high->size / low->size) / x,
                            .standard_error = sqrt(a + b) / fabs(x)};
    window.freedom = (a + b) * (a + b) /
                     (a * a / (double)(low->replicas - 1) + b * b / (double)(high->replicas - 1));
    const bool few = low->replicas < FRACAS_REPLICAS_OWN ||
                     high->replicas < FRACAS_REPLICAS_OWN; /* alike by chance */
    if (a + b > 0)
        window.half_width = gsl_cdf_tdist_Pinv(0.975, window.freedom) * window.standard_error;
    else window.half_width = few ? NAN : window.standard_error;
    return window;
}

static void add_series(const fracas_size_series *series, fracas_size_window *list, size_t *count)
{
    for (size_t i = 0; i + 1 < series->n; i++) {
        const fracas_size_point *low = &series->point[i], *high = low + 1;
        fracas_size_window made = {
            .point = {low->point, high->point},
            .rate = {low->rate, high->rate},
            .normalised = {low->rate / series->scales.rate, high->rate / series->scales.rate},
            .window = fracas_window_of(low, high)};
        if (low->whole || high->whole || !isfinite(made.window.slope))
            continue; /* the length of a body is no fragment size */
        FRACAS_PRINT(made.name, "%s", series->name);
        list[(*count)++] = made;
    }
}

fracas_err fracas_size_windows(const struct fracas_analysis *analysis, fracas_size_window **list,
                               size_t *count)
{
    fracas_size_series *series;
    size_t nseries, most = 1;
    *list = NULL;
    *count = 0;
    TRY(fracas_size_series_create(analysis, &series, &nseries));
    for (size_t i = 0; i < nseries; i++) most += series[i].n;
    *list = calloc(most, sizeof **list);
    for (size_t i = 0; *list && i < nseries; i++) add_series(&series[i], *list, count);
    fracas_size_series_free(series, nseries);
    return *list ? FRACAS_OK : fracas_no_memory("the slopes of the study");
}
