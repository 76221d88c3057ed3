/* Fragments: connected sets of elements over unbroken interfaces, and their motion as rigid bodies in space. */
#ifndef FRACAS_ENGINE_FRAGMENTS_FRAGMENTS_H
#define FRACAS_ENGINE_FRAGMENTS_FRAGMENTS_H

#include "base/partition.h"
#include "engine/record.h"

/* Sums over the nodes of one fragment; all 0 to begin with. */
typedef struct {
    int64_t elements, nodes;
    double mass;        /* kg */
    double size;        /* m: not a sum over nodes, the formulation says it */
    double first[3];    /* kg m: of m x */
    double origin[3];   /* m: place of its first node; */
    double second[6];   /* kg m2: of m y_i y_j of y = x - origin: xx, yy, zz, yz, zx, xy. So they are not lost in the rounding of a place far off */
    double momentum[3]; /* kg m/s: of m v */
    double moment[3];   /* kg m2/s: of x x m v, about (0, 0, 0) */
} fracas_fragment_sums;

/* Adds a node of `mass` [kg] at x [m] with velocity v [m/s]. */
void fracas_fragment_sums_add(fracas_fragment_sums *sums, double mass, const double x[3], const double v[3]);

/* Adds node k of masses M_kl that couple it with others, all of them of this fragment: mass = sum over l of M_kl [kg], carried
 * = sum of M_kl x_l [kg m], momentum = sum of M_kl v_l [kg m/s], x its own place [m]. Symmetric once all are added. */
void fracas_fragment_sums_add_coupled(fracas_fragment_sums *sums, double mass, const double x[3], const double carried[3],
                                      const double momentum[3]);

/* Gives the record `count` fragments of these sums and its momentum: centre of mass X, its velocity V, angular momentum about
 * it L = sum of x x m v - M X x V, spin = I^-1 L with I = sum of m ((y.y) 1 - y y^T), y = x - X, or where I is singular (nodes on
 * a line, a single node) the least such spin: 0 about an axis without inertia. Dust are fragments of at most `dust` elements. */
FRACAS_MUST_USE fracas_err fracas_fragments_take(const fracas_fragment_sums *sums, size_t count, int64_t dust, fracas_record *record);

#endif
