/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRACAS_ENGINE_MESH_SURFACE_CYLINDER_H
#define FRACAS_ENGINE_MESH_SURFACE_CYLINDER_H

#include "engine/mesh/surface/surface.h"

/* Around the y axis, -length/2 <= y <= length/2, open at both ends, normals outward; squares cut in
 * two, diagonals alternating. So many planes of symmetry cut it: 1: the part z >= 0; 2: x, z >= 0;
 * 3: x, y, z >= 0; 0: all of it. `divisions` of the shorter of a quarter of the circumference and
 * the length of the part. Nodes on a plane of symmetry are on it to the last bit. Tags: 1, 2 planes
 * along the axis, 3 smallest y, 4 largest y. */
FRACAS_MUST_USE fracas_err fracas_surface_cylinder(double radius, double length, int planes,
                                                   const fracas_surface_fineness *fineness,
                                                   const fracas_surface **surface);

#endif
