/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of all laws over lanes, for kernels. */
#ifndef FRACAS_ENGINE_COHESIVE_KERNELS_H
#define FRACAS_ENGINE_COHESIVE_KERNELS_H

#include "base/lanes.h"
#include "engine/cohesive/law.h"
#include "engine/cohesive/plane.h"
#include "engine/cohesive/resultants.h"

/* An interface of a chain, in series with the flux. */
typedef struct {
    vd mean, jump;            /* m = <sigma> [Pa], q [m] */
    vd damage;                /* D before the step, 0 until onset, 1 once broken */
    vd sigma_c, constant;     /* Pa; the law's own (trait `constant`) */
    vd stiffness, compliance; /* K [Pa/m], 1/K */
    const double *own;        /* the law's own numbers (trait `own`) */
} line_input;

typedef struct {
    vd traction;   /* T [Pa] */
    vd slip;       /* s = q - delta, which the flux itself carries of the jump [m] */
    vd damage;     /* D after the step */
    vd dissipated; /* so far, by G_c [1] */
    vd past_onset; /* trial stress beyond that of onset [Pa] */
    vd softening;  /* trial stress of the break beyond that of onset [Pa] */
    /* kinks of T(S), for its balance (engine/cohesive/balance.h) */
    vd trial;  /* S [Pa] */
    vd secant; /* T/S above S = 0, where D does not grow; below it is 1 */
    vd limit;  /* S beyond which D grows [Pa] ... */
    vd held;   /* ... and T there */
} line_result;

#include "engine/cohesive/laws.list.h"

/* Laws at a point of a surface, whose values `point` has, and laws on the resultants of a shell's
 * Gauss point, whose values of all layers it has. */
#define POINT_YES(name) IS_LAW(name)
#define POINT_RESULTANTS(name)
#define POINT_NO(name)
#define RESULTANTS_YES(name)
#define RESULTANTS_RESULTANTS(name) IS_LAW(name)
#define RESULTANTS_NO(name)
#define FRACAS_LAW(name, bar, ring, membrane, shell) POINT_##membrane(name) POINT_##shell(name)

/* Law number `law`; the values are brought up to date. */
LANES_FUNCTION plane_result plane_law(int law, const plane_interface *at, const plane_input *in,
                                      double *point)
{
#define IS_LAW(name) \
    if (law == FRACAS_LAW_##name) return plane_at_##name(at, in, point);
#include "engine/cohesive/laws.list.h"
#undef IS_LAW
    __builtin_unreachable();
}

/* Opening over that of the break: D of law number `law` reaches 1 with it. */
LANES_FUNCTION vd plane_opening(int law, const plane_interface *at, const plane_input *in,
                                const double *point)
{
#define IS_LAW(name) \
    if (law == FRACAS_LAW_##name) return plane_opening_##name(at, in, point);
#include "engine/cohesive/laws.list.h"
#undef IS_LAW
    __builtin_unreachable();
}
#undef FRACAS_LAW
#define FRACAS_LAW(name, bar, ring, membrane, shell) RESULTANTS_##shell(name)

LANES_FUNCTION int law_takes_resultants(int law)
{
#define IS_LAW(name) \
    if (law == FRACAS_LAW_##name) return 1;
#include "engine/cohesive/laws.list.h"
#undef IS_LAW
    return 0;
}

LANES_FUNCTION resultant_result resultant_law(int law, const plane_interface *at,
                                              const resultant_input *in, double *point)
{
#define IS_LAW(name) \
    if (law == FRACAS_LAW_##name) return resultant_at_##name(at, in, point);
#include "engine/cohesive/laws.list.h"
#undef IS_LAW
    __builtin_unreachable();
}

LANES_FUNCTION vd resultant_opening(int law, const plane_interface *at, const resultant_input *in,
                                    const double *point)
{
#define IS_LAW(name) \
    if (law == FRACAS_LAW_##name) return resultant_opening_##name(at, in, point);
#include "engine/cohesive/laws.list.h"
#undef IS_LAW
    __builtin_unreachable();
}
#undef FRACAS_LAW

/* Law number `law` at an interface of a chain. */
LANES_FUNCTION line_result line_law(int law, const line_input *in)
{
#define LINE_FLUX(name) \
    if (law == FRACAS_LAW_##name) return line_##name(in);
#define LINE_RIGID(name)
#define LINE_NO(name)
#define FRACAS_LAW(name, bar, ring, membrane, shell) LINE_##bar(name) LINE_##ring(name)
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW
#undef LINE_FLUX
#undef LINE_RIGID
#undef LINE_NO
    __builtin_unreachable();
}

#endif
