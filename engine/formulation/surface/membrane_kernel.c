/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane's sweep over lanes: a kernel.
 *
 * An element is drifted and strained when its turn comes, then the interfaces with elements before
 * it are visited; once an element has all its interfaces it gets its forces and is kicked.
 * Interfaces see an element through the stresses at its bulk points, and give back forces on nodes
 * and strains at those points: both are few. */
#include "engine/formulation/surface/membrane_sweep.h"
#include "engine/formulation/surface/sweep_template.h"

#include <math.h>

typedef struct {
    const fracas_membrane_constants *membrane;
    const fracas_membrane_tables *tables;
    fracas_step *step;
    int first;                         /* lane of the step that is lane 0 here */
    double *elements, *joints, *slots; /* of these lanes */
    const double *strengths;
    size_t element_size, joint_size;      /* doubles */
    size_t strengths_size, strength_step; /* doubles: of an interface; from one Gauss point to the
                                             next, 0 where they share one */
    vd drift, kick;                       /* s */
    vd spin;                              /* w(t_n)^2 [1/s2] */
    int begins;                           /* the first step of all */
    /* sums over the body, for the ledger: twice the energies, dissipated [J]; power [W], sum of m
     * r.v [kg m2/s] */
    vd strain_energy, flux, stored, kinetic, dissipated, power, moment;
} membrane_context;

/* Where an interface finds its two elements, - and +: nodes a, b (and c, the middle) of the edge
 * and bulk points a, b at its ends, o away from it. */
typedef struct {
    const double *element[2];
    double *slot[2];
    int node[2][3], bulk[2][3];
} membrane_sides;

/* At one Gauss point of an interface. */
typedef struct {
    vd jump[2], mean[2];        /* q = u+ - u- [m], mean traction of both sides [Pa] */
    vd traction[2], carried[2]; /* T [Pa], s = q - delta [m] */
} membrane_point;

/* Drift, stress and energy of element e; its slot is cleared of what it held before. */
LANES_FUNCTION void membrane_strain(membrane_context *c, int order, size_t e)
{
    static const double shape[2][3][6][2] = {FRACAS_TRIANGLE_DERIVATIVES_1,
                                             FRACAS_TRIANGLE_DERIVATIVES_2};
    const int nodes = MEMBRANE_NODES(order), points = MEMBRANE_BULK(order);
    const vd zero = lanes_set(0.0);
    double *at = c->elements + e * c->element_size;
    double *slot = c->slots +
                   (e & c->tables->visits.window) * (size_t)(MEMBRANE_SLOT(order) * LANES);
    vd u[12];
    UNROLL_FOR (int i = 0; i < 2 * nodes; i++) u[i] = lanes_load(surface_at(at, i));
    const double *bulk = c->tables->bulk + e * (size_t)(points * MEMBRANE_BULK_TABLE);
    const vd c11 = lanes_set(c->membrane->c11), c12 = lanes_set(c->membrane->c12),
             c33 = lanes_set(c->membrane->c33);
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
    const int from = MEMBRANE_SLOT_EXTRA(order), end = MEMBRANE_SLOT(order);
    UNROLL_FOR (int i = from; i < end; i++) lanes_store(surface_at(slot, i), zero);
}

LANES_FUNCTION membrane_sides membrane_sides_of(const membrane_context *c, int order, size_t i)
{
    const uint32_t *element = c->tables->element[i];
    const int k = c->tables->edge[i][0], l = c->tables->edge[i][1];
    membrane_sides sides = {.node = {{k, (k + 1) % 3, 3 + k}, {(l + 1) % 3, l, 3 + l}}};
    UNROLL_FOR (int side = 0; side < 2; side++) {
        const int linear = order == 1, away = ((side ? l : k) + 2) % 3;
        sides.element[side] = c->elements + element[side] * c->element_size;
        sides.slot[side] = c->slots + (element[side] & c->tables->visits.window) *
                                          (size_t)(MEMBRANE_SLOT(order) * LANES);
        UNROLL_FOR (int p = 0; p < 3; p++)
            sides.bulk[side][p] = linear ? 0 : p < 2 ? sides.node[side][p] : away;
    }
    return sides;
}

/* Jump, mean traction and the flux of interior penalty at the Gauss points, as long as nothing has
 * cracked. */
LANES_FUNCTION void membrane_flux(const membrane_context *c, int order, size_t i,
                                  const membrane_sides *sides, membrane_point at[3])
{
    static const double edge_point[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2};
    const fracas_membrane_constants *m = c->membrane;
    const int points = MEMBRANE_EDGE(order), bulk = MEMBRANE_BULK(order), nodes = order + 1;
    const double *table = c->tables->joint +
                          i * (size_t)(MEMBRANE_POINTS + points * MEMBRANE_POINT_TABLE);
    const vd stiffness = lanes_set(m->tangential * table[MEMBRANE_STIFFNESS]);
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
        const double *place = table + MEMBRANE_POINTS + g * MEMBRANE_POINT_TABLE;
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
        const vd more = lanes_set((m->normal - m->tangential) * table[MEMBRANE_STIFFNESS]) *
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

/* Gives the two elements the forces on the nodes of the edge, and strains at their bulk points. */
LANES_FUNCTION void membrane_give(const membrane_context *c, int order, size_t i,
                                  const membrane_sides *sides, const membrane_point at[3])
{
    static const double edge_point[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2};
    const int points = MEMBRANE_EDGE(order), bulk = MEMBRANE_BULK(order), nodes = order + 1;
    const double *table = c->tables->joint +
                          i * (size_t)(MEMBRANE_POINTS + points * MEMBRANE_POINT_TABLE);
    vd force[3][2], strain[3][3];
    UNROLL_FOR (int n = 0; n < 3; n++) {
        UNROLL_FOR (int j = 0; j < 2; j++) force[n][j] = lanes_set(0.0);
        UNROLL_FOR (int j = 0; j < 3; j++) strain[n][j] = lanes_set(0.0);
    }
    UNROLL_FOR (int g = 0; g < points; g++) {
        const double *place = table + MEMBRANE_POINTS + g * MEMBRANE_POINT_TABLE;
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
        double *forces = surface_at(sides->slot[side], MEMBRANE_SLOT_FORCE(order)),
               *extra = surface_at(sides->slot[side], MEMBRANE_SLOT_EXTRA(order));
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

/* Books what happened at an interface, lane by lane. */
__attribute__((noinline, cold, unused)) static void
membrane_book(const membrane_context *c, int points, size_t i, const vmask *cracks,
              const vmask *breaks, vmask opens, vmask parts)
{
    for (int l = 0; l < LANES; l++) {
        fracas_membrane_event event = {.opens = lanes_get(opens, l), .parts = lanes_get(parts, l)};
        for (int g = 0; g < points; g++) {
            event.cracks[g] = lanes_get(cracks[g], l);
            event.breaks[g] = lanes_get(breaks[g], l);
        }
        if (event.opens || event.parts)
            fracas_membrane_book(c->membrane, c->step, c->first + l, i, &event);
    }
}

/* The way of an interface at which some lane is cracked, or is about to. `at` holds what every lane
 * does that is not. */
LANES_FUNCTION void membrane_crack(membrane_context *c, int order, int law, size_t i, double *joint,
                                   const double *strength, membrane_point at[3])
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), two = lanes_set(2.0);
    const fracas_membrane_constants *m = c->membrane;
    const int points = MEMBRANE_EDGE(order);
    const double *table = c->tables->joint +
                          i * (size_t)(MEMBRANE_POINTS + points * MEMBRANE_POINT_TABLE);
    const vd stiffness = lanes_set(table[MEMBRANE_STIFFNESS]);
    plane_interface interface = {
        .k_n = lanes_set(m->normal) * stiffness,
        .k_t = lanes_set(m->tangential) * stiffness,
        .softness_n = lanes_set(table[MEMBRANE_COMPLIANCE] / m->normal),
        .softness_t = lanes_set(table[MEMBRANE_COMPLIANCE] / m->tangential),
        .beta_c = lanes_set(m->beta_c),
        .per_beta_c = lanes_set(1.0 / m->beta_c),
        .mu_c = lanes_set(m->mu_c),
        .energy = lanes_set(m->energy),
        .opening = lanes_set(m->opening),
        .onset_mean = m->onset_mean,
        .friction = m->friction};
    vmask cracks[3], breaks[3], whole = lanes_le(zero, zero), broken = whole,
                                opens = lanes_lt(zero, zero), parts = opens;
    vd created = zero, rubbed = zero;
    UNROLL_FOR (int g = 0; g < points; g++) {
        double *point = surface_at(joint, g * m->point_fields);
        interface.sigma_c = lanes_load(strength + (size_t)g * c->strength_step);
        const double *place = table + MEMBRANE_POINTS + g * MEMBRANE_POINT_TABLE;
        const vd nx = lanes_set(place[MEMBRANE_NX]), ny = lanes_set(place[MEMBRANE_NY]),
                 area = lanes_set(place[MEMBRANE_AREA]);
        const vd *q = at[g].jump, *mean = at[g].mean;
        const plane_input in = {.m_n = mean[0] * nx + mean[1] * ny,
                                .m_t = mean[1] * nx - mean[0] * ny,
                                .q_n = q[0] * nx + q[1] * ny,
                                .q_t = q[1] * nx - q[0] * ny};
        whole = lanes_and(whole, lanes_le(lanes_load(surface_at(point, SURFACE_PEAK)), zero));
        plane_result r = plane_law(law, &interface, &in, point);
        const vd damage = lanes_load(surface_at(point, SURFACE_DAMAGE));
        vd flux_energy = q[0] * (mean[0] + at[g].traction[0]) +
                         q[1] * (mean[1] + at[g].traction[1]);
        c->flux += area * lanes_select(r.cracked, two * r.flux, flux_energy);
        c->stored += area * lanes_select(r.cracked, two * r.stored, zero);
        c->dissipated += area * r.dissipated;
        created += area * r.created;
        rubbed += area * lanes_select(r.cracked, r.rubbed, zero);
        at[g].traction[0] = lanes_select(r.cracked, r.t_n * nx - r.t_t * ny, at[g].traction[0]);
        at[g].traction[1] = lanes_select(r.cracked, r.t_n * ny + r.t_t * nx, at[g].traction[1]);
        at[g].carried[0] = lanes_select(r.cracked, r.s_n * nx - r.s_t * ny, q[0]);
        at[g].carried[1] = lanes_select(r.cracked, r.s_n * ny + r.s_t * nx, q[1]);
        broken = lanes_and(broken, lanes_le(one, damage));
        cracks[g] = r.cracks;
        breaks[g] = r.breaks;
        opens = lanes_or(opens, r.cracks);
        parts = lanes_or(parts, r.breaks);
    }
    double *created_at = c->step->created + c->first, *rubbed_at = c->step->rubbed + c->first;
    lanes_store(created_at, lanes_load(created_at) + created);
    lanes_store(rubbed_at, lanes_load(rubbed_at) + rubbed);
    opens = lanes_and(opens, whole);  /* the first of its points */
    parts = lanes_and(parts, broken); /* the last */
    if (__builtin_expect(lanes_any(lanes_or(opens, parts)), 0))
        membrane_book(c, points, i, cracks, breaks, opens, parts);
}

/* Interface i: traction at its Gauss points, and what that does to its elements. */
LANES_FUNCTION void membrane_join(membrane_context *c, int order, int law, size_t i)
{
    const fracas_membrane_constants *m = c->membrane;
    const int points = MEMBRANE_EDGE(order);
    const membrane_sides sides = membrane_sides_of(c, order, i);
    double *joint = c->joints + i * c->joint_size;
    const double *strength = c->strengths + i * c->strengths_size;
    membrane_point at[3];
    membrane_flux(c, order, i, &sides, at);
    if (law == SURFACE_OPERATOR) {
        UNROLL_FOR (int g = 0; g < points; g++)
            UNROLL_FOR (int j = 0; j < 2; j++) {
                if (!m->contact) continue;
                at[g].traction[j] = at[g].traction[j] - at[g].mean[j];
                at[g].carried[j] = lanes_set(0.0);
            }
        membrane_give(c, order, i, &sides, at);
        return;
    }
    /* No lane is past its onset where none has a peak and no traction is near the least strength:
     * an onset needs |T| >= min(1, beta_c) sigma_c, and the margin covers its round-off, so that
     * lanes do not depend on each other. */
    vd largest = lanes_set(0.0), touched = lanes_set(0.0), weakest = lanes_load(strength);
    UNROLL_FOR (int g = 0; g < points; g++) {
        const vd *judged = m->onset_mean ? at[g].mean : at[g].traction;
        largest = plane_max(largest, judged[0] * judged[0] + judged[1] * judged[1]);
        touched += lanes_load(surface_at(joint, g * m->point_fields + SURFACE_PEAK));
        weakest = plane_min(weakest, lanes_load(strength + (size_t)g * c->strength_step));
    }
    const vd floor = lanes_set(0.999 * (m->beta_c < 1.0 ? m->beta_c : 1.0)) * weakest;
    if (lanes_any(lanes_or(lanes_lt(lanes_set(0.0), touched), lanes_lt(floor * floor, largest)))) {
        membrane_crack(c, order, law, i, joint, strength, at);
    } else {
        const double *table = c->tables->joint +
                              i * (size_t)(MEMBRANE_POINTS + points * MEMBRANE_POINT_TABLE);
        UNROLL_FOR (int g = 0; g < points; g++) {
            const vd *q = at[g].jump,
                     area = lanes_set(
                         table[MEMBRANE_POINTS + g * MEMBRANE_POINT_TABLE + MEMBRANE_AREA]);
            c->flux += area * (q[0] * (at[g].mean[0] + at[g].traction[0]) +
                               q[1] * (at[g].mean[1] + at[g].traction[1]));
        }
    }
    membrane_give(c, order, i, &sides, at);
}

/* Internal forces of element e: its own, what symmetrisation adds to its stresses, and its
 * interfaces'  (membrane.7). */
LANES_FUNCTION void membrane_forces(const membrane_context *c, int order, size_t e, vd force[12])
{
    static const double shape[2][3][6][2] = {FRACAS_TRIANGLE_DERIVATIVES_1,
                                             FRACAS_TRIANGLE_DERIVATIVES_2};
    const int nodes = MEMBRANE_NODES(order), points = MEMBRANE_BULK(order);
    double *slot = c->slots +
                   (e & c->tables->visits.window) * (size_t)(MEMBRANE_SLOT(order) * LANES);
    const double *bulk = c->tables->bulk + e * (size_t)(points * MEMBRANE_BULK_TABLE);
    const vd c11 = lanes_set(c->membrane->c11), c12 = lanes_set(c->membrane->c12),
             c33 = lanes_set(c->membrane->c33);
    UNROLL_FOR (int i = 0; i < 2 * nodes; i++)
        force[i] = lanes_load(surface_at(slot, MEMBRANE_SLOT_FORCE(order) + i));
    UNROLL_FOR (int g = 0; g < points; g++, bulk += MEMBRANE_BULK_TABLE) {
        const double *extra = surface_at(slot, MEMBRANE_SLOT_EXTRA(order) + 3 * g),
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

/* Accelerations from internal and body forces, held components 0; the power of what holds them. */
LANES_FUNCTION void membrane_accelerate(membrane_context *c, int order, size_t e,
                                        const vd *velocity, const vd *force, vd *acceleration)
{
    const int nodes = MEMBRANE_NODES(order), size = 2 * nodes;
    const fracas_membrane_tables *t = c->tables;
    const unsigned held = t->held ? t->held[e] : 0;
    const double *consistent = t->consistent ? t->consistent + e * (size_t)(3 * nodes * nodes)
                                             : NULL;
    UNROLL_FOR (int i = 0; i < size; i++) {
        if (!consistent) {
            acceleration[i] = lanes_set(-t->lumped[e * (size_t)size + (size_t)(i / 2)]) * force[i];
        } else {
            acceleration[i] = lanes_set(0.0);
            UNROLL_FOR (int k = 0; k < nodes; k++)
                acceleration[i] += lanes_set(-consistent[(i % 2 * nodes + i / 2) * nodes + k]) *
                                   force[2 * k + i % 2];
        }
        if (t->position)
            acceleration[i] +=
                c->spin * lanes_set(t->position[e * (size_t)size + (size_t)i]); /* (membrane.10) */
    }
    if (__builtin_expect(held != 0, 0))
        for (int i = 0; i < size; i++) {
            if (!(held >> i & 1)) continue;
            acceleration[i] = lanes_set(0.0);
            vd reaction = force[i]; /* (membrane.11) */
            for (int k = 0; consistent && k < nodes; k++)
                if (!(held >> (2 * k + i % 2) & 1))
                    reaction += lanes_set(consistent[(2 * nodes + i / 2) * nodes + k]) *
                                acceleration[2 * k + i % 2];
            c->power += reaction * velocity[i];
        }
}

/* Forces and kick of element e, and its share of kinetic energy. */
LANES_FUNCTION void membrane_kick(membrane_context *c, int order, int law, size_t e)
{
    const int nodes = MEMBRANE_NODES(order), size = 2 * nodes;
    const fracas_membrane_constants *m = c->membrane;
    const fracas_membrane_tables *t = c->tables;
    double *at = c->elements + e * c->element_size;
    const double *consistent =
        t->consistent ? t->consistent + e * (size_t)(3 * nodes * nodes) + 2 * nodes * nodes : NULL;
    vd force[12], v[12], a[12], after[12];
    membrane_forces(c, order, e, force);
    UNROLL_FOR (int i = 0; i < size; i++) v[i] = lanes_load(surface_at(at, SURFACE_V * size + i));
    membrane_accelerate(c, order, e, v, force, a);
    if (law == SURFACE_OPERATOR) {
        UNROLL_FOR (int i = 0; i < size; i++)
            lanes_store(surface_at(at, SURFACE_V * size + i), a[i]);
        return;
    }
    surface_kick(&m->motion, c->kick, c->begins, size, at, a, v, after);
    UNROLL_FOR (int k = 0; k < nodes; k++) { /* leapfrog: v_{n-1/2} M v_{n+1/2}  (membrane.9) */
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

/* Angular velocity squared at a time. */
LANES_FUNCTION vd membrane_spin(const fracas_membrane_constants *m, vd time)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    vd share = m->ramp > 0 ? plane_max(zero, plane_min(one, time / lanes_set(m->ramp))) : one;
    vd w = lanes_set(m->speed) * share;
    return w * w;
}

/* Sums to energies [J], those of the potential (membrane.8), power [W] and work [J]. */
LANES_FUNCTION void membrane_totals(const membrane_context *c)
{
    const fracas_membrane_constants *m = c->membrane;
    fracas_step *step = c->step;
    const vd half = lanes_set(0.5);
    const int first = c->first;
    lanes_store(step->kinetic + first, half * c->kinetic);
    lanes_store(step->elastic + first, half * (c->strain_energy + c->flux));
    lanes_store(step->cohesive + first, half * c->stored);
    lanes_store(step->dissipated + first, c->dissipated + lanes_load(step->rubbed + first));
    /* Central difference: exactly what the body force does between two steps is its mean times dt
     * v_{n-1/2}. */
    vd body = lanes_set(0.0), power = c->power;
    if (c->tables->position && m->motion.alpha) power += c->spin * c->moment;
    if (c->tables->position && !m->motion.alpha) {
        const vd before = membrane_spin(m, lanes_load(step->time + first) - c->drift);
        body = c->drift * half * (before + c->spin) * c->moment;
    }
    lanes_store(step->power + first, power);
    lanes_store(step->work + first, body);
}

LANES_FUNCTION void membrane_run(const fracas_membrane_constants *m, fracas_step *step, int first,
                                 int order, int law)
{
    const vd zero = lanes_set(0.0);
    const fracas_membrane_tables *t = m->tables;
    double *state = step->state + (size_t)first * fracas_membrane_state_fields(m);
    membrane_context context = {.membrane = m,
                                .tables = t,
                                .step = step,
                                .first = first,
                                .elements = state,
                                .joints = state + fracas_membrane_joints_at(m) * LANES,
                                .slots = state + fracas_membrane_slots_at(m) * LANES,
                                .strengths = state + fracas_membrane_strengths_at(m) * LANES,
                                .element_size = fracas_membrane_element_fields(m) * LANES,
                                .joint_size = fracas_membrane_joint_fields(m) * LANES,
                                .strengths_size = (size_t)m->strengths * LANES,
                                .strength_step = m->strengths > 1 ? LANES : 0,
                                .drift = lanes_load(step->drift + first),
                                .kick = lanes_load(step->kick + first),
                                .begins = !(step->drift[first] > 0),
                                .strain_energy = zero,
                                .flux = zero,
                                .stored = zero,
                                .dissipated = zero,
                                .kinetic = zero,
                                .power = zero,
                                .moment = zero};
    membrane_context *c = &context;
    c->spin = membrane_spin(m, lanes_load(step->time + first));
    for (size_t e = 0; e < t->nelements; e++) {
        if (law != SURFACE_OPERATOR)
            surface_drift(&m->motion, c->drift, 2 * MEMBRANE_NODES(order),
                          c->elements + e * c->element_size);
        membrane_strain(c, order, e);
        for (size_t j = t->visits.join_from[e]; j < t->visits.join_from[e + 1]; j++)
            membrane_join(c, order, law, t->visits.join[j]);
        for (size_t f = t->visits.finish_from[e]; f < t->visits.finish_from[e + 1]; f++)
            membrane_kick(c, order, law, t->visits.finish[f]);
    }
    if (law != SURFACE_OPERATOR) membrane_totals(c);
}

#define MEMBRANE_SWEEP(name, law)                                                              \
    static void linear_##name(const fracas_membrane_constants *membrane, fracas_step *step,    \
                              int first)                                                       \
    {                                                                                          \
        membrane_run(membrane, step, first, 1, law);                                           \
    }                                                                                          \
    static void quadratic_##name(const fracas_membrane_constants *membrane, fracas_step *step, \
                                 int first)                                                    \
    {                                                                                          \
        membrane_run(membrane, step, first, 2, law);                                           \
    }
#define FRACAS_LAW(name, bar, ring, membrane, shell) \
    FRACAS_IF_##membrane(MEMBRANE_SWEEP(name, FRACAS_LAW_##name))
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW
#if LANES == 1
MEMBRANE_SWEEP(operator, SURFACE_OPERATOR)
#endif

#define FRACAS_LAW(name, bar, ring, membrane, shell) \
    FRACAS_IF_##membrane([FRACAS_LAW_##name] = {linear_##name, quadratic_##name}, )
const fracas_membrane_kernel LANES_UNIT(fracas_membrane) = {
    .sweep = {
#include "engine/cohesive/laws.list.h"
#if LANES == 1
        [SURFACE_OPERATOR] = {linear_operator, quadratic_operator},
#endif
    }};
