/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces of triangles in space, for membranes and shells (docs/theory/meshes.md). Lengths in m.
 *
 * A triangle has the vertices 0, 1, 2; its edge k goes from vertex k to vertex k + 1 (mod 3). Order
 * 2 adds the nodes 3, 4, 5 on the edges 0, 1, 2. Neighbours go along their common edge in opposite
 * directions, so that every normal of a connected surface points to the same side.
 *
 * Each maker sets a surface, finished and checked: many threads may read it. FRACAS_USAGE names a
 * fault of the input, FRACAS_ENVIRONMENT means no memory; then none is made. */
#ifndef FRACAS_ENGINE_MESH_SURFACE_SURFACE_H
#define FRACAS_ENGINE_MESH_SURFACE_SURFACE_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FRACAS_SURFACE_LARGEST ((size_t)100000000) /* elements or nodes of a mesh */
#define FRACAS_SURFACE_AMPLITUDE 0.3               /* largest perturbation: no element can invert */

/* An edge between two elements. */
typedef struct {
    uint32_t element[2]; /* the lower one first */
    uint32_t edge[2];    /* its number in each */
    int32_t tag;         /* 0: none given */
} fracas_surface_interface;

/* An edge of the boundary. */
typedef struct {
    uint32_t element, edge;
    int32_t tag; /* 0: none given */
} fracas_surface_border;

/* A physical group of Gmsh's, of curves. */
typedef struct {
    int32_t number;
    char name[64];
} fracas_surface_group;

typedef struct fracas_surface {
    int order;      /* 1 or 2 */
    size_t corners; /* nodes of an element: 3 or 6 */
    size_t nnodes, nelements, ninterfaces, nborders;
    size_t nvertices;        /* nodes that are a vertex of an element */
    size_t turned;           /* elements of a file that went round against the others */
    const double (*node)[3]; /* in the order in which elements first name them */
    const uint32_t *element; /* [nelements][corners]: nodes, neighbours close to each other */
    const fracas_surface_interface *interface; /* sorted by their elements */
    const fracas_surface_border *border;       /* sorted by element and edge */
    size_t ngroups;
    const fracas_surface_group *group; /* those with names */
    unsigned passed; /* bits by tags: those of which an edge has another tag, a lesser one, too */
    const int64_t *given; /* [nelements] number of the element as it was given */
    const double *area; /* [nelements] m2: exact for straight edges in a plane, else by a quadrature
                           whose error falls as h^6 */
} fracas_surface;

/* A tag for the edge between two nodes, which are vertices. */
typedef struct {
    uint32_t node[2];
    int32_t tag;
} fracas_surface_tag;

/* A mesh as it comes. */
typedef struct {
    int order;
    size_t nnodes, nelements, ntags, turned, ngroups;
    const double (*node)[3];
    const uint32_t *element; /* [nelements][3 order] */
    const fracas_surface_tag *tag;
    const fracas_surface_group *group;
    unsigned passed;                             /* as of fracas_surface */
    const int64_t *node_number, *element_number; /* for messages; NULL: their index, from 0 */
} fracas_surface_arrays;

/* Refuses, with the number of the element: nodes out of range, repeated or unused; coordinates that
 * are no number; areas or edges below 1e-9 of the mean; equal triangles; edges of three or more
 * elements; an element turned against its neighbours, or folded back on one by more than 120
 * degrees; Jacobians not positive everywhere; mid-side nodes not shared; tags without edge or two
 * of an edge. */
FRACAS_MUST_USE fracas_err fracas_surface_assemble(const fracas_surface_arrays *arrays,
                                                   const fracas_surface **surface);
void fracas_surface_destroy(const fracas_surface *surface); /* NULL is allowed */
size_t fracas_surface_bytes(const fracas_surface *surface); /* all arrays together */

/* ---- meshes of simple bodies ---- */

typedef struct {
    double size; /* edge of the equilateral triangle with the mean area of elements [m]; or 0 and */
    size_t divisions; /* a number, see each body; 0 where there is a size */
    int order;
    double amplitude;         /* perturbation in local edge lengths, to FRACAS_SURFACE_AMPLITUDE */
    const double (*shift)[2]; /* two numbers in [-1, 1] for every vertex; NULL: no perturbation */
    size_t nshifts;           /* as many as `nvertices` of the mesh without perturbation */
    bool flat;                /* a file is for a body in a plane z = const */
} fracas_surface_fineness;

/* -width/2 <= x <= width/2, -height/2 <= y <= height/2, normal +z; squares cut in two, diagonals
 * alternating. `divisions` of the shorter side. Tags: 1 smallest x, 2 largest x, 3 smallest y, 4
 * largest y. */
FRACAS_MUST_USE fracas_err fracas_surface_rectangle(double width, double height,
                                                    const fracas_surface_fineness *fineness,
                                                    const fracas_surface **surface);
/* Around the origin, normal +z. `divisions` layers of elements between the circles. Tags: 1 inner,
 * 2 outer circle. */
FRACAS_MUST_USE fracas_err fracas_surface_annulus(double inner, double outer,
                                                  const fracas_surface_fineness *fineness,
                                                  const fracas_surface **surface);
/* Around the origin, normals outward; an icosahedron of which each edge has `divisions`: 20
 * divisions^2 elements. */
FRACAS_MUST_USE fracas_err fracas_surface_sphere(double radius,
                                                 const fracas_surface_fineness *fineness,
                                                 const fracas_surface **surface);
/* The part x, y, z >= 0 of a sphere, normals outward; divisions^2 elements. Nodes on a plane of
 * symmetry are on it to the last bit. Tags: 1 x = 0, 2 y = 0, 3 z = 0. */
FRACAS_MUST_USE fracas_err fracas_surface_octant(double radius,
                                                 const fracas_surface_fineness *fineness,
                                                 const fracas_surface **surface);

/* Place of node `corner` of an element [m]. */
static inline const double *fracas_surface_node(const fracas_surface *surface, size_t element,
                                                size_t corner)
{
    return surface->node[surface->element[element * surface->corners + corner]];
}

/* Sides of the box around all nodes [m]. */
void fracas_surface_box(const fracas_surface *surface, double side[3]);

/* |dx/dxi x dx/deta| and the values of the shape functions at a point of an element [m2]. */
double fracas_surface_density(const fracas_surface *surface, size_t element, double xi, double eta,
                              double shape[6]);
/* Length of an edge [m]: exact for straight edges, else by a quadrature whose error falls as h^6.
 */
double fracas_surface_length(const fracas_surface *surface, size_t element, size_t edge);

#endif
