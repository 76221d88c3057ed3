/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A cohesive law at an interface that opens only, in series with a chain's flux, over lanes. */
#ifndef FRACAS_ENGINE_COHESIVE_LINE_H
#define FRACAS_ENGINE_COHESIVE_LINE_H

#include "base/lanes.h"

typedef struct {
    vd mean, jump;            /* m = <sigma> [Pa], q [m] */
    vd damage;                /* D before the step, 0 until onset, 1 once broken */
    vd sigma_c, constant;     /* Pa; the law's own (trait `constant`) */
    vd stiffness, compliance; /* K [Pa/m], 1/K */
} line_input;

typedef struct {
    vd traction;   /* T [Pa] */
    vd slip;       /* s = q - delta, which the flux itself carries of the jump [m] */
    vd damage;     /* D after the step */
    vd dissipated; /* so far, by G_c [1] */
    vd past_onset; /* trial stress beyond that of onset [Pa] */
    vd softening;  /* trial stress of the break beyond that of onset [Pa] */
} line_result;

#endif
