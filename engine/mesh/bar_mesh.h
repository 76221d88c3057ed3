/* Uniform mesh of a straight bar: elements in a row, an interface between neighbours. */
#ifndef FRACAS_ENGINE_MESH_BAR_MESH_H
#define FRACAS_ENGINE_MESH_BAR_MESH_H

#include "base/param.h"

extern const fracas_section fracas_geometry_section;
extern const fracas_section fracas_mesh_section;
extern const fracas_kind fracas_ends_periodic, fracas_ends_held;

#endif
