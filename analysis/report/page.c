/* fracas_report_write: the page and the files beside it. */
#include "analysis/export/csv.h"
#include "analysis/report/figures.h"
#include "analysis/export/output.h"
#include "analysis/report/picture/picture.h"
#include "analysis/report/picture/surfaces.h"
#include "analysis/tables/side_tables.h"
#include "analysis/study/study.h"
#include "analysis/tables/table.h"

#include <errno.h>
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const char page_style[] =
    ":root{color-scheme:light dark;--ink:#1b1f24;--quiet:#57606a;--paper:#fff;--line:#d5dae0;--warn:#fff4e0;"
    "--edge:#D55E00}\n"
    "@media screen and (prefers-color-scheme:dark){:root{--ink:#e6e9ed;--quiet:#9aa4af;--paper:#14181d;--line:#30363d;"
    "--warn:#3a2a12}}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0 auto;padding:1.2rem 1rem 3rem;max-width:76rem;background:var(--paper);color:var(--ink);"
    "font:16px/1.5 system-ui,-apple-system,\"Segoe UI\",\"DejaVu Sans\",Arial,sans-serif}\n"
    "h1{font-size:1.7rem;margin:.2rem 0 .6rem;overflow-wrap:anywhere}\n"
    "h2{font-size:1.2rem;margin:2.2rem 0 .6rem}\n"
    "a{color:inherit}p{max-width:60rem}.quiet,figcaption,dl{color:var(--quiet);font-size:.875rem}\n"
    "dl{display:grid;grid-template-columns:max-content 1fr;gap:.1rem 1rem;margin:0}\n"
    "dd{margin:0;overflow-wrap:anywhere}\n"
    ".scroll{overflow-x:auto;border:1px solid var(--line);border-radius:6px}\n"
    ".side{width:fit-content;max-width:100%;margin-top:1rem}\n"
    "table{border-collapse:collapse;width:100%;font-size:.9rem;font-variant-numeric:tabular-nums}\n"
    "th,td{padding:.35rem .7rem;text-align:right;white-space:nowrap}th:last-child,td:last-child{text-align:left}\n"
    "th small{font-weight:400;color:var(--quiet);display:block}thead th{vertical-align:bottom}\n"
    "tbody tr{border-top:1px solid var(--line)}\n"
    ".warnings{background:var(--warn);border-left:4px solid var(--edge);border-radius:4px;margin:0;"
    "padding:.6rem 1rem .6rem 2rem}\n"
    ".wide,.small{display:grid;gap:1.5rem;grid-template-columns:repeat(auto-fill,minmax(min(100%,26rem),1fr))}\n"
    ".small{grid-template-columns:repeat(auto-fill,minmax(min(100%,18rem),1fr));margin-top:1.5rem}\n"
    "figure{margin:0;break-inside:avoid}figure svg{display:block;width:100%;height:auto;max-width:44rem}\n"
    "@media print{body{max-width:none;padding:0;font-size:11pt}.scroll{overflow:visible;border:0}table{font-size:7.5pt}"
    "th,td{padding:.2rem .3rem}.wide,.small{grid-template-columns:1fr 1fr}h2{break-after:avoid}}\n";

typedef struct {
    const fracas_analysis *analysis;
    const char *folder; /* of the report */
    FILE *out;          /* index.html */
} report_page;

/* ---- tables ---- */

static void put_rows(const fracas_result_table *table, FILE *out)
{
    fputs("<thead><tr>", out);
    for (size_t c = 0; c < table->columns; c++) {
        fputs("<th>", out);
        fracas_markup_text(fracas_result_table_cell(table, 0, c), out);
        fputs("<small>", out);
        const char *unit = fracas_result_table_cell(table, 1, c);
        fracas_markup_text(*unit ? unit : "\u00a0", out); /* keeps the names on one line */
        fputs("</small></th>", out);
    }
    fputs("</tr></thead>\n<tbody>\n", out);
    for (size_t r = FRACAS_RESULT_TABLE_HEAD; r < table->rows; r++) {
        fputs("<tr>", out);
        for (size_t c = 0; c < table->columns; c++) {
            fputs("<td>", out);
            fracas_markup_text(fracas_result_table_cell(table, r, c), out);
            fputs("</td>", out);
        }
        fputs("</tr>\n", out);
    }
    fputs("</tbody>\n", out);
}

static void put_legend(const char *const *legend, FILE *out)
{
    fputs("</table></div>\n<p class=\"quiet\">", out);
    for (size_t i = 0; legend[i]; i++) {
        fracas_markup_text(legend[i], out);
        putc('\n', out);
    }
    fputs("</p>\n", out);
}

typedef fracas_err make_table(const fracas_analysis *analysis, bool unicode, fracas_result_table *table);

/* Nothing if the table has no row; `heading` may be NULL. */
static fracas_err put_side_table(const report_page *page, const char *id, const char *heading, make_table *make,
                                 const char *const *legend)
{
    fracas_result_table table = {0};
    fracas_err err = make(page->analysis, true, &table);
    if (!err && table.rows > FRACAS_RESULT_TABLE_HEAD) {
        if (heading) fprintf(page->out, "<h2>%s</h2>\n", heading);
        fprintf(page->out, "<div class=\"scroll side\"><table id=\"%s\">\n", id);
        put_rows(&table, page->out);
        put_legend(legend, page->out);
    }
    fracas_result_table_clear(&table);
    return err;
}

/* ---- figures ---- */

static fracas_err write_svg(const report_page *page, const fracas_chart *chart)
{
    char name[sizeof chart->file + 8];
    snprintf(name, sizeof name, "%s.svg", chart->file);
    fracas_output_file output;
    TRY(fracas_output_open(page->folder, name, &output));
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", output.file);
    fracas_chart_write(chart, true, output.file);
    return fracas_output_close(&output, FRACAS_OK);
}

/* Puts the chart on the page and into a file of its own, and clears it; `built` is how its making ended. */
static fracas_err put_figure(const report_page *page, fracas_chart *chart, fracas_err built)
{
    fracas_err err = built;
    if (!err && chart->npanels > 0) {
        fprintf(page->out, "<figure id=\"%s\">\n", chart->file);
        fracas_chart_write(chart, false, page->out);
        fputs("<figcaption>", page->out);
        fracas_markup_text(chart->caption, page->out);
        fprintf(page->out, " <a href=\"%s.svg\">SVG</a></figcaption>\n</figure>\n", chart->file);
        err = write_svg(page, chart);
    }
    fracas_chart_clear(chart);
    return err;
}

static fracas_err write_picture(const report_page *page, const fracas_picture *picture)
{
    char name[sizeof picture->file + 8];
    snprintf(name, sizeof name, "%s.svg", picture->file);
    fracas_output_file output;
    TRY(fracas_output_open(page->folder, name, &output));
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", output.file);
    fracas_picture_write(picture, true, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    snprintf(name, sizeof name, "%s.csv", picture->file);
    TRY(fracas_output_open(page->folder, name, &output));
    fracas_picture_csv(picture, output.file);
    return fracas_output_close(&output, FRACAS_OK);
}

static fracas_err put_picture(const report_page *page, size_t point)
{
    fracas_picture picture;
    TRY(fracas_picture_create(page->analysis, point, &picture));
    fprintf(page->out, "<figure id=\"%s\">\n", picture.file);
    fracas_picture_write(&picture, false, page->out);
    fputs("<figcaption>", page->out);
    fracas_markup_text(picture.caption, page->out);
    fprintf(page->out, " <a href=\"%s.svg\">SVG</a> <a href=\"%s.csv\">CSV</a></figcaption>\n</figure>\n", picture.file,
            picture.file);
    fracas_err err = write_picture(page, &picture);
    fracas_picture_clear(&picture);
    return err;
}

static fracas_err put_pictures(const report_page *page)
{
    size_t point[FRACAS_MAX_PICTURES], count = fracas_picture_points(page->analysis, point);
    if (count == 0) return FRACAS_OK;
    fputs("<h2>Crack patterns</h2>\n<div class=\"wide\">\n", page->out);
    for (size_t i = 0; i < count; i++) TRY(put_picture(page, point[i]));
    fputs("</div>\n", page->out);
    return FRACAS_OK;
}

/* Instead of the figures against the rate, where there is none. */
static void say_no_rate(const report_page *page)
{
    for (size_t p = 0; p < page->analysis->table->npoints; p++)
        if (page->analysis->point[p].rate > 0) return;
    fputs("<p>No point begins with a strain rate above 0: nothing to draw against it.</p>\n", page->out);
}

static fracas_err put_figures(const report_page *page)
{
    const fracas_analysis *analysis = page->analysis;
    size_t npoints = analysis->table->npoints;
    fracas_chart chart;
    fracas_chart_init(&chart);
    fputs("<h2>Mean fragment size</h2>\n<div class=\"wide\">\n", page->out);
    TRY(put_figure(page, &chart, fracas_figure_rate(analysis, false, &chart)));
    TRY(put_figure(page, &chart, fracas_figure_rate(analysis, true, &chart)));
    fputs("</div>\n", page->out);
    say_no_rate(page);
    TRY(put_side_table(page, "slopes", NULL, fracas_slope_table_create, fracas_slope_table_legend));
    fputs("<h2>Fragment sizes</h2>\n<div class=\"wide\">\n", page->out);
    TRY(put_figure(page, &chart, fracas_figure_sizes_together(analysis, &chart)));
    fputs("</div>\n<div class=\"small\">\n", page->out);
    for (size_t p = 0; p < npoints; p++) TRY(put_figure(page, &chart, fracas_figure_sizes(analysis, p, &chart)));
    fputs("</div>\n", page->out);
    TRY(put_pictures(page));
    TRY(fracas_surfaces_put(analysis, page->folder, page->out));
    fputs("<h2>Energies over time</h2>\n<div class=\"wide\">\n", page->out);
    for (size_t p = 0; p < npoints; p++) TRY(put_figure(page, &chart, fracas_figure_energies(analysis, p, &chart)));
    fputs("</div>\n", page->out);
    return put_side_table(page, "motion", "Expansion after break-up", fracas_motion_table_create,
                          fracas_motion_table_legend);
}

/* ---- words and numbers ---- */

static void put_term(FILE *out, const char *term, const char *value)
{
    fprintf(out, "<dt>%s</dt><dd>", term);
    fracas_markup_text(value, out);
    fputs("</dd>\n", out);
}

static fracas_err put_head(const report_page *page)
{
    const fracas_analysis *analysis = page->analysis;
    bool surfaces;
    TRY(fracas_surfaces_any(analysis, &surfaces));
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
          "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n"
          "<link rel=\"icon\" href=\"data:,\"/>\n<title>", page->out);
    fracas_markup_text(analysis->name, page->out);
    fprintf(page->out, " \u00b7 fracas</title>\n<style>\n%s", page_style);
    fracas_chart_style(page->out);
    if (surfaces) fracas_surface_style(page->out);
    fputs("</style>\n</head>\n<body>\n<h1>", page->out);
    fracas_markup_text(analysis->name, page->out);
    fputs("</h1>\n<dl>\n", page->out);
    int64_t realizations = 0, unusable = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        realizations += analysis->point[p].realizations;
        unusable += analysis->point[p].unusable;
    }
    char text[128];
    snprintf(text, sizeof text, "%zu points, %" PRId64 " realizations, of these %" PRId64 " failed (not in any mean)",
             analysis->table->npoints, realizations, unusable);
    put_term(page->out, "study", text);
    fracas_hash_hex(&analysis->header.campaign, text);
    put_term(page->out, "campaign", text);
    snprintf(text, sizeof text, "%" PRIu64, analysis->header.seed);
    put_term(page->out, "seed", text);
    snprintf(text, sizeof text, "fracas %s", analysis->header.version);
    put_term(page->out, "program", text);
    fputs("</dl>\n", page->out);
    return FRACAS_OK;
}

static fracas_err put_warnings(const report_page *page)
{
    fracas_warning *warning;
    size_t count;
    TRY(fracas_analysis_warnings(page->analysis, &warning, &count));
    fputs("<h2>Warnings</h2>\n", page->out);
    if (count == 0) {
        fputs("<p>None: no realization failed or was stopped by its time limit; ledger residuals are below 1e-3 and "
              "created energy below 1e-2 of the dissipated energy, residuals below 1 % of the largest energy; mean "
              "fragments have 10 elements or more; at most 5 % of the fragments are dust.</p>\n", page->out);
    } else {
        fputs("<ul class=\"warnings\">\n", page->out);
        for (size_t i = 0; i < count; i++) {
            char label[256] = "";
            if (warning[i].point != SIZE_MAX)
                fracas_analysis_label(page->analysis, warning[i].point, label, sizeof label);
            fputs("<li>", page->out);
            fracas_markup_text(label, page->out);
            fputs(*label ? ": " : "", page->out);
            fracas_markup_text(warning[i].text, page->out);
            fputs("</li>\n", page->out);
        }
        fputs("</ul>\n", page->out);
    }
    free(warning);
    return FRACAS_OK;
}

/* How the replicas were decided, where they were not given. */
static void put_decisions(const report_page *page)
{
    char text[512];
    bool any = false;
    for (size_t p = 0; p < page->analysis->table->npoints; p++) {
        if (!fracas_analysis_decided(page->analysis, p, text, sizeof text)) continue;
        if (!any) fputs("<p>Replicas were added until the mean was known well enough:</p>\n<ul id=\"decisions\">\n", page->out);
        any = true;
        fputs("<li>", page->out);
        fracas_markup_text(text, page->out);
        fputs("</li>\n", page->out);
    }
    if (any) fputs("</ul>\n", page->out);
}

/* What the table does not show. */
static void put_beside(const report_page *page)
{
    char text[768];
    if (!fracas_result_table_beside(page->analysis, text, sizeof text)) return;
    fputs("<p id=\"beside\">", page->out);
    fracas_markup_text(text, page->out);
    fputs("</p>\n", page->out);
}

static fracas_err put_table(const report_page *page)
{
    fracas_result_table table;
    TRY(fracas_result_table_create(page->analysis, true, &table));
    fputs("<h2>Results</h2>\n<div class=\"scroll\"><table id=\"results\">\n", page->out);
    put_rows(&table, page->out);
    fracas_result_table_clear(&table);
    put_legend(fracas_result_table_legend(page->analysis), page->out);
    put_beside(page);
    put_decisions(page);
    fputs("<p class=\"quiet\">As files: <a href=\"points.csv\">points.csv</a> (every parameter and statistic), "
          "<a href=\"fragments.csv\">fragments.csv</a> (every fragment); both in SI units.</p>\n", page->out);
    return FRACAS_OK;
}

static fracas_err put_page(const report_page *page)
{
    TRY(put_head(page));
    TRY(put_table(page));
    TRY(put_warnings(page));
    TRY(put_figures(page));
    fputs("</body>\n</html>\n", page->out);
    return FRACAS_OK;
}

/* ---- files ---- */

static fracas_err write_tables(const fracas_analysis *analysis, const char *folder)
{
    fracas_output_file output;
    TRY(fracas_output_open(folder, "points.csv", &output));
    fracas_csv_points(analysis, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    TRY(fracas_output_open(folder, "energies.csv", &output));
    fracas_csv_energies(analysis, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    TRY(fracas_output_open(folder, "convergence.csv", &output));
    fracas_csv_convergence(analysis, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    TRY(fracas_output_open(folder, "fragments.csv", &output));
    return fracas_output_close(&output, fracas_csv_fragments(analysis, output.file));
}

static fracas_err write_page(const fracas_analysis *analysis, const char *folder)
{
    fracas_output_file output;
    TRY(fracas_output_open(folder, "index.html", &output));
    report_page page = {.analysis = analysis, .folder = folder, .out = output.file};
    return fracas_output_close(&output, put_page(&page));
}

fracas_err fracas_report_write(const fracas_analysis *analysis, const char *study)
{
    char *folder;
    if (asprintf(&folder, "%s/report", study) < 0) return fracas_no_memory("a path");
    fracas_err err = FRACAS_OK;
    if (mkdir(folder, 0777) && errno != EEXIST)
        err = fracas_fail(FRACAS_ENVIRONMENT, "cannot make the folder %s: %s", folder, strerror(errno));
    if (!err) err = write_tables(analysis, folder);
    if (!err) err = write_page(analysis, folder);
    free(folder);
    return err;
}
