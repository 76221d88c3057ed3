/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/make.h"

#include "engine/formulation/formulation.h"

static bool is_flat(const fracas_spec *spec)
{
    const fracas_formulation *model = (const fracas_formulation *)(const void *)spec->formulation;
    return model && model->flat;
}

fracas_err fracas_mesh_make(const fracas_spec *spec, const fracas_surface **surface)
{
    const fracas_mesh *mesh = &spec->mesh;
    const bool from_file = fracas_shape_of(spec)->from_file;
    if (from_file != fracas_spacing_of(spec)->from_file)
        return fracas_fail(FRACAS_USAGE, "geometry.shape is %s, and mesh.spacing %s: %s",
                           spec->geometry.shape->name, mesh->spacing->name,
                           from_file ? "write `spacing: given`, as the file has the elements"
                                     : "write `spacing: triangles` with size or divisions");
    const fracas_surface_fineness fineness = {
        .size = mesh->size,
        .divisions = (size_t)mesh->divisions,
        .order = (int)mesh->order,
        .amplitude = mesh->noise ? mesh->amplitude : 0.0,
        .shift = (const double(*)[2])(const void *)mesh->noise,
        .nshifts = mesh->nnoise / 2,
        .flat = is_flat(spec)};
    return fracas_shape_of(spec)->make(&spec->geometry, &fineness, surface);
}

fracas_err fracas_mesh_noise_count(const fracas_spec *spec, size_t *count)
{
    const fracas_spacing *spacing = fracas_spacing_of(spec);
    *count = spacing->moves ? (size_t)spec->mesh.elements + 1 : 0;
    if (!spacing->rows || !(spec->mesh.amplitude > 0)) return FRACAS_OK;
    fracas_spec regular = *spec;
    const fracas_surface *surface;
    regular.mesh.noise = NULL;
    TRY(fracas_mesh_make(&regular, &surface));
    *count = 2 * surface->nvertices;
    fracas_surface_destroy(surface);
    return FRACAS_OK;
}

static double mean_area(const fracas_surface *surface)
{
    double area = 0;
    for (size_t i = 0; i < surface->ninterfaces; i++)
        for (int side = 0; side < 2; side++)
            area += surface->area[surface->interface[i].element[side]];
    return surface->ninterfaces ? area / 3 / (double)surface->ninterfaces : surface->area[0];
}

double fracas_mesh_mean_length(const fracas_surface *surface)
{
    double length = 0;
    for (size_t i = 0; i < surface->ninterfaces; i++)
        length += fracas_surface_length(surface, surface->interface[i].element[0],
                                        surface->interface[i].edge[0]);
    return surface->ninterfaces ? length / (double)surface->ninterfaces : 0;
}

fracas_err fracas_mesh_interface_extent(const fracas_spec *spec, double *volume, double *area)
{
    const fracas_geometry *geometry = &spec->geometry;
    *area = geometry->area;
    *volume = geometry->area * fracas_spec_length(spec) / (double)spec->mesh.elements;
    if (!fracas_spec_is_surface(spec)) return FRACAS_OK;
    const fracas_surface *surface;
    TRY(fracas_mesh_make(spec, &surface));
    *volume = geometry->thickness * mean_area(surface);
    *area = geometry->thickness * fracas_mesh_mean_length(surface);
    fracas_surface_destroy(surface);
    return FRACAS_OK;
}
