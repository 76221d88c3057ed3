/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell over lanes: a body's kernel (engine/formulation/surface/kernel.h). */
#define BODY_NAME shell
#define BODY_DIMENSION 3
#define BODY_STRESSES 6
#define BODY_LAYERS 3
#define BODY_PLANE 0
#define BODY_BULK_TABLE SHELL_BULK_TABLE
#define BODY_TAKES(bar, ring, membrane, shell, ...) FRACAS_IF_##shell(__VA_ARGS__)
#define BODY_HEAD SHELL_POINTS
#define BODY_POINT_TABLE SHELL_POINT_TABLE
#define BODY_MEASURE SHELL_LENGTH
#include "engine/formulation/shell/shell.h"
#include "engine/formulation/surface/kernel.h"

#include "engine/formulation/shell/shell_crack.h"

enum { SHELL_RESULTANTS = BODY_STRESSES }; /* n_xx, n_yy, n_xy [N/m], m_xx, m_yy, m_xy [N] */

LANES_FUNCTION vd shell_dot(const double *a, const vd *b)
{
    return lanes_set(a[0]) * b[0] + lanes_set(a[1]) * b[1] + lanes_set(a[2]) * b[2];
}

LANES_FUNCTION void shell_load(const double *from, vd u[SHELL_UNKNOWNS])
{
    UNROLL_FOR (int i = 0; i < SHELL_UNKNOWNS; i++) u[i] = lanes_load(from + i * LANES);
}

/* ---- sides of interfaces and rims ---- */

/* Turn of a side about the edge, by its table: +-Dt_n  (shell.6) */
LANES_FUNCTION vd shell_turn(const double *side, const vd u[SHELL_UNKNOWNS])
{
    vd along[3];
    UNROLL_FOR (int i = 0; i < 3; i++) {
        along[i] = lanes_set(side[SHELL_SLOPE]) * u[i];
        UNROLL_FOR (int k = 1; k < SHELL_NODES; k++)
            along[i] += lanes_set(side[SHELL_SLOPE + k]) * u[3 * k + i];
    }
    return shell_dot(side + SHELL_TURN, along);
}

/* Adds the resultants n_nn, n_ns, m_nn, m_ns of a side at the Gauss points of its edge, times its
 * table's share, to `of`. Bulk points node[0], node[1] are at the ends; resultants are linear
 * between them  (membrane.2). */
LANES_FUNCTION void shell_resultants(const double *slot, const int node[3], const double *table,
                                     size_t stride, vd of[SHELL_EDGE][4])
{
    const double *a = slot + node[0] * SHELL_RESULTANTS * LANES,
                 *b = slot + node[1] * SHELL_RESULTANTS * LANES;
    const double *o = slot + (3 - node[0] - node[1]) * SHELL_RESULTANTS * LANES;
    vd at[SHELL_EDGE][SHELL_RESULTANTS];
    UNROLL_FOR (int j = 0; j < SHELL_RESULTANTS; j++) {
        const vd first = lanes_load(a + j * LANES), last = lanes_load(b + j * LANES);
        const vd half_way = lanes_set(2.0 / 3) * (first + last) -
                            lanes_set(1.0 / 3) * lanes_load(o + j * LANES);
        const vd off = lanes_set(2 * surface_edge_point[1][2] - 1) * (last - first);
        at[0][j] = half_way - off;
        at[1][j] = half_way;
        at[2][j] = half_way + off;
    }
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        const double *side = table + (size_t)g * stride;
        const vd xx = lanes_set(side[SHELL_SQUARE_X]), yy = lanes_set(side[SHELL_SQUARE_Y]),
                 xy = lanes_set(side[SHELL_PRODUCT]);
        UNROLL_FOR (int part = 0; part < 2; part++) {
            const vd *r = at[g] + 3 * part;
            of[g][2 * part] += xx * r[0] + yy * r[1] + (xy + xy) * r[2];
            of[g][2 * part + 1] += xy * (r[1] - r[0]) + (xx - yy) * r[2];
        }
    }
}

/* Adds to a side's slot the forces of moments `turned` [N m], and the strains of `work`, those with
 * n_nn, n_ns, m_nn, m_ns times length, at each Gauss point. */
LANES_FUNCTION void shell_give_side(const double *table, size_t stride, double *slot,
                                    const int node[3], const vd *turned, vd (*work)[4])
{
    const vd zero = lanes_set(0.0);
    vd force[SHELL_UNKNOWNS], strain[SHELL_EDGE][SHELL_RESULTANTS];
    UNROLL_FOR (int i = 0; i < SHELL_UNKNOWNS; i++) force[i] = zero;
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        const double *side = table + (size_t)g * stride;
        const vd pull[3] = {turned[g] * lanes_set(side[SHELL_TURN]),
                            turned[g] * lanes_set(side[SHELL_TURN + 1]),
                            turned[g] * lanes_set(side[SHELL_TURN + 2])};
        UNROLL_FOR (int k = 0; k < SHELL_NODES; k++)
            UNROLL_FOR (int i = 0; i < 3; i++)
                force[3 * k + i] += lanes_set(side[SHELL_SLOPE + k]) * pull[i];
        const vd xx = lanes_set(side[SHELL_SQUARE_X]), yy = lanes_set(side[SHELL_SQUARE_Y]),
                 xy = lanes_set(side[SHELL_PRODUCT]);
        UNROLL_FOR (int part = 0; part < 2; part++) {
            const vd nn = work[g][2 * part], ns = work[g][2 * part + 1];
            strain[g][3 * part] = xx * nn - xy * ns;
            strain[g][3 * part + 1] = yy * nn + xy * ns;
            strain[g][3 * part + 2] = (xy + xy) * nn + (xx - yy) * ns;
        }
    }
    double *forces = surface_at(slot, BODY_SLOT_FORCE(2));
    UNROLL_FOR (int i = 0; i < SHELL_UNKNOWNS; i++) surface_add(surface_at(forces, i), force[i]);
    const int bulk[3] = {node[0], node[1], 3 - node[0] - node[1]};
    UNROLL_FOR (int j = 0; j < SHELL_RESULTANTS; j++) { /* as resultants are read */
        const vd sum = strain[0][j] + strain[1][j] + strain[2][j],
                 off = lanes_set(2 * surface_edge_point[1][2] - 1) * (strain[2][j] - strain[0][j]);
        const vd share = lanes_set(2.0 / 3) * sum,
                 extra[3] = {share - off, share + off, lanes_set(-1.0 / 3) * sum};
        UNROLL_FOR (int p = 0; p < 3; p++)
            surface_add(surface_at(slot, BODY_SLOT_EXTRA(2) + SHELL_RESULTANTS * bulk[p] + j),
                        extra[p]);
    }
}

/* Rim r of an element, whose director does not turn about the edge  (shell.9). */
LANES_FUNCTION void shell_rim(surface_context *c, int order, size_t r, const double *at,
                              double *slot)
{
    const double *rim = c->tables->rim + r * (size_t)SHELL_RIM_TABLE;
    const int k = c->tables->rim_edge[r], node[3] = {k, (k + 1) % 3, 3 + k};
    (void)order;
    const vd zero = lanes_set(0.0), stiff = lanes_set(rim[SHELL_RIM_STIFFNESS]);
    vd u[SHELL_UNKNOWNS], turned[SHELL_EDGE], work[SHELL_EDGE][4], of[SHELL_EDGE][4];
    shell_load(at, u);
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++)
        UNROLL_FOR (int j = 0; j < 4; j++) of[g][j] = zero;
    shell_resultants(slot, node, rim + SHELL_RIM_POINTS + SHELL_RIM_SIDE, SHELL_RIM_POINT_TABLE,
                     of);
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        const double *point = rim + SHELL_RIM_POINTS + g * SHELL_RIM_POINT_TABLE,
                     *side = point + SHELL_RIM_SIDE;
        const vd turn = shell_turn(side, u), length = lanes_set(point[SHELL_RIM_LENGTH]),
                 moment = of[g][2] + stiff * turn;
        c->sum[SURFACE_RIMS] += length * (turn * (of[g][2] + moment));
        turned[g] = length * moment;
        work[g][0] = work[g][1] = work[g][3] = zero;
        work[g][2] = length * turn;
    }
    shell_give_side(rim + SHELL_RIM_POINTS + SHELL_RIM_SIDE, SHELL_RIM_POINT_TABLE, slot, node,
                    turned, work);
}

/* ---- elements ---- */

static const double shell_second[3][6] = FRACAS_TRIANGLE_SECOND_2;

/* (shell.4) */
LANES_FUNCTION void shell_strain(surface_context *c, int order, size_t e, double *at, double *slot)
{
    const double *bulk = surface_bulk(c, 2, e);
    vd u[SHELL_UNKNOWNS], bent[3][3], energy = lanes_set(0.0);
    shell_load(at, u);
    UNROLL_FOR (int b = 0; b < 3; b++)
        UNROLL_FOR (int i = 0; i < 3; i++) {
            bent[b][i] = lanes_set(0.0);
            UNROLL_FOR (int k = 0; k < SHELL_NODES; k++)
                if (shell_second[b][k] != 0.0)
                    bent[b][i] += lanes_set(shell_second[b][k]) * u[3 * k + i];
        }
    UNROLL_FOR (int g = 0; g < SHELL_BULK; g++, bulk += BODY_BULK_TABLE) {
        const double *x = bulk + SHELL_X, *y = bulk + SHELL_Y, *t = bulk + SHELL_T;
        vd by[4][3], r[SHELL_RESULTANTS];
        surface_gradient(2, g, bulk, u, by);
        const vd out[5] = {shell_dot(t, bent[0]), shell_dot(t, bent[1]), shell_dot(t, bent[2]),
                           shell_dot(t, by[0]), shell_dot(t, by[1])};
        vd strain[SHELL_RESULTANTS] = {shell_dot(x, by[2]), shell_dot(y, by[3]),
                                       shell_dot(x, by[3]) + shell_dot(y, by[2])};
        UNROLL_FOR (int ij = 0; ij < 3; ij++) {
            strain[3 + ij] = shell_dot(bulk + SHELL_SECOND + 3 * ij, out);
            strain[3 + ij] += lanes_set(bulk[SHELL_FIRST + 2 * ij]) * out[3] +
                              lanes_set(bulk[SHELL_FIRST + 2 * ij + 1]) * out[4];
        }
        surface_elastic(c->constants, strain, r);
        energy += lanes_set(bulk[SURFACE_WEIGHT]) *
                  ((r[0] * strain[0] + r[1] * strain[1] + r[2] * strain[2]) +
                   (r[3] * strain[3] + r[4] * strain[4] + r[5] * strain[5]));
        UNROLL_FOR (int i = 0; i < SHELL_RESULTANTS; i++)
            lanes_store(surface_at(slot, SHELL_RESULTANTS * g + i), r[i]);
    }
    c->sum[SURFACE_STRAIN] += energy;
    for (size_t rim = c->tables->rim_from[e]; rim < c->tables->rim_from[e + 1]; rim++)
        shell_rim(c, order, rim, at, slot);
}

/* (shell.10) */
LANES_FUNCTION void shell_forces(const surface_context *c, int order, size_t e, double *slot,
                                 vd *force)
{
    const double *bulk = surface_bulk(c, 2, e);
    vd bent[3][3];
    (void)order;
    UNROLL_FOR (int b = 0; b < 3; b++)
        UNROLL_FOR (int i = 0; i < 3; i++) bent[b][i] = lanes_set(0.0);
    UNROLL_FOR (int g = 0; g < SHELL_BULK; g++, bulk += BODY_BULK_TABLE) {
        const vd xi_x = lanes_set(bulk[SURFACE_XI_X]), xi_y = lanes_set(bulk[SURFACE_XI_Y]);
        const vd eta_x = lanes_set(bulk[SURFACE_ETA_X]), eta_y = lanes_set(bulk[SURFACE_ETA_Y]);
        vd r[SHELL_RESULTANTS], by_second[3], by_first[2], xi[3], eta[3];
        surface_stresses(c, 2, g, bulk, slot, r);
        UNROLL_FOR (int b = 0; b < 3; b++)
            by_second[b] = lanes_set(bulk[SHELL_SECOND + b]) * r[3] +
                           lanes_set(bulk[SHELL_SECOND + 3 + b]) * r[4] +
                           lanes_set(bulk[SHELL_SECOND + 6 + b]) * r[5];
        UNROLL_FOR (int a = 0; a < 2; a++)
            by_first[a] = lanes_set(bulk[SHELL_FIRST + a]) * r[3] +
                          lanes_set(bulk[SHELL_FIRST + 2 + a]) * r[4] +
                          lanes_set(bulk[SHELL_FIRST + 4 + a]) * r[5];
        UNROLL_FOR (int i = 0; i < 3; i++) {
            const vd x_i = lanes_set(bulk[SHELL_X + i]), y_i = lanes_set(bulk[SHELL_Y + i]),
                     t_i = lanes_set(bulk[SHELL_T + i]);
            const vd x = r[0] * x_i + r[2] * y_i, y = r[2] * x_i + r[1] * y_i;
            xi[i] = xi_x * x + xi_y * y + t_i * by_first[0];
            eta[i] = eta_x * x + eta_y * y + t_i * by_first[1];
            UNROLL_FOR (int b = 0; b < 3; b++) bent[b][i] += t_i * by_second[b];
        }
        surface_spread(2, g, xi, eta, force);
    }
    UNROLL_FOR (int b = 0; b < 3; b++)
        UNROLL_FOR (int k = 0; k < SHELL_NODES; k++)
            UNROLL_FOR (int i = 0; i < 3; i++)
                if (shell_second[b][k] != 0.0)
                    force[3 * k + i] += lanes_set(shell_second[b][k]) * bent[b][i];
}

/* Leapfrog: v_{n-1/2} M v_{n+1/2}  (membrane.9) */
LANES_FUNCTION vd shell_kinetic(const surface_context *c, int order, size_t e, const vd *v,
                                const vd *after, vd *moment)
{
    vd kinetic = lanes_set(0.0);
    (void)moment;
    const double *mass = c->tables->lumped + (2 * e + 1) * (size_t)SURFACE_NODES(order);
    UNROLL_FOR (int k = 0; k < SHELL_NODES; k++) {
        const vd m = lanes_set(mass[k]);
        kinetic += m * (v[3 * k] * after[3 * k] + v[3 * k + 1] * after[3 * k + 1] +
                        v[3 * k + 2] * after[3 * k + 2]);
    }
    return kinetic;
}

/* ---- interfaces ---- */

/* Jumps, means and the flux at the Gauss points, before any onset. */
LANES_FUNCTION void shell_flux(const surface_context *c, int order, size_t i,
                               const surface_sides *sides, shell_point at[SHELL_EDGE])
{
    const fracas_surface_constants *s = c->constants;
    const double *table = surface_table(c, order, i), h = s->thickness;
    const double membrane = table[SURFACE_STIFFNESS] * h, bending = membrane * (h * h / 12);
    const vd stiff[2] = {lanes_set(s->normal * membrane), lanes_set(s->tangential * membrane)};
    const vd turning[2] = {lanes_set(s->normal * bending), lanes_set(s->tangential * bending)},
             shearing = lanes_set(table[SHELL_SHEARING]);
    vd u[2][SHELL_UNKNOWNS], jump[3][3], means[SHELL_EDGE][4];
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++)
        UNROLL_FOR (int j = 0; j < 4; j++) means[g][j] = lanes_set(0.0);
    UNROLL_FOR (int side = 0; side < 2; side++) {
        shell_load(sides->element[side], u[side]);
        shell_resultants(sides->slot[side], sides->node[side],
                         table + SHELL_POINTS + SHELL_SIDES + side * SHELL_SIDE, SHELL_POINT_TABLE,
                         means);
    }
    surface_jumps(2, sides, jump);
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        const double *place = table + SHELL_POINTS + g * SHELL_POINT_TABLE;
        double shape[3], spread[3], slope[3];
        fracas_edge_shape(2, surface_edge_point[1][g], shape, spread);
        fracas_edge_slope(surface_edge_point[1][g], slope);
        vd q[3], along[3];
        const vd *mean = means[g];
        UNROLL_FOR (int j = 0; j < 3; j++) {
            if (g == 1) { /* half-way: the middle node's own */
                q[j] = jump[2][j];
                along[j] = jump[1][j] - jump[0][j];
                continue;
            }
            q[j] = lanes_set(shape[0]) * jump[0][j] + lanes_set(shape[1]) * jump[1][j] +
                   lanes_set(shape[2]) * jump[2][j];
            along[j] = lanes_set(slope[0]) * jump[0][j] + lanes_set(slope[1]) * jump[1][j] +
                       lanes_set(slope[2]) * jump[2][j];
        }
        const vd nn = lanes_set(place[SHELL_L_NN]), ns = lanes_set(place[SHELL_L_NS]),
                 ss = lanes_set(place[SHELL_L_SS]);
        shell_point *p = &at[g];
        p->jump[0] = shell_dot(place + SHELL_N, q);
        p->jump[1] = shell_dot(place + SHELL_S, q);
        p->lift = shell_dot(place + SHELL_LIFT, q);
        p->turn[0] = shell_turn(place + SHELL_SIDES, u[0]) +
                     shell_turn(place + SHELL_SIDES + SHELL_SIDE, u[1]);
        p->turn[1] = lanes_set(-place[SHELL_PER_SPEED]) * shell_dot(place + SHELL_LIFT, along);
        p->mean_n[0] = mean[0] + (nn * mean[2] + ns * mean[3]); /* (shell.5) */
        p->mean_n[1] = mean[1] + (ns * mean[2] + ss * mean[3]);
        p->shearing = shearing * p->lift;
        UNROLL_FOR (int j = 0; j < 2; j++) { /* (shell.8) */
            p->mean_m[j] = mean[2 + j];
            p->carried_u[j] = p->jump[j];
            p->carried_t[j] = p->turn[j];
            p->n[j] = p->mean_n[j] + stiff[j] * p->jump[j];
            p->m[j] = p->mean_m[j] + turning[j] * p->turn[j];
        }
    }
}

LANES_FUNCTION vd shell_flux_energy(const shell_point *p)
{
    return shell_energy(p) + p->shearing * p->lift;
}

/* By both faces, where |T| is largest. */
LANES_FUNCTION vd shell_square(const fracas_surface_constants *s, const shell_point *p)
{
    const vd per_h = lanes_set(1.0 / s->thickness),
             per_h2 = lanes_set(6.0 / (s->thickness * s->thickness));
    const vd *n = s->onset_mean ? p->mean_n : p->n, *m = s->onset_mean ? p->mean_m : p->m;
    const vd stretch[2] = {n[0] * per_h, n[1] * per_h}, bend[2] = {m[0] * per_h2, m[1] * per_h2};
    const vd cross = plane_abs(stretch[0] * bend[0] + stretch[1] * bend[1]);
    const vd square = stretch[0] * stretch[0] + stretch[1] * stretch[1] +
                      (bend[0] * bend[0] + bend[1] * bend[1]);
    return square + (cross + cross);
}

LANES_FUNCTION void shell_press(shell_point *p)
{
    p->shearing = lanes_set(0.0);
    UNROLL_FOR (int j = 0; j < 2; j++) {
        p->n[j] = p->n[j] - p->mean_n[j];
        p->m[j] = p->m[j] - p->mean_m[j];
        p->carried_u[j] = p->carried_t[j] = lanes_set(0.0);
    }
}

/* Scatters forces to the two elements, and strains to their bulk points  (shell.10). */
LANES_FUNCTION void shell_scatter(const surface_context *c, int order, size_t i,
                                  const surface_sides *sides, const shell_point at[SHELL_EDGE])
{
    const double *table = surface_table(c, order, i) + SHELL_POINTS;
    vd force[3][3], turned[SHELL_EDGE], work[SHELL_EDGE][4];
    UNROLL_FOR (int n = 0; n < 3; n++)
        UNROLL_FOR (int j = 0; j < 3; j++) force[n][j] = lanes_set(0.0);
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        const double *place = table + g * SHELL_POINT_TABLE;
        const shell_point *p = &at[g];
        const vd length = lanes_set(place[SHELL_LENGTH]), n = length * p->n[0],
                 s = length * p->n[1], lift = length * p->shearing;
        const vd twist = lanes_set(-place[SHELL_PER_SPEED]) * (length * p->m[1]);
        const vd nn = lanes_set(place[SHELL_L_NN]), ns = lanes_set(place[SHELL_L_NS]),
                 ss = lanes_set(place[SHELL_L_SS]);
        double shape[3], spread[3], slope[3];
        fracas_edge_shape(2, surface_edge_point[1][g], shape, spread);
        fracas_edge_slope(surface_edge_point[1][g], slope);
        UNROLL_FOR (int j = 0; j < 3; j++) {
            const vd out = lanes_set(place[SHELL_LIFT + j]);
            const vd pull = lanes_set(place[SHELL_N + j]) * n + lanes_set(place[SHELL_S + j]) * s +
                            out * lift,
                     bend = out * twist;
            UNROLL_FOR (int k = 0; k < 3; k++) {
                if (shape[k] != 0.0) force[k][j] += lanes_set(shape[k]) * pull;
                if (slope[k] != 0.0) force[k][j] += lanes_set(slope[k]) * bend;
            }
        }
        turned[g] = length * p->m[0];
        work[g][0] = length * p->carried_u[0];
        work[g][1] = length * p->carried_u[1];
        work[g][2] = length * p->carried_t[0] + (nn * work[g][0] + ns * work[g][1]);
        work[g][3] = length * p->carried_t[1] + (ns * work[g][0] + ss * work[g][1]);
    }
    UNROLL_FOR (int side = 0; side < 2; side++) {
        shell_give_side(table + SHELL_SIDES + side * SHELL_SIDE, SHELL_POINT_TABLE,
                        sides->slot[side], sides->node[side], turned, work);
        surface_push(2, sides, side, force);
    }
}

#include "engine/formulation/surface/sweep_kernel.h"
