/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell as a linear operator, and where a batch keeps what belongs to an element: for the
 * critical time step, and for tests that look at the state between steps. */
#ifndef FRACAS_ENGINE_FORMULATION_SHELL_SHELL_H
#define FRACAS_ENGINE_FORMULATION_SHELL_SHELL_H

#include "engine/formulation/shell/shell_sweep.h"

fracas_shell_constants fracas_shell_constants_of(const fracas_model *model);

/* Where the state has component i (3 node + 0, 1 or 2) of SURFACE_U, SURFACE_V, ... of an element.
 */
double *fracas_shell_value(const fracas_model *model, const fracas_step *step, size_t element,
                           int field, int i, int lane);
/* Where it has a field of layer k of Gauss point g of an interface: SURFACE_DAMAGE, ... */
double *fracas_shell_point(const fracas_model *model, const fracas_step *step, size_t interface,
                           int g, int k, int field, int lane);

/* The operator K of all interfaces whole, or all broken and pressed together:
 *   acceleration = -M^-1 K u, for [element][3 node + component]; components that are held: 0
 * `apply` may be called any number of times between open and close. */
typedef struct fracas_shell_operator fracas_shell_operator;
FRACAS_MUST_USE fracas_err fracas_shell_operator_open(const fracas_model *model, int contact,
                                                      fracas_shell_operator **op);
void fracas_shell_operator_apply(fracas_shell_operator *op, const double *u, double *acceleration);
void fracas_shell_operator_close(fracas_shell_operator *op); /* NULL is allowed */

/* The model's critical steps, from both operators (membrane.16). */
FRACAS_MUST_USE fracas_err fracas_shell_critical_step(fracas_model *model);

#endif
