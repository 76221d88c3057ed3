/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of a surface over lanes, first part: the means of a body's kernel.
 *
 * A body is one kernel, BODY_kernel.c. Before it includes this file it defines
 *   BODY_NAME       as in the file's name; NAME below stands for it
 *   BODY_DIMENSION  components of a displacement
 *   BODY_STRESSES   stresses at a bulk point
 *   BODY_LAYERS     points through the thickness at each Gauss point of an interface
 *   BODY_PLANE      1 where it has linear triangles, consistent masses and body forces
 *   BODY_TAKES(bar, ring, membrane, shell, ...)  the last, by its column of a law's line
 *   BODY_BULK_TABLE  size of a bulk point's table
 *   BODY_HEAD, BODY_POINT_TABLE, BODY_MEASURE  an interface's table: sizes of its head and of a
 *                   Gauss point, place of the weight there
 * Then it defines
 *   NAME_point      a Gauss point: jumps, mean tractions, tractions, the flux's part of the jumps
 *   NAME_strain     stresses of an element, into its slot, and their energy
 *   NAME_flux       the points of an interface before any onset
 *   NAME_flux_energy, NAME_square  of such a point: twice the energy of the flux; square of the
 *                   largest traction in any direction
 *   NAME_press      turns such a point into one of a broken interface in contact, for the operator
 *   NAME_input      mean traction and jump at a layer, for the law
 *   NAME_crack      the law at a Gauss point
 *   NAME_opening    opening of a layer over that of its break, from the point's values
 *   NAME_scatter       adds forces and strains of an interface to the slots of its two elements
 *   NAME_forces     adds the forces of an element's own stresses
 *   NAME_kinetic    twice its kinetic energy, and its share of SURFACE_MOMENT
 * Last it includes engine/formulation/surface/sweep_kernel.h, which visits elements and interfaces.
 */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_KERNEL_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_KERNEL_H

#include "engine/cohesive/kernels.h"
#include "engine/formulation/surface/traits.h"
#include "engine/integrator/central_difference.h"

#include <math.h>

#ifdef __SANITIZE_ADDRESS__ /* unrolled, checks take minutes to compile */
#define UNROLL_FOR(...) for (__VA_ARGS__)
#else
#define UNROLL_FOR(...) _Pragma("GCC unroll 18") for (__VA_ARGS__)
#endif

#define BODY(what) BODY_OF(BODY_NAME, what)
#define BODY_OF(name, what) BODY_PASTE(name, what)
#define BODY_PASTE(name, what) name##_##what

/* A slot: stresses at each bulk point, strains added there by symmetrisation, forces. */
#define BODY_SIZE(order) (BODY_DIMENSION * SURFACE_NODES(order))
#define BODY_SLOT_EXTRA(order) (BODY_STRESSES * SURFACE_BULK(order))
#define BODY_SLOT_FORCE(order) (2 * BODY_STRESSES * SURFACE_BULK(order))
#define BODY_SLOT(order) (BODY_SLOT_FORCE(order) + BODY_SIZE(order))

typedef struct {
    const fracas_surface_constants *constants;
    const fracas_surface_tables *tables;
    fracas_step *step;
    int first;            /* the step's lane of lane 0 here */
    int ghost;            /* 1 in the turn of a ghost */
    int keeps;            /* 1 where forces of held elements are kept */
    double *state, *sums; /* memory of these lanes */
    const double *strengths;
    size_t element_size, interface_size;  /* doubles */
    size_t strengths_size, strength_step; /* doubles: an interface's; to next point, 0: shared */
    vd drift, kick;                       /* s */
    vd spin;                              /* membranes: w(t_n)^2 [1/s2] */
    vmask begins;                         /* the lane's first step */
    vd sum[SURFACE_SUMS_BY_TURN];         /* so far, by elements of this block */
} surface_context;

/* Places of an interface in its two elements, - and +: nodes a, b (and c, the middle) of the edge;
 * bulk points a, b at its ends, o away from it. */
typedef struct {
    const double *element[2];
    double *slot[2];
    int node[2][3], bulk[2][3];
} surface_sides;

/* The law at one Gauss point, per unit of its weight. */
typedef struct {
    vd flux, stored;     /* twice the energies of the flux, of openings and contact */
    vd dissipated;       /* so far */
    vd created, rubbed;  /* in this step: put in by onsets and breaks, dissipated by friction */
    vd bending;          /* in this step: dissipated by bending */
    vmask whole, broken; /* no point was past onset before this step; all points are broken */
} surface_opening;
/* The layers of one Gauss point: D after this step; which have their onset, their break in it. */
typedef struct {
    vd *damage;
    vmask *cracks, *breaks;
} surface_marks;

LANES_FUNCTION double *surface_at(double *record, int field)
{
    return record + field * LANES;
}

/* Displacements of the `size` unknowns of an element at t_n, `dt` after its last kick. */
LANES_FUNCTION void surface_drift(const fracas_surface_motion *m, vd dt, int size, double *at)
{
    UNROLL_FOR (int i = 0; i < size; i++) {
        double *u = surface_at(at, SURFACE_U * size + i), *v = surface_at(at, SURFACE_V * size + i);
        if (!m->alpha) {
            lanes_store(u, central_drift(lanes_load(u), lanes_load(v), dt));
        } else { /* (membrane.15) */
            const vd old = lanes_load(surface_at(at, SURFACE_A * size + i)),
                     now = lanes_load(surface_at(at, SURFACE_A_NEXT * size + i));
            lanes_store(u, lanes_load(u) + dt * lanes_load(v) +
                               dt * dt * (lanes_set(0.5 - m->b) * old + lanes_set(m->b) * now));
            lanes_store(v,
                        lanes_load(v) + dt * (lanes_set(1.0 - m->g) * old + lanes_set(m->g) * now));
        }
    }
}

/* Velocities of an element after its kick, from those before it, by the accelerations a of its
 * forces over `dt`; Hulbert-Chung: v becomes v-, after is v+ (membrane.20). `begins`: in a lane's
 * first step. */
LANES_FUNCTION void surface_kick(const fracas_surface_motion *m, vd dt, vmask begins, int size,
                                 double *at, const vd *a, vd *v, vd *after)
{
    if (!m->alpha) {
        UNROLL_FOR (int i = 0; i < size; i++) {
            after[i] = central_kick(v[i], a[i], dt);
            lanes_store(surface_at(at, SURFACE_V * size + i), after[i]);
        }
    } else { /* (membrane.14); the first acceleration is the force's own */
        const vd keep = lanes_select(begins, lanes_set(0.0), lanes_set(m->alpha_m)),
                 share = lanes_select(begins, lanes_set(1.0), lanes_set(1.0 - m->alpha_m));
        UNROLL_FOR (int i = 0; i < size; i++) {
            const vd old = lanes_select(begins, a[i],
                                        lanes_load(surface_at(at, SURFACE_A_NEXT * size + i)));
            lanes_store(surface_at(at, SURFACE_A * size + i), old);
            lanes_store(surface_at(at, SURFACE_A_NEXT * size + i), (a[i] - keep * old) / share);
            v[i] -= lanes_set(0.5) * dt * old;
            after[i] = central_kick(v[i], a[i], dt);
        }
    }
}

LANES_FUNCTION void surface_add(double *to, vd x)
{
    lanes_store(to, lanes_load(to) + x);
}

/* The sums of element e's block, those by turns first. */
LANES_FUNCTION double *surface_sums(const surface_context *c, size_t e)
{
    return c->sums + e / SURFACE_BLOCK * (size_t)(SURFACE_SUMS * LANES);
}

/* The group's memory at a place (division.h). */
LANES_FUNCTION double *surface_place(const surface_context *c, uint32_t place)
{
    return c->state + (size_t)place * LANES;
}

/* Table of interface i. */
LANES_FUNCTION const double *surface_table(const surface_context *c, int order, size_t i)
{
    return c->tables->interface + i * (size_t)(BODY_HEAD + SURFACE_EDGE(order) * BODY_POINT_TABLE);
}

/* The sides of an interface without their elements and slots. */
LANES_FUNCTION surface_sides surface_edges(int order, const uint8_t edge[2])
{
    const int k = edge[0], l = edge[1];
    surface_sides sides = {.node = {{k, (k + 1) % 3, 3 + k}, {(l + 1) % 3, l, 3 + l}}};
    UNROLL_FOR (int side = 0; side < 2; side++) {
        const int linear = order == 1, away = ((side ? l : k) + 2) % 3;
        UNROLL_FOR (int p = 0; p < 3; p++)
            sides.bulk[side][p] = linear ? 0 : p < 2 ? sides.node[side][p] : away;
    }
    return sides;
}

LANES_FUNCTION surface_sides surface_sides_of(const surface_context *c, int order,
                                              const fracas_surface_facet *facet)
{
    surface_sides sides = surface_edges(order, facet->edge);
    UNROLL_FOR (int side = 0; side < 2; side++) {
        sides.element[side] = surface_place(c, facet->element[side]);
        sides.slot[side] = surface_place(c, facet->slot[side]);
    }
    return sides;
}

/* ---- elements ---- */

static const double surface_slope[2][3][6][2] = {FRACAS_TRIANGLE_DERIVATIVES_1,
                                                 FRACAS_TRIANGLE_DERIVATIVES_2};

LANES_FUNCTION const double *surface_bulk(const surface_context *c, int order, size_t e)
{
    return c->tables->bulk + e * (size_t)(SURFACE_BULK(order) * BODY_BULK_TABLE);
}

/* Derivatives of the displacements u at bulk point g by xi, eta, x, y. */
LANES_FUNCTION void surface_gradient(int order, int g, const double *bulk, const vd *u,
                                     vd (*by)[BODY_DIMENSION])
{
    UNROLL_FOR (int i = 0; i < BODY_DIMENSION; i++) {
        by[0][i] = by[1][i] = lanes_set(0.0);
        UNROLL_FOR (int k = 0; k < SURFACE_NODES(order); k++)
            UNROLL_FOR (int a = 0; a < 2; a++)
                if (surface_slope[order - 1][g][k][a] != 0.0)
                    by[a][i] += lanes_set(surface_slope[order - 1][g][k][a]) *
                                u[BODY_DIMENSION * k + i];
        UNROLL_FOR (int x = 0; x < 2; x++)
            by[2 + x][i] = lanes_set(bulk[SURFACE_XI_X + x]) * by[0][i] +
                           lanes_set(bulk[SURFACE_ETA_X + x]) * by[1][i];
    }
}

/* Adds to an element's forces those on its derivatives by xi, eta. */
LANES_FUNCTION void surface_spread(int order, int g, const vd *xi, const vd *eta, vd *force)
{
    UNROLL_FOR (int k = 0; k < SURFACE_NODES(order); k++)
        UNROLL_FOR (int i = 0; i < BODY_DIMENSION; i++) {
            const double *slope = surface_slope[order - 1][g][k];
            if (slope[0] != 0.0) force[BODY_DIMENSION * k + i] += lanes_set(slope[0]) * xi[i];
            if (slope[1] != 0.0) force[BODY_DIMENSION * k + i] += lanes_set(slope[1]) * eta[i];
        }
}

/* Stresses of strains: xx, yy, 2 xy, then of shells those of bending  (membrane.3), (shell.4). */
LANES_FUNCTION void surface_elastic(const fracas_surface_constants *s, const vd *strain, vd *stress)
{
    const double modulus[2][3] = {{s->c11, s->c12, s->c33}, {s->d11, s->d12, s->d33}};
    UNROLL_FOR (int p = 0; p < BODY_STRESSES; p += 3) {
        const vd m11 = lanes_set(modulus[p / 3][0]), m12 = lanes_set(modulus[p / 3][1]);
        stress[p] = m11 * strain[p] + m12 * strain[p + 1];
        stress[p + 1] = m12 * strain[p] + m11 * strain[p + 1];
        stress[p + 2] = lanes_set(modulus[p / 3][2]) * strain[p + 2];
    }
}

/* Weight times stresses at bulk point g, and those added by symmetrisation  (membrane.7). */
LANES_FUNCTION void surface_stresses(const surface_context *c, int order, int g, const double *bulk,
                                     double *slot, vd *stress)
{
    vd extra[BODY_STRESSES];
    UNROLL_FOR (int j = 0; j < BODY_STRESSES; j++)
        extra[j] = lanes_load(surface_at(slot, BODY_SLOT_EXTRA(order) + BODY_STRESSES * g + j));
    surface_elastic(c->constants, extra, stress);
    UNROLL_FOR (int j = 0; j < BODY_STRESSES; j++)
        stress[j] = lanes_set(bulk[SURFACE_WEIGHT]) *
                        lanes_load(surface_at(slot, BODY_STRESSES * g + j)) +
                    stress[j];
}

/* ---- interfaces ---- */

static const double surface_edge_point[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2};

/* u+ - u- at the nodes of an interface. */
LANES_FUNCTION void surface_jumps(int order, const surface_sides *sides, vd (*jump)[BODY_DIMENSION])
{
    UNROLL_FOR (int n = 0; n < order + 1; n++)
        UNROLL_FOR (int j = 0; j < BODY_DIMENSION; j++)
            jump[n][j] =
                lanes_load(sides->element[1] + (BODY_DIMENSION * sides->node[1][n] + j) * LANES) -
                lanes_load(sides->element[0] + (BODY_DIMENSION * sides->node[0][n] + j) * LANES);
}

/* Adds forces at those nodes to a side of the interface. */
LANES_FUNCTION void surface_push(int order, const surface_sides *sides, int side,
                                 vd (*force)[BODY_DIMENSION])
{
    double *forces = surface_at(sides->slot[side], BODY_SLOT_FORCE(order));
    UNROLL_FOR (int n = 0; n < order + 1; n++)
        UNROLL_FOR (int j = 0; j < BODY_DIMENSION; j++) {
            double *to = surface_at(forces, BODY_DIMENSION * sides->node[side][n] + j);
            lanes_store(to, side ? lanes_load(to) + force[n][j] : lanes_load(to) - force[n][j]);
        }
}

#endif
