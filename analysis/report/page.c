/* fracas_report_write: the frame of the page, the order of its sections, and the files beside it. */
#include "analysis/report/page.h"

#include "analysis/export/csv.h"
#include "analysis/export/output.h"
#include "analysis/report/assets.h"
#include "analysis/report/pdf.h"
#include "analysis/report/picture/surfaces.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const struct {
    const char *id, *title;
    fracas_page_section *put;
} sections[] = {
    {"summary", "Summary", fracas_section_summary},
    {"mean-size", "Mean fragment size", fracas_section_rate},
    {"fragment-sizes", "Fragment sizes", fracas_section_sizes},
    {"fits", "Fits to fragment sizes", fracas_section_fits},
    {"crack-patterns", "Crack patterns", fracas_section_patterns},
    {"broken-surfaces", "Broken surfaces", fracas_section_surfaces},
    {"energies-over-time", "Energies over time", fracas_section_energies},
    {"convergence", "Convergence with replicas", fracas_section_convergence},
    {"table-of-results", "Results", fracas_section_results},
    {"table-of-slopes", "Slopes", fracas_section_slopes},
    {"table-of-motion", "Expansion", fracas_section_motion},
    {"files", "Files", fracas_section_files},
};
enum { SECTIONS = sizeof sections / sizeof *sections };

/* What each section wrote; empty ones are not on the page. */
typedef struct {
    char *text[SECTIONS];
    size_t size[SECTIONS];
} contents;

static fracas_err write_section(fracas_page *page, int i, contents *of)
{
    page->out = open_memstream(&of->text[i], &of->size[i]);
    if (!page->out) return fracas_no_memory("a section of the report");
    fracas_err err = sections[i].put(page);
    const bool bad = ferror(page->out);
    if ((fclose(page->out) || bad) && !err) err = fracas_no_memory("a section of the report");
    return err;
}

static fracas_err put_head(const fracas_analysis *analysis, FILE *out)
{
    bool surfaces;
    TRY(fracas_surfaces_any(analysis, &surfaces));
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
          "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n"
          "<link rel=\"icon\" href=\"data:,\"/>\n<title>", out);
    fracas_markup_text(analysis->name, out);
    fprintf(out, " \u00b7 fracas</title>\n<style>\n%s%s", fracas_chart_style, fracas_page_style);
    if (surfaces) fracas_surface_style(out);
    fputs("</style>\n</head>\n<body>\n<header>\n<h1>", out);
    fracas_markup_text(analysis->name, out);
    fputs("</h1>\n", out);
    int64_t realizations = 0, unusable = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        realizations += analysis->point[p].realizations;
        unusable += analysis->point[p].unusable;
    }
    fprintf(out, "<p class=\"lead\">%zu point%s, %" PRId64 " realizations", analysis->table->npoints, analysis->table->npoints == 1 ? "" : "s",
            realizations);
    if (unusable > 0) fprintf(out, ", of these %" PRId64 " failed (not in any mean)", unusable);
    else fputs(", none failed", out);
    char partial[128];
    if (fracas_analysis_partial(analysis, partial, sizeof partial)) fprintf(out, "; %s", partial);
    fputs("</p>\n</header>\n", out);
    return FRACAS_OK;
}

static fracas_err put_page(const fracas_analysis *analysis, const contents *of, FILE *out)
{
    TRY(put_head(analysis, out));
    fputs("<nav aria-label=\"Contents\"><ul>\n", out);
    for (int i = 0; i < SECTIONS; i++)
        if (of->size[i] > 0) fprintf(out, "<li><a href=\"#%s\">%s</a></li>\n", sections[i].id, sections[i].title);
    fputs("</ul></nav>\n<main>\n", out);
    for (int i = 0; i < SECTIONS; i++) {
        if (of->size[i] == 0) continue;
        fprintf(out, "<section id=\"%s\">\n<h2>%s</h2>\n", sections[i].id, sections[i].title);
        fwrite(of->text[i], 1, of->size[i], out);
        fputs("</section>\n", out);
    }
    fprintf(out, "</main>\n<script>\n%s</script>\n</body>\n</html>\n", fracas_page_script);
    return FRACAS_OK;
}

/* ---- files ---- */

static fracas_err write_tables(const fracas_analysis *analysis, const char *folder)
{
    fracas_output_file output;
    TRY(fracas_csv_file(&fracas_csv_table_points, analysis, folder));
    TRY(fracas_csv_file(&fracas_csv_table_slopes, analysis, folder));
    TRY(fracas_csv_file(&fracas_csv_table_energies, analysis, folder));
    TRY(fracas_csv_file(&fracas_csv_table_convergence, analysis, folder));
    TRY(fracas_csv_file(&fracas_csv_table_fragments, analysis, folder));
    TRY(fracas_output_open(folder, "summary.json", &output));
    fracas_analysis_write_json(analysis, output.file);
    return fracas_output_close(&output, FRACAS_OK);
}

static fracas_err write_page(const fracas_analysis *analysis, const char *folder, const fracas_fits *fits, size_t stale)
{
    contents of = {0};
    fracas_page page = {.analysis = analysis, .folder = folder, .fits = fits, .stale = stale};
    fracas_err err = FRACAS_OK;
    for (int i = 0; i < SECTIONS && !err; i++) err = write_section(&page, i, &of);
    if (!err) err = fracas_pdf_write(folder, page.drawing, page.ndrawings);
    fracas_output_file output;
    if (!err) err = fracas_output_open(folder, "index.html", &output);
    if (!err) err = fracas_output_close(&output, put_page(analysis, &of, output.file));
    for (int i = 0; i < SECTIONS; i++) free(of.text[i]);
    free(page.drawing);
    return err;
}

fracas_err fracas_report_write(const fracas_analysis *analysis, const char *study)
{
    char *folder;
    if (asprintf(&folder, "%s/report", study) < 0) return fracas_no_memory("a path");
    fracas_err err = FRACAS_OK;
    if (mkdir(folder, 0777) && errno != EEXIST)
        err = fracas_fail(FRACAS_ENVIRONMENT, "cannot make the folder %s: %s", folder, strerror(errno));
    if (!err) err = write_tables(analysis, folder);
    fracas_fits *fits = NULL;
    size_t stale = 0;
    if (!err) err = fracas_fits_read(study, &fits);
    if (!err && fits) fracas_fits_keep(fits, analysis, &stale);
    if (!err) err = write_page(analysis, folder, fits, stale);
    fracas_fits_destroy(fits);
    free(folder);
    return err;
}
