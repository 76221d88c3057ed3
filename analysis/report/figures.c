/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/report/figures.h"

#include "analysis/data/format.h"
#include "base/own.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TALL = FRACAS_FIGURE_TALL, LOW = FRACAS_FIGURE_LOW };

fracas_number_text fracas_figure_range(size_t least, size_t most)
{
    fracas_number_text text;
    if (least < most) FRACAS_PRINT(text.text, "%zu to %zu", least, most);
    else FRACAS_PRINT(text.text, "%zu", most);
    return text;
}

/* ---- sizes ---- */

static double mean_of(const double *value, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += value[i];
    return sum / (double)count;
}

fracas_err fracas_figure_steps(const double *value, size_t n, double unit, double whole,
                               unsigned look, fracas_panel *panel)
{
    fracas_series *series;
    size_t vertex = 0;
    TRY(fracas_panel_add(panel, FRACAS_STEPS, look, n, &series));
    for (size_t i = 0; i < n; i++) {
        if (i > 0 && value[i] <= value[i - 1] * (1 + 1e-9)) continue;
        series->x[vertex] = value[i] / unit;
        series->y[vertex++] = (double)(n - i) / whole;
    }
    series->n = vertex;
    return FRACAS_OK;
}

static fracas_err add_sizes(const fracas_point_statistics *statistics, double unit, unsigned look,
                            fracas_panel *panel)
{
    const size_t n = statistics->nfragments;
    return fracas_figure_steps(statistics->fragment_size, n, unit, (double)n, look, panel);
}

static void name_cumulative_axes(fracas_panel *panel)
{
    panel->x.log = panel->y.log = true;
    FRACAS_PRINT(panel->y.label, "share of fragments \u2265 s");
}

bool fracas_figure_takes(const fracas_analysis *analysis, size_t point, size_t drawing,
                         unsigned *look)
{
    if (!fracas_analysis_draws(analysis, point) || analysis->point[point].nfragments == 0)
        return false;
    *look = 0;
    for (size_t p = 0; p < point; p++)
        *look += fracas_analysis_draws(analysis, p) && analysis->point[p].nfragments > 0;
    return *look / FRACAS_MEANS_SERIES == drawing;
}

void fracas_figure_name_drawing(const char *file, const char *title, size_t drawing,
                                fracas_chart *chart)
{
    FRACAS_PRINT(chart->file, "%s", file);
    FRACAS_PRINT(chart->title, "%s", title);
    if (drawing == 0) return;
    fracas_append(chart->file, sizeof chart->file, "-", "%zu", drawing + 1);
    fracas_append(chart->title, sizeof chart->title, ", ", "continued");
}

fracas_err fracas_figure_sizes_together(const fracas_analysis *analysis, size_t drawing,
                                        fracas_chart *chart)
{
    fracas_figure_name_drawing("sizes",
                               analysis->drawn ? "Fragment sizes of the drawn points"
                                               : "Fragment sizes of all points",
                               drawing, chart);
    size_t least = SIZE_MAX, most = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const size_t n = analysis->point[p].nfragments;
        if (!fracas_analysis_draws(analysis, p)) continue;
        if (n > 0 && n < least) least = n;
        if (n > most) most = n;
    }
    FRACAS_PRINT(
        chart->caption,
        "Share of the fragments that are at least of size s, over s / mean size of the "
        "point\u2019s fragments; n = %s fragments a point, of all usable replicas together, "
        "dust included.%s",
        fracas_figure_range(least, most).text,
        fracas_analysis_any_surface(analysis)
            ? " The size of a piece of a surface is the square root of its area."
            : "");
    fracas_panel *panel = NULL;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_point_statistics *statistics = &analysis->point[p];
        unsigned look;
        if (!fracas_figure_takes(analysis, p, drawing, &look)) continue;
        if (!panel) panel = fracas_chart_add(chart, TALL);
        TRY(add_sizes(statistics, mean_of(statistics->fragment_size, statistics->nfragments), look,
                      panel));
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

const fracas_figure fracas_figures[] = {
    {"fragment-sizes", "wide", false, fracas_figure_sizes_together},
    {"fragment-sizes", "wide", false, fracas_figure_masses},
    {"fragment-sizes", "small", true, fracas_figure_sizes},
    {"fragments-over-time", "wide", true, fracas_figure_fragments},
    {"energies-over-time", "wide", true, fracas_figure_energies},
    {"energies-over-time", "wide", true, fracas_figure_bands},
    {"probes-over-time", "wide", true, fracas_figure_probes},
    {"reactions-over-time", "wide", true, fracas_figure_reactions},
    {"cracks-over-time", "wide", true, fracas_figure_cracks},
    {"convergence", "small", true, fracas_figure_convergence},
    {NULL, NULL, false, NULL},
};
