/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figure of a surface's cracks over time. */
#include "analysis/data/cracks.h"
#include "analysis/report/figures.h"
#include "analysis/report/page.h"

#include <math.h>
#include <stdio.h>

enum { MOST = 160 }; /* values of a curve */

/* Place among all of the i-th drawn value; the last is drawn. */
static size_t thinned(size_t i, size_t drawn, size_t count)
{
    return drawn < count ? (i + 1) * count / drawn - 1 : i;
}

/* The breaks of the longest crack whose tip has a speed. */
static size_t count_speeds(const fracas_cracks *cracks, size_t longest)
{
    size_t count = 0;
    for (size_t b = 0; b < cracks->nbreaks; b++)
        count += cracks->broke[b].crack == longest && cracks->broke[b].speed > 0;
    return count;
}

static fracas_err add_lengths(const fracas_cracks *cracks, size_t longest,
                              const fracas_prefix *time, const fracas_prefix *metre,
                              fracas_panel *panel)
{
    const struct {
        const char *name;
        bool whole;
    } table[] = {{"all cracks", true}, {"longest crack", false}};
    for (unsigned s = 0; s < (cracks->ncracks > 1 ? 2 : 1); s++) {
        size_t count = 0, k = 0, i = 0;
        for (size_t b = 0; b < cracks->nbreaks; b++)
            count += table[s].whole || cracks->broke[b].crack == longest;
        const size_t drawn = count < MOST ? count : MOST;
        fracas_series *series;
        TRY(fracas_panel_add(panel, FRACAS_CURVE, s, drawn, &series));
        FRACAS_PRINT(series->name, "%s", table[s].name);
        for (size_t b = 0; b < cracks->nbreaks && i < drawn; b++) {
            const fracas_crack_break *of = &cracks->broke[b];
            if (!table[s].whole && of->crack != longest) continue;
            if (k++ != thinned(i, drawn, count)) continue;
            series->x[i] = of->time * time->factor;
            series->y[i++] = (table[s].whole ? of->length : of->crack_length) * metre->factor;
        }
    }
    FRACAS_PRINT(panel->y.label, "length [%sm]", metre->sign);
    return FRACAS_OK;
}

static fracas_err add_speed(const fracas_cracks *cracks, size_t longest, double rayleigh,
                            const fracas_prefix *time, fracas_panel *panel)
{
    const size_t count = count_speeds(cracks, longest), drawn = count < MOST ? count : MOST;
    fracas_series *series;
    size_t k = 0, i = 0;
    TRY(fracas_panel_add(panel, FRACAS_CURVE, 1, drawn, &series));
    FRACAS_PRINT(series->name, "tip of the longest crack");
    for (size_t b = 0; b < cracks->nbreaks && i < drawn; b++) {
        const fracas_crack_break *of = &cracks->broke[b];
        if (of->crack != longest || !(of->speed > 0)) continue;
        if (k++ != thinned(i, drawn, count)) continue;
        series->x[i] = of->time * time->factor;
        series->y[i++] = of->speed / rayleigh;
    }
    FRACAS_PRINT(panel->y.label, "speed/c_R");
    return FRACAS_OK;
}

static void write_caption(const fracas_analysis *analysis, size_t point,
                          const fracas_cracks *cracks, size_t longest, double rayleigh,
                          fracas_chart *chart)
{
    const fracas_crack *of = &cracks->crack[longest];
    const fracas_prefix metre = fracas_prefix_for(&of->length, 1);
    FRACAS_PRINT(chart->caption,
                 "Replica %lld, the one whose dissipated energy is the nearest to the mean: "
                 "interfaces that broke, by their lengths. The longest crack has %.3g %sm, %lld "
                 "%s",
                 (long long)analysis->point[point].typical_replica, of->length * metre.factor,
                 metre.sign, (long long)of->branches, of->branches == 1 ? "branch" : "branches");
    if (of->speed > 0)
        fracas_append(chart->caption, sizeof chart->caption, " and ",
                      "%.3g m/s on its whole way, at most %.3g m/s over %d vertices", of->speed,
                      of->fastest, FRACAS_CRACK_WINDOW);
    if (rayleigh > 0)
        fracas_append(chart->caption, sizeof chart->caption, "; ",
                      "Rayleigh waves have c_R = %.4g m/s", rayleigh);
    fracas_append(chart->caption, sizeof chart->caption, "", ".");
}

static fracas_err draw(const fracas_analysis *analysis, size_t point,
                       const fracas_broken_surface *surface, fracas_chart *chart)
{
    FRACAS_CLEARED(fracas_cracks) cracks = {0};
    TRY(fracas_cracks_find(&surface->mesh, &surface->record, &cracks));
    const size_t longest = fracas_cracks_longest(&cracks);
    if (longest == SIZE_MAX || cracks.nbreaks < 2) return FRACAS_OK;
    const fracas_point_table *table = analysis->table;
    const double rayleigh = fracas_rayleigh_speed(
                     fracas_columns_real(table, point, "material.young"),
                     fracas_columns_real(table, point, "material.density"),
                     fracas_columns_real(table, point, "material.poisson")),
                 end = cracks.broke[cracks.nbreaks - 1].time,
                 all = cracks.broke[cracks.nbreaks - 1].length;
    const fracas_prefix time = fracas_prefix_for(&end, 1), metre = fracas_prefix_for(&all, 1);
    TRY(add_lengths(&cracks, longest, &time, &metre, fracas_chart_add(chart, FRACAS_FIGURE_LOW)));
    if (rayleigh > 0 && count_speeds(&cracks, longest) > 1)
        TRY(add_speed(&cracks, longest, rayleigh, &time,
                      fracas_chart_add(chart, FRACAS_FIGURE_LOW)));
    for (size_t i = 0; i < chart->npanels; i++) {
        fracas_axis *x = &chart->panel[i].x;
        FRACAS_PRINT(x->label, "time [%ss]", time.sign);
        x->show[0] = cracks.broke[0].time * time.factor; /* alike in both */
        x->show[1] = end * time.factor;
    }
    write_caption(analysis, point, &cracks, longest, rayleigh, chart);
    return FRACAS_OK;
}

/* Surfaces that keep their interfaces have it, once study.h5 is there with its meshes. */
fracas_err fracas_figure_cracks(const fracas_analysis *analysis, size_t point, fracas_chart *chart)
{
    const int64_t replica = analysis->point[point].typical_replica;
    FRACAS_CLEARED(fracas_broken_surface) surface = {.thickness = 0};
    size_t interfaces, row;
    fracas_figure_name(analysis, point, "cracks", "Length of cracks", chart);
    TRY(fracas_results_mesh_interfaces(analysis->results, point, &interfaces));
    if (interfaces == 0 || replica < 0) return FRACAS_OK;
    TRY(fracas_results_find(analysis->results, point, replica, &row));
    TRY(fracas_broken_surface_read(analysis->results, point, row, &surface));
    return surface.strip ? FRACAS_OK : draw(analysis, point, &surface, chart);
}
