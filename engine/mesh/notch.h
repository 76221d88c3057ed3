/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interfaces that are broken from the start: the section `notch` (docs/theory/meshes.md). */
#ifndef FRACAS_ENGINE_MESH_NOTCH_H
#define FRACAS_ENGINE_MESH_NOTCH_H

#include "engine/mesh/surface/surface.h"
#include "engine/spec.h"

#define FRACAS_NOTCH_GROUP "notch" /* physical group of curves whose interfaces are broken, too */

extern const fracas_section fracas_notch_section;

/* True if its ends are apart. */
bool fracas_notch_has_line(const fracas_notch *notch);

/* False: its faces pass through each other. */
bool fracas_notch_touches(const fracas_notch *notch);

/* Where a body's interfaces are. */
typedef struct {
    const fracas_surface *surface; /* NULL of a chain: ... */
    size_t interfaces;
    const double (*position)[3]; /* ... the places of its interfaces [m], if there is a line */
    double size;                 /* m, mean length of an element, of a surface's interface */
} fracas_notch_places;

/* The interfaces of a notch, their numbers rising; the caller frees. A surface has the path along
 * edges from the vertex nearest to `from` to the one nearest to `to` that is short and keeps to the
 * line (meshes.9), and those of FRACAS_NOTCH_GROUP. A chain has the one nearest to the line, among
 * several the one nearest to its middle. Nothing is farther from the line than `within`, or `size`.
 * FRACAS_USAGE names the distance and the remedy. */
FRACAS_MUST_USE fracas_err fracas_notch_find(const fracas_notch *notch,
                                             const fracas_notch_places *places,
                                             uint32_t **interface, size_t *count);

#endif
