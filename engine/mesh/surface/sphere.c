/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spheres: each face of a polyhedron cut into divisions^2 triangles. */
#include "base/elementary.h"
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <math.h>

#define EQUILATERAL 0.43301270189221932 /* area by the square of the edge: sqrt(3)/4 */

enum { MOST_VERTICES = 12, MOST_FACES = 20 };

/* Neighbouring vertices span the angle pi `arc` at the origin. */
typedef struct {
    size_t nvertices, nfaces, nedges;
    double vertex[MOST_VERTICES][3];
    size_t face[MOST_FACES][3];                /* anticlockwise, seen from outside */
    size_t edge[MOST_VERTICES][MOST_VERTICES]; /* number of the edge between two */
    double arc;
} polyhedron;

static double square_distance(const double a[3], const double b[3])
{
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return fracas_surface_dot(d, d);
}

/* Edges and faces: pairs and triples of vertices no further apart than the edge's square. */
static void connect(polyhedron *solid, double edge_square)
{
    static const double origin[3];
    bool is_near[MOST_VERTICES][MOST_VERTICES];
    for (size_t a = 0; a < solid->nvertices; a++)
        for (size_t b = 0; b < solid->nvertices; b++) {
            is_near[a][b] = a != b && square_distance(solid->vertex[a], solid->vertex[b]) <
                                          1.01 * edge_square;
            if (a < b && is_near[a][b]) solid->edge[a][b] = solid->edge[b][a] = solid->nedges++;
        }
    for (size_t a = 0; a < solid->nvertices; a++)
        for (size_t b = a + 1; b < solid->nvertices; b++)
            for (size_t c = b + 1; c < solid->nvertices; c++) {
                if (!is_near[a][b] || !is_near[b][c] || !is_near[c][a]) continue;
                double normal[3];
                fracas_surface_normal(origin, solid->vertex[a], solid->vertex[b], normal);
                const bool is_outward = fracas_surface_dot(normal, solid->vertex[c]) > 0.0;
                size_t *face = solid->face[solid->nfaces++];
                face[0] = a;
                face[1] = is_outward ? b : c;
                face[2] = is_outward ? c : b;
            }
}

static polyhedron icosahedron(void)
{
    const double golden = 1.61803398874989485;
    polyhedron solid = {.nvertices = 12, .arc = 0.352416382349566726}; /* atan(2)/pi */
    for (size_t v = 0; v < 12; v++) {
        const size_t axis = v / 4;
        solid.vertex[v][(axis + 1) % 3] = v % 2 ? -1.0 : 1.0;
        solid.vertex[v][(axis + 2) % 3] = v / 2 % 2 ? -golden : golden;
    }
    connect(&solid, 4.0);
    return solid;
}

/* The face of an octahedron where x, y, z >= 0. */
static polyhedron octant(void)
{
    polyhedron solid = {.nvertices = 3, .arc = 0.5};
    for (size_t v = 0; v < 3; v++) solid.vertex[v][v] = 1.0;
    connect(&solid, 2.0);
    return solid;
}

/* Number of the node `step[k]` divisions away from the side opposite of each corner k of the face.
 * Vertices come first, then edges, each from its lower vertex, then faces, row by row. */
static uint32_t number_of(const polyhedron *solid, size_t face, size_t n, const size_t step[3])
{
    const size_t *corner = solid->face[face];
    for (size_t k = 0; k < 3; k++)
        if (step[k] == n) return (uint32_t)corner[k];
    for (size_t k = 0; k < 3; k++) {
        if (step[k] != 0) continue;
        const size_t a = corner[(k + 1) % 3], b = corner[(k + 2) % 3];
        const size_t from_low = a < b ? step[(k + 2) % 3] : step[(k + 1) % 3];
        return (uint32_t)(solid->nvertices + solid->edge[a][b] * (n - 1) + from_low - 1);
    }
    const size_t row = step[0] - 1; /* rows 0, 1, ... of n - 2, n - 3, ... nodes */
    const size_t before = row * (n - 2) - row * (row - 1) / 2; /* for row 0: 0 - 0, modulo 2^64 */
    return (uint32_t)(solid->nvertices + solid->nedges * (n - 1) + face * ((n - 1) * (n - 2) / 2) +
                      before + step[1] - 1);
}

/* (meshes.5) */
static void place(const polyhedron *solid, size_t face, size_t n, const size_t step[3],
                  double radius, double node[3])
{
    for (int i = 0; i < 3; i++) node[i] = 0.0;
    for (size_t k = 0; k < 3; k++) {
        const double weight = fracas_sinpi(solid->arc * ((double)step[k] / (double)n));
        for (int i = 0; i < 3; i++) node[i] += weight * solid->vertex[solid->face[face][k]][i];
    }
    fracas_surface_project(node, radius);
}

static void fill_face(const polyhedron *solid, size_t face, size_t n, double radius,
                      fracas_surface_draft *draft)
{
    uint32_t *put = draft->element + 3 * face * n * n;
    for (size_t i = 0; i <= n; i++)
        for (size_t j = 0; j <= n - i; j++) {
            const size_t k = n - i - j, here[3] = {i, j, k};
            const uint32_t number = number_of(solid, face, n, here);
            place(solid, face, n, here, radius, draft->node[number]);
            if (k == 0) continue;
            const size_t first[3] = {i + 1, j, k - 1}, second[3] = {i, j + 1, k - 1};
            *put++ = number;
            *put++ = number_of(solid, face, n, first);
            *put++ = number_of(solid, face, n, second);
            if (k == 1) continue;
            const size_t third[3] = {i + 1, j + 1, k - 2};
            *put++ = number_of(solid, face, n, first);
            *put++ = number_of(solid, face, n, third);
            *put++ = number_of(solid, face, n, second);
        }
}

/* Edges of the octant: on edge k the coordinate k is 0. */
static void fill_tags(const polyhedron *solid, size_t n, fracas_surface_tag *put)
{
    for (size_t k = 0; k < 3; k++)
        for (size_t s = 0; s < n; s++) {
            size_t from[3] = {0}, to[3] = {0};
            from[(k + 1) % 3] = n - s;
            from[(k + 2) % 3] = s;
            to[(k + 1) % 3] = n - s - 1;
            to[(k + 2) % 3] = s + 1;
            *put++ = (fracas_surface_tag){
                .node = {number_of(solid, 0, n, from), number_of(solid, 0, n, to)},
                .tag = (int32_t)k + 1};
        }
}

/* 2 E = 3 F: every edge is that of two faces. */
static bool is_closed(const polyhedron *solid)
{
    return 2 * solid->nedges == 3 * solid->nfaces;
}

static fracas_err fill(const polyhedron *solid, double radius, double n,
                       fracas_surface_draft *draft)
{
    const double faces = (double)solid->nfaces, edges = (double)solid->nedges;
    TRY(fracas_surface_draft_init(
        draft, (double)solid->nvertices + edges * (n - 1.0) + faces * (n - 1.0) * (n - 2.0) / 2.0,
        faces * n * n, is_closed(solid) ? 0.0 : 3.0 * n));
    draft->round = radius;
    for (int t = 0; t < FRACAS_SURFACE_TAGS; t++) draft->radius[t] = radius;
    for (size_t face = 0; face < solid->nfaces; face++)
        fill_face(solid, face, (size_t)n, radius, draft);
    if (!is_closed(solid)) fill_tags(solid, (size_t)n, draft->tag);
    return FRACAS_OK;
}

static fracas_err make(const polyhedron *solid, double radius,
                       const fracas_surface_fineness *fineness, const fracas_surface **surface)
{
    TRY(fracas_surface_check_length("the radius", radius));
    const double solid_angle = is_closed(solid) ? 4.0 * FRACAS_PI : 0.5 * FRACAS_PI;
    double n; /* n^2 equilateral triangles are as large as the part of the sphere over a face */
    TRY(fracas_surface_divide(fineness, radius,
                              sqrt(EQUILATERAL * (double)solid->nfaces / solid_angle), &n));
    FRACAS_CLEARED(fracas_surface_draft) draft = {0};
    TRY(fill(solid, radius, n, &draft));
    return fracas_surface_draft_finish(&draft, fineness, surface);
}

fracas_err fracas_surface_draft_octant(double radius, double divisions, fracas_surface_draft *draft)
{
    const polyhedron solid = octant();
    return fill(&solid, radius, divisions, draft);
}

fracas_err fracas_surface_sphere(double radius, const fracas_surface_fineness *fineness,
                                 const fracas_surface **surface)
{
    const polyhedron solid = icosahedron();
    return make(&solid, radius, fineness, surface);
}

fracas_err fracas_surface_octant(double radius, const fracas_surface_fineness *fineness,
                                 const fracas_surface **surface)
{
    const polyhedron solid = octant();
    return make(&solid, radius, fineness, surface);
}
