/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of this folder. */
#ifndef FRACAS_ENGINE_MESH_SURFACE_PARTS_H
#define FRACAS_ENGINE_MESH_SURFACE_PARTS_H

#include "engine/mesh/surface/surface.h"

#include <stdbool.h>

/* An edge as one element sees it. */
typedef struct {
    uint32_t low, high; /* its vertices */
    uint32_t element, edge;
} fracas_surface_side;

/* All 3 nelements sides, sorted by vertices, then by element. The caller frees them; NULL without
 * memory. */
fracas_surface_side *fracas_surface_sides(const uint32_t *element, size_t nelements,
                                          size_t corners);

static inline bool fracas_surface_same_edge(const fracas_surface_side *a,
                                            const fracas_surface_side *b)
{
    return a->low == b->low && a->high == b->high;
}

/* First side of the edge between two vertices, `nsides` where there is none. */
size_t fracas_surface_find_edge(const fracas_surface_side *side, size_t nsides, uint32_t a,
                                uint32_t b);

/* Sides of the edge that begins at `first`: they end before the return value. */
static inline size_t fracas_surface_next_edge(const fracas_surface_side *side, size_t first,
                                              size_t nsides)
{
    size_t next = first + 1;
    while (next < nsides && fracas_surface_same_edge(&side[first], &side[next])) next++;
    return next;
}

/* Numbers as messages give them. */
static inline int64_t fracas_surface_element_name(const fracas_surface_arrays *arrays,
                                                  size_t element)
{
    return arrays->element_number ? arrays->element_number[element] : (int64_t)element;
}

static inline int64_t fracas_surface_node_name(const fracas_surface_arrays *arrays, size_t node)
{
    return arrays->node_number ? arrays->node_number[node] : (int64_t)node;
}

/* Checks of single elements and their nodes; of neighbours; of elements of order 2. */
FRACAS_MUST_USE fracas_err fracas_surface_check_elements(const fracas_surface_arrays *arrays);
FRACAS_MUST_USE fracas_err fracas_surface_check_edges(const fracas_surface_arrays *arrays,
                                                      const fracas_surface_side *side);
FRACAS_MUST_USE fracas_err fracas_surface_check_jacobians(const fracas_surface_arrays *arrays);

/* Turns elements, whose nodes are `element`, until neighbours go round alike: in a flat mesh
 * counter-clockwise seen from +z, else as most of their part do. Elements that do so already stay.
 * *turned: how many were turned. FRACAS_USAGE for a surface of one side. */
FRACAS_MUST_USE fracas_err fracas_surface_orient(const fracas_surface_arrays *arrays, bool flat,
                                                 uint32_t *element, size_t *turned);

/* order[k]: the k-th element in the reverse order of Cuthill and McKee; neighbour[e][k]: the
 * element across edge k, UINT32_MAX for none. */
FRACAS_MUST_USE fracas_err fracas_surface_order(size_t nelements, const uint32_t (*neighbour)[3],
                                                uint32_t *order);

/* The area of an element of a surface whose nodes and elements are there [m2]. */
double fracas_surface_find_area(const fracas_surface *surface, size_t element);

/* c = (b - a) x (d - a), twice the area of the triangle a, b, d along its normal. */
static inline void fracas_surface_normal(const double a[3], const double b[3], const double d[3],
                                         double c[3])
{
    const double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]},
                 v[3] = {d[0] - a[0], d[1] - a[1], d[2] - a[2]};
    c[0] = u[1] * v[2] - u[2] * v[1];
    c[1] = u[2] * v[0] - u[0] * v[2];
    c[2] = u[0] * v[1] - u[1] * v[0];
}

static inline double fracas_surface_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- meshes in the making ---- */

enum { FRACAS_SURFACE_TAGS = 5 }; /* tags 0 to 4 */

/* Vertices, triangles and tags of a body; `radius` says for each tag (0: every other edge) onto
 * which radius around the origin mid-side nodes go, 0: they stay where they are. */
typedef struct {
    size_t nvertices, nelements, ntags;
    double (*node)[3];
    uint32_t *element; /* [nelements][3] */
    fracas_surface_tag *tag;
    double radius[FRACAS_SURFACE_TAGS];
    double round; /* radius on which vertices stay; 0: in the plane z = 0 */
    double axis;  /* this and all radii are around the part |y| <= axis of the y axis: 0 a sphere,
                     INFINITY a tube */
} fracas_surface_draft;

/* Room for so many; the caller clears. */
FRACAS_MUST_USE fracas_err fracas_surface_draft_init(fracas_surface_draft *draft, double nvertices,
                                                     double nelements, double ntags);
void fracas_surface_draft_clear(fracas_surface_draft *draft);

/* The octant of a sphere with so many divisions, as fracas_surface_octant. */
FRACAS_MUST_USE fracas_err fracas_surface_draft_octant(double radius, double divisions,
                                                       fracas_surface_draft *draft);

/* Perturbs, adds mid-side nodes, assembles. */
FRACAS_MUST_USE fracas_err fracas_surface_draft_finish(const fracas_surface_draft *draft,
                                                       const fracas_surface_fineness *fineness,
                                                       const fracas_surface **surface);

/* Refuses a length that no body has. */
FRACAS_MUST_USE fracas_err fracas_surface_check_length(const char *what, double length);
/* Whole number of divisions of `length`, each `height` times the size of elements. */
FRACAS_MUST_USE fracas_err fracas_surface_divide(const fracas_surface_fineness *fineness,
                                                 double length, double height, double *divisions);
/* Moves `point` along its line through the origin to the distance `radius`. */
void fracas_surface_project(double point[3], double radius);

#define FRACAS_SURFACE_LEG \
    0.93060485910209960 /* sqrt(sqrt(3)/2): half a square's leg by its edge */

/* Elements and tags of nx by ny squares cut in two along alternating diagonals, nodes row by row;
 * `closed`: the last square of a row is beside the first, and nx even. Tags: 1 first column, 2 last
 * column, 3 first row, 4 last row. */
void fracas_surface_fill_grid(fracas_surface_draft *draft, size_t nx, size_t ny, bool closed);

#endif
