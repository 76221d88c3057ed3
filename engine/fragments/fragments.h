/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fragments: connected sets of elements over unbroken interfaces, and their motion as rigid bodies
 * in space. */
#ifndef FRACAS_ENGINE_FRAGMENTS_FRAGMENTS_H
#define FRACAS_ENGINE_FRAGMENTS_FRAGMENTS_H

#include "base/partition.h"
#include "engine/record.h"

/* Sums over the nodes of one fragment; all 0 to begin with. Its elements [1] and size [m] are the
 * formulation's to say. Second moments are taken from the first node: those of a small fragment
 * would be lost in the rounding of a place far off. */
typedef struct {
    int64_t elements, nodes;
    double mass, size;  /* kg, m */
    double first[3];    /* kg m: of m x */
    double origin[3];   /* m: place of the first node */
    double second[6];   /* kg m2: of m y_i y_j, y = x - origin: xx, yy, zz, yz, zx, xy */
    double momentum[3]; /* kg m/s: of m v */
    double moment[3];   /* kg m2/s: of x x m v, about (0, 0, 0) */
} fracas_fragment_sums;

/* Adds a node of `mass` [kg] at x [m] with velocity v [m/s]. */
void fracas_fragment_sums_add(fracas_fragment_sums *sums, double mass, const double x[3],
                              const double v[3]);

/* Adds node k of masses M_kl that couple it with others, all of them of this fragment: mass = sum
 * over l of M_kl [kg], carried = sum of M_kl x_l [kg m], momentum = sum of M_kl v_l [kg m/s], x its
 * own place [m]. */
void fracas_fragment_sums_add_coupled(fracas_fragment_sums *sums, double mass, const double x[3],
                                      const double carried[3], const double momentum[3]);

/* Gives an empty record its momentum and `count` fragments of these sums, allocated by malloc
 * (FRACAS_ENVIRONMENT without memory): centre of mass X, its velocity V, angular momentum about it
 * L = sum of x x m v - M X x V, spin = I^-1 L with I = sum of m ((y.y) 1 - y y^T), y = x - X, or
 * where I is singular (nodes on a line, a single node) the least such spin: 0 about an axis without
 * inertia. Dust are fragments of at most `dust` elements. */
FRACAS_MUST_USE fracas_err fracas_fragments_take(const fracas_fragment_sums *sums, size_t count,
                                                 int64_t dust, fracas_record *record);

#endif
