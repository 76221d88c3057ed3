/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law at a Gauss point of a shell's interface, at its layers or on its resultants, for
 * shell_kernel.c alone. */
#ifndef FRACAS_ENGINE_FORMULATION_SHELL_CRACK_H
#define FRACAS_ENGINE_FORMULATION_SHELL_CRACK_H

#include "engine/formulation/shell/shell.h"
#include "engine/formulation/surface/kernel.h"

/* At one Gauss point of an interface: along its normal and along the edge  (shell.5) to (shell.8).
 */
typedef struct {
    vd jump[2], turn[2], lift;     /* [u] [m], [Dt] [1], [u].t [m] */
    vd mean_n[2], mean_m[2];       /* <N> [N/m], <M> [N] */
    vd n[2], m[2], shearing;       /* tractions N [N/m], M [N], and across the surface [N/m] */
    vd carried_u[2], carried_t[2]; /* the flux's part of the jumps [m], [1] */
} shell_point;

/* Twice the flux's energy at a whole Gauss point, without shearing off [J/m]  (shell.7) */
LANES_FUNCTION vd shell_energy(const shell_point *p)
{
    return p->jump[0] * (p->mean_n[0] + p->n[0]) + p->jump[1] * (p->mean_n[1] + p->n[1]) +
           (p->turn[0] * (p->mean_m[0] + p->m[0]) + p->turn[1] * (p->mean_m[1] + p->m[1]));
}

static const double layer_place[SHELL_LAYERS] = SHELL_LAYER_PLACES;

LANES_FUNCTION plane_input shell_input(const fracas_surface_constants *s, const double *place,
                                       const shell_point *p, int layer)
{
    (void)place;
    const double h = s->thickness, z = layer_place[layer] * h;
    const vd per_h = lanes_set(1.0 / h), bending = lanes_set(z * (12.0 / (h * h * h)));
    return (plane_input){.m_n = p->mean_n[0] * per_h + bending * p->mean_m[0],
                         .m_t = p->mean_n[1] * per_h + bending * p->mean_m[1],
                         .q_n = p->jump[0] + lanes_set(z) * p->turn[0],
                         .q_t = p->jump[1] + lanes_set(z) * p->turn[1]};
}

/* Sums over the layers of a Gauss point. */
typedef struct {
    surface_opening all; /* but for its bending and shearing off */
    vd n[2], m[2], carried_u[2], carried_t[2];
    vd used_n[2], used_m[2]; /* N, M at the damage halfway through the step */
    vd spent;                /* dissipated in this step */
    vmask cracked, breaks;   /* some layer is past its onset, breaks in this step */
} shell_layers;

LANES_FUNCTION shell_layers shell_no_layers(void)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    shell_layers of;
    of.all.flux = of.all.stored = of.all.dissipated = of.all.created = of.all.rubbed = zero;
    of.all.whole = of.all.broken = lanes_lt(zero, one);
    of.cracked = of.breaks = lanes_lt(one, zero);
    of.spent = zero;
    UNROLL_FOR (int j = 0; j < 2; j++)
        of.n[j] = of.m[j] = of.carried_u[j] = of.carried_t[j] = of.used_n[j] = of.used_m[j] = zero;
    return of;
}

/* Adds layer k by the law  (shell.12), (shell.13), (shell.14). */
LANES_FUNCTION plane_result shell_layer(const surface_context *c, const plane_interface *interface,
                                        int law, int k, const plane_input *in, double *point,
                                        shell_layers *of)
{
    static const double weight[SHELL_LAYERS] = SHELL_LAYER_WEIGHTS;
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    const double h = c->constants->thickness;
    const vd z = lanes_set(layer_place[k] * h), w = lanes_set(weight[k] * h);
    const vd share = lanes_set(weight[k]),
             moment = lanes_set(12.0 * weight[k] * layer_place[k] / h);
    surface_opening *all = &of->all;
    all->whole = lanes_and(all->whole, lanes_le(lanes_load(surface_at(point, SURFACE_PEAK)), zero));
    const plane_result r = plane_law(law, interface, in, point);
    const plane_traction flux = plane_flux(interface, in);
    const vd t[2] = {lanes_select(r.cracked, r.t_n, flux.n),
                     lanes_select(r.cracked, r.t_t, flux.t)};
    const vd carried[2] = {lanes_select(r.cracked, r.s_n, in->q_n),
                           lanes_select(r.cracked, r.s_t, in->q_t)};
    const vd used[2] = {lanes_select(r.cracked, r.midway_n, flux.n),
                        lanes_select(r.cracked, r.midway_t, flux.t)};
    UNROLL_FOR (int j = 0; j < 2; j++) {
        of->n[j] += w * t[j];
        of->m[j] += w * z * t[j];
        of->carried_u[j] += share * carried[j];
        of->carried_t[j] += moment * carried[j];
        of->used_n[j] += w * used[j];
        of->used_m[j] += w * z * used[j];
    }
    const vd whole = lanes_set(0.5) * (in->q_n * (in->m_n + flux.n) + in->q_t * (in->m_t + flux.t));
    all->flux += w * lanes_select(r.cracked, r.flux, whole);
    all->stored += w * lanes_select(r.cracked, r.stored, zero);
    all->dissipated += w * r.dissipated;
    all->created += w * r.created;
    all->rubbed += w * lanes_select(r.cracked, r.rubbed, zero);
    all->broken = lanes_and(all->broken, lanes_le(one, r.damage));
    of->spent += w * lanes_select(r.cracked, r.spent, zero);
    of->cracked = lanes_or(of->cracked, r.cracked);
    of->breaks = lanes_or(of->breaks, r.breaks);
    return r;
}

/* All of them; `state`: masks as in plane_input. */
LANES_FUNCTION shell_layers shell_evaluate(const surface_context *c,
                                           const plane_interface *interface, int law,
                                           const double *place, const shell_point *p,
                                           const plane_input *state, double *fields,
                                           const surface_marks *marks)
{
    shell_layers of = shell_no_layers();
    UNROLL_FOR (int k = 0; k < SHELL_LAYERS; k++) {
        plane_input in = shell_input(c->constants, place, p, k);
        in.opened = state->opened;
        in.were_broken = state->were_broken;
        in.are_broken = state->are_broken;
        const plane_result r = shell_layer(c, interface, law, k, &in,
                                           surface_at(fields, k * c->constants->point_fields), &of);
        marks->damage[k] = r.damage;
        marks->cracks[k] = r.cracks;
        marks->breaks[k] = r.breaks;
    }
    return of;
}

/* The law at all layers, and their sums  (shell.14). */
LANES_FUNCTION shell_layers shell_at_layers(const surface_context *c,
                                            const plane_interface *interface, int law,
                                            const double *place, const shell_point *p,
                                            double *fields, const surface_marks *marks)
{
    const int size = SHELL_LAYERS * c->constants->point_fields;
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    /* The mean stress is linear through the thickness and knows nothing of an open face. The layers
     * beside it carry the flux, and it cracks them  (shell.12). */
    vmask opened = lanes_lt(one, zero), broken = lanes_lt(zero, one);
    UNROLL_FOR (int k = 0; k < SHELL_LAYERS; k++) {
        const double *point = fields + k * c->constants->point_fields * LANES;
        opened = lanes_or(opened, lanes_lt(zero, lanes_load(point + SURFACE_PEAK * LANES)));
        broken = lanes_and(broken, lanes_le(one, lanes_load(point + SURFACE_DAMAGE * LANES)));
    }
    /* The step in which the last layer breaks is done again: all lose their means in it. */
    vd before[SHELL_LAYERS * SURFACE_POINT_FIELDS_MOST];
    if (!interface->calm)
        for (int i = 0; i < size; i++) before[i] = lanes_load(surface_at(fields, i));
    plane_input state = {.opened = opened, .were_broken = broken, .are_broken = broken};
    shell_layers of = shell_evaluate(c, interface, law, place, p, &state, fields, marks);
    if (!interface->calm && lanes_any(lanes_and(of.all.broken, of.breaks))) {
        for (int i = 0; i < size; i++) lanes_store(surface_at(fields, i), before[i]);
        state.are_broken = of.all.broken;
        of = shell_evaluate(c, interface, law, place, p, &state, fields, marks);
    }
    return of;
}

LANES_FUNCTION resultant_input shell_resultant_input(const fracas_surface_constants *s,
                                                     const shell_point *p)
{
    resultant_input in = {.thickness = s->thickness};
    UNROLL_FOR (int j = 0; j < 2; j++) {
        in.jump[j] = p->jump[j];
        in.turn[j] = p->turn[j];
        in.mean_n[j] = p->mean_n[j];
        in.mean_m[j] = p->mean_m[j];
        in.flux_n[j] = p->n[j];
        in.flux_m[j] = p->m[j];
    }
    return in;
}

/* A law on resultants, in place of its layers. */
LANES_FUNCTION shell_layers shell_at_resultants(const surface_context *c,
                                                const plane_interface *interface, int law,
                                                const shell_point *p, double *fields,
                                                const surface_marks *marks)
{
    shell_layers of = shell_no_layers();
    const vmask whole = lanes_le(lanes_load(surface_at(fields, SURFACE_PEAK)), lanes_set(0.0));
    const resultant_input in = shell_resultant_input(c->constants, p);
    const resultant_result r = resultant_law(law, interface, &in, fields);
    of.all.whole = whole;
    of.all.broken = lanes_le(lanes_set(1.0), r.damage);
    of.all.stored = r.stored;
    of.all.dissipated = r.dissipated;
    of.all.created = r.created;
    of.spent = r.spent;
    of.cracked = r.cracked;
    of.breaks = r.breaks;
    UNROLL_FOR (int j = 0; j < 2; j++) {
        of.n[j] = r.n[j];
        of.m[j] = r.m[j];
        of.used_n[j] = r.midway_n[j];
        of.used_m[j] = r.midway_m[j];
    }
    UNROLL_FOR (int k = 0; k < SHELL_LAYERS; k++) {
        marks->damage[k] = r.damage;
        marks->cracks[k] = r.cracks[k];
        marks->breaks[k] = r.breaks;
    }
    return of;
}

LANES_FUNCTION vd shell_opening(const fracas_surface_constants *s, const plane_interface *interface,
                                const plane_input *layer, const shell_point *p, int k,
                                const double *fields)
{
    if (!law_takes_resultants(s->law))
        return plane_opening(s->law, interface, layer, fields + k * s->point_fields * LANES);
    const resultant_input in = shell_resultant_input(s, p);
    return resultant_opening(s->law, interface, &in, fields);
}

/* The law at a Gauss point, and bending's share  (shell.14), (shell.15). */
LANES_FUNCTION surface_opening shell_crack(const surface_context *c,
                                           const plane_interface *interface, int law,
                                           const double *place, shell_point *p, double *fields,
                                           const surface_marks *marks)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), two = lanes_set(2.0);
    const shell_layers of = law_takes_resultants(law)
                                ? shell_at_resultants(c, interface, law, p, fields, marks)
                                : shell_at_layers(c, interface, law, place, p, fields, marks);
    surface_opening all = of.all;
    /* by the work of N and of M on the jumps  (shell.15) */
    const vd stretched = plane_max(zero, of.used_n[0] * p->jump[0] + of.used_n[1] * p->jump[1]);
    const vd bent = plane_max(zero, of.used_m[0] * p->turn[0] + of.used_m[1] * p->turn[1]),
             sum = stretched + bent;
    all.bending = of.spent * (bent / lanes_select(lanes_lt(zero, sum), sum, one));
    /* the stiffness against shearing off goes with the last layer  (shell.14) */
    const vd sheared = p->shearing * p->lift, kept = lanes_select(all.broken, zero, sheared);
    all.flux = lanes_select(of.cracked, two * all.flux, shell_energy(p)) + kept;
    all.stored = lanes_select(of.cracked, two * all.stored, zero);
    all.created = all.created -
                  lanes_select(lanes_and(all.broken, of.breaks), lanes_set(0.5) * sheared, zero);
    p->shearing = lanes_select(all.broken, zero, p->shearing);
    UNROLL_FOR (int j = 0; j < 2; j++) {
        p->n[j] = lanes_select(of.cracked, of.n[j], p->n[j]);
        p->m[j] = lanes_select(of.cracked, of.m[j], p->m[j]);
        p->carried_u[j] = lanes_select(of.cracked, of.carried_u[j], p->carried_u[j]);
        p->carried_t[j] = lanes_select(of.cracked, of.carried_t[j], p->carried_t[j]);
    }
    return all;
}

#endif
