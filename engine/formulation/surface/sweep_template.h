/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts common to the sweeps of membranes and shells. */
#ifndef FRACAS_ENGINE_SURFACE_SWEEP_TEMPLATE_H
#define FRACAS_ENGINE_SURFACE_SWEEP_TEMPLATE_H

#include "engine/cohesive/kernels.h"
#include "engine/formulation/surface/sweep.h"
#include "engine/integrator/central_difference.h"

#ifdef __SANITIZE_ADDRESS__ /* unrolled, checks take minutes to compile */
#define UNROLL_FOR(...) for (__VA_ARGS__)
#else
#define UNROLL_FOR(...) _Pragma("GCC unroll 18") for (__VA_ARGS__)
#endif

LANES_FUNCTION double *surface_at(double *record, int field)
{
    return record + field * LANES;
}

/* Displacements of the `size` unknowns of an element at t_n, from where the last kick left them,
 * `dt` ago. */
LANES_FUNCTION void surface_drift(const fracas_surface_motion *m, vd dt, int size, double *at)
{
    UNROLL_FOR (int i = 0; i < size; i++) {
        double *u = surface_at(at, SURFACE_U * size + i), *v = surface_at(at, SURFACE_V * size + i);
        if (!m->alpha) {
            lanes_store(u, central_drift(lanes_load(u), lanes_load(v), dt));
        } else { /* (membrane.15) */
            const vd old = lanes_load(surface_at(at, SURFACE_A * size + i)),
                     now = lanes_load(surface_at(at, SURFACE_A_NEXT * size + i));
            lanes_store(u, lanes_load(u) + dt * lanes_load(v) +
                               dt * dt * (lanes_set(0.5 - m->b) * old + lanes_set(m->b) * now));
            lanes_store(v,
                        lanes_load(v) + dt * (lanes_set(1.0 - m->g) * old + lanes_set(m->g) * now));
        }
    }
}

/* Velocities v of an element to those after its kick, which last `dt`, by the accelerations a of
 * its forces. `begins`: in the first step of all. */
LANES_FUNCTION void surface_kick(const fracas_surface_motion *m, vd dt, int begins, int size,
                                 double *at, const vd *a, const vd *v, vd *after)
{
    UNROLL_FOR (int i = 0; i < size; i++) after[i] = v[i];
    if (!m->alpha) {
        UNROLL_FOR (int i = 0; i < size; i++) {
            after[i] = central_kick(v[i], a[i], dt);
            lanes_store(surface_at(at, SURFACE_V * size + i), after[i]);
        }
    } else { /* (membrane.14); the first acceleration is the force's own */
        const vd keep = lanes_set(begins ? 0.0 : m->alpha_m),
                 share = lanes_set(begins ? 1.0 : 1.0 - m->alpha_m);
        UNROLL_FOR (int i = 0; i < size; i++) {
            const vd old = begins ? a[i] : lanes_load(surface_at(at, SURFACE_A_NEXT * size + i));
            lanes_store(surface_at(at, SURFACE_A * size + i), old);
            lanes_store(surface_at(at, SURFACE_A_NEXT * size + i), (a[i] - keep * old) / share);
        }
    }
}

#endif
