/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interfaces along a straight line: of a notch, and under a line force (docs/theory/meshes.md). */
#ifndef FRACAS_ENGINE_MESH_LINE_H
#define FRACAS_ENGINE_MESH_LINE_H

#include "engine/mesh/surface/surface.h"

typedef struct {
    double from[3], along[3], length; /* m */
    double within;                    /* m, no interface is farther from it */
    const char *what, *section;       /* messages: its name, the section with its keys */
} fracas_line;

/* A line between two ends; NaN: 0, and `from`. `within` not above 0, or NaN: `size`. */
fracas_line fracas_line_of(const char *what, const char *section, const double from[3],
                           const double to[3], double within, double size);

/* Distance of x from the line [m]; *share: of the nearest place on it, 0 to 1 from end to end. */
double fracas_line_distance(const fracas_line *line, const double x[3], double *share);

/* FRACAS_USAGE: its `part` is too far from the `nearest` `from` [m]. */
FRACAS_MUST_USE fracas_err fracas_line_too_far(const fracas_line *line, const char *part,
                                               const char *from, double nearest);

/* Sets on[interface] of a short path near the line, along interfaces, between the vertices nearest
 * to its ends (meshes.9). FRACAS_USAGE names the distance and the remedy. */
FRACAS_MUST_USE fracas_err fracas_line_find(const fracas_line *line, const fracas_surface *surface,
                                            bool *on);

#endif
