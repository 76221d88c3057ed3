/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh of a surface as its sweep reads it, and the constants of a model. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_TABLES_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_TABLES_H

#include "base/hash.h"
#include "engine/formulation/surface/layout.h"
#include "engine/loading/load.h"
#include "engine/mesh/surface/surface.h"

typedef struct fracas_surface_body fracas_surface_body;

/* The mesh as the sweep reads it: one copy for all lanes and realizations. The body lays out the
 * tables of bulk points and interfaces. */
typedef struct {
    const fracas_surface_body *body;
    int order;
    size_t nelements, ninterfaces;
    double *bulk;       /* [element][bulk point][body->bulk_table] */
    double *lumped;     /* [element]: of each node 1/mass [1/kg], then of each the mass [kg] */
    double *consistent; /* [element][3][node][node]: inverse for x, for y, with rows and columns of
                           held nodes 0 [1/kg], and the mass itself [kg]; NULL: masses are lumped */
    double *rotary;     /* [element][SURFACE_ROTARY_TABLE]; NULL: there is no rotary inertia */
    double *position;   /* [element][node][2] [m]; NULL: the loading does not need it */
    double *interface;  /* [interface]: head, then [Gauss point][body->point_table] */
    uint32_t (*element)[2]; /* [interface] */
    uint8_t (*edge)[2];     /* [interface]: which of its elements' edges */
    uint32_t *held, *fixed; /* [element]: bit dimension node + component: velocity held; at 0 */
    bool moves;             /* some edge is held, and not fixed */
    /* Elements under loads, with their forces at amplitude 1, load after load  (loads.3) */
    int forces, force[FRACAS_LOADINGS]; /* loads that are forces: numbers of their loadings */
    size_t nloads;
    uint32_t *load_row; /* [load][element]: its row + 1; 0: none; NULL: there is no load */
    double *load;       /* [row][unknown] [N] */
    fracas_load_clock *load_clock;           /* [row] */
    fracas_profile history[FRACAS_LOADINGS]; /* by loading */
    /* Elements with nodes that a load moves, u = s(t) d  (loads.5) */
    int motions, motion[FRACAS_LOADINGS]; /* loads that do: numbers of their loadings */
    size_t nmoved;
    uint32_t *moved;     /* [element]: bits as of `held`, among them; NULL: no node is moved */
    uint32_t *moved_row; /* [element]: its row + 1; 0: none */
    uint8_t *moved_by;   /* [row]: by which motion */
    double *direction;   /* [row][unknown]: d, 0 of components not moved */
    double *start;       /* [row][unknown]: u_0 [m]; NULL: 0 */
    int sets;            /* number of sets of nodes that loads hold */
    uint32_t *set;       /* [set][element]: bits as of `held`: what it holds, and no edge does */
    /* A shell's edges whose director is held. */
    size_t nrims;
    double *rim;        /* [rim][body->rim_table] */
    uint8_t *rim_edge;  /* [rim]: which of its element's edges */
    uint32_t *rim_from; /* [element]: its rims are rim_from[e] to rim_from[e + 1] - 1 */
} fracas_surface_tables;

typedef struct {
    int alpha;              /* Hulbert-Chung, with its parameters; else central difference */
    double alpha_m, b, g;   /* 1 */
    double excess, damping; /* 1 */
    double root;            /* 1: sqrt((1 - alpha_m)/2) */
} fracas_surface_motion;

/* Input of a sweep, the same for all lanes. */
typedef struct fracas_surface_constants {
    const fracas_surface_tables *tables;
    double thickness;     /* m */
    double c11, c12, c33; /* E/(1-nu^2), nu c11, E/(2 + 2 nu) [Pa]; shells: times thickness [N/m] */
    double d11, d12, d33; /* shells: thickness^2/12 of those [N m] */
    double normal, tangential; /* k_n/K and k_t/K of the interface, 1  (membrane.6) */
    double energy, opening;    /* G_c [J/m2], or 2 G_c/p [m]: the other is 0 */
    double beta_c, mu_c;       /* 1 */
    int law;                   /* its number */
    const double *own;         /* its own numbers (trait `own`) */
    int onset_mean, friction;
    int fields, point_fields; /* an element's, by its unknowns; an interface's point's */
    int strengths;            /* an interface's: 1, or one for each Gauss point */
    double speed, ramp;       /* rad/s, s: w = speed min(1, t/ramp) */
    const fracas_loading *force[FRACAS_LOADINGS];  /* loads that are forces, tables->forces */
    const fracas_loading *moving[FRACAS_LOADINGS]; /* loads that move nodes, tables->motions */
    int strained; /* the body starts with a strain, and so with accelerations */
    fracas_surface_motion motion;
    int contact; /* the operator: all interfaces broken and in contact; else whole */
} fracas_surface_constants;

/* Tables of model->surface and model->spec, checked. The caller destroys. */
FRACAS_MUST_USE fracas_err fracas_surface_tables_create(const fracas_model *model,
                                                        fracas_surface_tables **tables);
/* Components that hold each node of a border's edge, as bits; 0: it is free. */
unsigned fracas_surface_held_by(const fracas_model *model, const fracas_surface_border *border);
void fracas_surface_tables_destroy(void *tables); /* NULL is allowed */
size_t fracas_surface_tables_bytes(const fracas_surface_tables *tables);
/* Equal for equal tables of the linear operator. */
fracas_hash fracas_surface_tables_hash(const fracas_surface_tables *tables);

fracas_surface_constants fracas_surface_constants_of(const fracas_model *model);

#endif
