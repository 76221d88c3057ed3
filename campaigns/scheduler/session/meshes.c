/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/session/meshes.h"

#include "campaigns/plan/point_model.h"
#include "engine/mesh/make.h"

/* Ends and middle (or -1) of an edge of an element. */
static void edge_nodes(const fracas_surface *surface, size_t element, size_t edge, int64_t node[3])
{
    const uint32_t *of = surface->element + element * surface->corners;
    node[0] = of[edge];
    node[1] = of[(edge + 1) % 3];
    node[2] = surface->order > 1 ? (int64_t)of[3 + edge] : -1;
}

static fracas_err copy_surface(const fracas_surface *surface, fracas_stored_mesh *mesh)
{
    *mesh = (fracas_stored_mesh){.nnodes = surface->nnodes,
                                 .nelements = surface->nelements,
                                 .ninterfaces = surface->ninterfaces,
                                 .nborders = surface->nborders};
    TRY(fracas_stored_mesh_allocate(mesh));
    for (size_t n = 0; n < surface->nnodes; n++)
        for (int i = 0; i < 3; i++) mesh->node[n].position[i] = surface->node[n][i];
    for (size_t e = 0; e < surface->nelements; e++)
        for (size_t k = 0; k < 6; k++)
            mesh->element[e].node[k] = k < surface->corners
                                           ? (int64_t)surface->element[e * surface->corners + k]
                                           : -1;
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        const fracas_surface_interface *interface = &surface->interface[i];
        for (int side = 0; side < 2; side++)
            mesh->interface[i].element[side] = interface->element[side];
        edge_nodes(surface, interface->element[0], interface->edge[0], mesh->interface[i].node);
    }
    for (size_t b = 0; b < surface->nborders; b++) {
        mesh->border[b].element = surface->border[b].element;
        mesh->border[b].tag = surface->border[b].tag;
        edge_nodes(surface, surface->border[b].element, surface->border[b].edge,
                   mesh->border[b].node);
    }
    return FRACAS_OK;
}

static fracas_err get(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    const fracas_campaign *campaign = context;
    if (!fracas_spec_is_surface(&campaign->point[point].spec)) return FRACAS_OK;
    OWN(fracas_model) model = NULL;
    TRY(fracas_point_model_create(campaign, point, &model));
    return copy_surface(fracas_model_surface(model), mesh);
}

fracas_mesh_source fracas_campaign_meshes(const fracas_campaign *campaign)
{
    return (fracas_mesh_source){get, campaign};
}
