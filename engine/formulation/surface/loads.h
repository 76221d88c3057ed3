/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces of a load on the nodes of a surface (docs/theory/loads.md). */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_LOADS_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_LOADS_H

#include "engine/formulation/surface/surface.h"

/* Number of elements under load: 0 without one. FRACAS_USAGE where its edge does not exist. */
FRACAS_MUST_USE fracas_err fracas_surface_loads_count(const fracas_model *model, size_t *count);

/* Fills load_row, load, load_clock and load_history of tables whose masses are there. FRACAS_USAGE
 * where the load moves nothing, or for its history. */
FRACAS_MUST_USE fracas_err fracas_surface_loads_fill(const fracas_model *model,
                                                     fracas_surface_tables *tables);

#endif
