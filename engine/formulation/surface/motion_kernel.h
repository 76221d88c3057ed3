/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of a surface over lanes: elements with nodes that a load moves
 * (docs/theory/loads.md). They are few: functions of their own, for any order. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_MOTION_KERNEL_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_MOTION_KERNEL_H

#include "engine/formulation/surface/rotary_kernel.h"

/* An element's unknowns: velocities and forces in, accelerations out; directions, 0 of those not
 * moved, and the accelerations that lead moved ones along. */
typedef struct {
    vd velocity[18], force[18], acceleration[18], direction[18], lead[18];
} surface_moving;

LANES_FUNCTION int surface_is_moved(const surface_context *c, size_t e)
{
    return __builtin_expect(c->tables->moved != NULL, 0) && c->tables->moved[e] != 0;
}

LANES_FUNCTION const double *surface_direction(const surface_context *c, int size, size_t e)
{
    return c->tables->direction + (c->tables->moved_row[e] - 1) * (size_t)size;
}

/* Which motion moves it. */
LANES_FUNCTION int surface_mover(const surface_context *c, size_t e)
{
    return c->tables->moved_by[c->tables->moved_row[e] - 1];
}

/* Places moved unknowns, u = s(t_n) d: no rounding of a step is left  (loads.5) */
__attribute__((noinline, cold)) static void surface_place_moved(const surface_context *c, int order,
                                                                size_t e, double *at)
{
    const int size = BODY_SIZE(order);
    const double *direction = surface_direction(c, size, e);
    const vd path = lanes_load(c->step->path[surface_mover(c, e)] + c->first);
    const double *start = c->tables->start ? c->tables->start + (direction - c->tables->direction)
                                           : NULL;
    for (int i = 0; i < size; i++) {
        if (!(c->tables->moved[e] >> i & 1)) continue;
        const vd moved = path * lanes_set(direction[i]);
        lanes_store(surface_at(at, SURFACE_U * size + i),
                    start ? moved + lanes_set(start[i]) : moved); /* (initial.4) */
    }
}

/* Adds M x to the forces on an element's nodes. */
LANES_FUNCTION void surface_add_inertia(const surface_context *c, int order, size_t e, const vd *x,
                                        vd *force)
{
    const fracas_surface_tables *t = c->tables;
    const int nodes = SURFACE_NODES(order);
    const double *lumped = t->lumped + e * (size_t)(2 * nodes) + nodes,
                 *consistent = BODY_PLANE && t->consistent
                                   ? t->consistent + (3 * e + 2) * (size_t)(nodes * nodes)
                                   : NULL;
    for (int i = 0; i < BODY_SIZE(order); i++) {
        const int k = i / BODY_DIMENSION;
        if (!consistent) force[i] += lanes_set(lumped[k]) * x[i];
        for (int l = 0; consistent && l < nodes; l++)
            force[i] += lanes_set(consistent[k * nodes + l]) *
                        x[BODY_DIMENSION * l + i % BODY_DIMENSION];
    }
    if (BODY_DIMENSION < 3 || !t->rotary) return;
    const double *rotary = t->rotary + e * SURFACE_ROTARY_TABLE; /* (shell.16) */
    vd along[6];
    surface_turning(rotary, x, along);
    for (int k = 0; k < 6; k++) {
        const vd moment = surface_row(rotary + SURFACE_ROTARY, k, along);
        for (int i = 0; i < 3; i++)
            force[3 * k + i] += lanes_set(rotary[SURFACE_TURNING + i]) * moment;
    }
}

/* The body force of a spun membrane on moved unknowns, along their path: d . M w^2 x. It is no
 * reaction  (membrane.10), (loads.8) */
LANES_FUNCTION vd surface_spin_along(const surface_context *c, int order, size_t e,
                                     const vd *direction)
{
    const int size = BODY_SIZE(order);
    vd spun[18], force[18], sum = lanes_set(0.0);
    for (int i = 0; i < size; i++) {
        spun[i] = c->spin * lanes_set(c->tables->position[e * (size_t)size + (size_t)i]);
        force[i] = lanes_set(0.0);
    }
    surface_add_inertia(c, order, e, spun, force);
    for (int i = 0; i < size; i++) sum += direction[i] * force[i];
    return sum;
}

/* Acceleration of an unknown that goes on by `ahead` [m] in its next step, with its velocity v and
 * a_n of Hulbert and Chung's scheme, of which it is (1 - am) a_{n+1} + am a_n  (loads.7) */
LANES_FUNCTION vd surface_lead_by(const fracas_surface_motion *m, vd dt, vmask begins, vd ahead,
                                  vd v, vd now)
{
    const vd needed = (ahead / dt - v) / dt;
    if (!m->alpha) return needed;
    const vd next = (needed - lanes_set(0.5 - m->b) * now) / lanes_set(m->b);
    return lanes_select(begins, lanes_set(2.0) * needed, /* a_1 = a_0 */
                        lanes_set(1.0 - m->alpha_m) * next + lanes_set(m->alpha_m) * now);
}

/* Finds directions and leading accelerations, and adds the inertia of these to the forces, which
 * then push the other unknowns, and are the reactions of moved ones. */
LANES_FUNCTION void surface_lead_moved(const surface_context *c, int order, size_t e, double *at,
                                       surface_moving *of)
{
    const fracas_surface_motion *m = &c->constants->motion;
    const int size = BODY_SIZE(order), motion = surface_mover(c, e);
    const double *direction = surface_direction(c, size, e);
    const vd path = lanes_load(c->step->path_next[motion] + c->first) -
                    lanes_load(c->step->path[motion] + c->first);
    for (int i = 0; i < size; i++) {
        const vd none = lanes_set(0.0),
                 now = m->alpha ? lanes_load(surface_at(at, SURFACE_A_NEXT * size + i)) : none;
        of->direction[i] = of->lead[i] = none;
        if (!(c->tables->moved[e] >> i & 1)) continue;
        of->direction[i] = lanes_set(direction[i]);
        of->lead[i] = surface_lead_by(m, c->kick, c->begins, path * of->direction[i],
                                      of->velocity[i], now);
    }
    surface_add_inertia(c, order, e, of->lead, of->force);
}

#endif
