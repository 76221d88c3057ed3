/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws that act on the resultants of a shell's Gauss point, not at its layers: what they are given
 * and what they answer (docs/theory/cohesive.md). Index 0: along the normal, 1: along the edge.
 *
 * Its values are those of three layers: D and p the same in each, and RESULTANT_OWN others shared
 * out among them. */
#ifndef FRACAS_ENGINE_COHESIVE_RESULTANTS_H
#define FRACAS_ENGINE_COHESIVE_RESULTANTS_H

enum {
    RESULTANT_LAYERS = 3,
    RESULTANT_SHARE = 3,
    RESULTANT_FIELDS = SURFACE_POINT_FIELDS + RESULTANT_SHARE,
    RESULTANT_OWN = RESULTANT_LAYERS * RESULTANT_SHARE
};

/* Place of own value `which` among the values of a Gauss point. */
#define RESULTANT_PLACE(which)                                             \
    ((which) / RESULTANT_SHARE * RESULTANT_FIELDS + SURFACE_POINT_FIELDS + \
     (which) % RESULTANT_SHARE)

#ifndef FRACAS_LAW_TABLES
#include "engine/cohesive/plane.h"

typedef struct {
    double thickness;        /* m */
    vd jump[2], turn[2];     /* [u] [m], [Dt] [1] */
    vd mean_n[2], mean_m[2]; /* <N> [N/m], <M> [N] */
    vd flux_n[2], flux_m[2]; /* N [N/m], M [N] of the flux */
} resultant_input;

typedef struct {
    vd n[2], m[2];               /* N [N/m], M [N] */
    vd midway_n[2], midway_m[2]; /* the same at the D halfway through the step */
    vd damage;                   /* D after the step */
    vd stored;                   /* in opening and contact [J/m2 of the crack, times thickness] */
    vd dissipated, spent;        /* so far, in this step [same] */
    vd created;                  /* by an onset in this step [same] */
    vmask cracked;               /* past onset: the above holds */
    vmask cracks[RESULTANT_LAYERS]; /* in this step: of the layers, those above the strength */
    vmask breaks;                   /* in this step */
} resultant_result;

LANES_FUNCTION int resultant_place(int which)
{
    return RESULTANT_PLACE(which) * LANES;
}
#endif

#endif
