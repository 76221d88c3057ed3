/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces of loads on the nodes of a surface, and nodes that they move (docs/theory/loads.md). */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_LOADS_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_LOADS_H

#include "engine/formulation/surface/surface.h"
#include "engine/loading/load.h"

/* Tag of the i-th edge on which the load of loading number n acts; 0: there is none. FRACAS_USAGE
 * where the shape or the mesh has no such edge. */
FRACAS_MUST_USE fracas_err fracas_surface_load_tag(const fracas_model *model, int n, int i,
                                                   int32_t *tag);

/* Key of the edges of a tag: the tag where the shape, `geometry` or a load decides on them alone;
 * else 0, that of all others. */
int32_t fracas_surface_edge_key(const fracas_model *model, int32_t tag);

/* A load acts on edges of this tag, inside the body or on its boundary. */
bool fracas_surface_is_loaded(const fracas_model *model, int32_t tag, bool inside);

/* The kind of the edges of a tag: the shape's, that of `geometry`, or else that of all others. */
const fracas_kind *fracas_surface_edge_kind(const fracas_spec *spec, int32_t tag);

/* Components of displacement held by an edge of this kind, bits 1, 2, 4 for x, y, z; 0: none. A
 * free one goes along whole where a load has `moved` it. FRACAS_USAGE where the body cannot have
 * such an edge there. */
FRACAS_MUST_USE fracas_err fracas_surface_hold_edge(const fracas_model *model,
                                                    const fracas_surface_border *border,
                                                    const fracas_kind *kind, bool moved,
                                                    unsigned *components);
/* A shell does not turn about it. */
bool fracas_surface_has_rim(const fracas_model *model, const fracas_surface_border *border);
/* Fills held, fixed, moved and rims of the tables. FRACAS_USAGE where an edge does not exist, or
 * cannot be such. */
FRACAS_MUST_USE fracas_err fracas_surface_edges_fill(const fracas_model *model,
                                                     fracas_surface_tables *tables);
/* Sets on[node of the mesh], all false before, for the nodes of loading number n, a load on nodes.
 * FRACAS_USAGE where it has none; a point may have none. */
FRACAS_MUST_USE fracas_err fracas_surface_nodes_mark(const fracas_model *model, int n,
                                                     int dimension, bool *on);
/* Number of loads that hold sets of nodes, and their loadings. */
int fracas_surface_node_sets(const fracas_model *model, int number[FRACAS_LOADINGS]);
/* Then the sets of nodes, and adds them to these tables. FRACAS_USAGE where one has no node, holds
 * nothing, or holds what another does. */
FRACAS_MUST_USE fracas_err fracas_surface_nodes_fill(const fracas_model *model,
                                                     fracas_surface_tables *tables);

/* A place at s in (0, 1) on an edge, and |dx/ds| there [m]. */
fracas_place fracas_surface_place_on(const fracas_surface *surface,
                                     const fracas_surface_border *border, double s, double *speed);

/* Number of the loading that moves edges of a tag; FRACAS_LOADINGS: none does. */
int fracas_surface_mover(const fracas_model *model, int32_t tag);
/* Fills motions of the tables. FRACAS_USAGE as fracas_surface_load_tag, where two move an edge, and
 * where another loading prescribes velocities, too. */
FRACAS_MUST_USE fracas_err fracas_surface_motions(const fracas_model *model,
                                                  fracas_surface_tables *tables);
/* Makes and fills rows of the tables' motions, and their histories. FRACAS_USAGE where one moves a
 * component that nothing holds, or none, and where an element has nodes of two. */
FRACAS_MUST_USE fracas_err fracas_surface_motion_fill(const fracas_model *model,
                                                      fracas_surface_tables *tables);

/* Number of forces, and of elements under one, those of each. FRACAS_USAGE where an edge does not
 * exist. */
FRACAS_MUST_USE fracas_err fracas_surface_loads_count(const fracas_model *model, size_t *forces,
                                                      size_t *count);

/* Fills forces, load_row, load, load_clock and histories of tables whose masses are there.
 * FRACAS_USAGE where a load moves nothing, or for its history. */
FRACAS_MUST_USE fracas_err fracas_surface_loads_fill(const fracas_model *model,
                                                     fracas_surface_tables *tables);

#endif
