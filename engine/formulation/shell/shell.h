/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of a shell: the places of their values (docs/theory/shell.md). */
#ifndef FRACAS_ENGINE_FORMULATION_SHELL_SHELL_H
#define FRACAS_ENGINE_FORMULATION_SHELL_SHELL_H

#include "engine/formulation/surface/surface.h"

/* Quadratic triangles: nodes, unknowns, bulk points, Gauss points of an edge, layers. */
enum { SHELL_NODES = 6, SHELL_UNKNOWNS = 18, SHELL_BULK = 3, SHELL_EDGE = 3, SHELL_LAYERS = 3 };

/* A bulk point, after its head: the orthonormal frame x, y, t of the surface there, to which the
 * head's x, y belong  (shell.2); the bending strains xx, yy, 2 xy by t . u,xixi, t .
 * u,etaeta, t . u,xieta and by t . u,xi, t . u,eta  (shell.4). */
enum {
    SHELL_X = SURFACE_BULK_HEAD,
    SHELL_Y = SHELL_X + 3,
    SHELL_T = SHELL_Y + 3,
    SHELL_SECOND = SHELL_T + 3,
    SHELL_FIRST = SHELL_SECOND + 9,
    SHELL_BULK_TABLE = SHELL_FIRST + 6
};

/* An interface, after its head: the stiffness against shearing off [Pa]; then each Gauss point: the
 * frame n, s, t of the edge, 1/|dx/ds| [1/m], the weight: length times
 * quadrature weight [m], the mean curvatures L_nn, L_ns, L_ss [1/m], and for each side: half of the
 * normal's n_x^2, n_y^2, n_x n_y in the element's frame; the derivatives of its shape functions
 * along the normal [1/m]; the vector by which they turn: t of the first side, -t of the second. */
enum { SHELL_SHEARING = SURFACE_HEAD, SHELL_POINTS };
enum {
    SHELL_SQUARE_X,
    SHELL_SQUARE_Y,
    SHELL_PRODUCT,
    SHELL_SLOPE,
    SHELL_TURN = SHELL_SLOPE + SHELL_NODES,
    SHELL_SIDE = SHELL_TURN + 3
};
enum {
    SHELL_N,
    SHELL_S = SHELL_N + 3,
    SHELL_LIFT = SHELL_S + 3,
    SHELL_PER_SPEED = SHELL_LIFT + 3,
    SHELL_LENGTH,
    SHELL_L_NN,
    SHELL_L_NS,
    SHELL_L_SS,
    SHELL_SIDES,
    SHELL_POINT_TABLE = SHELL_SIDES + 2 * SHELL_SIDE
};
#define SHELL_INTERFACE_TABLE (SHELL_POINTS + SHELL_EDGE * SHELL_POINT_TABLE)

/* A rim, an edge whose director is held: the stiffness of its turn [N], then each Gauss point: the
 * weight, and a first side (but the whole of n_x^2, ...). */
enum { SHELL_RIM_STIFFNESS, SHELL_RIM_POINTS };
enum { SHELL_RIM_LENGTH, SHELL_RIM_SIDE, SHELL_RIM_POINT_TABLE = SHELL_RIM_SIDE + SHELL_SIDE };
#define SHELL_RIM_TABLE (SHELL_RIM_POINTS + SHELL_EDGE * SHELL_RIM_POINT_TABLE)

/* A layer's place by the thickness, and its weight: Simpson's rule  (shell.12). */
#define SHELL_LAYER_PLACES \
    {                      \
        -0.5, 0.0, 0.5     \
    }
#define SHELL_LAYER_WEIGHTS       \
    {                             \
        1.0 / 6, 4.0 / 6, 1.0 / 6 \
    }

#endif
