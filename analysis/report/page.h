/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page of a report while it is written, and the parts of its sections.
 *
 * A section is a function that writes to page->out, and a line in the table of page.c (of a
 * convergence: of converge/page.c). An empty one is left out, heading and all. Figures and tables
 * are numbered in the order of the page. */
#ifndef FRACAS_ANALYSIS_REPORT_PAGE_H
#define FRACAS_ANALYSIS_REPORT_PAGE_H

#include "analysis/draw/chart.h"
#include "analysis/draw/surface_picture.h"
#include "analysis/export/tables.h"
#include "analysis/fit/fits.h"
#include "analysis/report/foreign.h"
#include "analysis/summary/study.h"

#include <stdbool.h>
#include <stdio.h>

enum { FRACAS_DRAWING = 104 };
#define FRACAS_FILM_OF_POINT "film-point-" /* 3.html */

typedef struct {
    const fracas_analysis *analysis;
    const char *folder;             /* for the report */
    const fracas_fits *fits;        /* NULL: there are none */
    const fracas_shown_fits *shown; /* these; NULL on a page other than a study's */
    const void *of;                 /* subject of the sections of a page other than a study's */
    const char *source;             /* source of its figures; NULL: the study */
    int refresh;                    /* the page loads itself again after so many s; 0: never */
    const fracas_foreign *foreign;  /* somebody's own files in the folder; NULL: none */
    FILE *out;                      /* for the section */
    int figures, tables;            /* numbered so far */
    size_t ndrawings, room;
    char (*drawing)[FRACAS_DRAWING]; /* SVG files, without their ending, to become PDF */
    const char *grid; /* class of the grid to open with the next figure; NULL: none, or open */
    bool grid_open;
} fracas_page;

typedef fracas_err fracas_page_section(fracas_page *page);

enum { FRACAS_PAGE_SECTIONS = 20 }; /* at most */

typedef struct {
    const char *id, *title;
    fracas_page_section *put; /* NULL: its figures */
} fracas_page_entry;

/* The page as page->folder/index.html, with the text of its sections, and the PDFs of their
 * drawings. `lead`: a line below the title. */
FRACAS_MUST_USE fracas_err fracas_page_write(fracas_page *page, const char *title, const char *lead,
                                             const fracas_page_entry *section, size_t count);

/* Figures from here to fracas_page_grid_end stand side by side: "wide", "small". No figure, no
 * grid. */
void fracas_page_grid(fracas_page *page, const char *class);
void fracas_page_grid_end(fracas_page *page);

/* Puts the chart on the page with its other axes and its caption, writes it to FILE.svg and
 * FILE.csv (and, at the end, FILE.pdf), and clears it. Nothing if it has no panel. `built` is how
 * its making ended: passed on. */
FRACAS_MUST_USE fracas_err fracas_page_chart(fracas_page *page, fracas_chart *chart,
                                             fracas_err built);

/* A figure that is no chart: its contents are written in between. The end writes "Figure 3. title.
 * caption" with links to FILE.svg, .pdf and .csv, where those are `drawn` and there is a `csv`, and
 * its source. */
void fracas_page_figure(fracas_page *page, const char *id, const char *class);
void fracas_page_figure_end(fracas_page *page, const char *title, const char *caption,
                            const char *file, bool drawn, bool csv);

/* " SVG PDF" of a drawing, as links. */
void fracas_page_links(fracas_page *page, const char *file, bool drawn, bool csv);
/* Sets somebody's own FILE.svg, .csv and .pdf aside. */
FRACAS_MUST_USE fracas_err fracas_page_make_room(const fracas_page *page, const char *file);
/* Records that the folder has FILE.svg. */
FRACAS_MUST_USE fracas_err fracas_page_drew(fracas_page *page, const char *file);

/* "Table 2. title": a table, and below it its legend (lines, then NULL; may be NULL); nothing if it
 * has no row. `text`: the last column is words. Clears the table; `built` as above. */
FRACAS_MUST_USE fracas_err fracas_page_table(fracas_page *page, const char *id, const char *title,
                                             bool text, fracas_result_table *table,
                                             const char *const *legend, fracas_err built);

/* ---- the sections ---- */

fracas_page_section fracas_section_summary; /* summary.c */
fracas_page_section fracas_section_means, fracas_section_patterns, fracas_section_fits,
    fracas_section_results, fracas_section_slopes, fracas_section_effects, fracas_section_motion,
    fracas_section_files; /* sections.c */
/* The figures of a section: of the study, then point by point. */
FRACAS_MUST_USE fracas_err fracas_section_figures(fracas_page *page, const char *section);

typedef enum { FRACAS_DRAWING_PDF, FRACAS_DRAWING_PNG } fracas_drawing_format;

/* False in a program built without librsvg: then there are no PDFs, and the page says nothing of
 * them. */
extern const bool fracas_convert_possible;
/* True of a PNG that fracas_convert wrote, which names the program. */
bool fracas_convert_made_png(const char *path);
/* FRACAS_ENVIRONMENT if the library cannot be loaded. */
FRACAS_MUST_USE fracas_err fracas_convert_check(void);

/* Every name[i].svg of the folder as name[i].pdf, vectors, one page of its size (96 pixels an
 * inch), without a date; or as name[i].png, on white, with 2 by 2 dots a pixel. Drawn by a child
 * process, because the library ends its process when memory is short, and keeps its allocations.
 * FRACAS_ENVIRONMENT, naming the file, if it cannot. */
FRACAS_MUST_USE fracas_err fracas_convert(const char *folder, char (*name)[FRACAS_DRAWING],
                                          size_t count, fracas_drawing_format as);

/* The surface of a point, and its interfaces in a realization; of a bar or ring, its strip. */
typedef struct {
    fracas_stored_mesh mesh;
    fracas_record record; /* with its interfaces and fragments */
    double thickness;     /* m; 0 if the point has none */
    bool strip;
    size_t ninterfaces; /* the realization's; those within a strip's elements follow */
} fracas_broken_surface;

/* True if the study kept what draws the point's realizations. */
FRACAS_MUST_USE fracas_err fracas_broken_surface_kept(fracas_results *results, size_t point,
                                                      bool *kept);

/* The realization in row `row` of the study. Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_broken_surface_read(fracas_results *results, size_t point,
                                                      size_t row, fracas_broken_surface *surface);
void fracas_broken_surface_clear(fracas_broken_surface *surface);

FRACAS_MUST_USE fracas_err fracas_broken_surface_draw(const fracas_broken_surface *surface,
                                                      double time,
                                                      const fracas_surface_picture *picture,
                                                      FILE *out);
/* Writes a picture at a time into a file of its own. */
FRACAS_MUST_USE fracas_err fracas_broken_surface_save(const fracas_broken_surface *surface,
                                                      double time,
                                                      const fracas_surface_picture *picture,
                                                      const char *folder, const char *name);

/* The section of the page, nothing without surfaces. A partial study has no meshes: the section
 * says that they come. Else one realization of every point, the first FRAGMENTED or the typical
 * one, at FRACAS_MOMENTS times; a figure a point, each picture also as a file of the folder, with a
 * CSV of the times at which each interface cracked and broke, and a film, a page of its own, until
 * films have 60 MB. After some 1.5 million drawn elements it only says how to get the others. */
fracas_page_section fracas_section_surfaces;

#endif
