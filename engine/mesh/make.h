/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh of triangles that a spec describes. */
#ifndef FRACAS_ENGINE_MESH_MAKE_H
#define FRACAS_ENGINE_MESH_MAKE_H

#include "engine/mesh/body.h"

/* Makes it; errors as those of the makers, and FRACAS_USAGE for a shape and a spacing that do not
 * go together. */
FRACAS_MUST_USE fracas_err fracas_mesh_make(const fracas_spec *spec,
                                            const fracas_surface **surface);

/* *count: length of mesh.noise; 0: not perturbed. Makes the mesh of a surface once. */
FRACAS_MUST_USE fracas_err fracas_mesh_noise_count(const fracas_spec *spec, size_t *count);

/* Means of fracas_model_interface_volume and fracas_model_interface_area [m3, m2]; of a single
 * element, its own volume and no area. Makes the mesh of a surface once, without mesh.noise as it
 * is before its inner nodes move: the mean changes by the share of elements at edges at most. */
FRACAS_MUST_USE fracas_err fracas_mesh_interface_extent(const fracas_spec *spec, double *volume,
                                                        double *area);

/* Mean length of the interfaces of a surface [m]; 0 where there are none. */
double fracas_mesh_mean_length(const fracas_surface *surface);

#endif
