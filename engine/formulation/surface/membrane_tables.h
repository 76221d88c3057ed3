/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the membrane's sweep reads of the mesh: geometry at the quadrature points, masses, and the
 * order in which elements and interfaces are visited (docs/theory/membrane.md). One copy for all
 * lanes and realizations. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_MEMBRANE_TABLES_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_MEMBRANE_TABLES_H

#include "engine/formulation/formulation.h"
#include "engine/formulation/surface/visits.h"
#include "engine/mesh/surface/surface.h"

/* Of one order of elements: nodes, bulk points, Gauss points of an edge. */
#define MEMBRANE_NODES(order) (3 * (order))
#define MEMBRANE_BULK(order) ((order) == 1 ? 1 : 3)
#define MEMBRANE_EDGE(order) ((order) + 1)

/* Of a bulk point: derivatives of xi, eta by x, y, and the weight: |Jacobian| times quadrature
 * weight times thickness [m3]. */
enum {
    MEMBRANE_XI_X,
    MEMBRANE_XI_Y,
    MEMBRANE_ETA_X,
    MEMBRANE_ETA_Y,
    MEMBRANE_WEIGHT,
    MEMBRANE_BULK_TABLE
};
/* Of an interface: stiffness K [Pa/m], its inverse; then of each Gauss point the normal from
 * element[0] to element[1], and the weight: length times quadrature weight times thickness [m2]. */
enum { MEMBRANE_STIFFNESS, MEMBRANE_COMPLIANCE, MEMBRANE_POINTS };
enum { MEMBRANE_NX, MEMBRANE_NY, MEMBRANE_AREA, MEMBRANE_POINT_TABLE };

typedef struct {
    int order;
    size_t nelements, ninterfaces;
    double *bulk;       /* [element][point][MEMBRANE_BULK_TABLE] */
    double *lumped;     /* [element]: of each node 1/mass [1/kg], then of each the mass [kg] */
    double *consistent; /* [element][3][node][node]: inverse for x, for y, with rows and columns of
                           held nodes 0 [1/kg], and the mass itself [kg]; NULL: masses are lumped */
    double *position;   /* [element][node][2] [m]; NULL: the loading does not ask for it */
    double *joint;      /* [interface]: see above */
    uint32_t (*element)[2]; /* [interface] */
    uint8_t (*edge)[2];     /* [interface]: which of its elements' edges */
    uint16_t *held;  /* [element]: bit 2 node + component is set where the velocity is held; NULL:
                        nowhere */
    uint16_t *fixed; /* [element]: of those bits the ones of edges that stay where they are; NULL
                        with held */
    fracas_surface_visits visits;
} fracas_membrane_tables;

/* Tables of model->surface and model->spec. The caller destroys. */
FRACAS_MUST_USE fracas_err fracas_membrane_tables_create(const fracas_model *model,
                                                         fracas_membrane_tables **tables);
void fracas_membrane_tables_destroy(void *tables); /* NULL is allowed */

#endif
