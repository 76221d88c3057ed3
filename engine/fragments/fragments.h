/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fragments: sets of elements connected by unbroken interfaces, and their motion as rigid bodies.
 */
#ifndef FRACAS_ENGINE_FRAGMENTS_FRAGMENTS_H
#define FRACAS_ENGINE_FRAGMENTS_FRAGMENTS_H

#include "base/partition.h"
#include "engine/record.h"

/* Sums over the nodes of one fragment, 0 at first; the formulation sets elements [1], size [m] and
 * strain_energy [J].
 * Second moments are about the first node: from far off, rounding would lose small fragments'. */
typedef struct {
    int64_t elements, nodes;
    double mass, size;    /* kg, m */
    double strain_energy; /* J, of its elements */
    double first[3];      /* kg m: of m x */
    double origin[3];     /* m: place of the first node */
    double second[6];     /* kg m2: of m y_i y_j, y = x - origin: xx, yy, zz, yz, zx, xy */
    double momentum[3];   /* kg m/s: of m v */
    double moment[3];     /* kg m2/s: of x x m v, about (0, 0, 0) */
    double flow[3][3];    /* kg m2/s: of m v_i y_j */
    double kinetic;       /* J: of m v.v/2 */
} fracas_fragment_sums;

/* Kinds of motion of a fragment: as a rigid body, with a gradient of any kind, none at all. */
typedef enum { FRACAS_MOTION_RIGID, FRACAS_MOTION_HOMOGENEOUS, FRACAS_MOTION_NONE } fracas_motion;

/* v = velocity + gradient (x - centre). */
typedef struct {
    double centre[3], velocity[3]; /* m, m/s */
    double gradient[3][3];         /* 1/s */
} fracas_fragment_motion;

/* Adds a node of `mass` [kg] at x [m] with velocity v [m/s]. */
void fracas_fragment_sums_add(fracas_fragment_sums *sums, double mass, const double x[3],
                              const double v[3]);

/* Adds node k at x [m] with velocity v [m/s], coupled by masses M_kl with nodes l of this fragment:
 * mass = sum_l M_kl [kg], carried = sum_l M_kl x_l [kg m], momentum = sum_l M_kl v_l [kg m/s]. */
void fracas_fragment_sums_add_coupled(fracas_fragment_sums *sums, double mass, const double x[3],
                                      const double v[3], const double carried[3],
                                      const double momentum[3]);

/* The motion of this kind with the least kinetic energy beside it  (fragments.5). In a
 * direction in which the fragment has no extent there is no gradient. */
fracas_fragment_motion fracas_fragment_motion_of(const fracas_fragment_sums *sums,
                                                 fracas_motion kind);

/* Takes the motion at x off the velocity v. */
void fracas_fragment_motion_take_off(const fracas_fragment_motion *motion, const double x[3],
                                     double v[3]);

/* Gives an empty record its momentum and `count` fragments (FRACAS_ENVIRONMENT without memory):
 * centre of mass X, its velocity V, angular momentum about it L = sum of x x m v - M X x V, spin =
 * I^-1 L with I = sum of m ((y.y) 1 - y y^T), y = x - X; spin is 0 about an axis without inertia
 * (nodes on a line, a single node). Dust are fragments of at most `dust` elements. */
FRACAS_MUST_USE fracas_err fracas_fragments_take(const fracas_fragment_sums *sums, size_t count,
                                                 int64_t dust, fracas_record *record);

#endif
