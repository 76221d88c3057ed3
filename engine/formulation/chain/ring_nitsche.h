/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ring's sweep with laws in series with the flux: central difference, one pass. */
#ifndef FRACAS_ENGINE_CHAIN_RING_NITSCHE_H
#define FRACAS_ENGINE_CHAIN_RING_NITSCHE_H

#include "engine/cohesive/balance.h"
#include "engine/formulation/chain/ring_kinematics.h"

/* Action of an interface on its two elements. */
typedef struct {
    ring_vector force;  /* on the left element's node, minus that on the right one's [Pa] */
    ring_vector couple; /* turns both chords along with the interface's direction [Pa] */
    vd moment;          /* turns each against the other [Pa m]  (ring.19) */
    vd slip;            /* q - delta [m] */
} ring_link;

/* Fields of element e. */
LANES_FUNCTION double *ring_at(const ring_context *c, size_t e)
{
    return c->state + e * RING_FIELDS * LANES;
}

/* Displacement at t_n of a node whose displacement is at `u`, and its velocity at `v`. */
LANES_FUNCTION ring_vector ring_drift(const ring_context *c, double *u, const double *v)
{
    const ring_vector now = ring_add(ring_read(u), ring_scale(c->drift, ring_read(v)));
    ring_write(u, now);
    return now;
}

/* Element e at t_n, to which its displacements are brought. */
LANES_FUNCTION void ring_load(const ring_context *c, size_t e, ring_element *element)
{
    double *at = ring_at(c, e);
    const ring_vector left = ring_drift(c, at + RING_U_LEFT * LANES, at + RING_V_LEFT * LANES),
                      right = ring_drift(c, at + RING_U_RIGHT * LANES, at + RING_V_RIGHT * LANES);
    ring_stretch(c, e, ring_subtract(right, left), element);
}

/* Time derivative of the trial traction within the step [Pa/s]; the direction turns with the
 * elements' chords  (balance.6). `jump` across the interface. */
LANES_FUNCTION vd ring_trial_rate(const ring_context *c, const ring_element *left,
                                  const ring_element *right, const double *at,
                                  const double *at_right, const ring_frame *frame, vd across,
                                  vmask broken)
{
    const ring_vector parting = ring_jump(at, at_right, RING_V_LEFT);
    vd opening = ring_dot(parting, frame->n);
    if (c->ring->current) {
        const ring_vector chords = ring_add(ring_difference(at, RING_V_LEFT),
                                            ring_difference(at_right, RING_V_LEFT));
        opening += across * frame->turn * ring_dot(chords, ring_outward(frame->n));
    }
    return c->spring * opening +
           lanes_select(broken, lanes_set(0.0), ring_stress_rate(c, left, right, at, at_right));
}

LANES_FUNCTION void ring_interface(ring_context *c, int law, int balanced, size_t e,
                                   const ring_element *left, const ring_element *right,
                                   const ring_frame *frame, ring_link *link)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    double *at = ring_at(c, e), *at_right = ring_at(c, ring_next(c, e));
    vd before = lanes_load(at + RING_DAMAGE * LANES);
    const ring_vector jump = ring_jump(at, at_right, RING_U_LEFT);
    const ring_vector r = ring_outward(frame->n);
    vd q = ring_dot(jump, frame->n), p = ring_dot(jump, r); /* (ring.5) */
    vd mean = half * (left->stress + right->stress);
    const line_input in = {.mean = mean,
                           .jump = q,
                           .damage = before,
                           .sigma_c = lanes_load(at + RING_STRENGTH * LANES),
                           .constant = lanes_load(at + RING_LAW * LANES),
                           .stiffness = c->spring,
                           .compliance = c->compliance,
                           .own = c->ring->own};
    const line_result it = line_law(law, &in);
    lanes_store(at + RING_DAMAGE * LANES, it.damage);
    /* until it breaks the radial jump is restrained by the same stiffness, and the angle between
     * the chords by a section as thick as an element is long  (ring.6), (ring.19) */
    const vmask whole = lanes_lt(it.damage, one);
    vd restraint = lanes_select(whole, c->spring * p, zero);
    const vd bent = ring_cross(left->tangent, right->tangent) - c->corner;
    vd moment = lanes_select(whole, c->bending * bent, zero);

    c->flux_energy += it.slip * (mean + it.traction) + restraint * p + moment * bent;
    c->cohesive += it.traction * (q - it.slip);
    c->dissipated += it.dissipated;

    vmask grows = lanes_lt(before, it.damage);
    vmask cracks = lanes_and(grows, lanes_le(before, zero)),
          breaks = lanes_and(grows, lanes_le(one, it.damage));
    if (__builtin_expect(lanes_any(lanes_or(cracks, breaks)), 0)) {
        vd rate = ring_stress_rate(c, left, right, at, at_right) +
                  c->spring * ring_dot(ring_jump(at, at_right, RING_V_LEFT), frame->n);
        vd time = lanes_load(c->step->time + c->first);
        chain_note_events(
            c->step, c->first, c->ring->area, e,
            &(chain_events){.cracks = cracks,
                            .breaks = breaks,
                            .onset = time - it.past_onset / rate,
                            .broke = time - (it.past_onset - it.softening) / rate,
                            .at_onset = zero,
                            .at_break = half * mean * mean * c->compliance - /* (cohesive.6) */
                                        half * (c->spring * p * p +          /* (ring.7) */
                                                c->bending * bent * bent)});
    }
    /* forces have the balance of a crossing, energies do not */
    vd traction = it.traction, slip = it.slip;
    if (balanced) {
        const vd rate = ring_trial_rate(c, left, right, at, at_right, frame, p,
                                        lanes_le(one, before));
        const vd extra = balance_traction(&c->coupling, &in, &it, c->drift * rate);
        traction += extra;
        slip += lanes_select(lanes_le(one, it.damage), zero, extra * c->compliance);
    }
    vd couple = (traction * p - restraint * q) * frame->turn; /* (ring.9) */
    link->couple = ring_scale(couple, r);
    link->moment = moment * ring_dot(left->tangent, right->tangent);
    link->force = ring_add(ring_scale(traction, frame->n), ring_scale(restraint, r));
    link->slip = slip;
}

/* Forces and kick of one element, and its share of the sums. */
LANES_FUNCTION void ring_finish(ring_context *c, size_t e, const ring_element *element,
                                const ring_link *left, const ring_link *right)
{
    const vd half = lanes_set(0.5);
    double *at = ring_at(c, e);
    vd normal = element->stress + half * c->modulus * (left->slip + right->slip);
    ring_vector internal = ring_scale(normal, element->tangent); /* (ring.8) */
    if (c->ring->current) internal = ring_add(internal, ring_add(left->couple, right->couple));
    const vd bend = (right->moment - left->moment) * element->per_length;
    internal.x += bend * element->tangent.y;
    internal.y -= bend * element->tangent.x;
    double *at_left = at + RING_V_LEFT * LANES, *at_right = at + RING_V_RIGHT * LANES;
    const ring_vector left_before = ring_read(at_left), right_before = ring_read(at_right);
    ring_vector v_left = ring_drive_node(c, e, ring_read(at + RING_U_LEFT * LANES), left_before,
                                         ring_subtract(internal, left->force));
    ring_vector v_right = ring_drive_node(c, ring_next(c, e), ring_read(at + RING_U_RIGHT * LANES),
                                          right_before, ring_subtract(right->force, internal));
    ring_add_element(c, element, ring_dot(left_before, v_left), ring_dot(right_before, v_right));
    ring_write(at_left, v_left);
    ring_write(at_right, v_right);
}

/* Elements and interfaces on their way through a sweep: number e is at e % RING_HELD. */
enum { RING_HELD = 4 };
typedef struct {
    ring_element element[RING_HELD], end;
    ring_frame frame[RING_HELD];
    ring_link link[RING_HELD]; /* on the left of the element of its number */
} ring_held;

/* Directs interface round - 1, joins interface round - 2, finishes the element before that, and
 * loads element round + 1, as far as there are such. None of these waits for another's roots and
 * quotients: the CPU computes many at a time. at = round % RING_HELD. */
LANES_FUNCTION void ring_round(ring_context *c, int law, int balanced, ring_held *held,
                               size_t round, size_t at)
{
    const size_t last = c->ring->elements - 1, after = (at + 1) % RING_HELD,
                 before = (at + RING_HELD - 1) % RING_HELD, left = (at + RING_HELD - 2) % RING_HELD;
    ring_element *element = held->element;
    if (round - 1 < last)
        ring_direct(c, round - 1, &element[before], &element[at], &held->frame[before]);
    if (round - 2 < last) {
        ring_interface(c, law, balanced, round - 2, &element[left], &element[before],
                       &held->frame[left], &held->link[before]);
        ring_finish(c, round - 2, &element[left], &held->link[left], &held->link[before]);
    }
    if (round + 1 < last) ring_load(c, round + 1, &element[after]);
    else element[after] = held->end;
}

LANES_FUNCTION void ring_flux(const fracas_ring_constants *ring, fracas_step *step, int first,
                              int law, int balanced)
{
    const size_t last = ring->elements - 1;
    const vd dt = lanes_load(step->kick + first);
    ring_context context = ring_context_of(ring, step, first, RING_FIELDS, dt, lanes_set(0.5) * dt),
                 *c = &context;

    if (balanced)
        context.coupling = balance_couple(c->spring, c->kick + c->kick, c->drift,
                                          lanes_set(ring->whole),
                                          lanes_load(step->balance + first));

    /* One pass in place, as the bar's; the closing interface comes first. */
    ring_held held = {0};
    ring_load(c, last, &held.end);
    ring_load(c, 0, &held.element[0]);
    ring_direct(c, last, &held.end, &held.element[0], &held.frame[0]);
    ring_interface(c, law, balanced, last, &held.end, &held.element[0], &held.frame[0],
                   &held.link[0]);
    const ring_link closing = held.link[0];
    for (size_t round = 0; round < last + 2; round += RING_HELD) {
        ring_round(c, law, balanced, &held, round, 0);
        ring_round(c, law, balanced, &held, round + 1, 1);
        ring_round(c, law, balanced, &held, round + 2, 2);
        ring_round(c, law, balanced, &held, round + 3, 3);
    }
    ring_finish(c, last, &held.end, &held.link[last % RING_HELD], &closing);

    const vd area = lanes_set(ring->area), half_area = lanes_set(0.5 * ring->area);
    ring_totals(c, half_area * (lanes_set(ring->size) * c->elastic + c->flux_energy),
                area * lanes_set(ring->fracture_energy) * c->dissipated);
}

#endif
