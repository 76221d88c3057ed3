/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane as a linear operator, and where a batch keeps what belongs to an element: for the
 * critical time step, and for tests that look at the state between steps. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_MEMBRANE_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_MEMBRANE_H

#include "engine/formulation/surface/membrane_sweep.h"

fracas_membrane_constants fracas_membrane_constants_of(const fracas_model *model);

/* Where the state has component i (2 node + 0 or 1) of SURFACE_U, SURFACE_V, ... of an element. */
double *fracas_membrane_value(const fracas_model *model, const fracas_step *step, size_t element,
                              int field, int i, int lane);
/* Where it has a field of Gauss point g of an interface: SURFACE_DAMAGE, ... */
double *fracas_membrane_point(const fracas_model *model, const fracas_step *step, size_t interface,
                              int g, int field, int lane);

/* The operator K of all interfaces whole, or all broken and pressed together:
 *   acceleration = -M^-1 K u, for [element][2 node + component]; components that are held: 0
 * `apply` may be called any number of times between open and close. */
typedef struct fracas_membrane_operator fracas_membrane_operator;
FRACAS_MUST_USE fracas_err fracas_membrane_operator_open(const fracas_model *model, int contact,
                                                         fracas_membrane_operator **op);
void fracas_membrane_operator_apply(fracas_membrane_operator *op, const double *u,
                                    double *acceleration);
void fracas_membrane_operator_close(fracas_membrane_operator *op); /* NULL is allowed */

/* The model's critical steps, from both operators (membrane.16). */
FRACAS_MUST_USE fracas_err fracas_membrane_critical_step(fracas_model *model);

#endif
