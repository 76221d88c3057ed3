/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The drawing of a surface in space: shaded, without hidden parts. */
#ifndef FRACAS_ANALYSIS_DRAW_BODY_PICTURE_H
#define FRACAS_ANALYSIS_DRAW_BODY_PICTURE_H

#include "analysis/draw/facets.h"
#include "analysis/draw/trail.h"
#include "analysis/draw/surface_picture.h"

typedef struct {
    fracas_facets facets;
    fracas_frame frame;
    fracas_spot *spot; /* for each node of the facets */
} fracas_body_picture;

/* Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_body_picture_create(const fracas_stored_mesh *mesh,
                                                      const fracas_surface_state *state,
                                                      const fracas_surface_picture *picture,
                                                      const fracas_view *view,
                                                      fracas_body_picture *body);
void fracas_body_picture_clear(fracas_body_picture *body);

/* In whole units of the frame: layer by layer from the back, in each the areas (tint: of each
 * fragment; NULL: all of one body), over them shades, each a step darker than those it lies on, and
 * the lines. */
FRACAS_MUST_USE fracas_err fracas_body_picture_draw(const fracas_body_picture *body,
                                                    const uint8_t *tint, fracas_surface_show show,
                                                    FILE *out);

#endif
