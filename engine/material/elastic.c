/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/material/elastic.h"

static const fracas_param elastic[] = {
    {"young", FRACAS_REAL, "Pa", "Young's modulus E", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_material, young)},
    {"density", FRACAS_REAL, "kg/m3", "mass density rho", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_material, density)},
    {"poisson", FRACAS_REAL, "1", "Poisson's ratio nu", FRACAS_REQUIRED, 0, 0.49, false,
     offsetof(fracas_material, poisson), .only = FRACAS_GROUP_SURFACES},
};
const fracas_section fracas_material_section = {
    .name = "material",
    .doc = "Linear elastic material",
    FRACAS_PARAMS(elastic),
    .offset = offsetof(fracas_spec, material),
    .hashed = true,
};
