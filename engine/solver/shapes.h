/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes of a record's fragments. */
#ifndef FRACAS_ENGINE_SOLVER_SHAPES_H
#define FRACAS_ENGINE_SOLVER_SHAPES_H

#include "engine/formulation/formulation.h"

/* Gives the fragments of a harvested lane their volume, ellipsoid, extent and crack area. */
FRACAS_MUST_USE fracas_err fracas_shapes_take(const fracas_model *model, const fracas_step *step,
                                              int lane, fracas_record *record);

#endif
