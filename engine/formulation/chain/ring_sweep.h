/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweeps of the ring: one step of all lanes, in one pass over the elements, for Stershic's
 * algorithm in two (docs/theory/ring.md). State: a chain's (chain.h). Element e starts at vertex e
 * of the polygon; interface e is at vertex e + 1. */
#ifndef FRACAS_ENGINE_FORMULATION_RING_SWEEP_H
#define FRACAS_ENGINE_FORMULATION_RING_SWEEP_H

#include "engine/cohesive/law.h"
#include "engine/formulation/formulation.h"
#include "engine/loading/loading.h"

enum {
    RING_U_LEFT, /* displacement of the element's left node, x and y [m] */
    RING_U_RIGHT = RING_U_LEFT + 2,
    /* its velocity [m/s], half a step behind the displacement, ahead of it after the sweep */
    RING_V_LEFT = RING_U_RIGHT + 2,
    RING_V_RIGHT = RING_V_LEFT + 2,
    RING_DAMAGE = RING_V_RIGHT + 2, /* delta_max/delta_c of the interface */
    RING_STRENGTH,                  /* sigma_c [Pa] */
    RING_LAW,                  /* nitsche: K delta_c - sigma_c [Pa]; stershic: a ring_link_state */
    RING_FIELDS,               /* nitsche's */
    RING_STRESS = RING_FIELDS, /* stershic: stress of the element [Pa] */
    RING_STRAIN, /* stershic: eps_d, largest strain since both its links are barred; else -1 */
    RING_PULL,   /* stershic: stress of the interface along its normal, unless it is open [Pa] */
    RING_FIELDS_STERSHIC
};

/* The values of RING_LAW for Stershic's links. */
typedef enum { RING_LINK_CLOSED = 0, RING_LINK_OPEN = 1, RING_LINK_BARRED = 2 } ring_link_state;

/* Input of a sweep, the same for all lanes. */
typedef struct {
    size_t elements;
    const double *table; /* [elements][RING_TABLE] */
    int current;  /* interfaces open along their elements' mean direction as it is, not as it was */
    double young; /* Pa */
    double spring;           /* Pa/m: nitsche, K = beta E/h; stershic, the stiffness of contact */
    double whole;            /* 1, (1 - 1/(2 beta))^2, nitsche  (balance.2) */
    double size;             /* m, h */
    double bending, corner;  /* Pa m, 1: k, sin(2 pi/n)  (ring.19) */
    double radius;           /* m, of the polygon's vertices */
    double nodal_mass;       /* kg/m2, rho h/2 */
    double fracture_energy;  /* J/m2; stershic: 0 where the critical opening is given */
    double critical_opening; /* m, or 0 */
    double area;             /* m2 */
    double time_step;        /* s, stershic: unrefined */
    const double *own;       /* the law's own numbers (trait `own`) */
    fracas_ring_drive drive;
    int circumferential; /* direction of the drive; else radial */
    double level, rate;  /* level + rate t: velocity held [m/s], or force on a node per area [Pa] */
} fracas_ring_constants;

/* Cosine and sine of the angle of vertex e, and the chord with which element e starts [m]. */
enum { RING_COS, RING_SIN, RING_START_X, RING_START_Y, RING_TABLE };

/* Advances the lanes first .. first + lanes - 1 of the step. */
typedef void fracas_ring_sweep(const fracas_ring_constants *ring, fracas_step *step, int first);

/* A unit: [law][crossings balanced]. */
typedef struct {
    fracas_ring_sweep *sweep[FRACAS_LAWS][2];
} fracas_ring_kernel;

#endif
