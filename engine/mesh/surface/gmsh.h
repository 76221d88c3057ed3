/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes that Gmsh wrote: MSH 2.2 and 4.1, text and binary of either byte order
 * (docs/decisions/gmsh-reader.md). */
#ifndef FRACAS_ENGINE_MESH_SURFACE_GMSH_H
#define FRACAS_ENGINE_MESH_SURFACE_GMSH_H

#include "engine/mesh/surface/surface.h"

/* The surface of the 3- or 6-node triangles in the `size` bytes of a file, whose coordinates are in
 * `unit` [m]. The tag of an edge is the physical group of the line on it, else 0; `given` and
 * messages have Gmsh's numbers. Points, lines of no physical group, physical groups of triangles,
 * data and unused nodes are passed over. Elements that go round against the others are turned. A
 * flat body's nodes that round-off, up to 1e-9 of the body, put beside a plane z = const go onto
 * it, and its elements go round counter-clockwise. FRACAS_USAGE names the fault and its line (of a
 * binary file: byte), other elements by name. */
FRACAS_MUST_USE fracas_err fracas_surface_read_gmsh(const void *bytes, size_t size, double unit,
                                                    bool flat, const fracas_surface **surface);

#endif
