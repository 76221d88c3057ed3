/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Critical time step of central difference by power iteration. */
#ifndef FRACAS_ENGINE_INTEGRATOR_CRITICAL_STEP_H
#define FRACAS_ENGINE_INTEGRATOR_CRITICAL_STEP_H

#include "base/err.h"

#include <stddef.h>

/* Central difference is stable for omega dt below this. */
#define FRACAS_CENTRAL_DIFFERENCE_LIMIT 2.0

/* result = M^-1 K w for `n` degrees of freedom. */
typedef void fracas_operator(const void *context, const double *w, double *result);

/* (bar.16): *omega_squared = largest eigenvalue of M^-1 K [1/s2] by power iteration from `start`
 * (overwritten), until the quotient (w, M^-1 K w)/(w, w) moves by less than 1e-9 of itself in each
 * of 20 steps, 2000 steps at most. Where all masses are alike it is Rayleigh's and comes from
 * below: within 1e-3 when the top of the spectrum is dense, to round-off when `start` holds the
 * extreme mode, as regular meshes allow. With masses that differ it may come from above too, as
 * closely. */
FRACAS_MUST_USE fracas_err fracas_power_iteration(fracas_operator *apply, const void *context,
                                                  size_t n, double *start, double *omega_squared);

#endif
