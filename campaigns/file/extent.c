/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/extent.h"

#include "engine/mesh/make.h"

#include <string.h>

static bool is_same_mesh(const fracas_spec *a, const fracas_spec *b)
{
    return memcmp(&a->geometry, &b->geometry, sizeof a->geometry) == 0 &&
           memcmp(&a->mesh, &b->mesh, sizeof a->mesh) == 0;
}

fracas_err fracas_extent_find(const fracas_point *point, fracas_known_extent *known)
{
    if (!fracas_strength_has_size_effect(&point->strength)) return FRACAS_OK;
    if (known->spec && is_same_mesh(known->spec, &point->spec)) return FRACAS_OK;
    TRY(fracas_mesh_interface_extent(&point->spec, &known->extent.volume, &known->extent.area));
    known->spec = &point->spec;
    return FRACAS_OK;
}
