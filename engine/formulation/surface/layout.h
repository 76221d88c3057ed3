/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizes and places of a surface's state and of its tables.
 *
 * State of a group of lanes, one part after another:
 *   [element][field][lane]    SURFACE_U ..., each as wide as an element has unknowns (node 0 x, y,
 *                             ..., node 1 x, ...)
 *   [interface][point][field][lane]  values of the law (engine/cohesive/law.h)
 *   [strength][lane]          sigma_c [Pa], one for each interface, or for each of its Gauss points
 * and then, for the sweep alone and of no meaning between steps
 *   [ghost][field][lane]      each part's copies of elements and interfaces (division.h)
 *   [slot][field][lane]       each part's: stresses and forces of an element under way
 *   [block][sum][lane]        SURFACE_STRAIN ..., of SURFACE_BLOCK consecutive elements each
 */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_LAYOUT_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_LAYOUT_H

#include "engine/formulation/formulation.h"

/* By the order of triangles: nodes, bulk points (of stresses), Gauss points of an edge. */
#define SURFACE_NODES(order) (3 * (order))
#define SURFACE_BULK(order) ((order) == 1 ? 1 : 3)
#define SURFACE_EDGE(order) ((order) + 1)
/* At most: points of an interface at which a law acts, unknowns of an element. */
enum { SURFACE_POINTS_MOST = 9, SURFACE_UNKNOWNS_MOST = 18 };

/* Fields of an element, each as wide as it has unknowns: displacement at t_n; velocity, half a step
 * behind before the sweep and ahead after (Hulbert-Chung: at t_n); Hulbert-Chung: acceleration a_n
 * and a_{n+1}. */
enum {
    SURFACE_U,
    SURFACE_V,
    SURFACE_FIELDS,
    SURFACE_A = SURFACE_FIELDS,
    SURFACE_A_NEXT,
    SURFACE_FIELDS_ALPHA
};

/* Sums over a block, for the ledger. Elements and interfaces add one after another, an interface to
 * the block of its second element; then blocks are added by a fixed tree. So no sum depends on who
 * computes which blocks. First those that follow the turns of elements, then those of their kicks.
 */
enum {
    SURFACE_STRAIN,     /* twice the strain energy [J] */
    SURFACE_RIMS,       /* twice the energy of rims [J] */
    SURFACE_FLUX,       /* twice the energy of the flux [J] */
    SURFACE_STORED,     /* twice the energy of openings and contact [J] */
    SURFACE_DISSIPATED, /* energy dissipated so far [J] */
    SURFACE_BENDING,    /* energy dissipated by bending in this step [J] */
    SURFACE_CREATED,    /* energy put in by onsets and breaks in this step [J] */
    SURFACE_RUBBED,     /* energy dissipated by friction in this step [J] */
    SURFACE_SUMS_BY_TURN,
    SURFACE_KINETIC = SURFACE_SUMS_BY_TURN, /* twice the kinetic energy [J] */
    SURFACE_DAMPED,                         /* energy damped in this step [J] */
    SURFACE_MOMENT,                         /* membranes: sum of m r.du/dt of this step [kg m2/s] */
    SURFACE_WORK,                           /* work of loads in this step [J] */
    SURFACE_POWER,                          /* power of reactions [W]; where loads move nodes:
                                               of each motion the force along its path [N] */
    SURFACE_SUMS = SURFACE_POWER + FRACAS_LOADINGS
};
enum { SURFACE_BLOCK = 64 }; /* elements */

/* Head of a bulk point's table: derivatives of xi, eta along x, y, and the weight: of quadrature
 * times area, or times volume where stresses are no resultants. */
enum {
    SURFACE_XI_X,
    SURFACE_XI_Y,
    SURFACE_ETA_X,
    SURFACE_ETA_Y,
    SURFACE_WEIGHT,
    SURFACE_BULK_HEAD
};

/* Head of an interface's table: stiffness K [Pa/m], its inverse. */
enum { SURFACE_STIFFNESS, SURFACE_COMPLIANCE, SURFACE_HEAD };

/* An element's rotary inertia: the direction t along which displacements turn it, and two symmetric
 * matrices over its nodes, lower triangles row by row: R [kg], and the part of the inverse mass
 * beside M^-1 [1/kg]  (shell.17). */
enum {
    SURFACE_TURNING,
    SURFACE_ROTARY = SURFACE_TURNING + 3,
    SURFACE_ROTARY_INVERSE = SURFACE_ROTARY + 21,
    SURFACE_ROTARY_TABLE = SURFACE_ROTARY_INVERSE + 21
};
static inline int fracas_surface_entry(int row, int column)
{
    return row < column ? column * (column + 1) / 2 + row : row * (row + 1) / 2 + column;
}

#endif
