/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sections of figures and tables. */
#include "analysis/data/output.h"
#include "analysis/draw/picture.h"
#include "analysis/export/tables.h"
#include "analysis/report/figures.h"
#include "analysis/report/page.h"
#include "analysis/summary/effects.h"

#include <stdlib.h>
#include <string.h>

/* The drawings of a figure of the study, with the same axes. */
static fracas_err put_drawings(fracas_page *page, const fracas_figure *of)
{
    FRACAS_CLEARED(fracas_charts)
    charts = {.chart = calloc(FRACAS_MOST_DRAWINGS, sizeof(fracas_chart))};
    if (!charts.chart) return fracas_no_memory("a figure");
    while (charts.count < FRACAS_MOST_DRAWINGS) {
        fracas_chart *chart = &charts.chart[charts.count++];
        fracas_chart_init(chart);
        TRY(of->draw(page->analysis, charts.count - 1, chart));
        if (chart->npanels > 0) continue;
        charts.count--;
        break;
    }
    if (charts.count > 1) fracas_charts_align(charts.chart, charts.count);
    for (size_t i = 0; i < charts.count; i++)
        TRY(fracas_page_chart(page, &charts.chart[i], FRACAS_OK));
    return FRACAS_OK;
}

static fracas_err put_figures(fracas_page *page, const char *section, bool each, size_t number,
                              const fracas_figure **first)
{
    fracas_chart chart;
    fracas_chart_init(&chart);
    for (const fracas_figure *of = fracas_figures; of->section; of++) {
        if (strcmp(of->section, section) != 0 || of->each != each) continue;
        if (!*first) fracas_page_grid(page, (*first = of)->grid);
        if (each) TRY(fracas_page_chart(page, &chart, of->draw(page->analysis, number, &chart)));
        else TRY(put_drawings(page, of));
    }
    return FRACAS_OK;
}

/* Below the figures of points where not all have some. */
static void say_drawn(fracas_page *page, int before)
{
    const size_t n = fracas_analysis_ndrawn(page->analysis),
                 npoints = page->analysis->table->npoints;
    if (n == npoints || page->figures == before) return;
    fprintf(page->out,
            "<p>Drawn are %zu of %zu points. Others: <code>fracas report STUDY --points "
            "3,17,20-25</code>.</p>\n",
            n, npoints);
}

fracas_err fracas_section_figures(fracas_page *page, const char *section)
{
    const size_t npoints = page->analysis->table->npoints;
    const fracas_figure *first = NULL;
    const int before = page->figures;
    TRY(put_figures(page, section, false, 0, &first));
    if (first) fracas_page_grid_end(page);
    first = NULL;
    for (size_t p = 0; p < npoints; p++)
        if (fracas_analysis_draws(page->analysis, p))
            TRY(put_figures(page, section, true, p, &first));
    if (first) fracas_page_grid_end(page);
    say_drawn(page, before);
    return FRACAS_OK;
}

enum { FEW_DRAWINGS = 4 }; /* at most, where nobody asked for the statistic */

static fracas_err put_ordinate(fracas_page *page, const fracas_ordinate *ordinate, size_t *left_out)
{
    FRACAS_CLEARED(fracas_charts) charts = {0};
    TRY(fracas_figure_ordinate(page->analysis, ordinate, &charts));
    if (!page->analysis->asked && charts.count + charts.left_out > FEW_DRAWINGS) return FRACAS_OK;
    if (charts.count == 0 && page->analysis->asked && *page->analysis->axes.key)
        fprintf(page->out, "<p>No point has <code>%s</code>.</p>\n", ordinate->key);
    for (size_t i = 0; i < charts.count; i++)
        TRY(fracas_page_chart(page, &charts.chart[i], FRACAS_OK));
    *left_out = charts.left_out > *left_out ? charts.left_out : *left_out;
    return FRACAS_OK;
}

static fracas_err put_means(fracas_page *page, fracas_means of, size_t *left_out)
{
    FRACAS_CLEARED(fracas_charts) charts = {0};
    TRY(fracas_figure_means(page->analysis, of, &charts));
    for (size_t i = 0; i < charts.count; i++)
        TRY(fracas_page_chart(page, &charts.chart[i], FRACAS_OK));
    *left_out = charts.left_out > *left_out ? charts.left_out : *left_out;
    return FRACAS_OK;
}

fracas_err fracas_section_means(fracas_page *page)
{
    size_t left_out = 0;
    if (!*page->analysis->axes.key)
        fputs("<p>The points differ in nothing, and have no strain rate above 0: nothing to draw "
              "means against.</p>\n",
              page->out);
    fracas_page_grid(page, "wide");
    TRY(put_means(page, FRACAS_MEANS_SIZE, &left_out));
    TRY(put_means(page, FRACAS_MEANS_NORMALISED, &left_out));
    TRY(put_means(page, FRACAS_MEANS_COUNT, &left_out));
    for (size_t i = 0; i < page->analysis->nordinates; i++)
        TRY(put_ordinate(page, &page->analysis->ordinate[i], &left_out));
    fracas_page_grid_end(page);
    if (left_out > 0)
        fprintf(page->out,
                "<p>%zu more drawing%s of each mean %s left out: choose axes by <code>fracas "
                "report STUDY --x KEY --series KEY</code>; <a href=\"points.csv\">points.csv</a> "
                "has all points.</p>\n",
                left_out, left_out > 1 ? "s" : "", left_out > 1 ? "are" : "is");
    return FRACAS_OK;
}

static fracas_err write_pattern(fracas_page *page, const fracas_picture *picture)
{
    char name[sizeof picture->file + 8];
    FRACAS_PRINT(name, "%s.svg", picture->file);
    fracas_output_file output;
    TRY(fracas_page_make_room(page, picture->file));
    TRY(fracas_output_open(page->folder, name, &output));
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", output.file);
    fracas_picture_write(picture, true, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    FRACAS_PRINT(name, "%s.csv", picture->file);
    TRY(fracas_output_open(page->folder, name, &output));
    fracas_picture_csv(picture, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    return fracas_page_drew(page, picture->file);
}

static fracas_err put_pattern(fracas_page *page, size_t point)
{
    fracas_picture picture;
    TRY(fracas_picture_create(page->analysis, point, &picture));
    fracas_page_figure(page, picture.file, NULL);
    fracas_picture_write(&picture, false, page->out);
    fracas_page_figure_end(page, picture.title, picture.caption, picture.file, true, true);
    fracas_err err = write_pattern(page, &picture);
    fracas_picture_clear(&picture);
    return err;
}

fracas_err fracas_section_patterns(fracas_page *page)
{
    size_t point[FRACAS_MAX_PICTURES], count = fracas_picture_points(page->analysis, point);
    fracas_page_grid(page, "wide");
    for (size_t i = 0; i < count; i++) TRY(put_pattern(page, point[i]));
    fracas_page_grid_end(page);
    return FRACAS_OK;
}

static void put_of_point(const fracas_page *page, size_t p, const char *text)
{
    const fracas_label label = fracas_analysis_label(page->analysis, p);
    fprintf(page->out, "<p>Point %zu%s", p, *label.text ? ", " : "");
    fracas_markup(page->out, "%s: %s.</p>\n", label.text, text);
}

static void put_whole_bodies(const fracas_page *page)
{
    for (size_t p = 0; p < page->analysis->table->npoints; p++) {
        char text[256];
        if (!fracas_analysis_draws(page->analysis, p)) continue;
        const fracas_fits_row *whole = fracas_fits_find(page->fits, (int64_t)p, "data", "whole");
        if (!whole || !(whole->value > 0)) continue;
        FRACAS_PRINT(text, "%.0f %s", whole->value, whole->note);
        put_of_point(page, p, text);
    }
}

static void put_comparisons(const fracas_page *page)
{
    char text[256];
    for (size_t p = 0; p < page->analysis->table->npoints; p++)
        if (fracas_analysis_draws(page->analysis, p) &&
            fracas_fits_format_comparison(page->fits, (int64_t)p, text, sizeof text))
            put_of_point(page, p, text);
}

fracas_err fracas_section_fits(fracas_page *page)
{
    fracas_chart chart;
    fracas_result_table table = {0};
    const fracas_shown_fits *shown = page->shown;
    if (shown->stale)
        fprintf(page->out,
                "<p>What <code>fracas fit</code> kept of %zu point%s is not of these results: run "
                "it again.</p>\n",
                shown->stale, shown->stale == 1 ? "" : "s");
    if (shown->left_out) fracas_markup(page->out, "<p>%s.</p>\n", shown->left_out);
    const bool any = page->fits && page->fits->n > 0;
    const int before = page->figures;
    if (any) {
        put_whole_bodies(page);
        fracas_page_grid(page, "wide");
    }
    fracas_chart_init(&chart);
    for (size_t p = 0; p < page->analysis->table->npoints; p++)
        if (fracas_analysis_draws(page->analysis, p))
            TRY(fracas_page_chart(page, &chart,
                                  fracas_figure_fits(page->analysis, page->fits, p, &chart)));
    if (!any) return FRACAS_OK;
    fracas_page_grid_end(page);
    say_drawn(page, before);
    const fracas_err built = fracas_fit_table_create(page->analysis, page->fits, &table);
    TRY(fracas_page_table(page, "fits-table", "Families of distributions, by AICc", true, &table,
                          fracas_fit_table_legend, built));
    put_comparisons(page);
    return FRACAS_OK;
}

static void put_decisions(const fracas_page *page)
{
    char text[512];
    bool any = false;
    for (size_t p = 0; p < page->analysis->table->npoints; p++) {
        if (!fracas_analysis_decided(page->analysis, p, text, sizeof text)) continue;
        if (!any)
            fputs("<p>Replicas were added until the mean was known well enough:</p>\n<ul "
                  "id=\"decisions\">\n",
                  page->out);
        any = true;
        fracas_markup(page->out, "<li>%s</li>\n", text);
    }
    if (any) fputs("</ul>\n", page->out);
}

fracas_err fracas_section_results(fracas_page *page)
{
    char beside[768];
    fracas_legend legend;
    fracas_result_table table = {0};
    const fracas_err built = fracas_result_table_create(page->analysis, true, &table);
    fracas_result_table_legend(page->analysis, &legend);
    TRY(fracas_page_table(page, "results", "Results, a line a point", true, &table, legend.line,
                          built));
    if (fracas_result_table_beside(page->analysis, beside, sizeof beside))
        fracas_markup(page->out, "<p id=\"beside\">%s</p>\n", beside);
    put_decisions(page);
    return FRACAS_OK;
}

static fracas_err put_side_table(fracas_page *page, fracas_side_table_name name)
{
    const fracas_side_table *of = &fracas_side_tables[name];
    fracas_result_table table = {0};
    const fracas_err built = fracas_side_table_create(page->analysis, name, &table);
    return fracas_page_table(page, of->id, of->title, true, &table, of->legend, built);
}

fracas_err fracas_section_slopes(fracas_page *page)
{
    TRY(put_side_table(page, FRACAS_SLOPES));
    TRY(put_side_table(page, FRACAS_COUNT_SLOPES));
    TRY(put_side_table(page, FRACAS_COUNT_LARGE_SLOPES));
    TRY(put_side_table(page, FRACAS_WINDOWS));
    return put_side_table(page, FRACAS_CROSSOVERS);
}

enum { MOST_EACH = 60 }; /* rows of single settings: effects.csv has any number */

/* Against the strain rate alone slopes say more. */
fracas_err fracas_section_effects(fracas_page *page)
{
    if (!fracas_effects_shown(page->analysis)) return FRACAS_OK;
    TRY(put_side_table(page, FRACAS_EFFECTS));
    const fracas_side_table *of = &fracas_side_tables[FRACAS_EFFECTS_EACH];
    fracas_result_table table = {0};
    TRY(fracas_side_table_create(page->analysis, FRACAS_EFFECTS_EACH, &table));
    if (table.rows <= FRACAS_RESULT_TABLE_HEAD + MOST_EACH)
        return fracas_page_table(page, of->id, of->title, true, &table, of->legend, FRACAS_OK);
    fprintf(page->out, "<p>effects.csv has the %zu changes in single settings.</p>\n",
            table.rows - FRACAS_RESULT_TABLE_HEAD);
    fracas_result_table_clear(&table);
    return FRACAS_OK;
}

fracas_err fracas_section_motion(fracas_page *page)
{
    return put_side_table(page, FRACAS_MOTION);
}

fracas_err fracas_section_files(fracas_page *page)
{
    fputs("<p>In SI units: <a href=\"points.csv\">points.csv</a>, every parameter and statistic of "
          "every point; <a href=\"fragments.csv\">fragments.csv</a>, every fragment; <a "
          "href=\"slopes.csv\">slopes.csv</a>; <a href=\"effects.csv\">effects.csv</a>, changes "
          "with each "
          "parameter; <a href=\"energies.csv\">energies.csv</a>, mean and "
          "band at each time; <a href=\"convergence.csv\">convergence.csv</a>, the headline "
          "numbers from the first replicas; <a href=\"summary.json\">summary.json</a>, all "
          "numbers, and fits, for programs. Below each figure are its drawing and its data, in the "
          "units of its axes.</p>\n",
          page->out);
    return FRACAS_OK;
}
