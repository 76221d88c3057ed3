/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the campaign says of the edges of a surface. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_EDGES_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_EDGES_H

#include "engine/formulation/formulation.h"

/* What holds the edges of a tag. */
const fracas_kind *fracas_surface_edge_kind(const fracas_spec *spec, int32_t tag);

/* Edges of a mesh file that are to be held must be there. */
FRACAS_MUST_USE fracas_err fracas_surface_check_edge_tags(const fracas_model *model);

#endif
