/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures of probes and of reactions of a point: vectors over time. */
#include "analysis/report/figures.h"

#include <math.h>
#include <stdio.h>

/* Rows of the typical replica, `groups` at each time, in their order. */
typedef struct {
    const fracas_point_statistics *statistics;
    size_t count, groups;
    double (*time)(const fracas_point_statistics *statistics, size_t row);          /* s */
    const double *(*vector)(const fracas_point_statistics *statistics, size_t row); /* [3] */
    void (*name)(const fracas_analysis *analysis, const fracas_point_statistics *statistics,
                 size_t group, fracas_series *series);
    const char *symbol, *unit;
} vectors;

/* Largest |value| of a component. */
static double largest_of(const vectors *of, int component)
{
    double largest = 0;
    for (size_t i = 0; i < of->count; i++)
        largest = fmax(largest, fabs(of->vector(of->statistics, i)[component]));
    return largest;
}

static fracas_err add_component(const fracas_analysis *analysis, const vectors *of, int component,
                                const fracas_prefix *time, const fracas_prefix *unit,
                                fracas_panel *panel)
{
    const size_t rows = of->count / of->groups;
    for (size_t g = 0; g < of->groups; g++) {
        fracas_series *series;
        TRY(fracas_panel_add(panel, FRACAS_CURVE, (unsigned)g, rows, &series));
        of->name(analysis, of->statistics, g, series);
        for (size_t i = 0; i < rows; i++) {
            const size_t row = i * of->groups + g;
            series->x[i] = of->time(of->statistics, row) * time->factor;
            series->y[i] = of->vector(of->statistics, row)[component] * unit->factor;
        }
    }
    FRACAS_PRINT(panel->y.label, "%s_%c [%s%s]", of->symbol, "xyz"[component], unit -> sign,
                 of -> unit);
    return FRACAS_OK;
}

/* A panel for each component above rounding of the largest. */
static fracas_err draw(const fracas_analysis *analysis, const vectors *of, const char *what,
                       fracas_chart *chart)
{
    double largest = 0;
    for (int i = 0; i < 3; i++) largest = fmax(largest, largest_of(of, i));
    if (!(largest > 0)) return FRACAS_OK;
    const double end = of->time(of->statistics, of->count - 1);
    const fracas_prefix time = fracas_prefix_for(&end, 1), unit = fracas_prefix_for(&largest, 1);
    for (int i = 0; i < 3; i++) {
        if (!(largest_of(of, i) > 1e-9 * largest)) continue;
        fracas_panel *panel = fracas_chart_add(chart, FRACAS_FIGURE_LOW);
        TRY(add_component(analysis, of, i, &time, &unit, panel));
        FRACAS_PRINT(panel->x.label, "time [%ss]", time.sign);
    }
    FRACAS_PRINT(chart->caption,
                 "Replica %lld, the one whose dissipated energy is the nearest to the mean: %s.",
                 (long long)of->statistics->typical_replica, what);
    return FRACAS_OK;
}

/* ---- probes ---- */

static double time_of_probe(const fracas_point_statistics *statistics, size_t row)
{
    return statistics->probe[row].time;
}

static const double *displacement_of_probe(const fracas_point_statistics *statistics, size_t row)
{
    return statistics->probe[row].displacement;
}

static void name_probe(const fracas_analysis *analysis, const fracas_point_statistics *statistics,
                       size_t group, fracas_series *series)
{
    (void)statistics;
    FRACAS_PRINT(series->name, "%s", analysis->header.probes.probe[group].name);
}

fracas_err fracas_figure_probes(const fracas_analysis *analysis, size_t point, fracas_chart *chart)
{
    const vectors of = {&analysis->point[point],
                        analysis->point[point].nprobe,
                        analysis->header.probes.count,
                        time_of_probe,
                        displacement_of_probe,
                        name_probe,
                        "u",
                        "m"};
    fracas_figure_name(analysis, point, "probes", "Displacements of probes", chart);
    return draw(analysis, &of, "displacement of each probe's point of the body", chart);
}

/* ---- reactions ---- */

static double time_of_reaction(const fracas_point_statistics *statistics, size_t row)
{
    return statistics->reaction[row].time;
}

static const double *force_of_reaction(const fracas_point_statistics *statistics, size_t row)
{
    return statistics->reaction[row].force;
}

static void name_reaction(const fracas_analysis *analysis,
                          const fracas_point_statistics *statistics, size_t group,
                          fracas_series *series)
{
    const long long edge = (long long)statistics->reaction[group].edge;
    (void)analysis;
    if (edge > 0) FRACAS_PRINT(series->name, "edge %lld", edge);
    else if (edge == -1) FRACAS_PRINT(series->name, "nodes of loading");
    else if (edge < 0) FRACAS_PRINT(series->name, "nodes of loading %lld", -edge);
    else FRACAS_PRINT(series->name, "other edges");
}

/* Edges at one time. */
static size_t edges_of(const fracas_point_statistics *statistics)
{
    size_t edges = 0;
    while (edges < statistics->nreaction &&
           statistics->reaction[edges].time == statistics->reaction[0].time)
        edges++;
    return edges;
}

fracas_err fracas_figure_reactions(const fracas_analysis *analysis, size_t point,
                                   fracas_chart *chart)
{
    const vectors of = {&analysis->point[point],
                        analysis->point[point].nreaction,
                        edges_of(&analysis->point[point]),
                        time_of_reaction,
                        force_of_reaction,
                        name_reaction,
                        "F",
                        "N"};
    fracas_figure_name(analysis, point, "reactions", "Reactions of edges", chart);
    return draw(analysis, &of,
                "force of each edge that is held or moved on the body; edges by their numbers in "
                "study.h5",
                chart);
}
