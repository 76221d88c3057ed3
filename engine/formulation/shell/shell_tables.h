/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the shell's sweep reads of the mesh: geometry at the quadrature points and masses
 * (docs/theory/shell.md). One copy for all lanes and realizations. */
#ifndef FRACAS_ENGINE_FORMULATION_SHELL_SHELL_TABLES_H
#define FRACAS_ENGINE_FORMULATION_SHELL_SHELL_TABLES_H

#include "engine/formulation/formulation.h"
#include "engine/formulation/surface/visits.h"

/* Quadratic triangles: nodes, their unknowns, points at which stresses are kept, points of an edge,
 * layers of the thickness. */
enum { SHELL_NODES = 6, SHELL_UNKNOWNS = 18, SHELL_BULK = 3, SHELL_EDGE = 3, SHELL_LAYERS = 3 };

/* Of a bulk point, in the orthonormal frame x, y, t of the surface there  (shell.2): derivatives of
 * xi, eta along x, y; the frame; the bending strains xx, yy, 2 xy by t . u,xixi, t . u,etaeta, t .
 * u,xieta and by t . u,xi, t . u,eta  (shell.4); the weight: area times quadrature weight [m2]. */
enum {
    SHELL_XI_X,
    SHELL_XI_Y,
    SHELL_ETA_X,
    SHELL_ETA_Y,
    SHELL_X,
    SHELL_Y = SHELL_X + 3,
    SHELL_T = SHELL_Y + 3,
    SHELL_SECOND = SHELL_T + 3,
    SHELL_FIRST = SHELL_SECOND + 9,
    SHELL_WEIGHT = SHELL_FIRST + 6,
    SHELL_BULK_TABLE
};

/* Of an interface: stiffness K [Pa/m], its inverse, stiffness against shearing off [Pa]; then of
 * each Gauss point the frame n, s, t of the edge, 1/|dx/ds| [1/m], the weight: length times
 * quadrature weight [m], the mean curvatures L_nn, L_ns, L_ss [1/m], and for each side: half of the
 * normal's n_x^2, n_y^2, n_x n_y in the element's frame; the derivatives of its shape functions
 * along the normal [1/m]; and the vector that makes a turn of them: t of the first side, -t of the
 * second. */
enum { SHELL_STIFFNESS, SHELL_COMPLIANCE, SHELL_SHEARING, SHELL_POINTS };
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
#define SHELL_JOINT_TABLE (SHELL_POINTS + SHELL_EDGE * SHELL_POINT_TABLE)

/* Of an edge that holds the director: the stiffness of its turn [N], then of each Gauss point the
 * weight, and as of a first side (but the whole of n_x^2, ...). */
enum { SHELL_RIM_STIFFNESS, SHELL_RIM_POINTS };
enum { SHELL_RIM_LENGTH, SHELL_RIM_SIDE, SHELL_RIM_POINT_TABLE = SHELL_RIM_SIDE + SHELL_SIDE };
#define SHELL_RIM_TABLE (SHELL_RIM_POINTS + SHELL_EDGE * SHELL_RIM_POINT_TABLE)

typedef struct {
    size_t nelements, ninterfaces, nrims;
    double *bulk;           /* [element][point][SHELL_BULK_TABLE] */
    double *mass;           /* [element]: of each node 1/mass [1/kg], then of each the mass [kg] */
    double *joint;          /* [interface][SHELL_JOINT_TABLE] */
    double *rim;            /* [rim][SHELL_RIM_TABLE] */
    uint32_t (*element)[2]; /* [interface] */
    uint8_t (*edge)[2];     /* [interface]: which of its elements' edges */
    uint8_t *rim_edge;      /* [rim]: which of its element's edges */
    uint32_t *rim_from;     /* [element]: its rims are rim_from[e] to rim_from[e + 1] - 1 */
    uint32_t *held, *fixed; /* [element]: bit 3 node + component is set where the velocity is held,
                               and where it is held at 0 */
    fracas_surface_visits visits;
} fracas_shell_tables;

/* Tables of model->surface and model->spec. The caller destroys. */
FRACAS_MUST_USE fracas_err fracas_shell_tables_create(const fracas_model *model,
                                                      fracas_shell_tables **tables);
void fracas_shell_tables_destroy(void *tables); /* NULL is allowed */

#endif
