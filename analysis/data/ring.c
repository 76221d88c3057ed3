/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/ring.h"

#include <math.h>
#include <stdlib.h>

/* (estimators.4). */
double fracas_arc_centre(double half_angle)
{
    return half_angle > 0 ? sin(half_angle) / half_angle : 1;
}

/* (estimators.5). For small angles its series, whose next term is below 1e-14 of it: the difference
 * would cancel. */
double fracas_arc_inertia(double half_angle)
{
    double square = half_angle * half_angle, centre = fracas_arc_centre(half_angle);
    if (half_angle < 1e-2) return square / 3 * (1 - square * (2.0 / 15 - square / 105));
    return 1 - centre * centre;
}

/* Outward and counter-clockwise velocity of a fragment's centre of mass; its distance from the
 * origin. */
static double resolve(const fracas_fragment *fragment, double velocity[2])
{
    const double *r = fragment->position, *v = fragment->velocity;
    double distance = hypot(r[0], r[1]);
    velocity[0] = (r[0] * v[0] + r[1] * v[1]) / distance;
    velocity[1] = (r[0] * v[1] - r[1] * v[0]) / distance;
    return distance;
}

/* (estimators.6), (estimators.7), (estimators.8), (estimators.9). */
fracas_ring_motion fracas_ring_motion_of(const fracas_record *record, double radius)
{
    fracas_ring_motion motion = {NAN, NAN, NAN, NAN};
    if (record->nfragment < 2) return motion;
    double mass = 0, radial = 0, squares = 0, circumferential = 0, spin = 0, v[2];
    for (size_t i = 0; i < record->nfragment; i++) {
        const fracas_fragment *fragment = &record->fragment[i];
        if (!(resolve(fragment, v) > 0)) continue;
        double inertia = radius * radius * fracas_arc_inertia(fragment->size / (2 * radius));
        mass += fragment->mass;
        radial += fragment->mass * v[0];
        circumferential += fragment->mass * v[1] * v[1];
        spin += fabs(fragment->angular_momentum[2]) / inertia;
    }
    motion.radial = radial / mass;
    for (size_t i = 0; i < record->nfragment; i++) {
        if (!(resolve(&record->fragment[i], v) > 0)) continue;
        squares += record->fragment[i].mass * (v[0] - motion.radial) * (v[0] - motion.radial);
    }
    motion.scatter = sqrt(squares / mass);
    motion.circumferential = sqrt(circumferential / mass);
    motion.spin = spin / mass;
    return motion;
}

static int by_angle(const void *a, const void *b)
{
    const fracas_ring_piece *x = a, *y = b;
    if (x->angle != y->angle) return x->angle < y->angle ? -1 : 1;
    return (x->fragment > y->fragment) - (x->fragment < y->fragment);
}

/* (estimators.10), (estimators.11): the speed V leaves no momentum outward in the velocities
 * relative to it. */
static void place_pieces(const fracas_record *record, fracas_ring_pattern *pattern)
{
    double momentum = 0, carried = 0;
    for (size_t i = 0; i < pattern->n; i++) {
        const fracas_fragment *fragment = &record->fragment[i];
        fracas_ring_piece *piece = &pattern->piece[i];
        double v[2], distance = resolve(fragment, v);
        *piece = (fracas_ring_piece){
            .fragment = i,
            .dust = fragment->dust,
            .size = fragment->size,
            .half_angle = fragment->size / (2 * pattern->radius),
            .angle = atan2(fragment->position[1], fragment->position[0]),
            .distance = distance,
            .velocity = {v[0], v[1]},
        };
        double centre = fracas_arc_centre(piece->half_angle);
        piece->displacement = distance - pattern->radius * centre;
        if (!(distance > 0)) continue; /* it has no direction outward, and NaN velocities */
        momentum += fragment->mass * v[0];
        carried += fragment->mass * centre;
    }
    pattern->expansion = momentum / carried;
    for (size_t i = 0; i < pattern->n; i++) {
        fracas_ring_piece *piece = &pattern->piece[i];
        piece->relative[0] = piece->velocity[0] -
                             pattern->expansion * fracas_arc_centre(piece->half_angle);
        piece->relative[1] = piece->velocity[1];
    }
}

fracas_err fracas_ring_pattern_create(const fracas_record *record, double radius,
                                      fracas_ring_pattern *pattern)
{
    *pattern = (fracas_ring_pattern){
        .radius = radius, .time = record->end_time, .n = record->nfragment};
    pattern->piece = calloc(pattern->n + 1, sizeof *pattern->piece);
    if (!pattern->piece) return fracas_no_memory("the fragments of a ring");
    place_pieces(record, pattern);
    qsort(pattern->piece, pattern->n, sizeof *pattern->piece, by_angle);
    return FRACAS_OK;
}

void fracas_ring_pattern_clear(fracas_ring_pattern *pattern)
{
    free(pattern->piece);
    *pattern = (fracas_ring_pattern){0};
}
