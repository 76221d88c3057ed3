/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `rigid-link`: the interface elements of the code DynFrag1D (docs/theory/cohesive.md).
 *
 * A link is rigid until the mean stress of its elements has exceeded its strength. Two steps later
 * it carries
 *   q >= 0:  T = sigma_c (1 - D), D = max(D, min(1, q/delta_c)) loading
 *            T = sigma_c (1 - D) q/(D delta_c) below                              (cohesive.8)
 *   q < 0:   T = k q, contact, also after full break,
 *            k = (sigma_c^2 + 4.5 rate^(2/3) E G_c^(2/3) rho^(1/3))/(4.5 G_c)     (cohesive.9) */
#if defined FRACAS_LAW
FRACAS_LAW(rigid_link, RIGID, NO, NO, NO)
#elif defined FRACAS_LAW_TABLES
#include "base/elementary.h"

static const fracas_param rigid_link_params[] = {FRACAS_LAW_REAL(
    fracture_energy, "J/m2", FRACAS_REQUIRED, 0, INFINITY, true, 0, "fracture energy G_c")};
/* 4.5 rate^(2/3) E G_c^(2/3) rho^(1/3) [Pa2]  (cohesive.9) */
static void rigid_link_own(const fracas_spec *spec, double own[FRACAS_LAW_OWN])
{
    own[0] = 4.5 * fracas_pow(spec->loading.rate, 2.0 / 3.0) * spec->material.young *
             fracas_pow(spec->cohesive.fracture_energy, 2.0 / 3.0) *
             fracas_pow(spec->material.density, 1.0 / 3.0);
}

static double rigid_link_contact(const fracas_spec *spec, double strength)
{
    double own[FRACAS_LAW_OWN];
    rigid_link_own(spec, own);
    return (strength * strength + own[0]) / (4.5 * spec->cohesive.fracture_energy);
}

const fracas_law fracas_law_rigid_link = {
    FRACAS_LAW_HEAD(rigid_link, "rigid-link",
                    "linear softening of a link that is rigid until its stress has exceeded its "
                    "strength, contact by penalty (the algorithm of the code DynFrag1D)"),
    .own = rigid_link_own, .contact_by_strength = rigid_link_contact};

#else

/* k [Pa/m]  (cohesive.9) */
LANES_FUNCTION vd rigid_link_penalty(vd sigma_c, const double *own, double energy)
{
    return (sigma_c * sigma_c + lanes_set(own[0])) / lanes_set(4.5 * energy);
}

/* Traction of an open link [Pa]; *damage follows. `penalty` is k [Pa/m]. */
LANES_FUNCTION vd rigid_link_law(vd q, vd *damage, vd sigma_c, vd delta_c, vd penalty)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    vd opening = q / delta_c;
    vmask loading = lanes_le(*damage, opening);
    vd now = lanes_select(loading, lanes_select(lanes_lt(opening, one), opening, one), *damage);
    vd peak = sigma_c * (one - now);
    vd tension = lanes_select(loading, peak, peak * (opening / now));
    *damage = now;
    return lanes_select(lanes_lt(q, zero), penalty * q, tension);
}
#endif
