/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh of triangles that a spec describes. */
#ifndef FRACAS_ENGINE_MESH_MAKE_H
#define FRACAS_ENGINE_MESH_MAKE_H

#include "engine/mesh/body.h"

/* Makes it; errors as those of the makers, and FRACAS_USAGE for a shape and a spacing that do not
 * go together. */
FRACAS_MUST_USE fracas_err fracas_mesh_make(const fracas_spec *spec,
                                            const fracas_surface **surface);

/* *count: random numbers that the mesh of any body needs, mesh.noise; 0: it is not perturbed. Makes
 * the mesh of a surface once. */
FRACAS_MUST_USE fracas_err fracas_mesh_noise_count(const fracas_spec *spec, size_t *count);

/* *volume, *area: what an interface of the body stands for, and its own area, on average [m3, m2]
 * (fracas_model_interface_volume, fracas_model_interface_area); of a mesh with a single element,
 * its own volume and no area. Makes the mesh of a surface once; one that needs random numbers and
 * is given none counts as it is before its inner nodes move, which changes the average by the share
 * of the elements at its edges at most. */
FRACAS_MUST_USE fracas_err fracas_mesh_interface_extent(const fracas_spec *spec, double *volume,
                                                        double *area);

#endif
