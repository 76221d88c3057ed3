/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interfaces of the shell's sweep, and edges that hold the director, for one width; part of
 * shell_kernel.c. */
#ifndef FRACAS_ENGINE_SHELL_INTERFACE_TEMPLATE_H
#define FRACAS_ENGINE_SHELL_INTERFACE_TEMPLATE_H

/* Where an interface finds its two elements, - and +: nodes a, b and the middle c of the edge, and
 * bulk points a, b at its ends, o away from it. */
typedef struct {
    const double *element[2];
    double *slot[2];
    int node[2][3];
} shell_sides;

/* At one Gauss point of an interface: along its normal and along the edge  (shell.5) to (shell.8).
 */
typedef struct {
    vd jump[2], turn[2], lift;     /* [u] [m], [Dt] [1], [u].t [m] */
    vd mean_n[2], mean_m[2];       /* <N> [N/m], <M> [N] */
    vd n[2], m[2], shearing;       /* tractions N [N/m], M [N], and across the surface [N/m] */
    vd carried_u[2], carried_t[2]; /* what the flux carries of the jumps [m], [1] */
} shell_point;

/* What the layers of a Gauss point come to. */
typedef struct {
    vmask cracked; /* some layer is past onset: the rest holds */
    vd n[2], m[2], carried_u[2], carried_t[2];
    vd flux, stored, dissipated, created, rubbed; /* [J/m]; the last two: in this step */
    vd spent, spent_bending; /* dissipated in this step, and its share by bending [J/m] */
    vmask broken;            /* all of them */
    vmask whole;             /* none had been past its onset before this step */
} shell_layers;

/* For the booking. */
typedef struct {
    vmask cracks[SHELL_EDGE][SHELL_LAYERS], breaks[SHELL_EDGE][SHELL_LAYERS];
} shell_booked;

LANES_FUNCTION shell_sides shell_sides_of(const shell_context *c, size_t i)
{
    const uint32_t *element = c->tables->element[i];
    const int k = c->tables->edge[i][0], l = c->tables->edge[i][1];
    shell_sides sides = {.node = {{k, (k + 1) % 3, 3 + k}, {(l + 1) % 3, l, 3 + l}}};
    UNROLL_FOR (int side = 0; side < 2; side++) {
        sides.element[side] = c->elements + element[side] * c->element_size;
        sides.slot[side] = c->slots + (element[side] & c->tables->visits.window) *
                                          (size_t)(SHELL_SLOT * LANES);
    }
    return sides;
}

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

/* Adds the resultants n_nn, n_ns, m_nn, m_ns of a side at the three Gauss points of its edge (times
 * the share that its table has) to `of`; the ends of the edge are at the bulk points node[0],
 * node[1], and resultants are linear between them  (membrane.2). */
LANES_FUNCTION void shell_resultants(const double *slot, const int node[3], const double *table,
                                     size_t stride, vd of[SHELL_EDGE][4])
{
    static const double edge_point[3] = FRACAS_EDGE_POINTS_2;
    const double *a = slot + node[0] * SHELL_RESULTANTS * LANES,
                 *b = slot + node[1] * SHELL_RESULTANTS * LANES;
    const double *o = slot + (3 - node[0] - node[1]) * SHELL_RESULTANTS * LANES;
    vd at[SHELL_EDGE][SHELL_RESULTANTS];
    UNROLL_FOR (int j = 0; j < SHELL_RESULTANTS; j++) {
        const vd first = lanes_load(a + j * LANES), last = lanes_load(b + j * LANES);
        const vd half_way = lanes_set(2.0 / 3) * (first + last) -
                            lanes_set(1.0 / 3) * lanes_load(o + j * LANES);
        const vd off = lanes_set(2 * edge_point[2] - 1) * (last - first);
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

/* Jumps, means and the flux at the Gauss points, as long as nothing has cracked. */
LANES_FUNCTION void shell_flux(const shell_context *c, size_t i, const shell_sides *sides,
                               shell_point at[SHELL_EDGE])
{
    static const double edge_point[3] = FRACAS_EDGE_POINTS_2;
    const fracas_shell_constants *s = c->shell;
    const double *table = c->tables->joint + i * (size_t)SHELL_JOINT_TABLE, h = s->thickness;
    const double membrane = table[SHELL_STIFFNESS] * h, bending = membrane * (h * h / 12);
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
    UNROLL_FOR (int n = 0; n < 3; n++)
        UNROLL_FOR (int j = 0; j < 3; j++)
            jump[n][j] = lanes_load(sides->element[1] + (3 * sides->node[1][n] + j) * LANES) -
                         lanes_load(sides->element[0] + (3 * sides->node[0][n] + j) * LANES);
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        const double *place = table + SHELL_POINTS + g * SHELL_POINT_TABLE;
        double shape[3], spread[3], slope[3];
        fracas_edge_shape(2, edge_point[g], shape, spread);
        fracas_edge_slope(edge_point[g], slope);
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

/* Twice the flux's energy at a Gauss point that has not cracked, but for what shears it off [J/m]
 * (shell.7) */
LANES_FUNCTION vd shell_flux_energy(const shell_point *p)
{
    return p->jump[0] * (p->mean_n[0] + p->n[0]) + p->jump[1] * (p->mean_n[1] + p->n[1]) +
           (p->turn[0] * (p->mean_m[0] + p->m[0]) + p->turn[1] * (p->mean_m[1] + p->m[1]));
}

/* Gives one side of an interface what its turn and its resultants do: `turned` is the moment [N m],
 * `work` the strains that go with n_nn, n_ns, m_nn, m_ns (times length), at each Gauss point. */
LANES_FUNCTION void shell_give_side(const double *table, size_t stride, double *slot,
                                    const int node[3], const vd *turned, vd (*work)[4])
{
    static const double edge_point[3] = FRACAS_EDGE_POINTS_2;
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
    double *forces = surface_at(slot, SHELL_SLOT_FORCE);
    UNROLL_FOR (int i = 0; i < SHELL_UNKNOWNS; i++)
        lanes_store(surface_at(forces, i), lanes_load(surface_at(forces, i)) + force[i]);
    const int bulk[3] = {node[0], node[1], 3 - node[0] - node[1]};
    UNROLL_FOR (int j = 0; j < SHELL_RESULTANTS; j++) { /* as resultants are read */
        const vd sum = strain[0][j] + strain[1][j] + strain[2][j],
                 off = lanes_set(2 * edge_point[2] - 1) * (strain[2][j] - strain[0][j]);
        const vd share = lanes_set(2.0 / 3) * sum,
                 extra[3] = {share - off, share + off, lanes_set(-1.0 / 3) * sum};
        UNROLL_FOR (int p = 0; p < 3; p++) {
            double *to = surface_at(slot, SHELL_SLOT_EXTRA + SHELL_RESULTANTS * bulk[p] + j);
            lanes_store(to, lanes_load(to) + extra[p]);
        }
    }
}

/* Gives the two elements forces, and strains at their bulk points  (shell.10). */
LANES_FUNCTION void shell_give(const shell_context *c, size_t i, const shell_sides *sides,
                               const shell_point at[SHELL_EDGE])
{
    static const double edge_point[3] = FRACAS_EDGE_POINTS_2;
    const double *table = c->tables->joint + i * (size_t)SHELL_JOINT_TABLE + SHELL_POINTS;
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
        fracas_edge_shape(2, edge_point[g], shape, spread);
        fracas_edge_slope(edge_point[g], slope);
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
        double *forces = surface_at(sides->slot[side], SHELL_SLOT_FORCE);
        UNROLL_FOR (int n = 0; n < 3; n++)
            UNROLL_FOR (int j = 0; j < 3; j++) {
                double *to = surface_at(forces, 3 * sides->node[side][n] + j);
                lanes_store(to, side ? lanes_load(to) + force[n][j] : lanes_load(to) - force[n][j]);
            }
    }
}

/* Rim r of element e, whose director does not turn about the edge  (shell.9). */
LANES_FUNCTION void shell_rim(shell_context *c, size_t e, size_t r)
{
    const double *rim = c->tables->rim + r * (size_t)SHELL_RIM_TABLE;
    const int k = c->tables->rim_edge[r], node[3] = {k, (k + 1) % 3, 3 + k};
    double *slot = c->slots + (e & c->tables->visits.window) * (size_t)(SHELL_SLOT * LANES);
    const vd zero = lanes_set(0.0), stiff = lanes_set(rim[SHELL_RIM_STIFFNESS]);
    vd u[SHELL_UNKNOWNS], turned[SHELL_EDGE], work[SHELL_EDGE][4], of[SHELL_EDGE][4];
    shell_load(c->elements + e * c->element_size, u);
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++)
        UNROLL_FOR (int j = 0; j < 4; j++) of[g][j] = zero;
    shell_resultants(slot, node, rim + SHELL_RIM_POINTS + SHELL_RIM_SIDE, SHELL_RIM_POINT_TABLE,
                     of);
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        const double *point = rim + SHELL_RIM_POINTS + g * SHELL_RIM_POINT_TABLE,
                     *side = point + SHELL_RIM_SIDE;
        const vd turn = shell_turn(side, u), length = lanes_set(point[SHELL_RIM_LENGTH]),
                 moment = of[g][2] + stiff * turn;
        c->flux += length * (turn * (of[g][2] + moment));
        turned[g] = length * moment;
        work[g][0] = work[g][1] = work[g][3] = zero;
        work[g][2] = length * turn;
    }
    shell_give_side(rim + SHELL_RIM_POINTS + SHELL_RIM_SIDE, SHELL_RIM_POINT_TABLE, slot, node,
                    turned, work);
}

/* The layers of a Gauss point by the law  (shell.12), (shell.13), (shell.15). */
LANES_FUNCTION shell_layers shell_layers_point(const shell_context *c,
                                               const plane_interface *interface,
                                               const shell_point *p, int law, double *fields, int g,
                                               shell_booked *booked)
{
    static const double place[SHELL_LAYERS] = SHELL_LAYER_PLACES,
                        weight[SHELL_LAYERS] = SHELL_LAYER_WEIGHTS;
    const fracas_shell_constants *s = c->shell;
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), per_h = lanes_set(1.0 / s->thickness);
    const double per_h3 = 12.0 / (s->thickness * s->thickness * s->thickness);
    shell_layers all = {.cracked = lanes_lt(one, zero),
                        .broken = lanes_lt(zero, one),
                        .whole = lanes_lt(zero, one),
                        .flux = zero,
                        .stored = zero,
                        .dissipated = zero,
                        .created = zero,
                        .rubbed = zero,
                        .spent = zero};
    vd used_n[2], used_m[2];
    UNROLL_FOR (int j = 0; j < 2; j++)
        all.n[j] = all.m[j] = all.carried_u[j] = all.carried_t[j] = used_n[j] = used_m[j] = zero;
    /* The mean stress is linear through the thickness and knows nothing of a face that is open:
     * what the layers beside it then carry, and what cracks them, is the flux  (shell.12) */
    vmask opened = lanes_lt(one, zero);
    UNROLL_FOR (int k = 0; k < SHELL_LAYERS; k++)
        opened = lanes_or(
            opened,
            lanes_lt(zero, lanes_load(surface_at(fields, k * s->point_fields + SURFACE_PEAK))));
    UNROLL_FOR (int k = 0; k < SHELL_LAYERS; k++) {
        double *point = surface_at(fields, k * s->point_fields);
        const vd z = lanes_set(place[k] * s->thickness), w = lanes_set(weight[k] * s->thickness),
                 bending = lanes_set(place[k] * s->thickness * per_h3);
        const vd share = lanes_set(weight[k]),
                 moment = lanes_set(12.0 * weight[k] * place[k] / s->thickness);
        vd mean[2], q[2];
        UNROLL_FOR (int j = 0; j < 2; j++) {
            mean[j] = p->mean_n[j] * per_h + bending * p->mean_m[j];
            q[j] = p->jump[j] + z * p->turn[j];
        }
        const plane_input in = {
            .m_n = mean[0], .m_t = mean[1], .q_n = q[0], .q_t = q[1], .opened = opened};
        all.whole = lanes_and(all.whole,
                              lanes_le(lanes_load(surface_at(point, SURFACE_PEAK)), zero));
        const plane_result r = plane_law(law, interface, &in, point);
        const vd flux_n = mean[0] + interface->k_n * q[0], flux_t = mean[1] + interface->k_t * q[1];
        const vd t[2] = {lanes_select(r.cracked, r.t_n, flux_n),
                         lanes_select(r.cracked, r.t_t, flux_t)};
        const vd carried[2] = {lanes_select(r.cracked, r.s_n, q[0]),
                               lanes_select(r.cracked, r.s_t, q[1])};
        const vd used[2] = {lanes_select(r.cracked, r.midway_n, flux_n),
                            lanes_select(r.cracked, r.midway_t, flux_t)};
        UNROLL_FOR (int j = 0; j < 2; j++) {
            all.n[j] += w * t[j];
            all.m[j] += w * z * t[j];
            all.carried_u[j] += share * carried[j];
            all.carried_t[j] += moment * carried[j];
            used_n[j] += w * used[j];
            used_m[j] += w * z * used[j];
        }
        const vd whole = lanes_set(0.5) * (q[0] * (mean[0] + flux_n) + q[1] * (mean[1] + flux_t));
        all.flux += w * lanes_select(r.cracked, r.flux, whole);
        all.stored += w * lanes_select(r.cracked, r.stored, zero);
        all.dissipated += w * r.dissipated;
        all.created += w * r.created;
        all.rubbed += w * lanes_select(r.cracked, r.rubbed, zero);
        all.spent += w * lanes_select(r.cracked, r.spent, zero);
        all.cracked = lanes_or(all.cracked, r.cracked);
        all.broken = lanes_and(all.broken,
                               lanes_le(one, lanes_load(surface_at(point, SURFACE_DAMAGE))));
        booked->cracks[g][k] = r.cracks;
        booked->breaks[g][k] = r.breaks;
    }
    /* by the work of N and of M on the jumps  (shell.15) */
    const vd stretched = plane_max(zero, used_n[0] * p->jump[0] + used_n[1] * p->jump[1]);
    const vd bent = plane_max(zero, used_m[0] * p->turn[0] + used_m[1] * p->turn[1]),
             sum = stretched + bent;
    all.spent_bending = all.spent * (bent / lanes_select(lanes_lt(zero, sum), sum, one));
    return all;
}

/* Books what happened at an interface, lane by lane. */
__attribute__((noinline, cold, unused)) static void
shell_book(const shell_context *c, size_t i, const shell_booked *booked, vmask opens, vmask parts)
{
    for (int l = 0; l < LANES; l++) {
        fracas_shell_event event = {.opens = lanes_get(opens, l), .parts = lanes_get(parts, l)};
        for (int g = 0; g < SHELL_EDGE; g++)
            for (int k = 0; k < SHELL_LAYERS; k++) {
                event.cracks[g][k] = lanes_get(booked->cracks[g][k], l);
                event.breaks[g][k] = lanes_get(booked->breaks[g][k], l);
            }
        if (event.opens || event.parts)
            fracas_shell_book(c->shell, c->step, c->first + l, i, &event);
    }
}

/* The way of an interface at which some lane is cracked, or is about to  (shell.14). `at` holds
 * what every lane does that is not. */
LANES_FUNCTION void shell_crack(shell_context *c, int law, size_t i, double *joint,
                                const double *strength, shell_point at[SHELL_EDGE])
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), two = lanes_set(2.0);
    const fracas_shell_constants *s = c->shell;
    const double *table = c->tables->joint + i * (size_t)SHELL_JOINT_TABLE;
    const vd stiffness = lanes_set(table[SHELL_STIFFNESS]);
    plane_interface interface = {.k_n = lanes_set(s->normal) * stiffness,
                                 .k_t = lanes_set(s->tangential) * stiffness,
                                 .softness_n = lanes_set(table[SHELL_COMPLIANCE] / s->normal),
                                 .softness_t = lanes_set(table[SHELL_COMPLIANCE] / s->tangential),
                                 .beta_c = lanes_set(s->beta_c),
                                 .per_beta_c = lanes_set(1.0 / s->beta_c),
                                 .mu_c = lanes_set(s->mu_c),
                                 .energy = lanes_set(s->energy),
                                 .opening = lanes_set(s->opening),
                                 .onset_mean = s->onset_mean,
                                 .friction = s->friction};
    vmask whole = lanes_le(zero, zero), broken = whole, opens = lanes_lt(one, zero), parts = opens;
    vd created = zero, rubbed = zero, bending = zero;
    shell_booked booked;
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        double *fields = surface_at(joint, g * SHELL_LAYERS * s->point_fields);
        interface.sigma_c = lanes_load(strength + (size_t)g * c->strength_step);
        const vd length = lanes_set(table[SHELL_POINTS + g * SHELL_POINT_TABLE + SHELL_LENGTH]);
        shell_point *p = &at[g];
        const shell_layers all = shell_layers_point(c, &interface, p, law, fields, g, &booked);
        vmask breaks = lanes_lt(one, zero);
        UNROLL_FOR (int k = 0; k < SHELL_LAYERS; k++) {
            opens = lanes_or(opens, booked.cracks[g][k]);
            breaks = lanes_or(breaks, booked.breaks[g][k]);
        }
        /* what holds the faces against shearing off goes with the last layer */
        const vd sheared = p->shearing * p->lift, kept = lanes_select(all.broken, zero, sheared);
        c->flux += length *
                   (lanes_select(all.cracked, two * all.flux, shell_flux_energy(p)) + kept);
        c->stored += length * lanes_select(all.cracked, two * all.stored, zero);
        c->dissipated += length * all.dissipated;
        created += length * (all.created - lanes_select(lanes_and(all.broken, breaks),
                                                        lanes_set(0.5) * sheared, zero));
        rubbed += length * all.rubbed;
        bending += length * all.spent_bending;
        p->shearing = lanes_select(all.broken, zero, p->shearing);
        UNROLL_FOR (int j = 0; j < 2; j++) {
            p->n[j] = lanes_select(all.cracked, all.n[j], p->n[j]);
            p->m[j] = lanes_select(all.cracked, all.m[j], p->m[j]);
            p->carried_u[j] = lanes_select(all.cracked, all.carried_u[j], p->carried_u[j]);
            p->carried_t[j] = lanes_select(all.cracked, all.carried_t[j], p->carried_t[j]);
        }
        whole = lanes_and(whole, all.whole);
        broken = lanes_and(broken, all.broken);
        parts = lanes_or(parts, breaks);
    }
    fracas_step *step = c->step;
    double *const sum[3] = {step->created + c->first, step->rubbed + c->first,
                            step->dissipated_bending + c->first};
    lanes_store(sum[0], lanes_load(sum[0]) + created);
    lanes_store(sum[1], lanes_load(sum[1]) + rubbed);
    lanes_store(sum[2], lanes_load(sum[2]) + bending);
    opens = lanes_and(opens, whole);  /* the first of its points */
    parts = lanes_and(parts, broken); /* the last */
    if (__builtin_expect(lanes_any(lanes_or(opens, parts)), 0))
        shell_book(c, i, &booked, opens, parts);
}

/* Interface i: tractions at its Gauss points, and what they do to its elements. */
LANES_FUNCTION void shell_join(shell_context *c, int law, size_t i)
{
    const fracas_shell_constants *s = c->shell;
    const shell_sides sides = shell_sides_of(c, i);
    double *joint = c->joints + i * c->joint_size;
    const double *strength = c->strengths + i * c->strengths_size;
    shell_point at[SHELL_EDGE];
    shell_flux(c, i, &sides, at);
    if (law == SURFACE_OPERATOR) {
        UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
            if (!s->contact) continue;
            at[g].shearing = lanes_set(0.0);
            UNROLL_FOR (int j = 0; j < 2; j++) {
                at[g].n[j] = at[g].n[j] - at[g].mean_n[j];
                at[g].m[j] = at[g].m[j] - at[g].mean_m[j];
                at[g].carried_u[j] = at[g].carried_t[j] = lanes_set(0.0);
            }
        }
        shell_give(c, i, &sides, at);
        return;
    }
    /* No lane is past its onset where none has a peak and no traction is near the least strength:
     * an onset needs |T| >= min(1, beta_c) sigma_c in some layer, and both faces, where |T| is
     * largest, are looked at; the margin covers its round-off, so that lanes do not depend on each
     * other. */
    const vd per_h = lanes_set(1.0 / s->thickness),
             per_h2 = lanes_set(6.0 / (s->thickness * s->thickness));
    vd largest = lanes_set(0.0), touched = lanes_set(0.0), weakest = lanes_load(strength);
    UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
        const vd *n = s->onset_mean ? at[g].mean_n : at[g].n,
                 *m = s->onset_mean ? at[g].mean_m : at[g].m;
        const vd stretch[2] = {n[0] * per_h, n[1] * per_h},
                 bend[2] = {m[0] * per_h2, m[1] * per_h2};
        const vd cross = plane_abs(stretch[0] * bend[0] + stretch[1] * bend[1]);
        const vd square = stretch[0] * stretch[0] + stretch[1] * stretch[1] +
                          (bend[0] * bend[0] + bend[1] * bend[1]);
        weakest = plane_min(weakest, lanes_load(strength + (size_t)g * c->strength_step));
        largest = plane_max(largest, square + (cross + cross));
        UNROLL_FOR (int k = 0; k < SHELL_LAYERS; k++)
            touched += lanes_load(
                surface_at(joint, (g * SHELL_LAYERS + k) * s->point_fields + SURFACE_PEAK));
    }
    const vd floor = lanes_set(0.999 * (s->beta_c < 1.0 ? s->beta_c : 1.0)) * weakest;
    if (lanes_any(lanes_or(lanes_lt(lanes_set(0.0), touched), lanes_lt(floor * floor, largest)))) {
        shell_crack(c, law, i, joint, strength, at);
    } else {
        const double *table = c->tables->joint + i * (size_t)SHELL_JOINT_TABLE;
        UNROLL_FOR (int g = 0; g < SHELL_EDGE; g++) {
            const shell_point *p = &at[g];
            const vd length = lanes_set(table[SHELL_POINTS + g * SHELL_POINT_TABLE + SHELL_LENGTH]);
            c->flux += length * (shell_flux_energy(p) + p->shearing * p->lift);
        }
    }
    shell_give(c, i, &sides, at);
}

#endif
