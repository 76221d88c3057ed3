/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schemes of time integration and mass matrices that a campaign file can name. */
#ifndef FRACAS_ENGINE_INTEGRATOR_INTEGRATOR_H
#define FRACAS_ENGINE_INTEGRATOR_INTEGRATOR_H

#include "engine/spec.h"

/* Central difference is stable for omega dt below this. */
#define FRACAS_CENTRAL_DIFFERENCE_LIMIT 2.0

/* Traits of a scheme. */
typedef struct {
    double (*limit)(const fracas_time *); /* stable for omega dt below this, of an undamped body */
    bool accelerations;                   /* they are part of the state, as in hulbert_chung.h */
} fracas_integrator;

static inline const fracas_integrator *fracas_integrator_of(const fracas_spec *spec)
{
    return spec->time.integrator->traits;
}

extern const fracas_kind fracas_integrator_central_difference, fracas_integrator_hulbert_chung;
extern const fracas_kind fracas_mass_lumped, fracas_mass_consistent;
/* True for masses that couple the nodes of an element; else they are diagonal. */
bool fracas_mass_is_consistent(const fracas_time *time);

#endif
