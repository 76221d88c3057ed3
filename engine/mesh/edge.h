/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conditions of a surface's edges, by their keys in `geometry`. */
#ifndef FRACAS_ENGINE_MESH_EDGE_H
#define FRACAS_ENGINE_MESH_EDGE_H

#include "engine/spec.h"

/* Traits of a condition. */
typedef struct {
    unsigned models; /* groups of models whose edges can be such, bits */
    /* Held components of displacement, bits 1, 2, 4 for x, y, z, among `all` of the body. `across`:
     * the axis across its plane, 0 without `plane`. NULL: none. */
    unsigned (*holds)(unsigned all, unsigned across);
    bool plane;    /* the edge lies in a plane x, y or z = const */
    bool mirror;   /* ... at a right angle to the body; beyond it is the mirror image */
    bool director; /* a shell does not turn about it; the body then has rims (fill_rim) */
    bool moving;   /* at the velocity of the loading; else it rests */
} fracas_edge;

static inline const fracas_edge *fracas_edge_of(const fracas_kind *edge)
{
    return edge->traits;
}

/* Something holds it: a component, or its turn. */
static inline bool fracas_edge_is_held(const fracas_edge *edge)
{
    return edge->holds || edge->director;
}

/* Those of one group, by their names: "free, held or fixed". Returns text. */
const char *fracas_edge_names(unsigned group, char text[120]);

enum { FRACAS_EDGE_KINDS = 7 };
extern const fracas_kind *const fracas_edge_kinds[FRACAS_EDGE_KINDS];
extern const fracas_kind fracas_edge_free, fracas_edge_held, fracas_edge_sliding, fracas_edge_fixed,
    fracas_edge_clamped, fracas_edge_symmetry, fracas_edge_diaphragm;

#endif
