/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRACAS_ENGINE_MESH_SURFACE_CAPSULE_H
#define FRACAS_ENGINE_MESH_SURFACE_CAPSULE_H

#include "engine/mesh/surface/surface.h"

/* A tube around the y axis, -length/2 <= y <= length/2, closed by half spheres, normals outward. So
 * many planes of symmetry cut it, as a cylinder: 1: the part z >= 0; 2: x, z >= 0; 3: x, y, z >= 0;
 * 0: all of it. `divisions` of a quarter of the circumference. Other parts are mirror images of the
 * octant. Nodes on a plane of symmetry are on it to the last bit. Tags: 1 x = 0, 2 z = 0, 3 y = 0.
 */
FRACAS_MUST_USE fracas_err fracas_surface_capsule(double radius, double length, int planes,
                                                  const fracas_surface_fineness *fineness,
                                                  const fracas_surface **surface);

#endif
