/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figure of probes of a point. */
#include "analysis/report/figures.h"

#include <math.h>
#include <stdio.h>

/* Largest |displacement| of a component [m]. */
static double largest_of(const fracas_point_statistics *statistics, int component)
{
    double largest = 0;
    for (size_t i = 0; i < statistics->nprobe; i++)
        largest = fmax(largest, fabs(statistics->probe[i].displacement[component]));
    return largest;
}

static fracas_err add_component(const fracas_analysis *analysis,
                                const fracas_point_statistics *statistics, int component,
                                const fracas_prefix *time, const fracas_prefix *metre,
                                fracas_panel *panel)
{
    const fracas_probes *probes = &analysis->header.probes;
    const size_t rows = statistics->nprobe / probes->count;
    for (size_t p = 0; p < probes->count; p++) {
        fracas_series *series;
        TRY(fracas_panel_add(panel, FRACAS_CURVE, (unsigned)p, rows, &series));
        FRACAS_PRINT(series->name, "%s", probes->probe[p].name);
        for (size_t i = 0; i < rows; i++) {
            const fracas_probe_row *row = &statistics->probe[i * probes->count + p];
            series->x[i] = row->time * time->factor;
            series->y[i] = row->displacement[component] * metre->factor;
        }
    }
    FRACAS_PRINT(panel->y.label, "u_%c [%sm]", "xyz"[component], metre -> sign);
    return FRACAS_OK;
}

fracas_err fracas_figure_probes(const fracas_analysis *analysis, size_t point, fracas_chart *chart)
{
    const fracas_point_statistics *statistics = &analysis->point[point];
    double largest = 0;
    fracas_figure_name(analysis, point, "probes", "Displacements of probes", chart);
    for (int i = 0; i < 3; i++) largest = fmax(largest, largest_of(statistics, i));
    if (!(largest > 0)) return FRACAS_OK;
    const fracas_prefix time = fracas_prefix_for(&statistics->probe[statistics->nprobe - 1].time,
                                                 1),
                        metre = fracas_prefix_for(&largest, 1);
    for (int i = 0; i < 3; i++) {
        if (!(largest_of(statistics, i) > 1e-9 * largest)) continue; /* rounding */
        fracas_panel *panel = fracas_chart_add(chart, FRACAS_FIGURE_LOW);
        TRY(add_component(analysis, statistics, i, &time, &metre, panel));
        FRACAS_PRINT(panel->x.label, "time [%ss]", time.sign);
    }
    FRACAS_PRINT(chart->caption,
                 "Replica %lld, the one whose dissipated energy is the nearest to the mean: "
                 "displacement of each probe's point of the body.",
                 (long long)statistics->typical_replica);
    return FRACAS_OK;
}
