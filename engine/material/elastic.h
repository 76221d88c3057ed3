/* Linear elastic material. */
#ifndef FRACAS_ENGINE_MATERIAL_ELASTIC_H
#define FRACAS_ENGINE_MATERIAL_ELASTIC_H

#include "engine/spec.h"

extern const fracas_section fracas_material_section;

/* Speed of a longitudinal wave in a bar, c = sqrt(E/rho) [m/s]. */
double fracas_wave_speed(const fracas_material *material);

#endif
