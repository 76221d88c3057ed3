/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/report/page.h"

#include "analysis/data/output.h"
#include "base/text.h"

#include <ctype.h>
#include <limits.h>
#include <unistd.h>

/* ---- figures ---- */

void fracas_page_grid(fracas_page *page, const char *class)
{
    page->grid = class;
}

void fracas_page_grid_end(fracas_page *page)
{
    if (page->grid_open) fputs("</div>\n", page->out);
    page->grid = NULL;
    page->grid_open = false;
}

static const char *const kind_of_file[] = {"svg", "pdf", "csv"};

fracas_err fracas_page_make_room(const fracas_page *page, const char *file)
{
    for (size_t k = 0; k < FRACAS_COUNT(kind_of_file); k++) {
        char name[FRACAS_DRAWING + 4];
        FRACAS_PRINT(name, "%s.%s", file, kind_of_file[k]);
        TRY(fracas_foreign_aside(page->foreign, page->folder, name));
    }
    return FRACAS_OK;
}

fracas_err fracas_page_drew(fracas_page *page, const char *file)
{
    TRY(fracas_grow(&page->drawing, sizeof *page->drawing, page->ndrawings, &page->room,
                    "the figures of a report"));
    snprintf(page->drawing[page->ndrawings++], FRACAS_DRAWING, "%s", file);
    return FRACAS_OK;
}

void fracas_page_figure(fracas_page *page, const char *id, const char *class)
{
    if (page->grid) {
        fprintf(page->out, "<div class=\"%s\">\n", page->grid);
        page->grid_open = true;
        page->grid = NULL;
    }
    fprintf(page->out, "<figure id=\"%s\"", id);
    if (class) fprintf(page->out, " class=\"%s\"", class);
    fputs(">\n", page->out);
}

void fracas_page_links(fracas_page *page, const char *file, bool drawn, bool csv)
{
    fputs(" <span class=\"files\">", page->out);
    if (drawn) fprintf(page->out, "<a href=\"%s.svg\">SVG</a> ", file);
    if (drawn && fracas_convert_possible) fprintf(page->out, "<a href=\"%s.pdf\">PDF</a> ", file);
    if (csv) fprintf(page->out, "<a href=\"%s.csv\">CSV</a>", file);
    fputs("</span>", page->out);
}

static void put_source(fracas_page *page)
{
    fracas_markup(page->out, " <span class=\"source\">%s",
                  page->source ? page->source : page->analysis->name);
    if (!page->source)
        fprintf(page->out, ", campaign %.12s",
                fracas_hash_hex(&page->analysis->header.campaign).text);
    fracas_markup(page->out, ", fracas %s.</span>", page->analysis->header.version);
}

/* Text in which the c of "G_c" stands low; an underscore within a word stays. */
static void put_words(const char *text, FILE *out)
{
    const char *rest = text;
    while (*rest) {
        const bool low = rest[0] == '_' && rest > text && isalpha((unsigned char)rest[1]) &&
                         !isalnum((unsigned char)rest[2]) && rest[2] != '_';
        if (low) {
            fprintf(out, "<sub>%c</sub>", rest[1]);
            rest += 2;
            continue;
        }
        char character[5];
        int32_t code;
        const size_t length = fracas_text_character(rest, &code);
        snprintf(character, length + 1, "%s", rest);
        fracas_markup(out, "%s", character);
        rest += length;
    }
}

void fracas_page_figure_end(fracas_page *page, const char *title, const char *caption,
                            const char *file, bool drawn, bool csv)
{
    fprintf(page->out, "<figcaption><b>Figure %d.</b> ", ++page->figures);
    fracas_markup(page->out, "%s", title);
    fputs(*caption ? ". " : ".", page->out);
    put_words(caption, page->out);
    put_source(page);
    fracas_page_links(page, file, drawn, csv);
    fputs("</figcaption>\n</figure>\n", page->out);
}

static const struct {
    fracas_axes axes;
    const char *class, *label;
} drawings[] = {
    {FRACAS_AXES_OWN, "own", "log axes"},
    {FRACAS_AXES_SEMILOG, "semilog", "linear x"},
    {FRACAS_AXES_LINEAR, "linear", "linear axes"},
};
enum { DRAWINGS = sizeof drawings / sizeof *drawings };

static bool offered(const fracas_chart *chart, int i)
{
    return i == 0 || (chart->offers & (unsigned)drawings[i].axes);
}

/* One drawing a choice of axes; which is seen is for the style sheet to say, without a script. */
static void put_drawings(fracas_page *page, const fracas_chart *chart)
{
    const char *many = chart->columns > 0 ? "multiples" : ""; /* these a narrow window scrolls */
    if (!chart->offers) {
        fprintf(page->out, "<div class=\"%s\">\n", many);
        fracas_chart_write(chart, false, page->out);
        fputs("</div>\n", page->out);
        return;
    }
    for (int i = 0; i < DRAWINGS; i++)
        if (offered(chart, i))
            fprintf(page->out,
                    "<input type=\"radio\" class=\"axes %s\" name=\"axes-%s\" "
                    "id=\"%s-%s\"%s/><label for=\"%s-%s\">%s</label>\n",
                    drawings[i].class, chart->file, chart->file, drawings[i].class,
                    i ? "" : " checked=\"checked\"", chart->file, drawings[i].class,
                    drawings[i].label);
    for (int i = 0; i < DRAWINGS; i++) {
        if (!offered(chart, i)) continue;
        fprintf(page->out, "<div class=\"drawing %s %s\">\n", drawings[i].class, many);
        fracas_chart_write_axes(chart, drawings[i].axes, page->out);
        fputs("</div>\n", page->out);
    }
}

static fracas_err write_files(fracas_page *page, const fracas_chart *chart)
{
    char name[FRACAS_DRAWING + 4];
    fracas_output_file output;
    TRY(fracas_page_make_room(page, chart->file));
    FRACAS_PRINT(name, "%s.svg", chart->file);
    TRY(fracas_output_open(page->folder, name, &output));
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", output.file);
    fracas_chart_write(chart, true, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    FRACAS_PRINT(name, "%s.csv", chart->file);
    TRY(fracas_output_open(page->folder, name, &output));
    fracas_chart_csv(chart, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    return fracas_page_drew(page, chart->file);
}

/* A figure that is gone leaves no files of an older report behind. */
static void forget_files(const fracas_page *page, const char *name)
{
    for (size_t k = 0; k < FRACAS_COUNT(kind_of_file); k++) {
        char file[FRACAS_DRAWING + 4], path[PATH_MAX];
        FRACAS_PRINT(file, "%s.%s", name, kind_of_file[k]);
        if (!fracas_foreign_has(page->foreign, file) &&
            FRACAS_PRINT(path, "%s/%s", page->folder, file) < (int)sizeof path)
            unlink(path);
    }
}

fracas_err fracas_page_chart(fracas_page *page, fracas_chart *chart, fracas_err built)
{
    fracas_err err = built;
    if (!err && chart->npanels > 0) {
        fracas_page_figure(page, chart->file, chart->columns > 1 ? "row" : NULL);
        put_drawings(page, chart);
        fracas_page_figure_end(page, chart->title, chart->caption, chart->file, true, true);
        err = write_files(page, chart);
    } else if (!err) {
        forget_files(page, chart->file);
    }
    fracas_chart_clear(chart);
    return err;
}

/* ---- tables ---- */

enum { MANY = 15 }; /* columns of a printed page; more are smaller */

static void put_cells(const fracas_result_table *table, FILE *out)
{
    fputs("<thead><tr>", out);
    for (size_t c = 0; c < table->columns; c++) {
        fracas_markup(out, "<th scope=\"col\">%s<small>", fracas_result_table_cell(table, 0, c));
        const char *unit = fracas_result_table_cell(table, 1, c);
        fracas_markup(out, "%s", *unit ? unit : "\u00a0"); /* keeps the names on one line */
        fputs("</small></th>", out);
    }
    fputs("</tr></thead>\n<tbody>\n", out);
    for (size_t r = FRACAS_RESULT_TABLE_HEAD; r < table->rows; r++) {
        fputs("<tr>", out);
        for (size_t c = 0; c < table->columns; c++) {
            fracas_markup(out, "<td>%s</td>", fracas_result_table_cell(table, r, c));
        }
        fputs("</tr>\n", out);
    }
    fputs("</tbody>\n", out);
}

static const char *class_of(bool text, bool many)
{
    return text && many ? " class=\"text many\""
           : text       ? " class=\"text\""
           : many       ? " class=\"many\""
                        : "";
}

fracas_err fracas_page_table(fracas_page *page, const char *id, const char *title, bool text,
                             fracas_result_table *table, const char *const *legend,
                             fracas_err built)
{
    if (!built && table->rows > FRACAS_RESULT_TABLE_HEAD) {
        fprintf(page->out, "<p class=\"title\"><b>Table %d.</b> ", ++page->tables);
        fracas_markup(page->out, "%s", title);
        putc('.', page->out);
        put_source(page);
        fprintf(page->out,
                "</p>\n<div class=\"scroll fit\" tabindex=\"0\" role=\"region\" aria-label=\"Table "
                "%d\"><table id=\"%s\"%s>\n",
                page->tables, id, class_of(text, table->columns > MANY));
        put_cells(table, page->out);
        fputs("</table></div>\n", page->out);
        if (legend && legend[0]) {
            fputs("<p class=\"quiet\">", page->out);
            for (size_t i = 0; legend[i]; i++) {
                fracas_markup(page->out, "%s", legend[i]);
                putc('\n', page->out);
            }
            fputs("</p>\n", page->out);
        }
    }
    fracas_result_table_clear(table);
    return built;
}
