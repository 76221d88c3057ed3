/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elements, directions and drives of both sweeps of the ring, over lanes (docs/theory/ring.md). */
#ifndef FRACAS_ENGINE_CHAIN_RING_KINEMATICS_H
#define FRACAS_ENGINE_CHAIN_RING_KINEMATICS_H

#include "base/lanes.h"
#include "engine/cohesive/balance.h"
#include "engine/cohesive/kernels.h"
#include "engine/formulation/chain/chain_events.h"
#include "engine/formulation/chain/ring_sweep.h"
#include "engine/integrator/central_difference.h"

typedef struct {
    vd x, y;
} ring_vector;

LANES_FUNCTION ring_vector ring_add(ring_vector a, ring_vector b)
{
    return (ring_vector){a.x + b.x, a.y + b.y};
}
LANES_FUNCTION ring_vector ring_subtract(ring_vector a, ring_vector b)
{
    return (ring_vector){a.x - b.x, a.y - b.y};
}
LANES_FUNCTION ring_vector ring_scale(vd s, ring_vector a)
{
    return (ring_vector){s * a.x, s * a.y};
}
LANES_FUNCTION vd ring_dot(ring_vector a, ring_vector b)
{
    return a.x * b.x + a.y * b.y;
}
LANES_FUNCTION vd ring_cross(ring_vector a, ring_vector b)
{
    return a.x * b.y - a.y * b.x;
}

/* An element where its displacements are. */
typedef struct {
    ring_vector chord, tangent; /* from left to right node [m], and its direction */
    vd strain, stress;          /* strain of the chord; E strain [Pa] */
    vd per_length;              /* 1/l [1/m] */
} ring_element;

/* The directions of an interface: normal n, along which it opens, and r, outward. */
typedef struct {
    ring_vector n; /* r: ring_outward */
    vd turn;       /* dn/d(chord) = r r turn [1/m]; 0 for fixed directions */
} ring_frame;

#define RING_SUM(key, role, unit, meaning) vd key;
typedef struct {
    const fracas_ring_constants *ring;
    fracas_step *step;
    int first;            /* lane of the step that is lane 0 here */
    double *state;        /* state of these lanes */
    vd drift, kick;       /* dt [s]; dt/(nodal mass) of velocities [m/(s Pa)] */
    vd spring, modulus;   /* K, E/h [Pa/m] */
    vd compliance;        /* 1/K [m/Pa] */
    vd bending, corner;   /* k [Pa m], sin(2 pi/n)  (ring.19) */
    vd inverse_size;      /* 1/h [1/m] */
    vd drive, next_drive; /* force on a node [Pa] now; velocity held half a step ahead [m/s] */
    vd inertia;           /* nodal mass/dt [Pa s/m] */
    balance_coupling coupling;
    /* sums over the body, for the ledger, 0 at first; of a part: energy per area [J/m2] */
    FRACAS_EACH_ENERGY(RING_SUM)
    vd flux_energy;
    vd driven, driven_next; /* power of the drive at the velocities before and after now [W/m2] */
} ring_context;

LANES_FUNCTION ring_vector ring_read(const double *at)
{
    return (ring_vector){lanes_load(at), lanes_load(at + LANES)};
}

LANES_FUNCTION void ring_write(double *at, ring_vector a)
{
    lanes_store(at, a.x);
    lanes_store(at + LANES, a.y);
}

/* Right node less left node of the element whose fields begin at `at`; `of` displacements
 * (RING_U_LEFT) or velocities (RING_V_LEFT). */
LANES_FUNCTION ring_vector ring_difference(const double *at, int of)
{
    return ring_subtract(ring_read(at + (of + 2) * LANES), ring_read(at + of * LANES));
}

/* The same across the interface of two elements. */
LANES_FUNCTION ring_vector ring_jump(const double *left, const double *right, int of)
{
    return ring_subtract(ring_read(right + of * LANES), ring_read(left + (of + 2) * LANES));
}

/* Element e, whose nodes' displacements differ by `du`  (ring.2), (ring.3). */
LANES_FUNCTION void ring_stretch(const ring_context *c, size_t e, ring_vector du,
                                 ring_element *element)
{
    const double *table = c->ring->table + e * RING_TABLE;
    const ring_vector start = {lanes_set(table[RING_START_X]), lanes_set(table[RING_START_Y])};
    element->chord = ring_add(start, du);
    vd length = lanes_sqrt(ring_dot(element->chord, element->chord)),
       sum = length + lanes_set(c->ring->size), inverse = lanes_set(1.0) / (length * sum);
    element->per_length = sum * inverse;
    element->tangent = ring_scale(element->per_length, element->chord);
    /* (l - h)/h by the difference of squares: no digits of a small strain are lost */
    element->strain = (ring_dot(start, du) + ring_dot(element->chord, du)) * (length * inverse) *
                      c->inverse_size;
    element->stress = lanes_set(c->ring->young) * element->strain;
}

/* The normal turned by a quarter. */
LANES_FUNCTION ring_vector ring_outward(ring_vector n)
{
    return (ring_vector){n.y, lanes_set(0.0) - n.x};
}

/* Element or vertex after e. */
LANES_FUNCTION size_t ring_next(const ring_context *c, size_t e)
{
    return e + 1 < c->ring->elements ? e + 1 : 0;
}

/* The directions of interface e, between these elements  (ring.4). */
LANES_FUNCTION void ring_direct(const ring_context *c, size_t e, const ring_element *left,
                                const ring_element *right, ring_frame *frame)
{
    if (c->ring->current) {
        ring_vector sum = ring_add(left->chord, right->chord);
        frame->turn = lanes_set(1.0) / lanes_sqrt(ring_dot(sum, sum));
        frame->n = ring_scale(frame->turn, sum);
        return;
    }
    const double *table = c->ring->table + ring_next(c, e) * RING_TABLE;
    frame->turn = lanes_set(0.0);
    frame->n = (ring_vector){lanes_set(-table[RING_SIN]), lanes_set(table[RING_COS])};
}

/* Time derivative of an interface's mean stress within the step [Pa/s], for elements whose fields
 * begin at `at_left` and `at_right`. */
LANES_FUNCTION vd ring_stress_rate(const ring_context *c, const ring_element *left,
                                   const ring_element *right, const double *at_left,
                                   const double *at_right)
{
    return lanes_set(0.5) * c->modulus *
           (ring_dot(left->tangent, ring_difference(at_left, RING_V_LEFT)) +
            ring_dot(right->tangent, ring_difference(at_right, RING_V_LEFT)));
}

/* The velocity of a node at `vertex` kicked by `force` [Pa], under the drive  (ring.10). Books the
 * power of the drive's force, or of the reaction to a held velocity, before and after. */
LANES_FUNCTION ring_vector ring_drive_node(ring_context *c, size_t vertex, ring_vector u,
                                           ring_vector v, ring_vector force)
{
    const fracas_ring_constants *ring = c->ring;
    ring_vector after = {central_kick(v.x, force.x, c->kick), central_kick(v.y, force.y, c->kick)};
    if (ring->drive == FRACAS_RING_FREE) return after;
    const double *table = ring->table + vertex * RING_TABLE;
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    ring_vector place = {lanes_set(ring->radius * table[RING_COS]) + u.x,
                         lanes_set(ring->radius * table[RING_SIN]) + u.y};
    ring_vector out = ring_scale(one / lanes_sqrt(ring_dot(place, place)), place);
    ring_vector along = ring->circumferential ? (ring_vector){zero - out.y, out.x} : out;
    vd change = c->kick * c->drive, push = c->drive;
    if (ring->drive == FRACAS_RING_HELD) {
        change = c->next_drive - ring_dot(after, along);
        push = change * c->inertia;
    }
    after = ring_add(after, ring_scale(change, along));
    c->driven += push * ring_dot(v, along);
    c->driven_next += push * ring_dot(after, along);
    return after;
}

/* Work of the drive since the step before [J]  (ring.11). */
LANES_FUNCTION vd ring_drive_work(const ring_context *c)
{
    if (c->ring->drive == FRACAS_RING_FREE) return lanes_set(0.0);
    const vd half = lanes_set(0.5), area = lanes_set(c->ring->area);
    vd before = lanes_load(c->step->driven[0] + c->first);
    lanes_store(c->step->driven[0] + c->first, area * c->driven_next);
    return half * c->drift * (before + area * c->driven);
}

/* The kinetic and elastic energy of an element, from products of its velocities. */
LANES_FUNCTION void ring_add_element(ring_context *c, const ring_element *element, vd left,
                                     vd right)
{
    c->kinetic += left + right;
    c->elastic += element->stress * element->strain;
}

/* Sums to energies [J], of both sweeps: elastic energy and dissipation differ. */
LANES_FUNCTION void ring_totals(const ring_context *c, vd elastic, vd dissipated)
{
    const vd area = lanes_set(c->ring->area), half_area = lanes_set(0.5 * c->ring->area);
    fracas_step *step = c->step;
#define RING_PART(key, role, unit, meaning) \
    if (FRACAS_ROLE_##role == FRACAS_ROLE_PART) lanes_store(step->key + c->first, area * c->key);
    FRACAS_EACH_ENERGY(RING_PART)
    lanes_store(step->kinetic + c->first, half_area * lanes_set(c->ring->nodal_mass) * c->kinetic);
    lanes_store(step->elastic + c->first, elastic);
    lanes_store(step->cohesive + c->first, half_area * c->cohesive);
    lanes_store(step->dissipated + c->first, dissipated);
    lanes_store(step->work + c->first, ring_drive_work(c));
}

/* Velocities are advanced by `kick` [s], to `ahead` [s] beyond this step's time. */
LANES_FUNCTION ring_context ring_context_of(const fracas_ring_constants *ring, fracas_step *step,
                                            int first, int fields, vd kick, vd ahead)
{
    const vd mass = lanes_set(ring->nodal_mass), level = lanes_set(ring->level),
             rate = lanes_set(ring->rate), time = lanes_load(step->time + first);
    return (ring_context){.ring = ring,
                          .step = step,
                          .first = first,
                          .state = step->state + (size_t)first * ring->elements * (size_t)fields,
                          .drift = lanes_load(step->drift + first),
                          .kick = kick / mass,
                          .spring = lanes_set(ring->spring),
                          .modulus = lanes_set(ring->young / ring->size),
                          .compliance = lanes_set(1.0 / ring->spring),
                          .bending = lanes_set(ring->bending),
                          .corner = lanes_set(ring->corner),
                          .inverse_size = lanes_set(1.0 / ring->size),
                          .drive = level + rate * time,
                          .next_drive = level + rate * (time + ahead),
                          .inertia = mass / kick};
}

#endif
