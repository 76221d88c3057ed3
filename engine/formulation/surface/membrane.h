/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of a membrane: the places of their values (docs/theory/membrane.md). */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_MEMBRANE_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_MEMBRANE_H

#include "engine/formulation/surface/surface.h"

/* A Gauss point of an interface: the normal from element[0] to element[1], and the weight:
 * length times quadrature weight times thickness [m2]. */
enum { MEMBRANE_NX, MEMBRANE_NY, MEMBRANE_AREA, MEMBRANE_POINT_TABLE };

#endif
