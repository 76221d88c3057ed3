/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangles with 3 (order 1) or 6 (order 2) nodes: shape functions and quadrature
 * (docs/theory/membrane.md).
 *
 * Reference triangle (0,0), (1,0), (0,1) with barycentric coordinates l_0 = 1 - xi - eta, l_1 = xi,
 * l_2 = eta; node 3 + k is in the middle of edge k, from vertex k to vertex k + 1 (mod 3). Order 2:
 *   N_k = l_k (2 l_k - 1), N_{3+k} = 4 l_k l_{k+1} (membrane.1) */
#ifndef FRACAS_ENGINE_ELEMENT_TRIANGLE_H
#define FRACAS_ENGINE_ELEMENT_TRIANGLE_H

#include "base/param.h"

/* Values N[3 order] and derivatives D[3 order][2] by xi, eta at a point. */
void fracas_triangle_shape(int order, double xi, double eta, double *value,
                           double (*derivative)[2]);

/* Points at which bulk stresses are kept: 1 for order 1, 3 for order 2 (point g nearest to vertex
 * g, l_g = 2/3); both integrate the elastic energy of a straight-sided triangle exactly. A stress
 * linear over the triangle is s = sum_g (2 l_g - 1/3) s_g  (membrane.2). Their xi, eta, and the
 * derivatives there: */
#define FRACAS_TRIANGLE_POINTS_1 FRACAS_BRACES({1.0 / 3, 1.0 / 3})
#define FRACAS_TRIANGLE_POINTS_2 \
    FRACAS_BRACES({1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3})
#define T_(x) ((x) / 3.0)
#define FRACAS_TRIANGLE_DERIVATIVES_1 FRACAS_BRACES({{-1.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}})
#define FRACAS_TRIANGLE_DERIVATIVES_2    \
    FRACAS_BRACES({{T_(-5.0), T_(-5.0)}, \
                   {T_(-1.0), 0.0},      \
                   {0.0, T_(-1.0)},      \
                   {2.0, T_(-2.0)},      \
                   {T_(2.0), T_(2.0)},   \
                   {T_(-2.0), 2.0}},     \
                  {{T_(1.0), T_(1.0)},   \
                   {T_(5.0), 0.0},       \
                   {0.0, T_(-1.0)},      \
                   {-2.0, T_(-8.0)},     \
                   {T_(2.0), T_(8.0)},   \
                   {T_(-2.0), 0.0}},     \
                  {{T_(1.0), T_(1.0)},   \
                   {T_(-1.0), 0.0},      \
                   {0.0, T_(5.0)},       \
                   {0.0, T_(-2.0)},      \
                   {T_(8.0), T_(2.0)},   \
                   {T_(-8.0), -2.0}})

/* Second derivatives of the shape functions of order 2, the same everywhere: by xi xi, by eta eta,
 * by xi eta. */
#define FRACAS_TRIANGLE_SECOND_2                                                    \
    FRACAS_BRACES({4.0, 4.0, 0.0, -8.0, 0.0, 0.0}, {4.0, 0.0, 4.0, 0.0, 0.0, -8.0}, \
                  {4.0, 0.0, 0.0, -4.0, 4.0, -4.0})

/* A rule of degree 6 with 12 points (Dunavant 1985): xi, eta, weight; weights sum to 1/2. */
enum { FRACAS_TRIANGLE_FINE = 12 };
extern const double fracas_triangle_fine[FRACAS_TRIANGLE_FINE][3];

/* Gauss points on an edge, s in (0, 1) from its first vertex: 2 of weight 1/2 for order 1, 3 of
 * weights 5/18, 8/18, 5/18 for order 2. */
#define FRACAS_EDGE_POINTS_1 FRACAS_BRACES(0.21132486540518712, 0.78867513459481288)
#define FRACAS_EDGE_POINTS_2 FRACAS_BRACES(0.11270166537925831, 0.5, 0.88729833462074169)
#define FRACAS_EDGE_WEIGHTS_1 FRACAS_BRACES(0.5, 0.5)
#define FRACAS_EDGE_WEIGHTS_2 \
    FRACAS_BRACES(0.27777777777777778, 0.44444444444444444, 0.27777777777777778)
#define FRACAS_EDGE_MOST 3

/* At s on an edge: shape functions of its ends and its middle, and the weights by which stresses at
 * the bulk points next to its ends, and away from it, give the stress there  (membrane.2). Here,
 * not in the C file, to be folded into the kernels. */
static inline __attribute__((always_inline)) void
fracas_edge_shape(int order, double s, double shape[3], double spread[3])
{
    shape[0] = order == 1 ? 1 - s : (1 - s) * (1 - 2 * s);
    shape[1] = order == 1 ? s : s * (2 * s - 1);
    shape[2] = 4 * s * (1 - s);
    spread[0] = 2 * (1 - s) - 1.0 / 3;
    spread[1] = 2 * s - 1.0 / 3;
    spread[2] = -1.0 / 3;
}

/* Derivatives by s of those shape functions, of order 2. */
static inline __attribute__((always_inline)) void fracas_edge_slope(double s, double slope[3])
{
    slope[0] = 4 * s - 3;
    slope[1] = 4 * s - 1;
    slope[2] = 4 - 8 * s;
}

#endif
