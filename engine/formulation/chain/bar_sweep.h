/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of the bar: one step of central difference for all lanes, in one pass over the
 * elements. State: a chain's (chain.h). */
#ifndef FRACAS_ENGINE_FORMULATION_BAR_SWEEP_H
#define FRACAS_ENGINE_FORMULATION_BAR_SWEEP_H

#include "engine/cohesive/law.h"
#include "engine/formulation/formulation.h"

/* Values of BAR_LAW of a rigid link. */
enum { BAR_LINK_CLOSED, BAR_LINK_EXCEEDED, BAR_LINK_OPEN };

enum {
    BAR_W_LEFT, /* peculiar displacement of the element's left node [m]: u - rate t x */
    BAR_W_RIGHT,
    BAR_V_LEFT, /* its velocity, half a step before that, after the sweep half a step ahead [m/s] */
    BAR_V_RIGHT,
    BAR_DAMAGE,   /* delta_max/delta_c of the interface */
    BAR_STRENGTH, /* sigma_c [Pa] */
    BAR_LAW,      /* trait `constant`; rigid-link: BAR_LINK_CLOSED ... */
    BAR_FIELDS
};

/* Input of a sweep, the same for all lanes. */
typedef struct {
    size_t elements;
    int periodic, held;     /* ends: joined, moving with the background; else free */
    int walls;              /* beyond free ends */
    double gap, parting;    /* m, from there to the walls at the start; m/s, rate L/2  (bar.20) */
    double contact_factor;  /* 1, stiffness of contact over E/h */
    double young;           /* Pa */
    double beta, spring;    /* 1, Pa/m: nitsche, K = beta E/h */
    double whole;           /* 1, (1 - 1/(2 beta))^2, nitsche  (balance.2) */
    const double *own;      /* the law's own numbers (trait `own`) */
    double size;            /* m, h: of every element, where all are alike */
    const double *sizes;    /* m, [elements]; NULL where all are alike */
    double nodal_mass;      /* kg/m2, rho h/2 */
    double fracture_energy; /* J/m2 */
    double rate;            /* 1/s */
    double area;            /* m2 */
    int contact; /* operator: all interfaces broken and in contact; else whole, by their flux */
} fracas_bar_constants;

/* Advances the lanes first .. first + lanes - 1 of the step. */
typedef void fracas_bar_sweep(const fracas_bar_constants *bar, fracas_step *step, int first);

/* A unit: [law][crossings balanced][elements of one length: 0 no, 1 yes]. `operator`, of one lane
 * alone, leaves M^-1 (-K) w  (bar.6), (bar.7) in place of velocities, with `drift` and velocities
 * 0, `kick` 1; interfaces are [0: tied, 1: whole by their flux or in contact]. */
typedef struct {
    fracas_bar_sweep *sweep[FRACAS_LAWS][2][2];
    fracas_bar_sweep *operator[2][2];
} fracas_bar_kernel;

#endif
