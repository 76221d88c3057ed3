/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ring's sweep with laws in series with the flux: central difference, one pass. */
#ifndef FRACAS_ENGINE_CHAIN_RING_NITSCHE_H
#define FRACAS_ENGINE_CHAIN_RING_NITSCHE_H

#include "engine/formulation/chain/ring_kinematics.h"

LANES_FUNCTION ring_element ring_load(const ring_context *c, size_t e)
{
    ring_element element = ring_read_element(c->state + e * RING_FIELDS * LANES);
    element.u_left = ring_add(element.u_left, ring_scale(c->drift, element.v_left));
    element.u_right = ring_add(element.u_right, ring_scale(c->drift, element.v_right));
    ring_stretch(c, e, &element);
    return element;
}

LANES_FUNCTION ring_link ring_join(ring_context *c, int law, size_t e, const ring_element *left,
                                   const ring_element *right)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    double *at = c->state + e * RING_FIELDS * LANES;
    vd before = lanes_load(at + RING_DAMAGE * LANES);
    const ring_frame frame = ring_frame_of(c, e, left, right);
    const ring_vector jump = ring_subtract(right->u_left, left->u_right);
    vd q = ring_dot(jump, frame.n), p = ring_dot(jump, frame.r); /* (ring.5) */
    vd mean = half * (left->stress + right->stress), compliance = lanes_set(1.0 / c->ring->spring);
    const line_input in = {.mean = mean,
                           .jump = q,
                           .damage = before,
                           .sigma_c = lanes_load(at + RING_STRENGTH * LANES),
                           .constant = lanes_load(at + RING_LAW * LANES),
                           .stiffness = c->spring,
                           .compliance = compliance};
    const line_result it = line_law(law, &in);
    lanes_store(at + RING_DAMAGE * LANES, it.damage);
    /* the radial jump is restrained by the same stiffness until the interface cracks  (ring.6) */
    vd restraint = lanes_select(lanes_le(it.damage, zero), c->spring * p, zero);

    c->flux_energy += it.slip * (mean + it.traction) + restraint * p;
    c->cohesive += it.traction * (q - it.slip);
    c->dissipated += it.dissipated;

    vmask grows = lanes_lt(before, it.damage);
    vmask cracks = lanes_and(grows, lanes_le(before, zero)),
          breaks = lanes_and(grows, lanes_le(one, it.damage));
    if (__builtin_expect(lanes_any(lanes_or(cracks, breaks)), 0)) {
        vd rate = ring_stress_rate(c, left, right) +
                  c->spring * ring_dot(ring_subtract(right->v_left, left->v_right), frame.n);
        vd time = lanes_load(c->step->time + c->first);
        chain_note_events(
            c->step, c->first, c->ring->area, e,
            &(chain_events){.cracks = cracks,
                            .breaks = breaks,
                            .onset = time - it.past_onset / rate,
                            .broke = time - (it.past_onset - it.softening) / rate,
                            .at_onset = zero - half * c->spring * p * p,   /* (ring.7) */
                            .at_break = half * mean * mean * compliance}); /* (cohesive.6) */
    }
    vd couple = (it.traction * p - restraint * q) * frame.turn; /* (ring.9) */
    return (ring_link){
        .force = ring_add(ring_scale(it.traction, frame.n), ring_scale(restraint, frame.r)),
        .slip = it.slip,
        .couple = ring_scale(couple, frame.r)};
}

/* Forces and kick of one element, and its share of the sums. */
LANES_FUNCTION void ring_finish(ring_context *c, size_t e, const ring_element *element,
                                const ring_link *left, const ring_link *right)
{
    const vd half = lanes_set(0.5);
    double *at = c->state + e * RING_FIELDS * LANES;
    vd normal = element->stress + half * c->modulus * (left->slip + right->slip);
    ring_vector internal = ring_scale(normal, element->tangent); /* (ring.8) */
    if (c->ring->current) internal = ring_add(internal, ring_add(left->couple, right->couple));
    ring_vector v_left = ring_drive_node(c, e, element->u_left, element->v_left,
                                         ring_subtract(internal, left->force));
    ring_vector v_right = ring_drive_node(c, e + 1 < c->ring->elements ? e + 1 : 0,
                                          element->u_right, element->v_right,
                                          ring_subtract(right->force, internal));
    ring_add_element(c, element, ring_dot(element->v_left, v_left),
                     ring_dot(element->v_right, v_right));
    ring_write(at + RING_U_LEFT * LANES, element->u_left);
    ring_write(at + RING_U_RIGHT * LANES, element->u_right);
    ring_write(at + RING_V_LEFT * LANES, v_left);
    ring_write(at + RING_V_RIGHT * LANES, v_right);
}

LANES_FUNCTION void ring_flux(const fracas_ring_constants *ring, fracas_step *step, int first,
                              int law)
{
    const size_t last = ring->elements - 1;
    const vd dt = lanes_load(step->kick + first);
    ring_context context = ring_context_of(ring, step, first, RING_FIELDS, dt, lanes_set(0.5) * dt),
                 *c = &context;

    /* One pass in place, as the bar's; the closing interface comes first. */
    ring_element element = ring_load(c, 0), end = ring_load(c, last);
    const ring_link closing = ring_join(c, law, last, &end, &element);
    ring_element next = ring_load(c, 1);
    ring_link left, right = ring_join(c, law, 0, &element, &next);
    ring_finish(c, 0, &element, &closing, &right);
    for (size_t e = 1; e < last; e++) {
        left = right;
        element = next;
        next = ring_load(c, e + 1);
        right = ring_join(c, law, e, &element, &next);
        ring_finish(c, e, &element, &left, &right);
    }
    ring_finish(c, last, &next, &right, &closing);

    const vd area = lanes_set(ring->area), half_area = lanes_set(0.5 * ring->area);
    ring_totals(c, half_area * (lanes_set(ring->size) * c->elastic + c->flux_energy),
                area * lanes_set(ring->fracture_energy) * c->dissipated);
}

#endif
