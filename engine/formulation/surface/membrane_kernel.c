/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane over lanes: a body's kernel (engine/formulation/surface/kernel.h). */
#define BODY_NAME membrane
#define BODY_DIMENSION 2
#define BODY_STRESSES 3
#define BODY_LAYERS 1
#define BODY_PLANE 1
#define BODY_BULK_TABLE SURFACE_BULK_HEAD
#define BODY_TAKES(bar, ring, membrane, shell, ...) FRACAS_IF_##membrane(__VA_ARGS__)
#define BODY_HEAD SURFACE_HEAD
#define BODY_POINT_TABLE MEMBRANE_POINT_TABLE
#define BODY_MEASURE MEMBRANE_AREA
#include "engine/formulation/surface/membrane.h"

#include "engine/formulation/surface/kernel.h"

/* At one Gauss point of an interface. */
typedef struct {
    vd jump[2], mean[2];        /* q = u+ - u- [m], mean traction of both sides [Pa] */
    vd traction[2], carried[2]; /* T [Pa], s = q - delta [m] */
} membrane_point;

/* ---- elements ---- */

/* (membrane.3) */
LANES_FUNCTION void membrane_strain(surface_context *c, int order, size_t e, double *at,
                                    double *slot)
{
    const int points = SURFACE_BULK(order);
    const double *bulk = surface_bulk(c, order, e);
    vd u[12], energy = lanes_set(0.0);
    UNROLL_FOR (int i = 0; i < BODY_SIZE(order); i++) u[i] = lanes_load(surface_at(at, i));
    UNROLL_FOR (int g = 0; g < points; g++, bulk += BODY_BULK_TABLE) {
        vd by[4][2], s[3];
        surface_gradient(order, g, bulk, u, by);
        const vd strain[3] = {by[2][0], by[3][1], by[3][0] + by[2][1]};
        surface_elastic(c->constants, strain, s);
        energy += lanes_set(bulk[SURFACE_WEIGHT]) *
                  (s[0] * strain[0] + s[1] * strain[1] + s[2] * strain[2]);
        UNROLL_FOR (int j = 0; j < 3; j++) lanes_store(surface_at(slot, 3 * g + j), s[j]);
    }
    c->sum[SURFACE_STRAIN] += energy;
}

/* (membrane.7) */
LANES_FUNCTION void membrane_forces(const surface_context *c, int order, size_t e, double *slot,
                                    vd *force)
{
    const int points = SURFACE_BULK(order);
    const double *bulk = surface_bulk(c, order, e);
    UNROLL_FOR (int g = 0; g < points; g++, bulk += BODY_BULK_TABLE) {
        vd n[3];
        surface_stresses(c, order, g, bulk, slot, n);
        const vd xi_x = lanes_set(bulk[SURFACE_XI_X]), xi_y = lanes_set(bulk[SURFACE_XI_Y]);
        const vd eta_x = lanes_set(bulk[SURFACE_ETA_X]), eta_y = lanes_set(bulk[SURFACE_ETA_Y]);
        const vd xi[2] = {n[0] * xi_x + n[2] * xi_y, n[2] * xi_x + n[1] * xi_y};
        const vd eta[2] = {n[0] * eta_x + n[2] * eta_y, n[2] * eta_x + n[1] * eta_y};
        surface_spread(order, g, xi, eta, force);
    }
}

/* Leapfrog: v_{n-1/2} M v_{n+1/2}  (membrane.9) */
LANES_FUNCTION vd membrane_kinetic(const surface_context *c, int order, size_t e, const vd *v,
                                   const vd *after, vd *moment)
{
    vd kinetic = lanes_set(0.0);
    const fracas_surface_tables *t = c->tables;
    const int nodes = SURFACE_NODES(order), size = 2 * nodes;
    const double *consistent =
        t->consistent ? t->consistent + e * (size_t)(3 * nodes * nodes) + 2 * nodes * nodes : NULL;
    UNROLL_FOR (int k = 0; k < nodes; k++) {
        vd momentum[2];
        if (!consistent) {
            const vd mass = lanes_set(t->lumped[e * (size_t)size + (size_t)(nodes + k)]);
            momentum[0] = mass * v[2 * k];
            momentum[1] = mass * v[2 * k + 1];
        } else {
            momentum[0] = momentum[1] = lanes_set(0.0);
            UNROLL_FOR (int l = 0; l < nodes; l++)
                UNROLL_FOR (int i = 0; i < 2; i++)
                    momentum[i] += lanes_set(consistent[k * nodes + l]) * v[2 * l + i];
        }
        kinetic += momentum[0] * after[2 * k] + momentum[1] * after[2 * k + 1];
        if (t->position) {
            const double *x = t->position + e * (size_t)size + 2 * k;
            *moment += momentum[0] * lanes_set(x[0]) + momentum[1] * lanes_set(x[1]);
        }
    }
    return kinetic;
}

/* ---- interfaces ---- */

/* Jump, mean traction and the flux of interior penalty at the Gauss points, before any onset. */
LANES_FUNCTION void membrane_flux(const surface_context *c, int order, size_t i,
                                  const surface_sides *sides, membrane_point at[3])
{
    const fracas_surface_constants *m = c->constants;
    const int points = SURFACE_EDGE(order), bulk = SURFACE_BULK(order), nodes = order + 1;
    const double *table = surface_table(c, order, i);
    const vd stiffness = lanes_set(m->tangential * table[SURFACE_STIFFNESS]);
    vd jump[3][2], stress[3][3];
    surface_jumps(order, sides, jump);
    UNROLL_FOR (int p = 0; p < bulk; p++)
        UNROLL_FOR (int j = 0; j < 3; j++)
            stress[p][j] = lanes_set(0.5) *
                           (lanes_load(sides->slot[0] + (3 * sides->bulk[0][p] + j) * LANES) +
                            lanes_load(sides->slot[1] + (3 * sides->bulk[1][p] + j) * LANES));
    UNROLL_FOR (int g = 0; g < points; g++) {
        const double *place = table + BODY_HEAD + g * MEMBRANE_POINT_TABLE;
        const vd nx = lanes_set(place[MEMBRANE_NX]), ny = lanes_set(place[MEMBRANE_NY]);
        double shape[3], spread[3];
        fracas_edge_shape(order, surface_edge_point[order - 1][g], shape, spread);
        vd q[2], s[3];
        UNROLL_FOR (int j = 0; j < 2; j++) {
            q[j] = lanes_set(shape[0]) * jump[0][j] + lanes_set(shape[1]) * jump[1][j];
            if (nodes == 3) q[j] += lanes_set(shape[2]) * jump[2][j];
        }
        UNROLL_FOR (int j = 0; j < 3; j++) /* (membrane.2) */
            s[j] = bulk == 1
                       ? stress[0][j]
                       : lanes_set(spread[0]) * stress[0][j] + lanes_set(spread[1]) * stress[1][j] +
                             lanes_set(spread[2]) * stress[2][j];
        const vd mean[2] = {s[0] * nx + s[2] * ny, s[2] * nx + s[1] * ny};
        const vd more = lanes_set((m->normal - m->tangential) * table[SURFACE_STIFFNESS]) *
                        (q[0] * nx + q[1] * ny);
        const vd normal[2] = {nx, ny};
        UNROLL_FOR (int j = 0; j < 2; j++) { /* (membrane.4) */
            at[g].jump[j] = at[g].carried[j] = q[j];
            at[g].mean[j] = mean[j];
            at[g].traction[j] = mean[j] + stiffness * q[j];
            if (m->normal != m->tangential) at[g].traction[j] += more * normal[j];
        }
    }
}

LANES_FUNCTION vd membrane_flux_energy(const membrane_point *p)
{
    return p->jump[0] * (p->mean[0] + p->traction[0]) + p->jump[1] * (p->mean[1] + p->traction[1]);
}

LANES_FUNCTION vd membrane_square(const fracas_surface_constants *s, const membrane_point *p)
{
    const vd x = s->onset_mean ? p->mean[0] : p->traction[0],
             y = s->onset_mean ? p->mean[1] : p->traction[1];
    return x * x + y * y;
}

LANES_FUNCTION void membrane_press(membrane_point *p)
{
    UNROLL_FOR (int j = 0; j < 2; j++) {
        p->traction[j] = p->traction[j] - p->mean[j];
        p->carried[j] = lanes_set(0.0);
    }
}

/* Mean tractions and jumps along the normal and the edge. */
LANES_FUNCTION plane_input membrane_input(const fracas_surface_constants *m, const double *place,
                                          const membrane_point *p, int layer)
{
    (void)m;
    (void)layer;
    const vd nx = lanes_set(place[MEMBRANE_NX]), ny = lanes_set(place[MEMBRANE_NY]);
    return (plane_input){.m_n = p->mean[0] * nx + p->mean[1] * ny,
                         .m_t = p->mean[1] * nx - p->mean[0] * ny,
                         .q_n = p->jump[0] * nx + p->jump[1] * ny,
                         .q_t = p->jump[1] * nx - p->jump[0] * ny};
}

LANES_FUNCTION vd membrane_opening(const fracas_surface_constants *m,
                                   const plane_interface *interface, const plane_input *in,
                                   const membrane_point *p, int layer, const double *point)
{
    (void)p;
    (void)layer;
    return plane_opening(m->law, interface, in, point);
}

LANES_FUNCTION surface_opening membrane_crack(const surface_context *c,
                                              const plane_interface *interface, int law,
                                              const double *place, membrane_point *p, double *point,
                                              const surface_marks *marks)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), two = lanes_set(2.0);
    const vd nx = lanes_set(place[MEMBRANE_NX]), ny = lanes_set(place[MEMBRANE_NY]);
    plane_input in = membrane_input(c->constants, place, p, 0);
    in.were_broken = in.are_broken = lanes_lt(zero, one);
    const vmask whole = lanes_le(lanes_load(surface_at(point, SURFACE_PEAK)), zero);
    const plane_result r = plane_law(law, interface, &in, point);
    const surface_opening all = {
        .flux = lanes_select(r.cracked, two * r.flux, membrane_flux_energy(p)),
        .stored = lanes_select(r.cracked, two * r.stored, zero),
        .dissipated = r.dissipated,
        .created = r.created,
        .rubbed = lanes_select(r.cracked, r.rubbed, zero),
        .whole = whole,
        .broken = lanes_le(one, r.damage)};
    p->traction[0] = lanes_select(r.cracked, r.t_n * nx - r.t_t * ny, p->traction[0]);
    p->traction[1] = lanes_select(r.cracked, r.t_n * ny + r.t_t * nx, p->traction[1]);
    p->carried[0] = lanes_select(r.cracked, r.s_n * nx - r.s_t * ny, p->jump[0]);
    p->carried[1] = lanes_select(r.cracked, r.s_n * ny + r.s_t * nx, p->jump[1]);
    *marks->damage = r.damage;
    *marks->cracks = r.cracks;
    *marks->breaks = r.breaks;
    return all;
}

/* Scatters the forces on the nodes of the edge to the two elements, and strains to their bulk
 * points. */
LANES_FUNCTION void membrane_scatter(const surface_context *c, int order, size_t i,
                                     const surface_sides *sides, const membrane_point at[3])
{
    const int points = SURFACE_EDGE(order), bulk = SURFACE_BULK(order), nodes = order + 1;
    const double *table = surface_table(c, order, i);
    vd force[3][2], strain[3][3];
    UNROLL_FOR (int n = 0; n < 3; n++) {
        UNROLL_FOR (int j = 0; j < 2; j++) force[n][j] = lanes_set(0.0);
        UNROLL_FOR (int j = 0; j < 3; j++) strain[n][j] = lanes_set(0.0);
    }
    UNROLL_FOR (int g = 0; g < points; g++) {
        const double *place = table + BODY_HEAD + g * MEMBRANE_POINT_TABLE;
        const vd nx = lanes_set(place[MEMBRANE_NX]), ny = lanes_set(place[MEMBRANE_NY]),
                 area = lanes_set(place[MEMBRANE_AREA]);
        const vd half = lanes_set(0.5) * area, tx = area * at[g].traction[0],
                 ty = area * at[g].traction[1];
        const vd sx = half * at[g].carried[0], sy = half * at[g].carried[1];
        const vd symmetric[3] = {sx * nx, sy * ny, sx * ny + sy * nx};
        double shape[3], spread[3];
        fracas_edge_shape(order, surface_edge_point[order - 1][g], shape, spread);
        UNROLL_FOR (int n = 0; n < nodes; n++) {
            force[n][0] += lanes_set(shape[n]) * tx;
            force[n][1] += lanes_set(shape[n]) * ty;
        }
        UNROLL_FOR (int p = 0; p < bulk; p++)
            UNROLL_FOR (int j = 0; j < 3; j++)
                strain[p][j] += bulk == 1 ? symmetric[j] : lanes_set(spread[p]) * symmetric[j];
    }
    UNROLL_FOR (int side = 0; side < 2; side++) {
        double *extra = surface_at(sides->slot[side], BODY_SLOT_EXTRA(order));
        surface_push(order, sides, side, force);
        UNROLL_FOR (int p = 0; p < bulk; p++)
            UNROLL_FOR (int j = 0; j < 3; j++)
                surface_add(surface_at(extra, 3 * sides->bulk[side][p] + j), strain[p][j]);
    }
}

#include "engine/formulation/surface/sweep_kernel.h"
