/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The frame of a page; fracas_report_write: the sections of a study, and the files beside them. */
#include "analysis/report/page.h"

#include "analysis/export/csv.h"
#include "analysis/data/output.h"
#include "analysis/draw/chart.h"
#include "analysis/draw/html.h"
#include "base/param.h"
#include "base/own.h"
#include "campaigns/store/file/disk.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    char *text[FRACAS_PAGE_SECTIONS];
    size_t size[FRACAS_PAGE_SECTIONS];
    int refresh; /* s, 0: never */
} contents;

static fracas_err write_section(fracas_page *page, const fracas_page_entry *section, char **text,
                                size_t *size)
{
    page->out = open_memstream(text, size);
    if (!page->out) return fracas_no_memory("a section of the report");
    fracas_err err = section->put ? section->put(page) : fracas_section_figures(page, section->id);
    const bool bad = ferror(page->out);
    if ((fclose(page->out) || bad) && !err) err = fracas_no_memory("a section of the report");
    return err;
}

static fracas_err put_page(const char *title, const char *lead, const fracas_page_entry *section,
                           size_t count, const contents *of, FILE *out)
{
    TRY(fracas_html_begin(title, lead, fracas_page_script, of->refresh, out));
    fputs("<nav aria-label=\"Contents\"><ul>\n", out);
    for (size_t i = 0; i < count; i++)
        if (of->size[i] > 0)
            fprintf(out, "<li><a href=\"#%s\">%s</a></li>\n", section[i].id, section[i].title);
    fputs("</ul></nav>\n<main>\n", out);
    for (size_t i = 0; i < count; i++) {
        if (of->size[i] == 0) continue;
        fprintf(out, "<section id=\"%s\">\n<h2>%s</h2>\n", section[i].id, section[i].title);
        fwrite(of->text[i], 1, of->size[i], out);
        fputs("</section>\n", out);
    }
    fputs("</main>\n", out);
    fracas_html_end(fracas_page_script, out);
    return FRACAS_OK;
}

/* True for a drawing of the page, or the data of its pictures. */
static bool is_drawn(const fracas_page *page, const char *stem)
{
    char first[FRACAS_DRAWING + 2];
    FRACAS_PRINT(first, "%s-1", stem);
    for (size_t i = 0; i < page->ndrawings; i++)
        if (!strcmp(page->drawing[i], stem) || !strcmp(page->drawing[i], first)) return true;
    return false;
}

/* Removes a figure of an older report that this one has not. */
static fracas_err forget(void *context, const char *path, const char *name)
{
    static const char *const kinds[] = {".svg", ".pdf", ".csv"}, *const marks[] = {"-point-",
                                                                                   "-against-"};
    char stem[FRACAS_DRAWING];
    bool of_figure = false, of_kind = false;
    const char *dot = strrchr(name, '.');
    if (!dot || (size_t)(dot - name) >= sizeof stem) return FRACAS_OK;
    snprintf(stem, sizeof stem, "%.*s", (int)(dot - name), name);
    if (!strncmp(stem, FRACAS_FILM_OF_POINT, strlen(FRACAS_FILM_OF_POINT)) &&
        !strcmp(dot, ".html")) { /* a row of pictures has it */
        snprintf(stem, sizeof stem, "surface-point-%.*s",
                 (int)(dot - name - (ptrdiff_t)strlen(FRACAS_FILM_OF_POINT)),
                 name + strlen(FRACAS_FILM_OF_POINT));
        of_kind = true;
    }
    for (size_t k = 0; k < FRACAS_COUNT(kinds); k++) of_kind = of_kind || !strcmp(dot, kinds[k]);
    for (size_t k = 0; k < FRACAS_COUNT(marks); k++)
        of_figure = of_figure || strstr(stem, marks[k]);
    const fracas_page *page = context;
    if (of_kind && of_figure && !is_drawn(page, stem) && !fracas_foreign_has(page->foreign, name))
        unlink(path);
    return FRACAS_OK;
}

fracas_err fracas_page_write(fracas_page *page, const char *title, const char *lead,
                             const fracas_page_entry *section, size_t count)
{
    contents of = {.refresh = page->refresh};
    fracas_err err = FRACAS_OK;
    for (size_t i = 0; i < count && !err; i++)
        err = write_section(page, &section[i], &of.text[i], &of.size[i]);
    if (!err) err = fracas_disk_each(page->folder, forget, page);
    if (!err)
        err = fracas_convert(page->folder, page->drawing, page->ndrawings, FRACAS_DRAWING_PDF);
    fracas_output_file output;
    if (!err) err = fracas_foreign_aside(page->foreign, page->folder, FRACAS_OUTPUT_PAGE);
    if (!err) err = fracas_output_open(page->folder, FRACAS_OUTPUT_PAGE, &output);
    if (!err)
        err = fracas_output_close(&output, put_page(title, lead, section, count, &of, output.file));
    for (size_t i = 0; i < count; i++) free(of.text[i]);
    free(page->drawing);
    page->drawing = NULL;
    page->ndrawings = page->room = 0;
    return err;
}

/* ---- the page of a study ---- */

static const fracas_page_entry sections[] = {
    {"summary", "Summary", fracas_section_summary},
    {"mean-size", "Mean fragment size and count", fracas_section_means},
    {"fragment-sizes", "Fragment sizes", NULL},
    {"fits", "Fits to fragment sizes", fracas_section_fits},
    {"crack-patterns", "Crack patterns", fracas_section_patterns},
    {"broken-surfaces", "Break-up over time", fracas_section_surfaces},
    {"fragments-over-time", "Fragments over time", NULL},
    {"energies-over-time", "Energies over time", NULL},
    {"probes-over-time", "Probes over time", NULL},
    {"reactions-over-time", "Reactions over time", NULL},
    {"cracks-over-time", "Cracks over time", NULL},
    {"convergence", "Convergence with replicas", NULL},
    {"table-of-results", "Results", fracas_section_results},
    {"table-of-slopes", "Slopes", fracas_section_slopes},
    {"table-of-effects", "Effects of parameters", fracas_section_effects},
    {"table-of-motion", "Expansion", fracas_section_motion},
    {"files", "Files", fracas_section_files},
};
_Static_assert(FRACAS_COUNT(sections) <= FRACAS_PAGE_SECTIONS,
               "a page has no room for its sections");

/* "3 points, 96 realizations, none failed" */
static void say_what(const fracas_analysis *analysis, char *text, size_t size)
{
    int64_t realizations = 0, unusable = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        realizations += analysis->point[p].realizations;
        unusable += analysis->point[p].unusable;
    }
    char failed[96] = ", none failed", partial[128] = "";
    if (unusable > 0)
        FRACAS_PRINT(failed, ", of these %" PRId64 " failed (not in any mean)", unusable);
    const bool is_partial = fracas_analysis_partial(analysis, partial, sizeof partial);
    snprintf(text, size, "%zu point%s, %" PRId64 " realizations%s%s%s", analysis->table->npoints,
             analysis->table->npoints == 1 ? "" : "s", realizations, failed, is_partial ? "; " : "",
             partial);
}

/* ---- files ---- */

#define SUMMARY "summary.json"
enum { MOST_WHOLE = 100 }; /* points whose summary is whole: a whole one has some 10 kB a point */

static const fracas_csv_table *const tables[] = {&fracas_csv_table_points,
                                                 &fracas_csv_table_slopes,
                                                 &fracas_csv_table_energies,
                                                 &fracas_csv_table_convergence,
                                                 &fracas_csv_table_fragments,
                                                 &fracas_csv_table_effects,
                                                 NULL};

/* `foreign` gets out of their way. */
static fracas_err write_tables(const fracas_analysis *analysis, const char *folder,
                               const fracas_shown_fits *shown, const fracas_foreign *foreign)
{
    fracas_output_file output;
    TRY(fracas_foreign_aside(foreign, folder, SUMMARY));
    for (size_t i = 0; tables[i]; i++) {
        char name[64];
        FRACAS_PRINT(name, "%s.csv", tables[i]->name);
        TRY(fracas_foreign_aside(foreign, folder, name));
    }
    TRY(fracas_output_open(folder, SUMMARY, &output)); /* first: it tells whose they are */
    fracas_summary_write(analysis, shown, analysis->table->npoints > MOST_WHOLE, output.file);
    TRY(fracas_output_close(&output, FRACAS_OK));
    for (size_t i = 0; tables[i]; i++) TRY(fracas_csv_file(tables[i], analysis, folder));
    return FRACAS_OK;
}

fracas_err fracas_report_write(const fracas_analysis *analysis, const char *study,
                               const char *wanted, int refresh)
{
    OWNED char *folder = NULL;
    FRACAS_CLEARED(fracas_shown_fits) shown = {0};
    FRACAS_CLEARED(fracas_foreign) foreign = {0};
    char lead[512];
    TRY(fracas_output_folder_in(wanted, study, "report", &folder));
    if (wanted) {
        static const char *const others[] = {FRACAS_OUTPUT_PAGE, SUMMARY};
        TRY(fracas_output_free(folder, others, FRACAS_COUNT(others)));
        TRY(fracas_csv_free(tables, folder));
    }
    TRY(fracas_shown_fits_read(study, analysis, &shown));
    TRY(fracas_foreign_find(folder, &foreign));
    TRY(write_tables(analysis, folder, &shown, &foreign));
    say_what(analysis, lead, sizeof lead);
    if (refresh)
        fracas_append(lead, sizeof lead, "; ", "this page loads itself again every %d s", refresh);
    fracas_page page = {.analysis = analysis,
                        .folder = folder,
                        .fits = shown.fits,
                        .shown = &shown,
                        .foreign = &foreign,
                        .refresh = refresh};
    return fracas_page_write(&page, analysis->name, lead, sections, FRACAS_COUNT(sections));
}
