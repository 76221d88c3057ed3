/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/edges.h"

#include "engine/mesh/body.h"
#include "engine/mesh/surface/surface.h"

const fracas_kind *fracas_surface_edge_kind(const fracas_spec *spec, int32_t tag)
{
    if (spec->geometry.shape == &fracas_shape_sphere)
        return &fracas_edge_symmetry; /* of the octant; the whole sphere has none */
    const fracas_kind *kind = spec->geometry.edge[tag > 0 && tag < FRACAS_EDGES ? tag : 0];
    return kind ? kind : &fracas_edge_free;
}

fracas_err fracas_surface_check_edge_tags(const fracas_model *model)
{
    const fracas_surface *surface = model->surface;
    for (int32_t tag = 1; model->spec.geometry.shape == &fracas_shape_file && tag < FRACAS_EDGES;
         tag++) {
        size_t found = 0;
        for (size_t b = 0; b < surface->nborders; b++) found += surface->border[b].tag == tag;
        const fracas_kind *edge = model->spec.geometry.edge[tag];
        if (found == 0 && edge && edge != &fracas_edge_free)
            return fracas_fail(
                FRACAS_USAGE,
                "geometry.edge_%d is %s, but the mesh has no edge on its boundary of the physical "
                "group %d: give the lines that number, or use `edges` for all others",
                (int)tag, edge->name, (int)tag);
    }
    return FRACAS_OK;
}
