/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A surface for a drawing: its facets (triangles facing the reader, in the frame of the
 * view), which of them hide others, and tints of its fragments. The shell is a solid with the
 * surface in its middle: an element shows its outer skin or, turned away, its inner one; at an
 * edge, the cut through the thickness may show, too. */
#ifndef FRACAS_ANALYSIS_DRAW_FACETS_H
#define FRACAS_ANALYSIS_DRAW_FACETS_H

#include "analysis/draw/surface_picture.h"
#include "analysis/draw/trail.h"
#include "campaigns/store/mesh.h"

#include <stddef.h>
#include <stdint.h>

typedef enum { FRACAS_FACET_OUTER, FRACAS_FACET_INNER, FRACAS_FACET_CUT } fracas_facet_kind;

/* Line of a side of a facet. The first three are connected interfaces, as in
 * fracas_interface_state. */
typedef enum {
    FRACAS_SIDE_CLOSED,
    FRACAS_SIDE_CRACKED,
    FRACAS_SIDE_BROKEN,
    FRACAS_SIDE_PARTED, /* broken, and its fragments are apart */
    FRACAS_SIDE_EDGE,   /* all of the surface, or the part facing the reader */
    FRACAS_SIDE_NONE    /* no line */
} fracas_side;

/* Side k goes from node k to node k + 1 (mod 3), counter-clockwise for the reader. */
typedef struct {
    uint32_t node[3];
    int32_t middle[3];    /* node half way of a curved side, -1: it is straight */
    int32_t neighbour[3]; /* facet across the side, -1: none, or none in the same skin */
    uint8_t side[3];      /* fracas_side */
    uint8_t kind;         /* fracas_facet_kind */
    uint32_t fragment;
    float light;   /* share of a light falling on it square on, 0 to 1 */
    int32_t layer; /* -1: hidden; else behind all layers hiding part of it, from 0 */
} fracas_facet;

typedef struct {
    size_t nfacets, nnodes, nlayers;
    fracas_facet *facet; /* owned; facet e < nskin is the skin of element e */
    size_t nskin;
    double (*node)[3];           /* owned; to the right, upward, toward the reader [m] */
    double least[2], largest[2]; /* m, right and up: room for it at any time of its run */
} fracas_facets;

/* By the view, the distances and the thickness of the picture, whose view is not NULL. Without
 * layers: those are all 0. Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_facets_create(const fracas_stored_mesh *mesh,
                                                const fracas_surface_state *state,
                                                const fracas_surface_picture *picture,
                                                fracas_facets *facets);
void fracas_facets_clear(fracas_facets *facets);

/* Turns [m] in x, y, z to right, up, toward the reader: r = (-sin a, cos a, 0), u = (-sin h cos a,
 * -sin h sin a, cos h), t = (cos h cos a, cos h sin a, sin h) with a azimuth and h elevation. */
void fracas_view_turn(const fracas_view *view, const double vector[3], double turned[3]);

/* Finds hidden facets and layers (facets_hiding.c). Facets of a layer do not hide each other,
 * except in circles. A facet counts as hidden if 45 points spread over it are, or if it is seen
 * edge on. */
FRACAS_MUST_USE fracas_err fracas_facets_hide(fracas_facets *facets);

/* In whole units of the frame: layer by layer from the back, in each the areas (tint: of each
 * fragment; NULL: all of one body), if `shaded` over them shades, each a step darker than those it
 * lies on, and the lines. */
FRACAS_MUST_USE fracas_err fracas_facets_draw(const fracas_facets *facets,
                                              const fracas_frame *frame, const uint8_t *tint,
                                              bool shaded, fracas_surface_show show, FILE *out);

enum { FRACAS_TINTS = 7, FRACAS_TINT_DUST = FRACAS_TINTS };

/* *tint: one for each fragment, freed by the caller; FRACAS_TINT_DUST for dust. The largest
 * fragment comes first; each gets the tint with the shortest common border, of several the one with
 * the fewest elements so far. */
FRACAS_MUST_USE fracas_err fracas_tint_fragments(const fracas_stored_mesh *mesh,
                                                 const fracas_surface_state *state, uint8_t **tint);

#endif
