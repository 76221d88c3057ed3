/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fragments of a ring: how they move, and where they are in the plane
 * (docs/theory/estimators.md). */
#ifndef FRACAS_ANALYSIS_DATA_RING_H
#define FRACAS_ANALYSIS_DATA_RING_H

#include "base/err.h"
#include "campaigns/store/datafile.h"

#include <stddef.h>
#include <stdint.h>

/* For an arc of half angle a on a circle of radius 1: distance of its centre of mass from the
 * centre of the circle, sin(a)/a (estimators.4), and its moment of inertia about its centre of mass
 * over its mass, 1 - (sin(a)/a)^2 (estimators.5). a >= 0. */
double fracas_arc_centre(double half_angle);
double fracas_arc_inertia(double half_angle);

/* Motion of the fragments of one realization, each weighed by its mass; NaN with fewer than two
 * fragments. */
typedef struct {
    double radial;          /* m/s, mean of v_r (estimators.6) */
    double scatter;         /* m/s, standard deviation of v_r over fragments (estimators.7) */
    double circumferential; /* m/s, root mean square of v_theta (estimators.8) */
    double spin;            /* rad/s, mean |angular velocity| (estimators.9) */
} fracas_ring_motion;

/* radius: of the ring at its start, > 0 [m]; the centre of the ring is the origin. A fragment whose
 * centre of mass is there has no direction outward and is left out. */
fracas_ring_motion fracas_ring_motion_of(const fracas_record *record, double radius);

/* One fragment as it lies in the plane. */
typedef struct {
    size_t fragment; /* which of the record's */
    int64_t dust;
    double size;         /* m, length */
    double half_angle;   /* size/(2 radius) */
    double angle;        /* for the centre of mass, -pi to pi */
    double distance;     /* m, of the centre of mass from the origin */
    double displacement; /* m, distance - that in the ring at its start (estimators.10) */
    double velocity[2];  /* m/s, outward and counter-clockwise, of the centre of mass */
    double relative[2];  /* m/s, the same beside the uniform expansion (estimators.11) */
} fracas_ring_piece;

typedef struct {
    double radius;    /* m, of the ring at its start */
    double time;      /* s, end of the realization */
    double expansion; /* m/s, speed V of the uniform expansion */
    size_t n;
    fracas_ring_piece *piece; /* counter-clockwise, by angle */
} fracas_ring_pattern;

/* Where the fragments of `record` are. *pattern is cleared by the caller. */
FRACAS_MUST_USE fracas_err fracas_ring_pattern_create(const fracas_record *record, double radius,
                                                      fracas_ring_pattern *pattern);
void fracas_ring_pattern_clear(fracas_ring_pattern *pattern);

#endif
