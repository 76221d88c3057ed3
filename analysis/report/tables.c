/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sections of tables, and the list of files. */
#include "analysis/report/page.h"

#include "analysis/export/side_tables.h"

/* How the replicas were decided, where they were not given. */
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

/* Parameters missing in the table. */
static void put_beside(const fracas_page *page)
{
    char text[768];
    if (!fracas_result_table_beside(page->analysis, text, sizeof text)) return;
    fracas_markup(page->out, "<p id=\"beside\">%s</p>\n", text);
}

fracas_err fracas_section_results(fracas_page *page)
{
    fracas_result_table table = {0};
    const fracas_err built = fracas_result_table_create(page->analysis, true, &table);
    TRY(fracas_page_table(page, "results", "Results, a line a point", true, &table,
                          fracas_result_table_legend(page->analysis), built));
    put_beside(page);
    put_decisions(page);
    return FRACAS_OK;
}

fracas_err fracas_section_slopes(fracas_page *page)
{
    fracas_result_table table = {0};
    const fracas_err built = fracas_slope_table_create(page->analysis, true, &table);
    TRY(fracas_page_table(page, "slopes", "Slope of log(mean size) against log(strain rate)", true,
                          &table, fracas_slope_table_legend, built));
    const fracas_err windows = fracas_window_table_create(page->analysis, true, &table);
    TRY(fracas_page_table(page, "windows", "Slope from each strain rate to the next", true, &table,
                          fracas_window_table_legend, windows));
    const fracas_err crossovers = fracas_crossover_table_create(page->analysis, true, &table);
    return fracas_page_table(page, "crossovers",
                             "Crossover from the quasi-static to the dynamic regime", true, &table,
                             fracas_crossover_table_legend, crossovers);
}

fracas_err fracas_section_motion(fracas_page *page)
{
    fracas_result_table table = {0};
    const fracas_err built = fracas_motion_table_create(page->analysis, true, &table);
    return fracas_page_table(page, "motion", "Velocities of the fragments of rings at the end",
                             true, &table, fracas_motion_table_legend, built);
}

fracas_err fracas_section_files(fracas_page *page)
{
    fputs("<p>In SI units: <a href=\"points.csv\">points.csv</a>, every parameter and statistic of "
          "every point; <a href=\"fragments.csv\">fragments.csv</a>, every fragment; <a "
          "href=\"slopes.csv\">slopes.csv</a>; <a href=\"energies.csv\">energies.csv</a>, mean and "
          "band at each time; <a href=\"convergence.csv\">convergence.csv</a>, the headline "
          "numbers from the first replicas; <a href=\"summary.json\">summary.json</a>, all "
          "numbers, and fits, for programs. Below each figure are its drawing and its data, in the "
          "units of its axes.</p>\n",
          page->out);
    return FRACAS_OK;
}
