/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Page and figures of a convergence. */
#include "analysis/converge/rows.h"
#include "analysis/draw/chart.h"
#include "analysis/data/format.h"
#include "analysis/data/output.h"
#include "analysis/report/page.h"
#include "base/own.h"
#include "base/param.h"
#include "campaigns/store/file/disk.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { HEIGHT = 220, MARK_PIXELS = 22, MARGINS = 150, WIDEST = 940 };
enum { BOX_LOOK = FRACAS_CHART_GREY, TOLERANCE_LOOK = FRACAS_CHART_GREY + 2 };

/* False of a point without a usable realization: its number is unknown, and nothing is drawn of it.
 */
static bool has_change(const fracas_convergence_row *row)
{
    return isfinite(row->value.difference);
}

/* Number of rows with a change. */
static size_t rows_of(const fracas_convergence *convergence, const fracas_number *number)
{
    size_t count = 0;
    for (size_t i = 0; i < convergence->nrows; i++)
        count += convergence->row[i].number == number && has_change(&convergence->row[i]);
    return count;
}

static size_t level_of(const fracas_convergence *convergence, const fracas_convergence_row *row)
{
    size_t at = 0;
    while (at + 1 < convergence->nlevels && strcmp(convergence->level[at], row->refinement) != 0)
        at++;
    return at;
}

/* Beside each other at a level, in the order of the points. */
static double place_of(const fracas_convergence *convergence, const fracas_convergence_row *row)
{
    const double points = (double)convergence->study->table->npoints,
                 apart = fmin(0.2, 0.8 / points);
    return (double)level_of(convergence, row) + 1 + apart * ((double)row->point - (points - 1) / 2);
}

/* Subject of a figure. Changes are in per cent of the base; where the base is 0 at some point, they
 * are in the number's unit. */
typedef struct {
    const fracas_convergence *convergence;
    const fracas_number *number;
    bool relative;
    fracas_prefix prefix;
} subject;

static subject subject_of(const fracas_convergence *convergence, const fracas_number *number)
{
    subject of = {convergence, number, true, {1, "", ""}};
    double most = 0;
    for (size_t i = 0; i < convergence->nrows; i++) {
        const fracas_convergence_row *row = &convergence->row[i];
        if (row->number != number || !has_change(row)) continue;
        if (!isfinite(row->value.relative)) of.relative = false;
        most = fmax(most, fabs(row->value.difference));
    }
    if (!of.relative) of.prefix = fracas_prefix_in(number->unit, &most, 1);
    return of;
}

/* Per cent of a change `of` the number as it is, or the change as it is. */
static double shown_as(const subject *what, double relative, double change)
{
    return what->relative ? 100 * relative : what->prefix.factor * change;
}

static bool differs(const fracas_convergence_row *row)
{
    return row->verdict == FRACAS_NUMBER_MOVED || row->verdict == FRACAS_NUMBER_SHIFTED;
}

static fracas_err add_boxes(const subject *what, fracas_panel *panel)
{
    const fracas_convergence *convergence = what->convergence;
    fracas_series *series;
    size_t n = 0;
    TRY(fracas_panel_add(panel, FRACAS_BOXES, BOX_LOOK, rows_of(convergence, what->number),
                         &series));
    FRACAS_PRINT(series->name, "95 %% as it is");
    for (size_t i = 0; i < convergence->nrows; i++) {
        const fracas_convergence_row *row = &convergence->row[i];
        const fracas_estimate *base = &row->value.a;
        if (row->number != what->number || !has_change(row)) continue;
        series->x[n] = place_of(convergence, row);
        const double half_width = base->half_width > FRACAS_CONVERGENCE_ROUND_OFF * fabs(base->mean)
                                      ? base->half_width
                                      : 0;
        series->high[n] = shown_as(what, half_width / fabs(base->mean), half_width);
        series->low[n] = 0 - series->high[n]; /* no -0 */
        n++;
    }
    return FRACAS_OK;
}

static fracas_err add_point(const subject *what, size_t point, bool open, fracas_panel *panel)
{
    const fracas_convergence *convergence = what->convergence;
    fracas_series *series;
    size_t n = 0;
    TRY(fracas_panel_add(panel, FRACAS_MARKS, (unsigned)point, convergence->nlevels, &series));
    const fracas_label label = fracas_analysis_label(convergence->study, point);
    FRACAS_PRINT(series->name, "%.127s", *label.text ? label.text : "refined");
    series->open = open;
    for (size_t i = 0; i < convergence->nrows && n < convergence->nlevels; i++) {
        const fracas_convergence_row *row = &convergence->row[i];
        const fracas_compared_value *value = &row->value;
        if (row->number != what->number || row->point != point || !has_change(row) ||
            differs(row) == open)
            continue;
        series->x[n] = place_of(convergence, row);
        series->y[n] = shown_as(what, value->relative, value->difference);
        series->low[n] = shown_as(what, value->relative_low, value->low);
        series->high[n] = shown_as(what, value->relative_high, value->high);
        n++;
    }
    series->n = n;
    return FRACAS_OK;
}

/* Lines at the tolerance. Sets *shown to false where they would hide the changes, or do not belong
 * to this axis. */
static fracas_err add_tolerance(const subject *what, fracas_panel *panel, bool *shown)
{
    const double tolerance = 100 * what->convergence->tolerance, most = 4;
    double largest = 0;
    for (size_t s = 0; s < panel->nseries; s++)
        for (size_t i = 0; i < panel->series[s].n; i++)
            largest = fmax(largest,
                           fmax(fabs(panel->series[s].low[i]), fabs(panel->series[s].high[i])));
    *shown = what->relative && tolerance <= most * largest;
    for (int side = -1; side <= 1 && *shown; side += 2) {
        fracas_series *series;
        TRY(fracas_panel_add(panel, FRACAS_CURVE, TOLERANCE_LOOK, 2, &series));
        if (side < 0) FRACAS_PRINT(series->name, "\u00b1 %g %%", tolerance);
        series->x[0] = 0.5;
        series->x[1] = (double)what->convergence->nlevels + 0.5;
        series->y[0] = series->y[1] = side * tolerance;
    }
    return FRACAS_OK;
}

static void put_words(const subject *what, bool tolerance, fracas_chart *chart)
{
    const fracas_convergence *convergence = what->convergence;
    size_t of[FRACAS_NUMBER_VERDICTS] = {0};
    char beyond[96] = "";
    for (size_t i = 0; i < convergence->nrows; i++)
        if (convergence->row[i].number == what->number) of[convergence->row[i].verdict]++;
    FRACAS_PRINT(chart->file, "converge-%s", what->number->key);
    FRACAS_PRINT(chart->title, "What refinement changes: %s", what->number->key);
    if (!what->relative)
        FRACAS_PRINT(beyond, " As it is the mean is 0 at some point: no parts of it are shown.");
    else if (!tolerance)
        FRACAS_PRINT(beyond, " The tolerance of %g %% is far outside.",
                     100 * convergence->tolerance);
    FRACAS_PRINT(
        chart->caption,
        "Change of the mean (%s) with half the element size (mesh), half the time step (step), "
        "interfaces twice as stiff (beta) and twice the time (end), bars: 95 %% interval of the "
        "change; boxes: "
        "that of the number as it is. Filled: it differs, by p corrected for all numbers; "
        "open: it need not. Moved: %zu, shifted: %zu, hold: %zu, unclear: %zu.%s",
        what->number->doc, of[FRACAS_NUMBER_MOVED], of[FRACAS_NUMBER_SHIFTED],
        of[FRACAS_NUMBER_HOLDS], of[FRACAS_NUMBER_UNCLEAR] + of[FRACAS_NUMBER_UNKNOWN], beyond);
}

/* The figure of one number: its change at each refinement, a mark a row, filled if it differs, with
 * its interval; behind it a box, the interval of the number as it is. No panel if there is no row.
 */
static fracas_err draw_figure(const fracas_convergence *convergence, const fracas_number *number,
                              fracas_chart *chart)
{
    const size_t npoints = convergence->study->table->npoints;
    const subject what = subject_of(convergence, number);
    bool tolerance = false;
    if (rows_of(convergence, number) == 0) return FRACAS_OK;
    chart->width = (int)fmin(
        fmax(FRACAS_CHART_WIDE, MARGINS + MARK_PIXELS * (double)(convergence->nlevels * npoints)),
        WIDEST);
    fracas_panel *panel = fracas_chart_add(chart, HEIGHT);
    TRY(add_boxes(&what, panel));
    for (size_t p = 0; p < npoints; p++) {
        TRY(add_point(&what, p, false, panel));
        TRY(add_point(&what, p, true, panel));
    }
    TRY(add_tolerance(&what, panel, &tolerance));
    panel->x.name = convergence->level;
    panel->x.nnames = convergence->nlevels;
    FRACAS_PRINT(panel->x.label, "refined");
    if (what.relative) FRACAS_PRINT(panel->y.label, "change of %s [%%]", number->key);
    else
        FRACAS_PRINT(panel->y.label, "change of %s [%s%s]", number->key, what.prefix.sign,
                     number->unit);
    put_words(&what, tolerance, chart);
    return FRACAS_OK;
}

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
        TRY(fracas_page_chart(page, &chart,
                              draw_figure(page->of, &fracas_realization_numbers[v], &chart)));
    fracas_page_grid_end(page);
    return FRACAS_OK;
}

static fracas_err put_numbers(fracas_page *page)
{
    static const char *const legend[] = {
        "change: of the mean, with the half width of its 95 % interval: of pairs with the same "
        "strengths but for mesh, there by Welch; half widths: in those of the number as it "
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
    OWNED char *to = NULL;
    char lead[160];
    TRY(fracas_output_folder_in(NULL, folder, "report", &to));
    fracas_page page = {
        .analysis = convergence->study, .folder = to, .of = convergence, .source = title};
    const size_t npoints = convergence->study->table->npoints;
    FRACAS_PRINT(lead, "What refinement changes: %zu point%s, %zu numbers, tolerance %g %%",
                 npoints, npoints == 1 ? "" : "s", convergence->nrows,
                 100 * convergence->tolerance);
    return fracas_page_write(&page, title, lead, sections, FRACAS_COUNT(sections));
}
