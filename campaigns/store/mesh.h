/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh of a surface in study.h5, with the interfaces of its realizations, for pictures. Lengths
 * in m. */
#ifndef FRACAS_CAMPAIGNS_STORE_MESH_H
#define FRACAS_CAMPAIGNS_STORE_MESH_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    double position[3];
} fracas_stored_node;

/* A triangle: its vertices, then the middles of the edges from vertex k to vertex k + 1, -1 where
 * there are none. */
typedef struct {
    int64_t node[6];
} fracas_stored_element;

/* An edge between two elements: its ends, as the first element goes round, and its middle or -1. */
typedef struct {
    int64_t element[2], node[3];
} fracas_stored_interface;

/* An edge of the boundary, likewise. */
typedef struct {
    int64_t element, node[3], tag; /* tag 0: none */
} fracas_stored_border;

/* All zero: none, as that of a bar or a ring. */
typedef struct {
    size_t nnodes, nelements, ninterfaces, nborders;
    fracas_stored_node *node; /* owned */
    fracas_stored_element *element;
    fracas_stored_interface *interface; /* in the order of the interfaces of a realization */
    fracas_stored_border *border;
} fracas_stored_mesh;

/* Arrays of the counts, all zero; cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_stored_mesh_allocate(fracas_stored_mesh *mesh);
void fracas_stored_mesh_clear(fracas_stored_mesh *mesh);

/* True if every bit is the same. */
bool fracas_stored_mesh_same(const fracas_stored_mesh *a, const fracas_stored_mesh *b);

/* The first fault of its numbers, NULL if there is none: missing nodes or elements, positions that
 * are no numbers, edges of other elements. */
const char *fracas_stored_mesh_fault(const fracas_stored_mesh *mesh);

/* Where the meshes of a campaign's points come from. */
typedef struct {
    /* Sets *mesh, which is all zero and is cleared by the caller; leaves it so for a point that is
     * no surface. */
    fracas_err (*get)(const void *context, size_t point, fracas_stored_mesh *mesh);
    const void *context;
} fracas_mesh_source;

#endif
