/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mean sizes and counts against the abscissa of the axes. */
#include "analysis/report/means_plot.h"

#include "analysis/data/format.h"
#include "base/own.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TALL = FRACAS_FIGURE_TALL, MULTIPLE = 190 };

static const size_t ALL_SERIES = SIZE_MAX;

static void fracas_means_plot_clear(fracas_means_plot *plot)
{
    free(plot->mark);
    free(plot->slope);
    free(plot->crossover);
}

static bool has_scales(const fracas_means_plot *plot, size_t point)
{
    const fracas_point_statistics *statistics = &plot->analysis->point[point];
    return fracas_means_has(plot, point) && !statistics->surface &&
           isfinite(statistics->scales.size) && isfinite(statistics->scales.rate);
}

static bool mark_has_scales(const fracas_means_plot *plot, size_t mark)
{
    return has_scales(plot, plot->mark[mark].point);
}

/* Rate and size that are 1 on the axes. */
static fracas_scales units_of(const fracas_means_plot *plot, const fracas_scales *scales)
{
    return fracas_means_normalised(plot) ? *scales
                                         : (fracas_scales){.rate = 1, .size = 1 / plot->factor};
}

static double x_of(const fracas_means_plot *plot, size_t point)
{
    return plot->axes->value[point] / units_of(plot, &plot->analysis->point[point].scales).rate;
}

/* ---- series, panels and drawings ---- */

/* Classes of all points. */
typedef struct {
    size_t *series, *panel, *drawing;
} classes;

static size_t parts_of(size_t count, size_t most)
{
    return (count + most - 1) / most;
}

/* Marks with their series, panels and drawings. A drawing has at most FRACAS_MEANS_PANELS panels of
 * at most FRACAS_MEANS_SERIES series. */
static void number_marks(const classes *of, fracas_means_plot *plot)
{
    const size_t parts = parts_of(plot->nseries, FRACAS_MEANS_SERIES),
                 pages = parts_of(plot->npanels, FRACAS_MEANS_PANELS);
    for (size_t p = 0; p < plot->analysis->table->npoints; p++) {
        if (fracas_means_normalised(plot) ? !has_scales(plot, p) : !fracas_means_has(plot, p))
            continue;
        const double x = x_of(plot, p);
        plot->x[0] = plot->n ? fmin(plot->x[0], x) : x;
        plot->x[1] = plot->n ? fmax(plot->x[1], x) : x;
        plot->mark[plot->n++] = (fracas_mean_mark){
            .point = p,
            .series = of->series[p],
            .panel = of->panel[p],
            .drawing = (of->drawing[p] * pages + of->panel[p] / FRACAS_MEANS_PANELS) * parts +
                       of->series[p] / FRACAS_MEANS_SERIES};
    }
}

/* Numbers drawings anew from 0, without gaps; returns how many there are. */
static size_t number_drawings(fracas_means_plot *plot)
{
    size_t count = 0;
    for (size_t low = 0;; count++) {
        size_t next = SIZE_MAX;
        for (size_t m = 0; m < plot->n; m++)
            if (plot->mark[m].drawing >= low && plot->mark[m].drawing < next)
                next = plot->mark[m].drawing;
        if (next == SIZE_MAX) return count;
        for (size_t m = 0; m < plot->n; m++)
            if (plot->mark[m].drawing == next) plot->mark[m].drawing = count;
        low = next + 1;
    }
}

static fracas_err find_marks(fracas_means_plot *plot, size_t *ndrawings)
{
    const fracas_point_table *table = plot->analysis->table;
    const fracas_means_axes *axes = plot->axes;
    OWNED size_t *class = calloc(3 * table->npoints + 1, sizeof *class);
    plot->mark = calloc(table->npoints + 1, sizeof *plot->mark);
    if (!plot->mark || !class) return fracas_no_memory("a figure");
    const classes of = {class, class + table->npoints, class + 2 * table->npoints};
    plot->nseries = fracas_columns_classes(table, &axes->series, of.series);
    plot->npanels = fracas_columns_classes(table, &axes->panels, of.panel);
    fracas_columns_classes(table, &axes->drawings, of.drawing);
    number_marks(&of, plot);
    *ndrawings = number_drawings(plot);
    return FRACAS_OK;
}

/* Against the rate: fitted powers and crossovers, and the names of their series. */
static fracas_err find_fits(fracas_means_plot *plot)
{
    FRACAS_CLEARED(fracas_columns) rates = {0};
    if (!plot->axes->rate || plot->of == FRACAS_MEANS_OTHER) return FRACAS_OK;
    TRY(fracas_columns_without_rate(plot->analysis->table, &plot->analysis->shown, &rates));
    for (size_t m = 0; m < plot->n; m++)
        fracas_columns_label(plot->analysis->table, &rates, plot->mark[m].point, plot->mark[m].name,
                             sizeof plot->mark[m].name);
    if (plot->of == FRACAS_MEANS_COUNT)
        return fracas_count_slopes(plot->analysis, true, &plot->slope, &plot->nslopes);
    if (!fracas_means_normalised(plot))
        TRY(fracas_size_slopes(plot->analysis, &plot->slope, &plot->nslopes));
    return fracas_size_crossovers(plot->analysis, false, &plot->crossover, &plot->ncrossovers);
}

/* The first mark of a series; SIZE_MAX: it has none here. */
static size_t first_of(const fracas_means_plot *plot, size_t series)
{
    for (size_t m = 0; m < plot->n; m++)
        if (plot->mark[m].series == series) return m;
    return SIZE_MAX;
}

/* ---- marks ---- */

/* The marks of a series. */
static fracas_err add_means(const fracas_means_plot *plot, const fracas_ordinate *ordinate,
                            size_t number, fracas_panel *panel)
{
    fracas_series *series;
    TRY(fracas_panel_add(panel, FRACAS_MARKS, (unsigned)number, plot->n, &series));
    FRACAS_PRINT(series->name, ordinate->over ? "mean, 95 %% interval" : "95 %% interval");
    series->n = 0;
    for (size_t m = 0; m < plot->n; m++) {
        if (plot->mark[m].series != number) continue;
        const fracas_point_statistics *statistics = fracas_means_statistics(plot, m);
        double low, high;
        const double value = fracas_ordinate_at(ordinate, statistics, &low, &high);
        const double unit = units_of(plot, &statistics->scales).size;
        const size_t i = series->n++;
        if (i == 0 && plot->axes->series.count > 0)
            fracas_columns_label(plot->analysis->table, &plot->axes->series, plot->mark[m].point,
                                 series->name, sizeof series->name);
        series->x[i] = x_of(plot, plot->mark[m].point);
        series->y[i] = value / unit;
        series->low[i] = low / unit;
        series->high[i] = high / unit;
    }
    return FRACAS_OK;
}

/* None where two marks have one abscissa. */
static fracas_err join_means(const fracas_means_plot *plot, fracas_panel *panel)
{
    const size_t marks = panel->nseries - 1;
    fracas_series *line;
    if (!fracas_means_joined(plot)) return FRACAS_OK;
    const size_t n = panel->series[marks].n;
    TRY(fracas_panel_add(panel, FRACAS_CURVE, panel->series[marks].look, n, &line));
    const fracas_series *of = &panel->series[marks];
    line->n = 0;
    for (size_t i = 0; i < n; i++) { /* sorted in */
        size_t at = line->n++;
        for (; at > 0 && line->x[at - 1] > of->x[i]; at--) {
            line->x[at] = line->x[at - 1];
            line->y[at] = line->y[at - 1];
        }
        line->x[at] = of->x[i];
        line->y[at] = of->y[i];
    }
    for (size_t i = 1; i < n; i++)
        if (line->x[i] == line->x[i - 1]) line->n = 0;
    if (line->n < 2) line->n = 0;
    return FRACAS_OK;
}

/* ---- laws of the strain rate ---- */

/* Values of a curve: in a narrow panel fewer of them are as smooth. */
static size_t law_values(const fracas_means_plot *plot)
{
    return plot->axes->panels.count > 0 ? 40 : 80;
}

/* A curve over the rates of all marks and a factor of two beyond, without its y. */
static fracas_err add_curve(const fracas_means_plot *plot, unsigned look, fracas_panel *panel,
                            fracas_series **series)
{
    const size_t n = law_values(plot);
    TRY(fracas_panel_add(panel, FRACAS_CURVE, look, n, series));
    for (size_t i = 0; i < n; i++)
        (*series)->x[i] = plot->x[0] / 2 *
                          pow(4 * plot->x[1] / plot->x[0], (double)i / (double)(n - 1));
    return FRACAS_OK;
}

static fracas_err add_law(const fracas_means_plot *plot, fracas_scaling_law_id law,
                          const fracas_scales *scales, unsigned look, fracas_panel *panel)
{
    fracas_series *series;
    TRY(add_curve(plot, look, panel, &series));
    FRACAS_PRINT(series->name, "%s", fracas_scaling_laws[law].name);
    for (size_t i = 0; i < series->n; i++)
        series->y[i] = fracas_means_normalised(plot)
                           ? fracas_scaling_laws[law].normalised(series->x[i], scales->modulus)
                           : fracas_scaling_law_at(law, scales, series->x[i]) * plot->factor;
    return FRACAS_OK;
}

/* True if one curve of a scaling law serves all marks of a series, or of ALL_SERIES. */
static bool same_scales(const fracas_means_plot *plot, size_t series)
{
    const fracas_scales *first = NULL;
    for (size_t m = 0; m < plot->n; m++) {
        const fracas_scales *scales = &fracas_means_statistics(plot, m)->scales;
        if (!mark_has_scales(plot, m) || (series != ALL_SERIES && plot->mark[m].series != series))
            continue;
        if (first && !fracas_scales_same(first, scales)) return false;
        first = scales;
    }
    return true;
}

bool fracas_means_series_serves(const fracas_means_plot *plot, size_t series)
{
    return same_scales(plot, series);
}

/* True if the law is a number, and one curve of it serves all marks: Mott's only where all
 * strengths have one modulus. */
static bool law_serves(const fracas_means_plot *plot, fracas_scaling_law_id law,
                       const fracas_scales *scales)
{
    if (!isfinite(fracas_scaling_laws[law].normalised(1, scales->modulus))) return false;
    for (size_t m = 0; law == FRACAS_LAW_MOTT && m < plot->n; m++)
        if (mark_has_scales(plot, m) &&
            !(fabs(fracas_means_statistics(plot, m)->scales.modulus / scales->modulus - 1) < 1e-9))
            return false;
    return true;
}

/* All laws where one curve each serves all marks; else ZMR in the colour of each series it serves.
 * None for surfaces, and none against anything but the rate. */
static fracas_err add_laws(const fracas_means_plot *plot, size_t number, bool *drawn,
                           fracas_panel *panel)
{
    const size_t first = first_of(plot, number);
    const fracas_scales *scales = &fracas_means_statistics(plot, first)->scales;
    if (!plot->axes->rate || !mark_has_scales(plot, first) || *drawn) return FRACAS_OK;
    if (fracas_means_normalised(plot) || plot->same_scales) {
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

/* The look of the series that slopes and crossovers know by this name; false: it has no marks here.
 */
static bool look_of(const fracas_means_plot *plot, const char *name, bool only, unsigned *look)
{
    *look = 0;
    if (only) return true;
    for (size_t m = 0; m < plot->n; m++) {
        *look = (unsigned)plot->mark[m].series;
        if (!strcmp(plot->mark[m].name, name)) return true;
    }
    return false;
}

static bool series_has_scales(const fracas_means_plot *plot, unsigned series)
{
    for (size_t m = 0; m < plot->n; m++)
        if (plot->mark[m].series == series && mark_has_scales(plot, m)) return true;
    return false;
}

/* The fitted line of each series, in the colour of its marks; sizes only of those that have no
 * laws.
 */
static fracas_err add_slopes(const fracas_means_plot *plot, fracas_panel *panel)
{
    const bool only = fracas_means_alone(plot), beside_laws = plot->of == FRACAS_MEANS_COUNT;
    for (size_t i = 0; i < plot->nslopes; i++) {
        const fracas_size_slope *of = &plot->slope[i];
        unsigned number;
        fracas_series *series;
        if (!look_of(plot, of->name, only, &number)) continue; /* through several series */
        if (!beside_laws && series_has_scales(plot, number)) continue;
        TRY(add_curve(plot, number + 2 * FRACAS_CHART_COLOURS, panel, &series));
        for (size_t v = 0; v < series->n; v++)
            series->y[v] = fracas_slope_at(&of->slope, series->x[v]) * plot->factor;
        if (only)
            FRACAS_PRINT(series->name, "fitted: power %s", fracas_slope_text(&of->slope).text);
    }
    return FRACAS_OK;
}

/* The fitted crossover of each series, in the colour of its marks. */
static fracas_err add_crossovers(const fracas_means_plot *plot, fracas_panel *panel)
{
    const bool only = plot->ncrossovers == 1 && plot->npanels == 1;
    for (size_t i = 0; i < plot->ncrossovers; i++) {
        const fracas_size_crossover *of = &plot->crossover[i];
        const fracas_scales unit = units_of(plot, &of->scales);
        unsigned look;
        fracas_series *series;
        if (*of->reason || !isfinite(unit.rate) || !isfinite(unit.size)) continue;
        if (!look_of(plot, of->name, only, &look)) continue; /* surfaces have no normalised sizes */
        /* ZMR has the other dashes */
        TRY(add_curve(plot, look + (only ? 0 : FRACAS_CHART_COLOURS), panel, &series));
        for (size_t v = 0; v < series->n; v++)
            series->y[v] = fracas_crossover_at(of, series->x[v] * unit.rate) / unit.size;
        if (only) FRACAS_PRINT(series->name, "fitted crossover");
    }
    return FRACAS_OK;
}

/* ---- charts ---- */

/* Marks with dust on those without it, where there is much. */
static fracas_err add_counts(const fracas_means_plot *plot, size_t series, fracas_panel *panel)
{
    if (fracas_analysis_much_dust(plot->analysis)) {
        const fracas_ordinate large_count = fracas_ordinate_of(
            &fracas_realization_numbers[FRACAS_NUMBER_count_large]);
        TRY(add_means(plot, &large_count, series, panel));
        fracas_series *large = &panel->series[panel->nseries - 1];
        large->open = true;
        fracas_append(large->name, sizeof large->name, ", ", "without dust");
    }
    TRY(add_means(plot, &plot->ordinate, series, panel));
    return join_means(plot, panel);
}

static fracas_err add_series(const fracas_means_plot *plot, fracas_panel *panel)
{
    bool drawn = false; /* laws for all series */
    for (size_t s = 0; s < plot->nseries; s++) {
        if (first_of(plot, s) == SIZE_MAX) continue;
        if (plot->of == FRACAS_MEANS_COUNT) {
            TRY(add_counts(plot, s, panel));
            continue;
        }
        if (plot->of != FRACAS_MEANS_OTHER) TRY(add_laws(plot, s, &drawn, panel));
        TRY(add_means(plot, &plot->ordinate, s, panel));
        TRY(join_means(plot, panel));
    }
    TRY(add_slopes(plot, panel));
    return add_crossovers(plot, panel);
}

/* The marks of a drawing, or of a panel of it, in `mark`. */
static fracas_means_plot part_of(const fracas_means_plot *whole, size_t drawing, size_t panel,
                                 fracas_mean_mark *mark)
{
    fracas_means_plot plot = *whole;
    plot.mark = mark;
    plot.n = 0;
    for (size_t m = 0; m < whole->n; m++)
        if (whole->mark[m].drawing == drawing &&
            (panel == SIZE_MAX || whole->mark[m].panel == panel))
            mark[plot.n++] = whole->mark[m];
    return plot;
}

/* One curve of a law serves the marks of each panel. */
static bool panels_have_scales(const fracas_means_plot *whole, size_t drawing,
                               fracas_mean_mark *mark)
{
    for (size_t p = 0; p < whole->npanels; p++) {
        const fracas_means_plot plot = part_of(whole, drawing, p, mark);
        if (!same_scales(&plot, ALL_SERIES)) return false;
    }
    return true;
}

/* The drawing of this number, panel by panel. */
static fracas_err draw(const fracas_means_plot *whole, size_t drawing, const char *sign,
                       fracas_chart *chart)
{
    OWNED fracas_mean_mark *mark = calloc(whole->n + 1, sizeof *mark);
    if (!mark) return fracas_no_memory("a figure");
    const bool same = panels_have_scales(whole, drawing, mark),
               multiples = whole->axes->panels.count > 0;
    fracas_means_plot plot = part_of(whole, drawing, SIZE_MAX, mark);
    plot.same_scales = same;
    fracas_means_name(&plot, drawing, chart);
    for (size_t p = 0; p < whole->npanels; p++) {
        plot = part_of(whole, drawing, p, mark);
        plot.same_scales = same;
        if (plot.n == 0) continue;
        fracas_panel *panel = fracas_chart_add(chart, multiples ? MULTIPLE : TALL);
        fracas_means_set_axes(whole, sign, chart, panel);
        if (multiples) fracas_means_name_panel(&plot, panel);
        TRY(add_series(&plot, panel));
    }
    if (!multiples || chart->npanels == 0) return FRACAS_OK;
    if (chart->npanels > 1) chart->width = FRACAS_CHART_MULTIPLES;
    chart->columns = chart->npanels == 4 ? 2 : chart->npanels < 3 ? chart->npanels : 3;
    return FRACAS_OK;
}

void fracas_charts_clear(fracas_charts *charts)
{
    for (size_t i = 0; i < charts->count; i++) fracas_chart_clear(&charts->chart[i]);
    free(charts->chart);
    *charts = (fracas_charts){0};
}

static size_t most_drawings(const fracas_means_plot *plot)
{
    const size_t panels = plot->npanels < FRACAS_MEANS_PANELS ? plot->npanels : FRACAS_MEANS_PANELS,
                 most = FRACAS_MOST_PANELS / (panels > 0 ? panels : 1);
    return most < FRACAS_MOST_DRAWINGS ? most : FRACAS_MOST_DRAWINGS;
}

static fracas_err make_charts(fracas_means_plot *plot, const char *sign, fracas_charts *charts)
{
    size_t ndrawings = 0;
    TRY(find_marks(plot, &ndrawings));
    TRY(find_fits(plot));
    const size_t most = most_drawings(plot);
    charts->left_out = ndrawings > most ? ndrawings - most : 0;
    ndrawings -= charts->left_out;
    charts->chart = calloc(ndrawings + 1, sizeof *charts->chart);
    if (!charts->chart) return fracas_no_memory("a figure");
    for (size_t d = 0; d < ndrawings; d++) {
        fracas_chart_init(&charts->chart[charts->count++]);
        TRY(draw(plot, d, sign, &charts->chart[d]));
    }
    if (ndrawings > 1 || plot->axes->panels.count > 0)
        fracas_charts_align(charts->chart, ndrawings);
    return FRACAS_OK;
}

/* A prefix for all values of the ordinate. */
static fracas_err prefix_of(const fracas_analysis *analysis, const fracas_ordinate *ordinate,
                            fracas_prefix *prefix)
{
    const size_t npoints = analysis->table->npoints;
    double low, high;
    OWNED double *value = calloc(npoints + 1, sizeof *value);
    if (!value) return fracas_no_memory("a figure");
    for (size_t p = 0; p < npoints; p++)
        value[p] = fracas_ordinate_at(ordinate, &analysis->point[p], &low, &high);
    *prefix = fracas_prefix_in(ordinate->unit, value, npoints);
    return FRACAS_OK;
}

static fracas_err figure(const fracas_analysis *analysis, fracas_means of,
                         const fracas_ordinate *ordinate, fracas_charts *charts)
{
    fracas_prefix prefix;
    *charts = (fracas_charts){0};
    TRY(prefix_of(analysis, ordinate, &prefix));
    FRACAS_CLEARED(fracas_means_plot)
    plot = {.analysis = analysis,
            .axes = &analysis->axes,
            .of = of,
            .ordinate = *ordinate,
            .factor = prefix.factor};
    if (!*analysis->axes.key || (of == FRACAS_MEANS_NORMALISED && !analysis->axes.rate))
        return FRACAS_OK;
    return make_charts(&plot, prefix.sign, charts);
}

fracas_err fracas_figure_means(const fracas_analysis *analysis, fracas_means of,
                               fracas_charts *charts)
{
    const fracas_ordinate ordinate = fracas_ordinate_of(
        &fracas_realization_numbers[of == FRACAS_MEANS_COUNT ? FRACAS_NUMBER_count
                                                             : FRACAS_NUMBER_size]);
    return figure(analysis, of, &ordinate, charts);
}

fracas_err fracas_figure_ordinate(const fracas_analysis *analysis, const fracas_ordinate *ordinate,
                                  fracas_charts *charts)
{
    return figure(analysis, FRACAS_MEANS_OTHER, ordinate, charts);
}
