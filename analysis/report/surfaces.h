/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of the broken surfaces of a study: on the page of its report. */
#ifndef FRACAS_ANALYSIS_REPORT_SURFACES_H
#define FRACAS_ANALYSIS_REPORT_SURFACES_H

#include "analysis/report/page.h"
#include "analysis/draw/surface_picture.h"
#include "analysis/summary/study.h"

#include <stdbool.h>
#include <stdio.h>

/* The surface of a point, and its interfaces in a realization. */
typedef struct {
    fracas_stored_mesh mesh;
    fracas_record record; /* with its interfaces */
    double thickness;     /* m; 0 if the point has none */
} fracas_broken_surface;

/* The realization in row `row` of the study. Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_broken_surface_read(fracas_results *results, size_t point,
                                                      size_t row, fracas_broken_surface *surface);
void fracas_broken_surface_clear(fracas_broken_surface *surface);

/* Writes a picture at a time into a file of its own. */
FRACAS_MUST_USE fracas_err fracas_broken_surface_save(const fracas_broken_surface *surface,
                                                      double time,
                                                      const fracas_surface_picture *picture,
                                                      const char *folder, const char *name);

/* True if some point of the study has a mesh. */
FRACAS_MUST_USE fracas_err fracas_surfaces_any(const fracas_analysis *analysis, bool *any);

/* The section of the page, nothing without surfaces. A partial study has no meshes: the section
 * says that they come. Else one realization of every point, the first FRAGMENTED or the typical
 * one, at FRACAS_MOMENTS times; a figure a point, each picture also as a file of the folder, with a
 * CSV of the times at which each interface cracked and broke. After some 1.5 million drawn elements
 * it only says how to get the others. */
FRACAS_MUST_USE fracas_err fracas_surfaces_put(fracas_page *page);

#endif
