/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A picture of a broken surface at one time, as it was before any motion. */
#ifndef FRACAS_ANALYSIS_DRAW_SURFACE_PICTURE_H
#define FRACAS_ANALYSIS_DRAW_SURFACE_PICTURE_H

#include "analysis/analysis.h"
#include "analysis/data/format.h"
#include "analysis/data/surface.h"
#include "campaigns/store/mesh.h"

#include <stdbool.h>
#include <stdio.h>

enum { FRACAS_SURFACE_WIDTH = 800 }; /* pixels of a picture in a file of its own */

typedef struct {
    const char *title; /* text for a reader who cannot see */
    fracas_surface_show show;
    int width;               /* pixels */
    bool standalone;         /* as fracas_svg_begin has it */
    const fracas_view *view; /* NULL: a flat surface from +z, any other from (1, 1, 1) */
    double explode;          /* fragments are moved by this times (their centroid - that of all) */
    double thickness;        /* thickness of the shell in space [m]; 0: its cuts do not show */
} fracas_surface_picture;

/* All at one z, to rounding: drawn as it lies. */
bool fracas_surface_is_flat(const fracas_stored_mesh *mesh);

/* The <svg> element: cracked interfaces light, broken ones dark, the outline, fragments (unless it
 * shows cracks alone) filled, dust in a colour of its own, the mesh if asked for; time, fragments
 * and a scale bar below. Fragments are drawn as loops: the size goes with the length of cracks, at
 * most some 20 bytes an interface. A surface in space, or with a view or fragments apart, is
 * shaded; hidden parts are not drawn, its inner side is darker, and its axes are at the lower
 * right. */
FRACAS_MUST_USE fracas_err fracas_surface_picture_write(const fracas_stored_mesh *mesh,
                                                        const fracas_surface_state *state,
                                                        const fracas_surface_picture *picture,
                                                        FILE *out);

/* "26.5 us": a time with its unit, as pictures and messages have it; "µs" with `unicode`. "never"
 * for NaN. */
fracas_number_text fracas_surface_time(double time, bool unicode);

#endif
