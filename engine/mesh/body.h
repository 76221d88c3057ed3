/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bodies that can be broken up, and their meshes: the sections `geometry` and `mesh`. */
#ifndef FRACAS_ENGINE_MESH_BODY_H
#define FRACAS_ENGINE_MESH_BODY_H

#include "engine/mesh/edge.h"
#include "engine/mesh/surface/surface.h"
#include "engine/spec.h"

#include <stdbool.h>

/* Traits of a shape. */
typedef struct {
    double (*length)(const fracas_geometry *); /* whole chain [m]; NULL: a surface */
    double (*period)(const fracas_geometry *); /* bar, 0 unless it closes on itself; NULL: 0 */
    bool (*free)(const fracas_geometry *);     /* its ends move by themselves; NULL: it has none */
    double (*gap)(const fracas_geometry *); /* walls beyond free ends [m]; NaN: none; NULL: NaN */
    /* Makes the mesh of a surface; NULL of chains. */
    fracas_err (*make)(const fracas_geometry *, const fracas_surface_fineness *,
                       const fracas_surface **);
    bool round;     /* a chain along a circle in the plane */
    bool even;      /* without holes, notches and curvature: stretches evenly */
    bool from_file; /* the mesh is an attachment */
    /* Kind of the edges of a tag, which the shape decides; NULL: the campaign chooses. Such edges
     * lie along an expansion. NULL without any. */
    const fracas_kind *(*edge)(const fracas_geometry *, int32_t tag);
    /* Free, and set growing at the rates (1, ratio, 1) along x, y, z. Largest stress by an even
     * stretch's; NULL: 4. Largest strain by rate [s]; NULL: 4 passages of a wave. */
    double (*concentration)(double ratio);
    double (*swing)(const fracas_spec *, double ratio);
} fracas_shape;

/* Traits of a part of a shape. */
typedef struct {
    int planes; /* number of planes of symmetry: z = 0, x = 0, y = 0, in this order */
} fracas_part_of_shape;

/* Traits of a spacing. */
typedef struct {
    bool uniform;   /* elements of one length */
    bool rows;      /* triangles in regular rows, unless they are perturbed */
    bool from_file; /* the elements are those of a mesh file */
    bool moves;     /* moves the nodes of a chain at random */
    /* Lengths [m] of the elements of a bar whose ends stay; NULL: all are equal. */
    fracas_err (*fill)(const fracas_mesh *, double length, double *size);
} fracas_spacing;

extern const fracas_section fracas_geometry_section;
extern const fracas_kind fracas_shape_bar, fracas_shape_ring, fracas_shape_plate,
    fracas_shape_annulus, fracas_shape_sphere, fracas_shape_cylinder, fracas_shape_capsule,
    fracas_shape_file;
extern const fracas_kind fracas_part_whole, fracas_part_half, fracas_part_quarter,
    fracas_part_octant;
extern const fracas_kind fracas_ends_periodic, fracas_ends_held, fracas_ends_free;
extern const fracas_kind fracas_direction_initial, fracas_direction_current;

extern const fracas_section fracas_mesh_section;
extern const fracas_kind fracas_spacing_uniform, fracas_spacing_graded, fracas_spacing_perturbed,
    fracas_spacing_triangles, fracas_spacing_given;

/* Tag of the edges of a shape, by their key in `geometry`. FRACAS_USAGE names the parameter
 * `asked`, which has the key, and lists the shape's own, and the names in its mesh file. */
FRACAS_MUST_USE fracas_err fracas_shape_edge_tag(const fracas_geometry *geometry, const char *asked,
                                                 const char *key, int32_t *tag);

/* The name that the body's mesh file gives to the edges of a key; false: none. */
bool fracas_shape_edge_name(const fracas_geometry *geometry, const char *key,
                            char name[FRACAS_RENAMED]);

static inline const fracas_shape *fracas_shape_of(const fracas_spec *spec)
{
    return spec->geometry.shape->traits;
}
static inline const fracas_spacing *fracas_spacing_of(const fracas_spec *spec)
{
    return spec->mesh.spacing->traits;
}

/* Kind of the edges of a tag, by the shape; NULL: the campaign chooses. */
static inline const fracas_kind *fracas_shape_edge(const fracas_spec *spec, int32_t tag)
{
    const fracas_shape *shape = fracas_shape_of(spec);
    return shape->edge ? shape->edge(&spec->geometry, tag) : NULL;
}

static inline bool fracas_spec_is_surface(const fracas_spec *spec)
{
    return fracas_shape_of(spec)->make != NULL;
}

#endif
