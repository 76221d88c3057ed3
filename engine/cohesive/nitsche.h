/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `nitsche` over lanes: the crack's opening delta in series with the discontinuous-Galerkin
 * flux (docs/theory/cohesive.md).
 *
 * With mean stress m = <sigma>, jump q, stiffness K, strength sigma_c, delta_c = 2 G_c/sigma_c, D =
 * delta_max/delta_c: trial traction        S = m + K q (unbroken), K q (broken) (cohesive.1)
 *   loading, S - sigma_c > D x, x = K delta_c - sigma_c:  D = min(1, (S - sigma_c)/x) (cohesive.2)
 *   traction              T = sigma_c (1 - D) loading, S sigma_c (1 - D)/(sigma_c + D x) on the
 * secant (cohesive.3) T = S where S <= 0: contact by the flux itself q - delta = (T - m)/K
 * (unbroken), 0 (broken)                                     (cohesive.4) At D = 0 the secant is
 * exactly T = S, plain interior penalty. */
#ifndef FRACAS_ENGINE_COHESIVE_NITSCHE_H
#define FRACAS_ENGINE_COHESIVE_NITSCHE_H

#include "base/lanes.h"

typedef struct {
    vd traction; /* T [Pa] */
    vd slip;     /* q - delta [m]: what the flux itself carries of the jump */
    vd damage;   /* D after the step */
    vd trial;    /* S [Pa] */
} nitsche_interface;

LANES_FUNCTION nitsche_interface nitsche_law(vd mean, vd q, vd damage, vd sigma_c, vd x, vd spring,
                                             vd compliance)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    vmask broken = lanes_le(one, damage);
    vd trial = spring * q + lanes_select(broken, zero, mean);
    vd excess = trial - sigma_c;
    vd reached = damage * x;
    vmask loading = lanes_lt(reached, excess);
    vd ratio = lanes_select(loading, excess, sigma_c - sigma_c * damage) /
               lanes_select(loading, x, sigma_c + reached);
    vd capped = lanes_select(lanes_lt(ratio, one), ratio, one);
    vd now = lanes_select(loading, capped, damage);
    vd tension = lanes_select(loading, sigma_c * (one - now), trial * ratio);
    vd traction = lanes_select(lanes_lt(zero, trial), tension, trial);
    vd slip = lanes_select(lanes_le(one, now), zero, (traction - mean) * compliance);
    return (nitsche_interface){traction, slip, now, trial};
}

#endif
