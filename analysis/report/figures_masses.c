/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fragments of a body by mass, all points on one axis. */
#include "analysis/report/figures.h"

#include "analysis/data/format.h"
#include "base/own.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEIGHT = 300 }; /* pixels */

/* An open mark on the steps at the lightest fragment that is not dust: all below it are dust. */
static fracas_err add_end_of_dust(const fracas_ensemble *ensemble, double unit, unsigned look,
                                  fracas_panel *panel)
{
    double least = INFINITY;
    size_t heavier = 0;
    for (size_t i = 0; i < ensemble->nfragments; i++)
        if (!ensemble->dust[i]) least = fmin(least, ensemble->mass[i]);
    for (size_t i = 0; i < ensemble->nfragments; i++)
        heavier += ensemble->mass[i] * (1 + 1e-9) >= least;
    if (heavier == ensemble->nfragments || heavier == 0) return FRACAS_OK;
    fracas_series *series;
    TRY(fracas_panel_add(panel, FRACAS_MARKS, look, 1, &series));
    series->open = true;
    FRACAS_PRINT(series->name, "lightest that is no dust");
    series->x[0] = least / unit;
    series->y[0] = (double)heavier / (double)ensemble->nrealizations;
    series->low[0] = series->high[0] = NAN;
    return FRACAS_OK;
}

/* `unit` of the axis [kg]. */
static fracas_err add_point(const fracas_analysis *analysis, size_t p, unsigned look, double unit,
                            fracas_panel *panel)
{
    const fracas_ensemble *ensemble = &analysis->point[p].ensemble;
    const size_t n = ensemble->nfragments;
    OWNED double *mass = malloc((n + 1) * sizeof *mass);
    if (!mass) return fracas_no_memory("a figure");
    memcpy(mass, ensemble->mass, n * sizeof *mass);
    gsl_sort(mass, 1, n);
    TRY(fracas_figure_steps(mass, n, unit, (double)ensemble->nrealizations, look, panel));
    FRACAS_PRINT(panel->series[panel->nseries - 1].name, "%.127s",
                 fracas_analysis_label(analysis, p).text);
    return add_end_of_dust(ensemble, unit, look, panel);
}

/* Mean mass of a fragment over all points [kg]; 0 without any. */
static double mean_mass(const fracas_analysis *analysis)
{
    double sum = 0, n = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_ensemble *ensemble = &analysis->point[p].ensemble;
        for (size_t i = 0; i < ensemble->nfragments; i++) sum += ensemble->mass[i];
        n += (double)ensemble->nfragments;
    }
    return n > 0 ? sum / n : 0;
}

fracas_err fracas_figure_masses(const fracas_analysis *analysis, size_t drawing,
                                fracas_chart *chart)
{
    const double grams = 1e3 * mean_mass(analysis);
    fracas_panel *panel = NULL;
    fracas_figure_name_drawing("masses",
                               analysis->drawn ? "Fragment masses of the drawn points"
                                               : "Fragment masses of all points",
                               drawing, chart);
    if (!(grams > 0)) return FRACAS_OK;
    const fracas_prefix prefix = fracas_prefix_for(&grams, 1);
    FRACAS_PRINT(chart->caption,
                 "Fragments of a body that have a mass of at least m: mean over all usable "
                 "replicas, dust included. A curve begins at the number of all fragments; left of "
                 "an open mark they are dust.");
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        unsigned look;
        if (!fracas_figure_takes(analysis, p, drawing, &look)) continue;
        if (!panel) panel = fracas_chart_add(chart, HEIGHT);
        TRY(add_point(analysis, p, look, 1e-3 / prefix.factor, panel));
    }
    if (!panel) return FRACAS_OK;
    panel->x.log = panel->y.log = true;
    chart->offers = FRACAS_AXES_SEMILOG | FRACAS_AXES_LINEAR;
    FRACAS_PRINT(panel->x.label, "fragment mass m [%sg]", prefix.sign);
    FRACAS_PRINT(panel->y.label, "fragments of a body of mass \u2265 m");
    return FRACAS_OK;
}
