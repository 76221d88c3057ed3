/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schemes of time integration and mass matrices that a campaign file can name. */
#ifndef FRACAS_ENGINE_INTEGRATOR_INTEGRATOR_H
#define FRACAS_ENGINE_INTEGRATOR_INTEGRATOR_H

#include "base/param.h"

/* Central difference is stable for omega dt below this. */
#define FRACAS_CENTRAL_DIFFERENCE_LIMIT 2.0

extern const fracas_kind fracas_integrator_central_difference, fracas_integrator_hulbert_chung;
extern const fracas_kind fracas_mass_lumped, fracas_mass_consistent;

#endif
