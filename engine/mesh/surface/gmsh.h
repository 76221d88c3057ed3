/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes that Gmsh wrote: MSH 2.2 and 4.1, text and binary of either byte order
 * (docs/decisions/gmsh-reader.md). */
#ifndef FRACAS_ENGINE_MESH_SURFACE_GMSH_H
#define FRACAS_ENGINE_MESH_SURFACE_GMSH_H

#include "engine/mesh/surface/surface.h"

/* The surface of the 3- or 6-node triangles in the `size` bytes of a file. Edges have the number of
 * the physical group of the line that lies on them as tag, others 0; `given` holds Gmsh's numbers,
 * and messages use them. Points, lines of no physical group, physical groups of triangles, and
 * sections with data are passed over, as are nodes that no triangle names. FRACAS_USAGE says what
 * is wrong and at which line (of a binary file: byte), other elements by their name. */
FRACAS_MUST_USE fracas_err fracas_surface_read_gmsh(const void *bytes, size_t size,
                                                    const fracas_surface **surface);

#endif
