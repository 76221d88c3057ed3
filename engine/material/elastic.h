/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear elastic material. */
#ifndef FRACAS_ENGINE_MATERIAL_ELASTIC_H
#define FRACAS_ENGINE_MATERIAL_ELASTIC_H

#include "engine/spec.h"

extern const fracas_section fracas_material_section;

#endif
