/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Critical time step of a surface. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_CRITICAL_STEP_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_CRITICAL_STEP_H

#include "engine/formulation/formulation.h"
#include "engine/integrator/lanczos.h"

/* *omega: the highest angular frequency [1/s] of K u = omega^2 M u, with what Lanczos' iteration
 * adds to it. `scale`, for each unknown: the mass of a node of its element, by which the start is
 * made (elements of small mass have most of it), 0 where it is held. */
FRACAS_MUST_USE fracas_err fracas_surface_frequency(const fracas_lanczos_problem *problem,
                                                    const double *scale, double *omega);

/* dt_c = Omega_c/omega_max of both operators: all interfaces whole, all broken and in contact
 * (membrane.16) */
void fracas_surface_set_critical_step(fracas_model *model, double whole, double pressed);

#endif
