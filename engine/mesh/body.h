/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bodies that can be broken up, and their meshes: the sections `geometry` and `mesh`. */
#ifndef FRACAS_ENGINE_MESH_BODY_H
#define FRACAS_ENGINE_MESH_BODY_H

#include "base/param.h"

extern const fracas_section fracas_geometry_section;
extern const fracas_kind fracas_shape_bar, fracas_shape_ring, fracas_shape_plate,
    fracas_shape_annulus, fracas_shape_sphere, fracas_shape_file;
extern const fracas_kind fracas_part_whole, fracas_part_octant;
extern const fracas_kind fracas_ends_periodic, fracas_ends_held;
extern const fracas_kind fracas_direction_initial, fracas_direction_current;
extern const fracas_kind fracas_edge_free, fracas_edge_held, fracas_edge_sliding, fracas_edge_fixed,
    fracas_edge_clamped, fracas_edge_symmetry, fracas_edge_diaphragm;

extern const fracas_section fracas_mesh_section;
extern const fracas_kind fracas_spacing_uniform, fracas_spacing_graded, fracas_spacing_perturbed,
    fracas_spacing_triangles, fracas_spacing_given;

#endif
