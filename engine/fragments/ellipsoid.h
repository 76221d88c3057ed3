/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shape of a fragment: an ellipsoid of its second moments, and its extent. */
#ifndef FRACAS_ENGINE_FRAGMENTS_ELLIPSOID_H
#define FRACAS_ENGINE_FRAGMENTS_ELLIPSOID_H

#include "engine/record.h"

#include <stddef.h>

/* Sums over the matter of one fragment, 0 at first. Second moments are about the first place: from
 * far off, rounding would lose small fragments'. */
typedef struct {
    int started;
    double mass;      /* kg */
    double origin[3]; /* m: the first place */
    double first[3];  /* kg m: of m y, y = x - origin */
    double second[6]; /* kg m2: of m y_i y_j: xx, yy, zz, yz, zx, xy */
} fracas_fragment_matter;

/* Adds `mass` [kg] about x [m], with second moments `spread` [kg m2] about x. */
void fracas_fragment_matter_add(fracas_fragment_matter *matter, double mass, const double x[3],
                                const double spread[6]);

/* spread = along d d^T + across (1 - d d^T), d a unit vector. */
void fracas_fragment_spread(const double d[3], double along, double across, double spread[6]);

/* Gives a fragment the semi-axes sqrt(5 C_a/m) of the homogeneous ellipsoid with its mass m and its
 * principal second moments C_a about its centre, the largest first, and their directions
 * (fragments.7): the largest component of the first two is positive, the third is their vector
 * product. NaN where the matter is in no place. */
void fracas_fragment_set_ellipsoid(const fracas_fragment_matter *matter, fracas_fragment *fragment);

/* Largest distance of two of the nodes [m]; 0 of none. Exact, where at most FRACAS_EXTENT_ALL of
 * them may be its ends; else no smaller than FRACAS_EXTENT_SURE of it. The time is proportional to
 * the number of nodes  (fragments.8). */
#define FRACAS_EXTENT_ALL 256
#define FRACAS_EXTENT_SURE 0.99
double fracas_fragment_extent(const double (*node)[3], size_t count);

#endif
