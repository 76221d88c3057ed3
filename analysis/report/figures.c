/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/report/figures.h"

#include "analysis/scaling/scaling.h"
#include "analysis/data/format.h"
#include "base/own.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LAW_VALUES = 80, TALL = 300, LOW = FRACAS_FIGURE_LOW };

/* ---- mean size against rate ---- */

static const size_t ALL_SERIES = SIZE_MAX;

typedef struct {
    size_t point, series; /* series: from 0, in the order of their first points */
} rate_mark;

typedef struct {
    const fracas_analysis *analysis;
    bool normalised;
    double size_factor;
    fracas_columns others; /* columns making series */
    size_t n, nseries;
    rate_mark *mark;
    double rate[2]; /* least and greatest, in the unit of the axis */
} rate_plot;

static void rate_plot_clear(rate_plot *plot)
{
    fracas_columns_clear(&plot->others);
    free(plot->mark);
}

static const fracas_point_statistics *statistics_of(const rate_plot *plot, size_t mark)
{
    return &plot->analysis->point[plot->mark[mark].point];
}

static bool has_mean(const fracas_point_statistics *statistics)
{
    return isfinite(statistics->rate) && statistics->rate > 0 &&
           isfinite(statistics->size.mean); /* the axis is a log one */
}

static bool has_scales(const fracas_point_statistics *statistics)
{
    return has_mean(statistics) && !statistics->surface && isfinite(statistics->scales.size) &&
           isfinite(statistics->scales.rate);
}

/* Rate and size that are 1 on the axes. */
static fracas_scales units_of(const rate_plot *plot, const fracas_scales *scales)
{
    return plot->normalised ? *scales : (fracas_scales){.rate = 1, .size = 1 / plot->size_factor};
}

static fracas_err find_marks(rate_plot *plot)
{
    const fracas_point_table *table = plot->analysis->table;
    TRY(fracas_columns_without_rate(table, &plot->analysis->shown, &plot->others));
    plot->mark = calloc(table->npoints + 1, sizeof *plot->mark);
    if (!plot->mark) return fracas_no_memory("a figure");
    for (size_t p = 0; p < table->npoints; p++) {
        const fracas_point_statistics *statistics = &plot->analysis->point[p];
        if (plot->normalised ? !has_scales(statistics) : !has_mean(statistics)) continue;
        const double rate = statistics->rate / units_of(plot, &statistics->scales).rate;
        size_t like = 0;
        while (like < plot->n &&
               !fracas_columns_same(table, &plot->others, p, plot->mark[like].point))
            like++;
        const size_t series = like < plot->n ? plot->mark[like].series : plot->nseries++;
        plot->rate[0] = plot->n ? fmin(plot->rate[0], rate) : rate;
        plot->rate[1] = fmax(plot->rate[1], rate);
        plot->mark[plot->n++] = (rate_mark){p, series};
    }
    return FRACAS_OK;
}

static fracas_err add_means(const rate_plot *plot, size_t number, fracas_panel *panel)
{
    fracas_series *series;
    TRY(fracas_panel_add(panel, FRACAS_MARKS, (unsigned)number, plot->n, &series));
    FRACAS_PRINT(series->name, "mean, 95 %% interval");
    series->n = 0;
    for (size_t m = 0; m < plot->n; m++) {
        if (plot->mark[m].series != number) continue;
        const fracas_point_statistics *statistics = statistics_of(plot, m);
        const fracas_estimate *size = &statistics->size;
        const fracas_scales unit = units_of(plot, &statistics->scales);
        const size_t i = series->n++;
        if (i == 0 && plot->others.count > 0)
            fracas_columns_label(plot->analysis->table, &plot->others, plot->mark[m].point,
                                 series->name, sizeof series->name);
        series->x[i] = statistics->rate / unit.rate;
        series->y[i] = size->mean / unit.size;
        series->low[i] = (size->mean - size->half_width) / unit.size;
        series->high[i] = (size->mean + size->half_width) / unit.size;
    }
    return FRACAS_OK;
}

/* A curve over the rates of all marks and a factor of two beyond, without its y. */
static fracas_err add_curve(const rate_plot *plot, unsigned look, fracas_panel *panel,
                            fracas_series **series)
{
    TRY(fracas_panel_add(panel, FRACAS_CURVE, look, LAW_VALUES, series));
    for (size_t i = 0; i < LAW_VALUES; i++)
        (*series)->x[i] = plot->rate[0] / 2 *
                          pow(4 * plot->rate[1] / plot->rate[0], (double)i / (LAW_VALUES - 1));
    return FRACAS_OK;
}

static fracas_err add_law(const rate_plot *plot, fracas_scaling_law_id law,
                          const fracas_scales *scales, unsigned look, fracas_panel *panel)
{
    fracas_series *series;
    TRY(add_curve(plot, look, panel, &series));
    FRACAS_PRINT(series->name, "%s", fracas_scaling_laws[law].name);
    for (size_t i = 0; i < LAW_VALUES; i++)
        series->y[i] = plot->normalised
                           ? fracas_scaling_laws[law].normalised(series->x[i], scales->modulus)
                           : fracas_scaling_law_at(law, scales, series->x[i]) * plot->size_factor;
    return FRACAS_OK;
}

/* True if one curve of a scaling law serves all marks of a series, or of ALL_SERIES. */
static bool same_scales(const rate_plot *plot, size_t series)
{
    const fracas_scales *first = NULL;
    for (size_t m = 0; m < plot->n; m++) {
        const fracas_point_statistics *statistics = statistics_of(plot, m);
        if (!has_scales(statistics) || (series != ALL_SERIES && plot->mark[m].series != series))
            continue;
        if (first &&
            (first->size != statistics->scales.size || first->rate != statistics->scales.rate))
            return false;
        first = &statistics->scales;
    }
    return true;
}

/* True if the law is a number, and one curve of it serves all marks: Mott's only where all
 * strengths have one modulus. */
static bool law_serves(const rate_plot *plot, fracas_scaling_law_id law,
                       const fracas_scales *scales)
{
    if (!isfinite(fracas_scaling_laws[law].normalised(1, scales->modulus))) return false;
    for (size_t m = 0; law == FRACAS_LAW_MOTT && m < plot->n; m++)
        if (has_scales(statistics_of(plot, m)) &&
            statistics_of(plot, m)->scales.modulus != scales->modulus)
            return false;
    return true;
}

/* All laws where one curve each serves all marks; else ZMR in the colour of each series it serves.
 * None for surfaces. */
static fracas_err add_laws(const rate_plot *plot, size_t number, bool *drawn, fracas_panel *panel)
{
    size_t first = 0;
    while (plot->mark[first].series != number) first++;
    const fracas_scales *scales = &statistics_of(plot, first)->scales;
    if (!has_scales(statistics_of(plot, first)) || *drawn) return FRACAS_OK;
    if (plot->normalised || same_scales(plot, ALL_SERIES)) {
        *drawn = true;
        for (unsigned law = 0; law < FRACAS_SCALING_LAWS; law++)
            if (law_serves(plot, (fracas_scaling_law_id)law, scales))
                TRY(add_law(plot, (fracas_scaling_law_id)law, scales, (unsigned)plot->nseries + law,
                            panel));
    } else if (same_scales(plot, number)) {
        TRY(add_law(plot, FRACAS_LAW_ZMR, scales, (unsigned)number, panel));
        panel->series[panel->nseries - 1].name[0] = '\0'; /* named by its marks */
    }
    return FRACAS_OK;
}

/* The fitted crossover of each series, in the colour of its marks. */
static fracas_err add_crossovers(const rate_plot *plot, fracas_panel *panel)
{
    OWNED fracas_size_crossover *list = NULL;
    size_t count;
    TRY(fracas_size_crossovers(plot->analysis, false, &list, &count));
    for (size_t i = 0; i < count; i++) {
        const fracas_scales unit = units_of(plot, &list[i].scales);
        if (*list[i].reason || !isfinite(unit.rate) || !isfinite(unit.size)) continue;
        fracas_series *series;
        size_t marks = 0;
        while (marks < panel->nseries && strcmp(panel->series[marks].name, list[i].name)) marks++;
        const unsigned look = marks < panel->nseries
                                  ? panel->series[marks].look + FRACAS_CHART_COLOURS
                                  : 0; /* ZMR has the other dashes */
        TRY(add_curve(plot, look, panel, &series));
        for (size_t v = 0; v < LAW_VALUES; v++)
            series->y[v] = fracas_crossover_at(&list[i], series->x[v] * unit.rate) / unit.size;
        if (count == 1) FRACAS_PRINT(series->name, "fitted crossover");
    }
    return FRACAS_OK;
}

/* "16 to 64", or "64" */
static fracas_number_text range_text(size_t least, size_t most)
{
    fracas_number_text text;
    if (least < most) FRACAS_PRINT(text.text, "%zu to %zu", least, most);
    else FRACAS_PRINT(text.text, "%zu", most);
    return text;
}

static void caption_of_rate(const rate_plot *plot, fracas_chart *chart)
{
    size_t least = SIZE_MAX, most = 0; /* replicas a mark */
    for (size_t p = 0; p < plot->analysis->table->npoints; p++) {
        const size_t n = (size_t)plot->analysis->point[p].size.n;
        if (!has_mean(&plot->analysis->point[p])) continue;
        least = n < least ? n : least;
        most = n > most ? n : most;
    }
    const fracas_number_text n = range_text(least, most);
    if (fracas_analysis_all_surfaces(plot->analysis)) {
        FRACAS_PRINT(
            chart->caption,
            "Mean over replicas (n = %s) of the mean square root of a fragment\u2019s area, dust "
            "included; bars: 95 %% interval of the mean (Student\u2019s t over replicas).",
            n.text);
        return;
    }
    FRACAS_PRINT(
        chart->caption,
        "%sMean over replicas (n = %s) of body length / fragments%s; bars: 95 %% interval of the "
        "mean (Student\u2019s t over replicas).%s A crossover fitted to the marks, where "
        "there is one, is a line in their colour, too.",
        plot->normalised
            ? "Sizes over s\u2080 = E G_c/\u03c3_c\u00b2, rates over \u03b5\u0307\u2080 "
              "= c \u03c3_c\u00b3/(E\u00b2 G_c), \u03c3_c the mean strength. "
            : "",
        n.text,
        !plot->normalised && fracas_analysis_any_surface(plot->analysis)
            ? ", of surfaces of the mean square root of their areas"
            : "",
        plot->normalised || same_scales(plot, ALL_SERIES)
            ? " Lines: scaling laws of Zhou, Molinari and Ramesh (ZMR, ZMR-2), Grady, and Glenn "
              "and Chudnovsky (GC); Mott\u2019s where all strengths have one Weibull modulus."
            : " Lines: ZMR law with the material of the marks of the same colour, where these "
              "have one.");
}

fracas_err fracas_figure_rate(const fracas_analysis *analysis, bool normalised, fracas_chart *chart)
{
    const fracas_prefix prefix = fracas_prefix_over(
        &analysis->point->size.mean, sizeof *analysis->point, analysis->table->npoints);
    FRACAS_CLEARED(rate_plot)
    plot = {.analysis = analysis, .normalised = normalised, .size_factor = prefix.factor};
    TRY(find_marks(&plot));
    FRACAS_PRINT(chart->file, "size-against-rate%s", normalised ? "-normalised" : "");
    FRACAS_PRINT(chart->title, "%s",
                 normalised ? "Normalised mean fragment size against strain rate"
                            : "Mean fragment size against strain rate");
    caption_of_rate(&plot, chart);
    if (plot.n == 0) return FRACAS_OK;
    fracas_panel *panel = fracas_chart_add(chart, TALL);
    bool drawn = false; /* laws for all series */
    panel->x.log = panel->y.log = true;
    chart->offers = FRACAS_AXES_LINEAR;
    FRACAS_PRINT(panel->x.label, "strain rate %s",
                 normalised ? "\u03b5\u0307/\u03b5\u0307\u2080" : "[1/s]");
    if (normalised) FRACAS_PRINT(panel->y.label, "mean fragment size s/s\u2080");
    else FRACAS_PRINT(panel->y.label, "mean fragment size [%sm]", prefix.sign);
    for (size_t s = 0; s < plot.nseries; s++) {
        TRY(add_laws(&plot, s, &drawn, panel));
        TRY(add_means(&plot, s, panel));
    }
    return add_crossovers(&plot, panel);
}

/* ---- sizes ---- */

static double mean_of(const double *value, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += value[i];
    return sum / (double)count;
}

/* P(S >= s) at each size. Sizes equal to rounding (1e-9) are one: they are the same number of
 * elements. */
static fracas_err add_sizes(const fracas_point_statistics *statistics, double unit, unsigned look,
                            fracas_panel *panel)
{
    fracas_series *series;
    size_t n = statistics->nfragments, vertex = 0;
    const double *size = statistics->fragment_size;
    TRY(fracas_panel_add(panel, FRACAS_STEPS, look, n, &series));
    for (size_t i = 0; i < n; i++) {
        if (i > 0 && size[i] <= size[i - 1] * (1 + 1e-9)) continue;
        series->x[vertex] = size[i] / unit;
        series->y[vertex++] = (double)(n - i) / (double)n;
    }
    series->n = vertex;
    return FRACAS_OK;
}

static void name_cumulative_axes(fracas_panel *panel)
{
    panel->x.log = panel->y.log = true;
    FRACAS_PRINT(panel->y.label, "share of fragments \u2265 s");
}

fracas_err fracas_figure_sizes_together(const fracas_analysis *analysis, size_t point,
                                        fracas_chart *chart)
{
    (void)point;
    FRACAS_PRINT(chart->file, "sizes");
    FRACAS_PRINT(chart->title, "Fragment sizes of all points");
    size_t least = SIZE_MAX, most = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const size_t n = analysis->point[p].nfragments;
        if (n > 0 && n < least) least = n;
        if (n > most) most = n;
    }
    FRACAS_PRINT(
        chart->caption,
        "Share of the fragments that are at least of size s, over s / mean size of the "
        "point\u2019s fragments; n = %s fragments a point, of all usable replicas together, "
        "dust included.%s",
        range_text(least, most).text,
        fracas_analysis_any_surface(analysis)
            ? " The size of a piece of a surface is the square root of its area."
            : "");
    fracas_panel *panel = NULL;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_point_statistics *statistics = &analysis->point[p];
        if (statistics->nfragments == 0) continue;
        if (!panel) panel = fracas_chart_add(chart, TALL);
        TRY(add_sizes(statistics, mean_of(statistics->fragment_size, statistics->nfragments),
                      (unsigned)p, panel));
        fracas_series *series = &panel->series[panel->nseries - 1];
        FRACAS_PRINT(series->name, "%.127s", fracas_analysis_label(analysis, p).text);
    }
    if (!panel) return FRACAS_OK;
    name_cumulative_axes(panel);
    chart->offers = FRACAS_AXES_SEMILOG | FRACAS_AXES_LINEAR;
    FRACAS_PRINT(panel->x.label, "fragment size s / mean size");
    return FRACAS_OK;
}

void fracas_figure_name(const fracas_analysis *analysis, size_t point, const char *file,
                        const char *title, fracas_chart *chart)
{
    const fracas_label label = fracas_analysis_label(analysis, point);
    FRACAS_PRINT(chart->file, "%s-point-%zu", file, point);
    FRACAS_PRINT(chart->title, "%s%s%.159s", title, *label.text ? ", " : "", label.text);
}

fracas_err fracas_figure_sizes(const fracas_analysis *analysis, size_t point, fracas_chart *chart)
{
    const fracas_point_statistics *statistics = &analysis->point[point];
    fracas_figure_name(analysis, point, "sizes", "Fragment sizes", chart);
    if (statistics->nfragments == 0) return FRACAS_OK;
    double mean = mean_of(statistics->fragment_size, statistics->nfragments);
    fracas_prefix prefix = fracas_prefix_for(&mean, 1);
    chart->width = FRACAS_CHART_NARROW;
    fracas_panel *panel = fracas_chart_add(chart, LOW);
    TRY(add_sizes(statistics, 1 / prefix.factor, (unsigned)point, panel));
    name_cumulative_axes(panel);
    FRACAS_PRINT(panel->x.label, "fragment size s [%sm]", prefix.sign);
    chart->offers = FRACAS_AXES_SEMILOG | FRACAS_AXES_LINEAR;
    FRACAS_PRINT(chart->caption,
                 "Share of the fragments that are at least of size s: n = %zu fragments of %lld "
                 "replicas together, dust included.",
                 statistics->nfragments, (long long)statistics->usable);
    return FRACAS_OK;
}

/* ---- the table of figures ---- */

static fracas_err draw_rate(const fracas_analysis *analysis, size_t point, fracas_chart *chart)
{
    (void)point;
    return fracas_figure_rate(analysis, false, chart);
}

static fracas_err draw_normalised(const fracas_analysis *analysis, size_t point,
                                  fracas_chart *chart)
{
    (void)point;
    return fracas_figure_rate(analysis, true, chart);
}

const fracas_figure fracas_figures[] = {
    {"mean-size", "wide", false, draw_rate},
    {"mean-size", "wide", false, draw_normalised},
    {"fragment-sizes", "wide", false, fracas_figure_sizes_together},
    {"fragment-sizes", "small", true, fracas_figure_sizes},
    {"energies-over-time", "wide", true, fracas_figure_energies},
    {"energies-over-time", "wide", true, fracas_figure_bands},
    {"convergence", "small", true, fracas_figure_convergence},
    {NULL, NULL, false, NULL},
};
