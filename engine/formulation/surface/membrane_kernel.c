/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane over lanes: a body's kernel (engine/formulation/surface/kernel.h). */
#define BODY_NAME membrane
#define BODY_DIMENSION 2
#define BODY_STRESSES 3
#define BODY_LAYERS 1
#define BODY_LINEAR 1
#define BODY_CONSISTENT 1
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

/* ---- loads ---- */

/* Angular velocity squared at a time. */
LANES_FUNCTION vd membrane_spin(const fracas_surface_constants *m, vd time)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    vd share = m->ramp > 0 ? plane_max(zero, plane_min(one, time / lanes_set(m->ramp))) : one;
    vd w = lanes_set(m->speed) * share;
    return w * w;
}

LANES_FUNCTION void membrane_begin(surface_context *c)
{
    c->spin = membrane_spin(c->constants, lanes_load(c->step->time + c->first));
}

/* Work of the body force since the step before [J], or its power, added to *power [W]. Central
 * difference: the work between two steps is exactly the mean of the force times dt v_{n-1/2}. */
LANES_FUNCTION vd membrane_work(const surface_context *c, vd *power)
{
    const fracas_surface_constants *m = c->constants;
    const vd half = lanes_set(0.5);
    vd body = lanes_set(0.0);
    if (c->tables->position && m->motion.alpha) *power += c->spin * c->moment;
    if (c->tables->position && !m->motion.alpha) {
        const vd before = membrane_spin(m, lanes_load(c->step->time + c->first) - c->drift);
        body = c->drift * half * (before + c->spin) * c->moment;
    }
    return body;
}

/* ---- elements ---- */

/* Stress and energy of element e, of displacements `at`; the rest of its slot is cleared. */
LANES_FUNCTION void membrane_strain(surface_context *c, int order, size_t e, double *at,
                                    double *slot)
{
    static const double shape[2][3][6][2] = {FRACAS_TRIANGLE_DERIVATIVES_1,
                                             FRACAS_TRIANGLE_DERIVATIVES_2};
    const int nodes = SURFACE_NODES(order), points = SURFACE_BULK(order);
    const vd zero = lanes_set(0.0);
    vd u[12];
    UNROLL_FOR (int i = 0; i < 2 * nodes; i++) u[i] = lanes_load(surface_at(at, i));
    const double *bulk = c->tables->bulk + e * (size_t)(points * MEMBRANE_BULK_TABLE);
    const vd c11 = lanes_set(c->constants->c11), c12 = lanes_set(c->constants->c12),
             c33 = lanes_set(c->constants->c33);
    UNROLL_FOR (int g = 0; g < points; g++, bulk += MEMBRANE_BULK_TABLE) {
        vd by_xi[2], by_eta[2], by_x[2], by_y[2];
        UNROLL_FOR (int i = 0; i < 2; i++) {
            by_xi[i] = by_eta[i] = zero;
            UNROLL_FOR (int k = 0; k < nodes; k++) {
                if (shape[order - 1][g][k][0] != 0.0)
                    by_xi[i] += lanes_set(shape[order - 1][g][k][0]) * u[2 * k + i];
                if (shape[order - 1][g][k][1] != 0.0)
                    by_eta[i] += lanes_set(shape[order - 1][g][k][1]) * u[2 * k + i];
            }
            by_x[i] = lanes_set(bulk[MEMBRANE_XI_X]) * by_xi[i] +
                      lanes_set(bulk[MEMBRANE_ETA_X]) * by_eta[i];
            by_y[i] = lanes_set(bulk[MEMBRANE_XI_Y]) * by_xi[i] +
                      lanes_set(bulk[MEMBRANE_ETA_Y]) * by_eta[i];
        }
        vd xx = by_x[0], yy = by_y[1], xy = by_y[0] + by_x[1];
        vd s_xx = c11 * xx + c12 * yy, s_yy = c12 * xx + c11 * yy,
           s_xy = c33 * xy; /* (membrane.3) */
        c->strain_energy += lanes_set(bulk[MEMBRANE_WEIGHT]) * (s_xx * xx + s_yy * yy + s_xy * xy);
        lanes_store(surface_at(slot, 3 * g), s_xx);
        lanes_store(surface_at(slot, 3 * g + 1), s_yy);
        lanes_store(surface_at(slot, 3 * g + 2), s_xy);
    }
    const int from = BODY_SLOT_EXTRA(order), end = BODY_SLOT(order);
    UNROLL_FOR (int i = from; i < end; i++) lanes_store(surface_at(slot, i), zero);
}

/* Internal forces of element e: its own, what symmetrisation adds to its stresses, and its
 * interfaces'  (membrane.7). */
LANES_FUNCTION void membrane_forces(const surface_context *c, int order, size_t e, vd *force)
{
    static const double shape[2][3][6][2] = {FRACAS_TRIANGLE_DERIVATIVES_1,
                                             FRACAS_TRIANGLE_DERIVATIVES_2};
    const int nodes = SURFACE_NODES(order), points = SURFACE_BULK(order);
    double *slot = surface_slot(c, order, e);
    const double *bulk = c->tables->bulk + e * (size_t)(points * MEMBRANE_BULK_TABLE);
    const vd c11 = lanes_set(c->constants->c11), c12 = lanes_set(c->constants->c12),
             c33 = lanes_set(c->constants->c33);
    UNROLL_FOR (int i = 0; i < 2 * nodes; i++)
        force[i] = lanes_load(surface_at(slot, BODY_SLOT_FORCE(order) + i));
    UNROLL_FOR (int g = 0; g < points; g++, bulk += MEMBRANE_BULK_TABLE) {
        const double *extra = surface_at(slot, BODY_SLOT_EXTRA(order) + 3 * g),
                     *stress = surface_at(slot, 3 * g);
        const vd weight = lanes_set(bulk[MEMBRANE_WEIGHT]);
        const vd xx = lanes_load(extra), yy = lanes_load(extra + LANES),
                 xy = lanes_load(extra + 2 * LANES);
        const vd n_xx = weight * lanes_load(stress) + (c11 * xx + c12 * yy);
        const vd n_yy = weight * lanes_load(stress + LANES) + (c12 * xx + c11 * yy);
        const vd n_xy = weight * lanes_load(stress + 2 * LANES) + c33 * xy;
        const vd xi_x = lanes_set(bulk[MEMBRANE_XI_X]), xi_y = lanes_set(bulk[MEMBRANE_XI_Y]);
        const vd eta_x = lanes_set(bulk[MEMBRANE_ETA_X]), eta_y = lanes_set(bulk[MEMBRANE_ETA_Y]);
        const vd along_xi[2] = {n_xx * xi_x + n_xy * xi_y, n_xy * xi_x + n_yy * xi_y};
        const vd along_eta[2] = {n_xx * eta_x + n_xy * eta_y, n_xy * eta_x + n_yy * eta_y};
        UNROLL_FOR (int k = 0; k < nodes; k++)
            UNROLL_FOR (int i = 0; i < 2; i++) {
                if (shape[order - 1][g][k][0] != 0.0)
                    force[2 * k + i] += lanes_set(shape[order - 1][g][k][0]) * along_xi[i];
                if (shape[order - 1][g][k][1] != 0.0)
                    force[2 * k + i] += lanes_set(shape[order - 1][g][k][1]) * along_eta[i];
            }
    }
}

/* Leapfrog: v_{n-1/2} M v_{n+1/2}  (membrane.9) */
LANES_FUNCTION void membrane_kinetic(surface_context *c, int order, size_t e, const vd *v,
                                     const vd *after)
{
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
        c->kinetic += momentum[0] * after[2 * k] + momentum[1] * after[2 * k + 1];
        if (t->position) {
            const double *x = t->position + e * (size_t)size + 2 * k;
            c->moment += momentum[0] * lanes_set(x[0]) + momentum[1] * lanes_set(x[1]);
        }
    }
}

/* ---- interfaces ---- */

/* Jump, mean traction and the flux of interior penalty at the Gauss points, before any onset. */
LANES_FUNCTION void membrane_flux(const surface_context *c, int order, size_t i,
                                  const surface_sides *sides, membrane_point at[3])
{
    static const double edge_point[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2};
    const fracas_surface_constants *m = c->constants;
    const int points = SURFACE_EDGE(order), bulk = SURFACE_BULK(order), nodes = order + 1;
    const double *table = surface_table(c, order, i);
    const vd stiffness = lanes_set(m->tangential * table[SURFACE_STIFFNESS]);
    vd jump[3][2], stress[3][3];
    UNROLL_FOR (int n = 0; n < nodes; n++)
        UNROLL_FOR (int j = 0; j < 2; j++)
            jump[n][j] = lanes_load(sides->element[1] + (2 * sides->node[1][n] + j) * LANES) -
                         lanes_load(sides->element[0] + (2 * sides->node[0][n] + j) * LANES);
    UNROLL_FOR (int p = 0; p < bulk; p++)
        UNROLL_FOR (int j = 0; j < 3; j++)
            stress[p][j] = lanes_set(0.5) *
                           (lanes_load(sides->slot[0] + (3 * sides->bulk[0][p] + j) * LANES) +
                            lanes_load(sides->slot[1] + (3 * sides->bulk[1][p] + j) * LANES));
    UNROLL_FOR (int g = 0; g < points; g++) {
        const double *place = table + BODY_HEAD + g * MEMBRANE_POINT_TABLE;
        const vd nx = lanes_set(place[MEMBRANE_NX]), ny = lanes_set(place[MEMBRANE_NY]);
        double shape[3], spread[3];
        fracas_edge_shape(order, edge_point[order - 1][g], shape, spread);
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
    const vd *judged = s->onset_mean ? p->mean : p->traction;
    return judged[0] * judged[0] + judged[1] * judged[1];
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

LANES_FUNCTION surface_opening membrane_crack(const surface_context *c,
                                              const plane_interface *interface, int law,
                                              const double *place, membrane_point *p, double *point,
                                              vmask *cracks, vmask *breaks)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), two = lanes_set(2.0);
    const vd nx = lanes_set(place[MEMBRANE_NX]), ny = lanes_set(place[MEMBRANE_NY]);
    const plane_input in = membrane_input(c->constants, place, p, 0);
    const vmask whole = lanes_le(lanes_load(surface_at(point, SURFACE_PEAK)), zero);
    const plane_result r = plane_law(law, interface, &in, point);
    const surface_opening all = {
        .flux = lanes_select(r.cracked, two * r.flux, membrane_flux_energy(p)),
        .stored = lanes_select(r.cracked, two * r.stored, zero),
        .dissipated = r.dissipated,
        .created = r.created,
        .rubbed = lanes_select(r.cracked, r.rubbed, zero),
        .whole = whole,
        .broken = lanes_le(one, lanes_load(surface_at(point, SURFACE_DAMAGE)))};
    p->traction[0] = lanes_select(r.cracked, r.t_n * nx - r.t_t * ny, p->traction[0]);
    p->traction[1] = lanes_select(r.cracked, r.t_n * ny + r.t_t * nx, p->traction[1]);
    p->carried[0] = lanes_select(r.cracked, r.s_n * nx - r.s_t * ny, p->jump[0]);
    p->carried[1] = lanes_select(r.cracked, r.s_n * ny + r.s_t * nx, p->jump[1]);
    *cracks = r.cracks;
    *breaks = r.breaks;
    return all;
}

/* Gives the two elements the forces on the nodes of the edge, and strains at their bulk points. */
LANES_FUNCTION void membrane_give(const surface_context *c, int order, size_t i,
                                  const surface_sides *sides, const membrane_point at[3])
{
    static const double edge_point[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2};
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
        fracas_edge_shape(order, edge_point[order - 1][g], shape, spread);
        UNROLL_FOR (int n = 0; n < nodes; n++) {
            force[n][0] += lanes_set(shape[n]) * tx;
            force[n][1] += lanes_set(shape[n]) * ty;
        }
        UNROLL_FOR (int p = 0; p < bulk; p++)
            UNROLL_FOR (int j = 0; j < 3; j++)
                strain[p][j] += bulk == 1 ? symmetric[j] : lanes_set(spread[p]) * symmetric[j];
    }
    UNROLL_FOR (int side = 0; side < 2; side++) {
        double *forces = surface_at(sides->slot[side], BODY_SLOT_FORCE(order)),
               *extra = surface_at(sides->slot[side], BODY_SLOT_EXTRA(order));
        UNROLL_FOR (int n = 0; n < nodes; n++)
            UNROLL_FOR (int j = 0; j < 2; j++) {
                double *to = surface_at(forces, 2 * sides->node[side][n] + j);
                lanes_store(to, side ? lanes_load(to) + force[n][j] : lanes_load(to) - force[n][j]);
            }
        UNROLL_FOR (int p = 0; p < bulk; p++)
            UNROLL_FOR (int j = 0; j < 3; j++) {
                double *to = surface_at(extra, 3 * sides->bulk[side][p] + j);
                lanes_store(to, lanes_load(to) + strain[p][j]);
            }
    }
}

#include "engine/formulation/surface/sweep_kernel.h"
