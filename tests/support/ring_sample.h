/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One ring with the law nitsche in one lane, whose nodes and interfaces a test sets and reads. */
#ifndef FRACAS_TESTS_SUPPORT_RING_SAMPLE_H
#define FRACAS_TESTS_SUPPORT_RING_SAMPLE_H

#include "tests/support/ring.h"

#include "engine/formulation/chain/ring_sweep.h"

#define RING_PI 3.14159265358979323846

typedef struct {
    double x, y;
} ring_point;

static inline ring_point ring_plus(ring_point a, double s, ring_point b)
{
    return (ring_point){a.x + s * b.x, a.y + s * b.y};
}
static inline ring_point ring_minus(ring_point a, ring_point b)
{
    return ring_plus(a, -1, b);
}
static inline double ring_inner(ring_point a, ring_point b)
{
    return a.x * b.x + a.y * b.y;
}
static inline double ring_cross(ring_point a, ring_point b)
{
    return a.x * b.y - a.y * b.x;
}
static inline ring_point ring_turned(ring_point a, double angle)
{
    return (ring_point){a.x * cos(angle) - a.y * sin(angle), a.x * sin(angle) + a.y * cos(angle)};
}

static inline double *ring_field(const one_run *s, size_t element, int field)
{
    return s->batch->step.state + element * RING_FIELDS + (size_t)field;
}

/* Of the left (0) or right (1) node of an element: where it starts, where it is, its velocity. */
static inline ring_point ring_origin(const one_run *s, size_t element, size_t side)
{
    const size_t n = s->model->elements;
    const double radius = s->model->element_size / (2 * sin(RING_PI / (double)n)),
                 angle = 2 * RING_PI * (double)((element + side) % n) / (double)n;
    return (ring_point){radius * cos(angle), radius * sin(angle)};
}

static inline ring_point ring_node(const one_run *s, size_t element, size_t side)
{
    const double *u = ring_field(s, element, side ? RING_U_RIGHT : RING_U_LEFT);
    return ring_plus(ring_origin(s, element, side), 1, (ring_point){u[0], u[1]});
}

static inline ring_point ring_velocity(const one_run *s, size_t element, size_t side)
{
    const double *v = ring_field(s, element, side ? RING_V_RIGHT : RING_V_LEFT);
    return (ring_point){v[0], v[1]};
}

static inline void ring_put(const one_run *s, size_t element, size_t side, ring_point at)
{
    const ring_point u = ring_minus(at, ring_origin(s, element, side));
    double *to = ring_field(s, element, side ? RING_U_RIGHT : RING_U_LEFT);
    to[0] = u.x;
    to[1] = u.y;
}

static inline ring_point ring_chord(const one_run *s, size_t element)
{
    return ring_minus(ring_node(s, element, 1), ring_node(s, element, 0));
}

/* The direction along which interface e opens. */
static inline ring_point ring_normal(const one_run *s, size_t e)
{
    const size_t n = s->model->elements, next = (e + 1) % n;
    const double angle = 2 * RING_PI * (double)next / (double)n;
    if (s->model->spec.geometry.direction == &fracas_direction_initial)
        return (ring_point){-sin(angle), cos(angle)};
    const ring_point sum = ring_plus(ring_chord(s, e), 1, ring_chord(s, next));
    return ring_plus((ring_point){0, 0}, 1 / sqrt(ring_inner(sum, sum)), sum);
}

/* What interface e has opened by, along its normal and across it [m]. */
static inline ring_point ring_jump(const one_run *s, size_t e)
{
    const ring_point n = ring_normal(s, e), outward = {n.y, -n.x};
    const ring_point jump = ring_minus(ring_node(s, (e + 1) % s->model->elements, 0),
                                       ring_node(s, e, 1));
    return (ring_point){ring_inner(jump, n), ring_inner(jump, outward)};
}

/* Mass of a node [kg]. */
static inline double ring_nodal_mass(const one_run *s)
{
    return s->model->mass / (2 * (double)s->model->elements);
}

/* Linear and angular momentum about the origin of elements first .. first + count - 1, round the
 * ring. */
static inline void ring_momenta(const one_run *s, size_t first, size_t count, ring_point *linear,
                                double *angular)
{
    const double mass = ring_nodal_mass(s);
    *linear = (ring_point){0, 0};
    *angular = 0;
    for (size_t i = 0; i < 2 * count; i++) {
        const size_t e = (first + i / 2) % s->model->elements;
        const ring_point v = ring_velocity(s, e, i % 2);
        *linear = ring_plus(*linear, mass, v);
        *angular += mass * ring_cross(ring_node(s, e, i % 2), v);
    }
}

/* Uniform in [-1, 1). */
static inline double ring_noise(uint64_t *seed)
{
    return 2 * random_noise(seed);
}

/* ---- rings in a given state ---- */

enum { MOST = 12 }; /* elements of the rings of which states are set */

typedef struct {
    double u[MOST][4], damage[MOST]; /* of left and right node, x and y [m] */
} ring_state;

typedef struct {
    double elastic, cohesive, dissipated; /* J */
    ring_point force[MOST][2];            /* N, on left and right node */
    double largest;                       /* N, of the forces' components */
} ring_answer;

/* n elements 20 um long. */
static inline one_run small_ring(size_t n, double beta, const fracas_kind *direction)
{
    fracas_spec spec = ring_reference((int64_t)n, 1e4, 1);
    spec.cohesive.beta = beta;
    spec.geometry.radius = (double)n * 2e-5 / (2 * RING_PI);
    spec.geometry.direction = direction;
    return begin(&spec, BAR_STRENGTH_MEAN);
}

/* What the engine makes of a state that it does not move: energies, and forces from the kick of
 * velocities that are 0. */
static inline ring_answer answer(one_run *s, const ring_state *state)
{
    fracas_step *step = &s->batch->step;
    ring_answer a = {.largest = 0};
    for (size_t e = 0; e < s->model->elements; e++) {
        memcpy(ring_field(s, e, RING_U_LEFT), state->u[e], sizeof state->u[e]);
        memset(ring_field(s, e, RING_V_LEFT), 0, 4 * sizeof(double));
        *ring_field(s, e, RING_DAMAGE) = state->damage[e];
    }
    step->drift[0] = 0;
    step->kick[0] = 1e-9;
    s->model->formulation->advance(s->model, step);
    a.elastic = step->elastic[0];
    a.cohesive = step->cohesive[0];
    a.dissipated = step->dissipated[0];
    for (size_t e = 0; e < s->model->elements; e++)
        for (size_t side = 0; side < 2; side++) {
            a.force[e][side] = ring_plus((ring_point){0, 0}, ring_nodal_mass(s) / 1e-9,
                                         ring_velocity(s, e, side));
            a.largest = fmax(a.largest, fmax(fabs(a.force[e][side].x), fabs(a.force[e][side].y)));
        }
    return a;
}

#endif
