/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of a convergence: conclusions, a figure a number, the table. */
#include "analysis/converge/rows.h"

#include "analysis/report/page.h"
#include "base/param.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>

static void put_line(void *out, const char *text)
{
    fracas_markup(out, "<li>%s</li>\n", text);
}

static fracas_err put_summary(fracas_page *page)
{
    fputs("<ul id=\"conclusions\">\n", page->out);
    fracas_convergence_conclude(page->of, put_line, page->out);
    fputs("</ul>\n", page->out);
    return FRACAS_OK;
}

static fracas_err put_figures(fracas_page *page)
{
    fracas_chart chart;
    fracas_chart_init(&chart);
    fracas_page_grid(page, "wide");
    for (size_t v = 0; v < FRACAS_COMPARED_VALUES; v++)
        TRY(fracas_page_chart(
            page, &chart,
            fracas_convergence_figure(page->of, &fracas_compared_quantities[v], &chart)));
    fracas_page_grid_end(page);
    return FRACAS_OK;
}

static fracas_err put_numbers(fracas_page *page)
{
    static const char *const legend[] = {
        "change: of the mean, with the half width of its 95 % interval: of pairs with the same "
        "strengths for step and beta, by Welch for mesh; half widths: in those of the number as it "
        "is.",
        "moved: Holm's p among all numbers is below 0.05, and the interval is not within the "
        "tolerance; shifted: it is; holds: it is, and p is not; unclear: neither.",
        NULL,
    };
    fracas_result_table table = {0};
    const fracas_err built = fracas_convergence_table_create(page->of, true, &table);
    TRY(fracas_page_table(page, "numbers", "What refinement changes, a line a number", true, &table,
                          legend, built));
    fputs("<p>All digits, in SI units: <a href=\"../converge.csv\">converge.csv</a>. Below each "
          "figure are its drawing and its data.</p>\n",
          page->out);
    return FRACAS_OK;
}

static const fracas_page_entry sections[] = {
    {"summary", "Summary", put_summary},
    {"changes", "Changes", put_figures},
    {"table-of-numbers", "Numbers", put_numbers},
};

fracas_err fracas_convergence_write_page(const fracas_convergence *convergence, const char *folder,
                                         const char *title)
{
    char *to, lead[160];
    if (asprintf(&to, "%s/report", folder) < 0) return fracas_no_memory("a path");
    fracas_page page = {
        .analysis = convergence->study, .folder = to, .of = convergence, .source = title};
    const size_t npoints = convergence->study->table->npoints;
    FRACAS_PRINT(lead, "What refinement changes: %zu point%s, %zu numbers, tolerance %g %%",
                 npoints, npoints == 1 ? "" : "s", convergence->nrows,
                 100 * convergence->tolerance);
    fracas_err err = mkdir(to, 0777) && errno != EEXIST
                         ? fracas_fail_system(errno, "cannot make the folder %s", to)
                         : FRACAS_OK;
    if (!err) err = fracas_page_write(&page, title, lead, sections, FRACAS_COUNT(sections));
    free(to);
    return err;
}
