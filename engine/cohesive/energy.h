/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fracture energy and critical opening, over lanes. A point's parameters give one of the two for
 * all interfaces, the other is 0. */
#ifndef FRACAS_ENGINE_COHESIVE_ENERGY_H
#define FRACAS_ENGINE_COHESIVE_ENERGY_H

#include "base/lanes.h"

/* G_c [J/m2] at a strength or peak [Pa]: as given, or peak delta_c/2. */
LANES_FUNCTION vd cohesive_energy(vd energy, vd opening, vd peak)
{
    return energy + lanes_set(0.5) * (opening * peak);
}

/* delta_c [m] at a strength or peak [Pa]: as given, or 2 G_c/peak. */
LANES_FUNCTION vd cohesive_opening(double energy, double opening, vd peak)
{
    return opening > 0 ? lanes_set(opening) : lanes_set(2.0 * energy) / peak;
}

#endif
