/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cohesive laws: what an interface does once its stress has reached its strength
 * (theory/cohesive.md). */
#ifndef FRACAS_ENGINE_COHESIVE_LAW_H
#define FRACAS_ENGINE_COHESIVE_LAW_H

#include "engine/spec.h"

extern const fracas_section fracas_cohesive_section;
extern const fracas_kind fracas_law_nitsche, fracas_law_rigid_link, fracas_law_stershic,
    fracas_law_camacho_ortiz_standard, fracas_law_camacho_ortiz;
extern const fracas_kind fracas_onset_mean, fracas_onset_flux;
extern const fracas_kind fracas_zone_softening, fracas_zone_steep;

#endif
