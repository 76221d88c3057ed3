/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Central difference (Newmark beta = 0, gamma = 1/2) in leapfrog form, over lanes.
 *
 *   w_n = w_{n-1} + dt v_{n-1/2}                   (bar.9)
 *   v_{n+1/2} = v_{n-1/2} + dt f(w_n)/m            (bar.10)
 *
 * Its stability limit is in integrator.h. */
#ifndef FRACAS_ENGINE_INTEGRATOR_CENTRAL_DIFFERENCE_H
#define FRACAS_ENGINE_INTEGRATOR_CENTRAL_DIFFERENCE_H

#include "base/lanes.h"

LANES_FUNCTION vd central_drift(vd w, vd v, vd dt)
{
    return w + dt * v;
}
/* `dt_over_m` = dt/m. */
LANES_FUNCTION vd central_kick(vd v, vd force, vd dt_over_m)
{
    return v + dt_over_m * force;
}

#endif
