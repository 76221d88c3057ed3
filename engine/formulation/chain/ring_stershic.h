/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ring's sweep with Stershic's algorithm (docs/theory/ring.md): explicit Newmark with
 * velocities at whole steps, rigid links opening at sigma_c, time step refined by critical zones,
 * fracture-limiting zone with bulk damage. Two passes: forces need the links that open, and the
 * length of the next step. */
#ifndef FRACAS_ENGINE_CHAIN_RING_STERSHIC_H
#define FRACAS_ENGINE_CHAIN_RING_STERSHIC_H

#include "engine/formulation/chain/ring_kinematics.h"

/* Results of the first pass: links that reach their strength, and those in the critical zones. */
typedef struct {
    vmask qualifies, opening, compressed;
} stershic_watch;

/* ---- first pass ---- */

/* Stress of an element under bulk damage  (ring.16); largest: its eps_d. */
LANES_FUNCTION vd stershic_stress(const ring_context *c, vd strain, vd largest, vd yield)
{
    const vd zero = lanes_set(0.0), young = lanes_set(c->ring->young);
    vd reached = lanes_select(lanes_lt(largest, strain), strain, largest);
    vmask damaged = lanes_and(lanes_lt(zero, strain), lanes_lt(yield, young * reached));
    return lanes_select(damaged, strain * yield / reached, young * strain);
}

/* Mean strength of the element's two links, by which it yields [Pa]. */
LANES_FUNCTION vd stershic_yield(const ring_context *c, size_t e)
{
    const size_t before = e > 0 ? e - 1 : c->ring->elements - 1;
    return lanes_set(0.5) *
           (lanes_load(c->state + (before * RING_FIELDS_STERSHIC + RING_STRENGTH) * LANES) +
            lanes_load(c->state + (e * RING_FIELDS_STERSHIC + RING_STRENGTH) * LANES));
}

/* Fields of element e. */
LANES_FUNCTION double *stershic_at(const ring_context *c, size_t e)
{
    return c->state + e * RING_FIELDS_STERSHIC * LANES;
}

/* The element where its displacements are now, with its stress. */
LANES_FUNCTION ring_element stershic_load(const ring_context *c, size_t e)
{
    const double *at = stershic_at(c, e);
    ring_element element;
    ring_stretch(c, e, ring_difference(at, RING_U_LEFT), &element);
    if (c->ring->own[STERSHIC_ZONE] > 0) {
        vd largest = lanes_load(at + RING_STRAIN * LANES);
        vmask barred = lanes_le(lanes_set(0.0), largest);
        element.stress = lanes_select(
            barred, stershic_stress(c, element.strain, largest, stershic_yield(c, e)),
            element.stress);
    }
    return element;
}

LANES_FUNCTION vmask stershic_is_open(vd state)
{
    return lanes_and(lanes_lt(lanes_set(RING_LINK_CLOSED), state),
                     lanes_lt(state, lanes_set(RING_LINK_BARRED)));
}

/* Traction of an open link [Pa], from the jump q along its normal; *damage is brought up to date
 * (ring.13). */
LANES_FUNCTION vd stershic_traction(const ring_context *c, vd q, vd *damage, vd sigma_c,
                                    vd *delta_c)
{
    const fracas_ring_constants *ring = c->ring;
    *delta_c = cohesive_opening(ring->fracture_energy, ring->critical_opening, sigma_c);
    return rigid_link_law(q, damage, sigma_c, *delta_c, c->spring);
}

/* Inspects one interface: does it qualify, is it in a critical zone  (ring.14)? Only the
 * component along n of its elements' pull counts, so that a link that qualifies does open. */
LANES_FUNCTION void stershic_inspect(const ring_context *c, size_t e, const ring_element *left,
                                     const ring_element *right, stershic_watch *watch)
{
    const vd zero = lanes_set(0.0);
    double *at = stershic_at(c, e);
    const double *at_right = stershic_at(c, ring_next(c, e));
    ring_frame frame;
    ring_direct(c, e, left, right, &frame);
    vd state = lanes_load(at + RING_LAW * LANES), sigma_c = lanes_load(at + RING_STRENGTH * LANES);
    vd before = lanes_load(at + RING_DAMAGE * LANES), damage = before, delta_c;
    vmask closed = lanes_le(state, lanes_set(RING_LINK_CLOSED)), open = stershic_is_open(state);
    vd pull = lanes_set(0.5) * (left->stress * ring_dot(left->tangent, frame.n) +
                                right->stress * ring_dot(right->tangent, frame.n));
    vd q = ring_dot(ring_jump(at, at_right, RING_U_LEFT), frame.n);
    vd traction = stershic_traction(c, q, &damage, sigma_c, &delta_c);
    vd watched = c->ring->own[STERSHIC_STEEP] > 0 ? zero
                                                  : before * delta_c; /* least opening to look at */
    vmask softens = lanes_and(open,
                              lanes_and(lanes_le(watched, q), lanes_lt(c->modulus * q, traction)));
    vmask rises = lanes_and(closed, lanes_le(lanes_set(0.95) * sigma_c, pull));
    vd stress = lanes_select(open, traction, pull);
    watch->qualifies = lanes_or(watch->qualifies, lanes_and(closed, lanes_le(sigma_c, pull)));
    watch->opening = lanes_or(watch->opening, lanes_or(softens, rises));
    watch->compressed = lanes_or(watch->compressed, lanes_lt(stress, zero));
    lanes_store(at + RING_PULL * LANES, pull);
}

/* Moves all nodes on, and looks at every interface. */
LANES_FUNCTION stershic_watch stershic_look_around(const ring_context *c)
{
    const size_t last = c->ring->elements - 1;
    const vd zero = lanes_set(0.0);
    stershic_watch watch = {lanes_lt(zero, zero), lanes_lt(zero, zero), lanes_lt(zero, zero)};
    ring_element first = {.stress = zero}, before = first;
    for (size_t e = 0; e <= last; e++) {
        double *at = stershic_at(c, e);
        for (int i = 0; i < 4; i++) {
            vd u = lanes_load(at + (RING_U_LEFT + i) * LANES),
               v = lanes_load(at + (RING_V_LEFT + i) * LANES);
            lanes_store(at + (RING_U_LEFT + i) * LANES, central_drift(u, v, c->drift));
        }
        ring_element element = stershic_load(c, e);
        lanes_store(at + RING_STRESS * LANES, element.stress);
        if (e == 0) first = element;
        else stershic_inspect(c, e - 1, &before, &element, &watch);
        before = element;
    }
    stershic_inspect(c, last, &before, &first, &watch);
    return watch;
}

/* ---- opening links: rare, lane by lane ---- */

/* A field of one lane. */
static inline double *stershic_value(const ring_context *c, size_t element, int field, int lane)
{
    return c->state + (element * RING_FIELDS_STERSHIC + (size_t)field) * LANES + lane;
}

/* Time at which the stress of link e passed its strength, by the rate of the velocities [s]. */
LANES_FUNCTION double stershic_onset(const ring_context *c, size_t e, int lane)
{
    const size_t next = ring_next(c, e);
    const ring_element left = stershic_load(c, e), right = stershic_load(c, next);
    const double *at = stershic_at(c, e);
    const vd past = lanes_load(at + RING_PULL * LANES) - lanes_load(at + RING_STRENGTH * LANES),
             time = lanes_load(c->step->time + c->first) -
                    past / ring_stress_rate(c, &left, &right, at, stershic_at(c, next));
    double of[LANES];
    memcpy(of, &time, sizeof of);
    return of[lane];
}

/* Opens link e, bars the closed ones within the zone, and lets elements between two barred ones
 * suffer damage: those beyond their yield stress lose E (eps - eps_y)^2/2 per volume, booked as
 * created  (ring.15). */
__attribute__((noinline, cold)) static void stershic_open_one(const ring_context *c, size_t e,
                                                              int lane)
{
    const fracas_ring_constants *ring = c->ring;
    const size_t n = ring->elements,
                 reach = (size_t)fmin(ring->own[STERSHIC_ZONE] / ring->size * (1 + 1e-12),
                                      (double)(n / 2));
    *stershic_value(c, e, RING_LAW, lane) = RING_LINK_OPEN;
    fracas_chain_note_onset(c->step, c->first + lane, e, stershic_onset(c, e, lane));
    for (size_t d = 1; d <= reach; d++) {
        double *ahead = stershic_value(c, (e + d) % n, RING_LAW, lane),
               *behind = stershic_value(c, (e + n - d) % n, RING_LAW, lane);
        if (*ahead == RING_LINK_CLOSED) *ahead = RING_LINK_BARRED;
        if (*behind == RING_LINK_CLOSED) *behind = RING_LINK_BARRED;
    }
    for (size_t d = 0; reach > 0 && d <= 2 * reach + 1; d++) { /* all beside links just barred */
        const size_t i = (e + n - reach + d) % n, before = (i + n - 1) % n;
        double *largest = stershic_value(c, i, RING_STRAIN, lane);
        if (*largest >= 0 || *stershic_value(c, i, RING_LAW, lane) != RING_LINK_BARRED ||
            *stershic_value(c, before, RING_LAW, lane) != RING_LINK_BARRED)
            continue;
        double strain = *stershic_value(c, i, RING_STRESS, lane) / ring->young;
        double yield = 0.5 *
                       (*stershic_value(c, before, RING_STRENGTH, lane) +
                        *stershic_value(c, i, RING_STRENGTH, lane)) /
                       ring->young;
        *largest = fmax(strain, 0);
        if (strain > yield)
            c->step->created[c->first + lane] -= 0.5 * ring->area * ring->size * ring->young *
                                                 (strain - yield) * (strain - yield);
    }
}

/* Opens the qualifying links of one lane, unless barred by then: the largest stress by strength
 * first, of several the lowest number. */
__attribute__((noinline, cold)) static void stershic_open_links(const ring_context *c, int lane)
{
    const size_t n = c->ring->elements;
    for (;;) {
        size_t best = n;
        double largest = 0;
        for (size_t e = 0; e < n; e++) {
            double pull = *stershic_value(c, e, RING_PULL, lane),
                   strength = *stershic_value(c, e, RING_STRENGTH, lane);
            double ratio = pull / strength;
            if (*stershic_value(c, e, RING_LAW, lane) != RING_LINK_CLOSED || !(pull >= strength))
                continue;
            if (c->ring->own[STERSHIC_ZONE] == 0)
                stershic_open_one(c, e, lane); /* order does not matter */
            else if (ratio > largest) {
                largest = ratio;
                best = e;
            }
        }
        if (best == n) return;
        stershic_open_one(c, best, lane);
    }
}

/* The next time step: base xi^k, k the number of occupied critical zones  (ring.12). */
LANES_FUNCTION vd stershic_refine(const ring_context *c, const stershic_watch *watch)
{
    const vd xi = lanes_set(c->ring->own[STERSHIC_REFINEMENT]), one = lanes_set(1.0);
    vd next = lanes_set(c->ring->time_step) * lanes_select(watch->opening, xi, one);
    return next * lanes_select(watch->compressed, xi, one);
}

/* ---- second pass ---- */

/* Action of an interface on its two elements. */
typedef struct {
    ring_vector force;  /* on the left element's node, minus that on the right one's [Pa] */
    vmask open;         /* if not, both nodes move as one ... */
    ring_vector common; /* ... under this force each [Pa] */
} stershic_link;

LANES_FUNCTION stershic_link stershic_interface(ring_context *c, size_t e, const ring_element *left,
                                                const ring_element *right)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    double *at = stershic_at(c, e);
    vd before = lanes_load(at + RING_DAMAGE * LANES),
       sigma_c = lanes_load(at + RING_STRENGTH * LANES);
    vd damage = before, delta_c;
    vmask open = stershic_is_open(lanes_load(at + RING_LAW * LANES));
    const double *at_right = stershic_at(c, ring_next(c, e));
    ring_frame frame;
    ring_direct(c, e, left, right, &frame);
    vd q = ring_dot(ring_jump(at, at_right, RING_U_LEFT), frame.n);
    vd traction = stershic_traction(c, q, &damage, sigma_c, &delta_c);
    damage = lanes_select(open, damage, before);
    traction = lanes_select(open, traction, zero);
    lanes_store(at + RING_DAMAGE * LANES, damage);
    c->cohesive += traction * q;
    c->dissipated += half * sigma_c * delta_c * damage;

    vmask breaks = lanes_and(lanes_lt(before, damage), lanes_le(one, damage));
    if (__builtin_expect(lanes_any(breaks), 0)) {
        vd time = lanes_load(c->step->time + c->first);
        vd speed = ring_dot(ring_jump(at, at_right, RING_V_LEFT), frame.n);
        chain_note_events(c->step, c->first, c->ring->area, e,
                          &(chain_events){.cracks = lanes_lt(one, zero),
                                          .breaks = breaks,
                                          .onset = zero,
                                          .broke = time - (q - delta_c) / speed,
                                          .at_onset = zero,
                                          .at_break = zero});
    }
    /* both nodes of a link share the forces of their two elements, unless it is open */
    ring_vector common = ring_scale(half, ring_subtract(ring_scale(right->stress, right->tangent),
                                                        ring_scale(left->stress, left->tangent)));
    return (stershic_link){.force = ring_scale(traction, frame.n), .open = open, .common = common};
}

LANES_FUNCTION ring_vector stershic_choose(vmask mask, ring_vector a, ring_vector b)
{
    return (ring_vector){lanes_select(mask, a.x, b.x), lanes_select(mask, a.y, b.y)};
}

/* Forces and new velocities of one element, and its share of the sums; `share` = dt/(dt + next dt):
 * where between the velocities half a step before and after now the one of now is. */
LANES_FUNCTION void stershic_finish(ring_context *c, size_t e, const ring_element *element,
                                    const stershic_link *left, const stershic_link *right, vd share)
{
    double *at = stershic_at(c, e);
    ring_vector internal = ring_scale(element->stress, element->tangent);
    ring_vector on_left = stershic_choose(left->open, ring_subtract(internal, left->force),
                                          left->common);
    ring_vector on_right = stershic_choose(right->open, ring_subtract(right->force, internal),
                                           right->common);
    double *at_left = at + RING_V_LEFT * LANES, *at_right = at + RING_V_RIGHT * LANES;
    const ring_vector left_before = ring_read(at_left), right_before = ring_read(at_right);
    ring_vector v_left = ring_drive_node(c, e, ring_read(at + RING_U_LEFT * LANES), left_before,
                                         on_left);
    ring_vector v_right = ring_drive_node(c, ring_next(c, e), ring_read(at + RING_U_RIGHT * LANES),
                                          right_before, on_right);
    ring_vector now_left = ring_add(left_before,
                                    ring_scale(share, ring_subtract(v_left, left_before)));
    ring_vector now_right = ring_add(right_before,
                                     ring_scale(share, ring_subtract(v_right, right_before)));
    ring_add_element(c, element, ring_dot(now_left, now_left), ring_dot(now_right, now_right));
    if (c->ring->own[STERSHIC_ZONE] > 0) {
        const vd zero = lanes_set(0.0), half = lanes_set(0.5), young = lanes_set(c->ring->young);
        vd largest = lanes_load(at + RING_STRAIN * LANES), yield = stershic_yield(c, e);
        vmask grows = lanes_and(lanes_le(zero, largest), lanes_lt(largest, element->strain));
        largest = lanes_select(grows, element->strain, largest);
        lanes_store(at + RING_STRAIN * LANES, largest);
        vd beyond = largest - yield / young; /* (ring.17) */
        c->dissipated += lanes_select(lanes_lt(zero, beyond),
                                      half * lanes_set(c->ring->size) * yield * beyond, zero);
    }
    ring_write(at_left, v_left);
    ring_write(at_right, v_right);
}

LANES_FUNCTION void stershic_advance(ring_context *c, vd share)
{
    const size_t last = c->ring->elements - 1;
    ring_element element = stershic_load(c, 0), end = stershic_load(c, last);
    const stershic_link closing = stershic_interface(c, last, &end, &element);
    ring_element next = stershic_load(c, 1);
    stershic_link left, right = stershic_interface(c, 0, &element, &next);
    stershic_finish(c, 0, &element, &closing, &right, share);
    for (size_t e = 1; e < last; e++) {
        left = right;
        element = next;
        next = stershic_load(c, e + 1);
        right = stershic_interface(c, e, &element, &next);
        stershic_finish(c, e, &element, &left, &right, share);
    }
    stershic_finish(c, last, &next, &right, &closing, share);
}

static void ring_rigid(const fracas_ring_constants *ring, fracas_step *step, int first)
{
    const vd zero = lanes_set(0.0), half = lanes_set(0.5), drift = lanes_load(step->drift + first);
    ring_context context = ring_context_of(ring, step, first, RING_FIELDS_STERSHIC, drift, zero),
                 *c = &context;
    const stershic_watch watch = stershic_look_around(c);
    if (__builtin_expect(lanes_any(watch.qualifies), 0))
        for (int lane = 0; lane < LANES; lane++)
            if (lanes_get(watch.qualifies, lane)) stershic_open_links(c, lane);

    const vd next = stershic_refine(c, &watch);
    lanes_store(step->next + first, next);
    context = ring_context_of(ring, step, first, RING_FIELDS_STERSHIC, half * (drift + next),
                              half * next);
    stershic_advance(c, drift / (drift + next));

    const vd area = lanes_set(ring->area), half_area = half * area;
    ring_totals(c, half_area * lanes_set(ring->size) * c->elastic, area * c->dissipated);
}

#endif
