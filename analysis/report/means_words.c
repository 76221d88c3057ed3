/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names, captions and axes of figures of means. */
#include "analysis/report/means_plot.h"

#include "analysis/data/format.h"
#include "analysis/data/words.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static fracas_number_text replicas_text(const fracas_means_plot *plot)
{
    const fracas_analysis *analysis = plot->analysis;
    size_t least = SIZE_MAX, most = 0; /* replicas a mark */
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const size_t n = (size_t)analysis->point[p].size.n;
        if (!fracas_means_has(plot, p)) continue;
        least = n < least ? n : least;
        most = n > most ? n : most;
    }
    return fracas_figure_range(least, most);
}

static const char *lines_of(const fracas_means_plot *plot)
{
    return fracas_means_joined(plot) ? " Lines join the marks of a series." : "";
}

static void caption_of_size(const fracas_means_plot *plot, fracas_chart *chart)
{
    const fracas_number_text n = replicas_text(plot);
    const bool rate = plot->axes->rate, normalised = fracas_means_normalised(plot);
    if (fracas_analysis_all_surfaces(plot->analysis)) {
        FRACAS_PRINT(chart->caption,
                     "Mean over replicas (n = %s) of the mean square root of a fragment\u2019s "
                     "area, dust included; bars: 95 %% interval of the mean (Student\u2019s t over "
                     "replicas).%s%s",
                     n.text, lines_of(plot),
                     rate ? " Lines: powers of the rate, and a crossover where there is one, "
                            "fitted to the marks of the same colour. The scaling laws are of bars "
                            "and rings."
                          : "");
        return;
    }
    FRACAS_PRINT(
        chart->caption,
        "%sMean over replicas (n = %s) of body length / fragments%s%s; bars: 95 %% interval of the "
        "mean (Student\u2019s t over replicas).%s%s%s",
        normalised ? "Sizes over s\u2080 = E G_c/\u03c3_c\u00b2, rates over \u03b5\u0307\u2080 "
                     "= c \u03c3_c\u00b3/(E\u00b2 G_c), \u03c3_c the mean strength. "
                   : "",
        n.text,
        !normalised && fracas_analysis_any_surface(plot->analysis)
            ? ", of surfaces of the mean square root of their areas"
            : "",
        rate && !normalised && fracas_analysis_any_surface(plot->analysis)
            ? ", with a fitted power of the rate"
            : "",
        lines_of(plot),
        !rate ? ""
        : normalised || plot->same_scales
            ? " Lines: scaling laws of Zhou, Molinari and Ramesh (ZMR, ZMR-2), Grady, and Glenn "
              "and Chudnovsky (GC); Mott\u2019s where all strengths have one Weibull modulus."
            : " Lines: ZMR law with the material of the marks of the same colour, where these "
              "have one.",
        rate ? " A crossover fitted to the marks, where there is one, is a line in their colour, "
               "too."
             : "");
}

static void caption_of_count(const fracas_means_plot *plot, fracas_chart *chart)
{
    FRACAS_PRINT(
        chart->caption,
        "Mean over replicas (n = %s) of the number of fragments of a body, dust "
        "included%s; bars: 95 %% interval of the mean (Student\u2019s t over replicas).%s%s",
        replicas_text(plot).text,
        fracas_analysis_much_dust(plot->analysis) ? ", and without it (open marks)" : "",
        lines_of(plot),
        plot->axes->rate
            ? " Lines: powers of the rate fitted to the filled marks of the same colour."
            : "");
}

static void caption_of_other(const fracas_means_plot *plot, fracas_chart *chart)
{
    const fracas_ordinate *of = &plot->ordinate;
    const bool interval = of->half_width != SIZE_MAX || of->low != SIZE_MAX;
    FRACAS_PRINT(chart->caption, "%s %.180s (n = %s)%s.%s",
                 of->over ? "Mean over replicas of the" : "From all usable replicas together: the",
                 of->words, replicas_text(plot).text,
                 of->over   ? "; bars: 95 % interval of the mean (Student\u2019s t over replicas)"
                 : interval ? "; bars: 95 % interval by resampling replicas"
                            : "",
                 lines_of(plot));
}

static const struct {
    const char *file, *suffix, *title, *y;
} texts[] = {
    [FRACAS_MEANS_SIZE] = {"size", "", "Mean fragment size", "mean fragment size [%sm]"},
    [FRACAS_MEANS_NORMALISED] = {"size", "-normalised", "Normalised mean fragment size",
                                 "mean fragment size s/s\u2080"},
    [FRACAS_MEANS_COUNT] = {"count", "", "Mean number of fragments", "mean number of fragments"},
};

/* "count-against-strength-shape-2" */
static void name_file(const fracas_means_plot *plot, size_t drawing, fracas_chart *chart)
{
    const bool other = plot->of == FRACAS_MEANS_OTHER;
    FRACAS_PRINT(chart->file, "%.32s-against-%.38s%s",
                 other ? plot->ordinate.key : texts[plot->of].file,
                 plot->axes->rate ? "rate" : plot->axes->key, other ? "" : texts[plot->of].suffix);
    for (char *dot = chart->file; (dot = strpbrk(dot, "._"));) *dot = '-';
    if (drawing > 0) fracas_append(chart->file, sizeof chart->file, "-", "%zu", drawing + 1);
}

/* "Weibull modulus and radius" */
static void name_columns(const fracas_means_plot *plot, const fracas_columns *columns, char *text,
                         size_t size)
{
    for (size_t i = 0; i < columns->count; i++)
        fracas_append(text, size, " and ", "%s",
                      fracas_column_words(plot->analysis->table, columns->column[i]).text);
}

/* Drawings with more series or panels of the same figure differ in nothing else. */
static void name_drawing(const fracas_means_plot *plot, size_t drawing, fracas_chart *chart)
{
    char label[128] = "";
    if (plot->axes->drawings.count > 0)
        fracas_columns_label(plot->analysis->table, &plot->axes->drawings, plot->mark->point, label,
                             sizeof label);
    if (*label) fracas_append(chart->title, sizeof chart->title, ", ", "%.100s", label);
    if (drawing > 0 &&
        (!*label || plot->nseries > FRACAS_MEANS_SERIES || plot->npanels > FRACAS_MEANS_PANELS))
        fracas_append(chart->title, sizeof chart->title, ", ", "continued");
}

static void caption_of_panels(const fracas_means_plot *plot, fracas_chart *chart)
{
    char words[128] = "";
    name_columns(plot, &plot->axes->panels, words, sizeof words);
    fracas_append(chart->caption, sizeof chart->caption, " ", "A panel for each %s.", words);
}

/* Chains of the figure by the strength of their scales, and those without scales. */
static void caption_of_strengths(const fracas_means_plot *plot, fracas_chart *chart)
{
    size_t by[3] = {0}, without = 0;
    for (size_t p = 0; p < plot->analysis->table->npoints; p++) {
        const fracas_point_statistics *of = &plot->analysis->point[p];
        if (!fracas_means_has(plot, p) || of->surface) continue;
        const bool scales = isfinite(of->scales.size) && isfinite(of->scales.rate);
        if (scales) by[of->strength_by]++;
        without += !scales;
    }
    if (by[FRACAS_STRENGTH_OF_PIECE] > 0)
        fracas_append(
            chart->caption, sizeof chart->caption, " ",
            "With a size effect the laws take the mean strength of a piece s\u2080 long.");
    if (by[FRACAS_STRENGTH_OF_MESH] > 0)
        fracas_append(chart->caption, sizeof chart->caption, " ",
                      "Of %zu point%s they take an interface\u2019s, which a finer mesh makes "
                      "stronger.",
                      by[FRACAS_STRENGTH_OF_MESH], by[FRACAS_STRENGTH_OF_MESH] == 1 ? "" : "s");
    if (without > 0)
        fracas_append(chart->caption, sizeof chart->caption, " ",
                      "%s %zu point%s without a mean strength.",
                      fracas_means_normalised(plot) ? "Left out:" : "No law for", without,
                      without == 1 ? "" : "s");
}

/* Series that no line of a law serves. */
static void caption_of_series(const fracas_means_plot *plot, fracas_chart *chart)
{
    size_t without = 0;
    for (size_t s = 0; s < plot->nseries; s++) without += !fracas_means_series_serves(plot, s);
    if (without > 0 && !plot->same_scales && !fracas_means_normalised(plot))
        fracas_append(chart->caption, sizeof chart->caption, " ",
                      "No line of a law for %zu series, whose points differ in material or mean "
                      "strength.",
                      without);
}

/* Points that the figure leaves out, as with a load without a strain rate. */
static void caption_of_missing(const fracas_means_plot *plot, fracas_chart *chart)
{
    size_t missing = 0;
    for (size_t p = 0; p < plot->analysis->table->npoints; p++) {
        double low, high;
        const double mean = fracas_ordinate_at(&plot->ordinate, &plot->analysis->point[p], &low,
                                               &high);
        missing += isfinite(mean) && !isfinite(plot->axes->value[p]);
    }
    if (missing > 0)
        fracas_append(chart->caption, sizeof chart->caption, " ",
                      missing == 1 ? "%zu point has no %.70s and is not drawn."
                                   : "%zu points have no %.70s and are not drawn.",
                      missing, plot->axes->words);
}

void fracas_means_name(const fracas_means_plot *plot, size_t drawing, fracas_chart *chart)
{
    name_file(plot, drawing, chart);
    FRACAS_PRINT(chart->title, "%.70s against %.70s",
                 plot->of == FRACAS_MEANS_OTHER ? plot->ordinate.words : texts[plot->of].title,
                 plot->axes->words);
    if (plot->n > 0) name_drawing(plot, drawing, chart);
    chart->title[0] = (char)toupper((unsigned char)chart->title[0]);
    if (plot->of == FRACAS_MEANS_OTHER) caption_of_other(plot, chart);
    else if (plot->of == FRACAS_MEANS_COUNT) caption_of_count(plot, chart);
    else caption_of_size(plot, chart);
    if (plot->axes->rate && (plot->of == FRACAS_MEANS_SIZE || fracas_means_normalised(plot))) {
        caption_of_strengths(plot, chart);
        caption_of_series(plot, chart);
    }
    caption_of_missing(plot, chart);
    if (plot->axes->panels.count > 0) caption_of_panels(plot, chart);
    if (plot->nseries > FRACAS_MEANS_SERIES)
        fracas_append(chart->caption, sizeof chart->caption, " ",
                      "At most %d of %zu series: the others follow.", FRACAS_MEANS_SERIES,
                      plot->nseries);
}

void fracas_means_name_panel(const fracas_means_plot *plot, fracas_panel *panel)
{
    fracas_columns_label(plot->analysis->table, &plot->axes->panels, plot->mark->point,
                         panel->title, sizeof panel->title);
}

/* Marks at the ends of the range do not lie on the frame. */
static void leave_room(const double range[2], fracas_axis *axis)
{
    const double part = 0.04, apart = range[1] - range[0];
    if (axis->nnames || !(apart > 0)) return;
    axis->show[0] = axis->log      ? range[0] * pow(range[0] / range[1], part)
                    : range[0] < 0 ? range[0] - part * apart
                                   : fmax(0, range[0] - part * apart);
    axis->show[1] = axis->log ? range[1] * pow(range[1] / range[0], part) : range[1] + part * apart;
}

static void label_other(const fracas_means_plot *plot, const char *sign, fracas_axis *axis)
{
    const fracas_ordinate *of = &plot->ordinate;
    const bool pure = !*of->unit || !strcmp(of->unit, "1");
    const size_t room = pure ? 44 : 36; /* characters beside a panel */
    FRACAS_PRINT(axis->label, "%.44s", strlen(of->words) <= room ? of->words : of->key);
    if (!pure) fracas_append(axis->label, sizeof axis->label, " ", "[%s%s]", sign, of->unit);
}

enum { MOST_TWICE = 300 }; /* marks of a figure that a page has twice, for other axes */

/* Sizes and counts go with powers of the rate; against anything else an axis is logarithmic if its
 * values are of several decades. */
void fracas_means_set_axes(const fracas_means_plot *plot, const char *sign, fracas_chart *chart,
                           fracas_panel *panel)
{
    const bool other = plot->of == FRACAS_MEANS_OTHER;
    double least = INFINITY, most = -INFINITY;
    for (size_t m = 0; m < plot->n; m++) {
        double low, high;
        const double mean = fracas_ordinate_at(&plot->ordinate, fracas_means_statistics(plot, m),
                                               &low, &high);
        least = fmin(least, mean);
        most = fmax(most, mean);
    }
    panel->x.log = plot->axes->log;
    panel->y.log = (plot->axes->rate && !other) || (least > 0 && most >= 10 * least);
    panel->x.nnames = plot->axes->nnames;
    panel->x.name = plot->axes->name;
    leave_room(plot->x, &panel->x);
    if ((panel->x.log || panel->y.log) && plot->n <= MOST_TWICE) chart->offers = FRACAS_AXES_LINEAR;
    if (fracas_means_normalised(plot))
        FRACAS_PRINT(panel->x.label, "strain rate \u03b5\u0307/\u03b5\u0307\u2080");
    else FRACAS_PRINT(panel->x.label, "%s", plot->axes->label);
    const double factor = plot->factor, range[] = {least * factor, most * factor};
    if (other && !panel->y.log) leave_room(range, &panel->y);
    if (other) label_other(plot, sign, &panel->y);
    else if (plot->of == FRACAS_MEANS_SIZE)
        FRACAS_PRINT(panel->y.label, "mean fragment size [%sm]", sign);
    else FRACAS_PRINT(panel->y.label, "%s", texts[plot->of].y);
}
