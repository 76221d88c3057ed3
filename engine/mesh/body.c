/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/body.h"

#include "engine/formulation/formulation.h"
#include "engine/mesh/surface/surface.h"
#include "engine/spec.h"

const fracas_kind fracas_ends_periodic = {
    .name = "periodic", .doc = "the bar closes on itself, as the hoop direction of a ring does"};
const fracas_kind fracas_ends_held = {.name = "held",
                                      .doc = "both ends move with the imposed rate"};
static const fracas_kind *const ends[] = {&fracas_ends_periodic, &fracas_ends_held};

const fracas_kind fracas_direction_initial = {
    .name = "initial", .doc = "interfaces open along the circumference as it was at the start"};
const fracas_kind fracas_direction_current = {
    .name = "current",
    .doc = "interfaces open along the mean of their two elements, wherever these have turned"};
static const fracas_kind *const directions[] = {&fracas_direction_current,
                                                &fracas_direction_initial};

const fracas_kind fracas_edge_free = {.name = "free", .doc = "nothing holds the edge"};
const fracas_kind fracas_edge_held = {
    .name = "held",
    .doc = "the edge moves with the velocity of the loading all the time: that of the expansion, "
           "or none; a shell may turn about it"};
const fracas_kind fracas_edge_sliding = {
    .name = "sliding",
    .doc = "membranes: as held, but free to slide along itself; an edge along x or y only"};
const fracas_kind fracas_edge_fixed = {
    .name = "fixed", .doc = "the edge stays where it is; a shell may turn about it"};
const fracas_kind fracas_edge_clamped = {
    .name = "clamped", .doc = "shells: the edge stays where it is and does not turn"};
const fracas_kind fracas_edge_symmetry = {.name = "symmetry",
                                          .doc = "shells: the edge lies in a plane x, y or z = "
                                                 "const, and what is beyond is the mirror image"};
const fracas_kind fracas_edge_diaphragm = {
    .name = "diaphragm",
    .doc = "shells: the edge lies in a plane x, y or z = const and does not move in it; it may "
           "leave it, and the shell turn about it"};
static const fracas_kind *const edges[] = {
    &fracas_edge_free,    &fracas_edge_held,     &fracas_edge_sliding,  &fracas_edge_fixed,
    &fracas_edge_clamped, &fracas_edge_symmetry, &fracas_edge_diaphragm};
const fracas_kind fracas_part_whole = {.name = "whole", .doc = "all of it"};
const fracas_kind fracas_part_octant = {.name = "octant",
                                        .doc = "x, y, z >= 0; the other seven are mirror images"};
static const fracas_kind *const parts[] = {&fracas_part_whole, &fracas_part_octant};
#define EDGE(key, tag, what)                                                          \
    {                                                                                 \
        .name = key, .type = FRACAS_CHOICE, .unit = "1", .doc = "what holds " what,   \
        .choices = edges, .nchoices = FRACAS_COUNT(edges),                            \
        .offset = offsetof(fracas_geometry, edge) + tag * sizeof(const fracas_kind *) \
    }
#define AREA                                                                             \
    {                                                                                    \
        "area", FRACAS_REAL, "m2", "area of the cross-section", 1e-6, 0, INFINITY, true, \
            offsetof(fracas_geometry, area)                                              \
    }
#define THICKNESS                                                                             \
    {                                                                                         \
        "thickness", FRACAS_REAL, "m", "thickness of the plate or shell", FRACAS_REQUIRED, 0, \
            INFINITY, true, offsetof(fracas_geometry, thickness)                              \
    }
#define LENGTH(key, member, what)                                        \
    {                                                                    \
        key, FRACAS_REAL, "m", what, FRACAS_REQUIRED, 0, INFINITY, true, \
            offsetof(fracas_geometry, member)                            \
    }

static const fracas_param bar[] = {
    AREA,
    {"length", FRACAS_REAL, "m",
     "length of the bar; with periodic ends that of the circumference it stands for",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_geometry, length)},
    {.name = "ends",
     .type = FRACAS_CHOICE,
     .unit = "1",
     .doc = "what happens at the bar's two ends",
     .choices = ends,
     .nchoices = FRACAS_COUNT(ends),
     .offset = offsetof(fracas_geometry, ends)},
};
const fracas_kind fracas_shape_bar = {
    .name = "bar", .doc = "a straight bar", .params = bar, .nparams = FRACAS_COUNT(bar)};

static const fracas_param ring[] = {
    AREA,
    {"radius", FRACAS_REAL, "m", "radius of the ring: its circumference is 2 pi radius",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_geometry, radius)},
    {.name = "direction",
     .type = FRACAS_CHOICE,
     .unit = "1",
     .doc = "in which interfaces open",
     .choices = directions,
     .nchoices = FRACAS_COUNT(directions),
     .offset = offsetof(fracas_geometry, direction)},
};
const fracas_kind fracas_shape_ring = {
    .name = "ring", .doc = "a closed thin ring", .params = ring, .nparams = FRACAS_COUNT(ring)};

static const fracas_param plate[] = {
    LENGTH("width", width, "along x, from -width/2 to width/2"),
    LENGTH("height", height, "along y, from -height/2 to height/2"),
    THICKNESS,
    EDGE("left", 1, "the edge at the smallest x"),
    EDGE("right", 2, "the edge at the largest x"),
    EDGE("bottom", 3, "the edge at the smallest y"),
    EDGE("top", 4, "the edge at the largest y"),
};
const fracas_kind fracas_shape_plate = {.name = "plate",
                                        .doc = "a flat rectangle about the origin",
                                        .params = plate,
                                        .nparams = FRACAS_COUNT(plate)};

static const fracas_param annulus[] = {
    LENGTH("inner", inner, "radius of the hole"),
    LENGTH("outer", outer, "radius of the rim"),
    THICKNESS,
    EDGE("inner_edge", 1, "the edge of the hole"),
    EDGE("outer_edge", 2, "the rim"),
};
const fracas_kind fracas_shape_annulus = {.name = "annulus",
                                          .doc = "a flat plate ring about the origin",
                                          .params = annulus,
                                          .nparams = FRACAS_COUNT(annulus)};

static const fracas_param sphere[] = {
    LENGTH("radius", radius, "radius of the mid-surface"),
    THICKNESS,
    {.name = "part",
     .type = FRACAS_CHOICE,
     .unit = "1",
     .doc = "how much of it is there",
     .choices = parts,
     .nchoices = FRACAS_COUNT(parts),
     .offset = offsetof(fracas_geometry, part)},
};
const fracas_kind fracas_shape_sphere = {.name = "sphere",
                                         .doc = "a thin spherical shell about the origin",
                                         .params = sphere,
                                         .nparams = FRACAS_COUNT(sphere)};

static const fracas_param file[] = {
    {.name = "file",
     .type = FRACAS_ATTACHMENT,
     .unit = "1",
     .doc = "Gmsh file (MSH 2.2 or 4.1) of triangles with 3 or 6 nodes, in m",
     .fallback = FRACAS_REQUIRED,
     .offset = offsetof(fracas_geometry, file)},
    THICKNESS,
    EDGE("edges", 0, "all edges but those of the physical groups below"),
    EDGE("edge_1", 1, "the edges of the physical group 1"),
    EDGE("edge_2", 2, "the edges of the physical group 2"),
    EDGE("edge_3", 3, "the edges of the physical group 3"),
    EDGE("edge_4", 4, "the edges of the physical group 4"),
};
const fracas_kind fracas_shape_file = {.name = "file",
                                       .doc = "the surface of a mesh file",
                                       .params = file,
                                       .nparams = FRACAS_COUNT(file)};

static const fracas_kind *const shapes[] = {&fracas_shape_bar,    &fracas_shape_ring,
                                            &fracas_shape_plate,  &fracas_shape_annulus,
                                            &fracas_shape_sphere, &fracas_shape_file};
const fracas_section fracas_geometry_section = {
    .name = "geometry",
    .doc = "The body",
    .selector = "shape",
    .kinds = shapes,
    .nkinds = FRACAS_COUNT(shapes),
    .kind_offset = offsetof(fracas_geometry, shape),
    .offset = offsetof(fracas_spec, geometry),
    .hashed = true,
};

#define ELEMENTS                                                                               \
    {                                                                                          \
        "elements", FRACAS_INTEGER, "1", "number of elements", FRACAS_REQUIRED, 2, 1e8, false, \
            offsetof(fracas_mesh, elements)                                                    \
    }

static const fracas_param uniform[] = {ELEMENTS};
const fracas_kind fracas_spacing_uniform = {.name = "uniform",
                                            .doc = "elements of one length",
                                            .params = uniform,
                                            .nparams = FRACAS_COUNT(uniform)};

static const fracas_param graded[] = {
    ELEMENTS,
    {"ratio", FRACAS_REAL, "1",
     "length of the last element by that of the first, those between in geometric progression",
     FRACAS_REQUIRED, 1e-3, 1e3, false, offsetof(fracas_mesh, ratio)},
};
const fracas_kind fracas_spacing_graded = {.name = "graded",
                                           .doc = "lengths in geometric progression along the bar",
                                           .params = graded,
                                           .nparams = FRACAS_COUNT(graded)};

static const fracas_param perturbed[] = {
    ELEMENTS,
    {"amplitude", FRACAS_REAL, "1",
     "largest move of a node between elements, in uniform element lengths", FRACAS_REQUIRED, 0,
     0.45, true, offsetof(fracas_mesh, amplitude)},
};
const fracas_kind fracas_spacing_perturbed = {
    .name = "perturbed",
    .doc = "nodes moved at random from a uniform mesh, once a point",
    .params = perturbed,
    .nparams = FRACAS_COUNT(perturbed)};

static const fracas_param triangles[] = {
    {"size", FRACAS_REAL, "m",
     "edge of the equilateral triangle with the mean area of the elements; or give divisions", 0, 0,
     INFINITY, false, offsetof(fracas_mesh, size)},
    {"divisions", FRACAS_INTEGER, "1",
     "elements along the shorter side of a plate, layers of elements of an annulus, elements along "
     "each edge of an octant of a sphere or of the 20 faces of a whole one; or give size",
     0, 0, 1e4, false, offsetof(fracas_mesh, divisions)},
    {"order", FRACAS_INTEGER, "1",
     "1: linear triangles, 2: quadratic ones, which follow curved edges", 1, 1, 2, false,
     offsetof(fracas_mesh, order), .only = fracas_membrane_models},
    {"order", FRACAS_INTEGER, "1", "2: quadratic triangles, which bend", 2, 2, 2, false,
     offsetof(fracas_mesh, order), .only = fracas_shell_models},
    {"amplitude", FRACAS_REAL, "1",
     "largest random move of an inner node, in local edge lengths, once a point: regular meshes "
     "lead cracks along their lines",
     0, 0, FRACAS_SURFACE_AMPLITUDE, false, offsetof(fracas_mesh, amplitude)},
};
const fracas_kind fracas_spacing_triangles = {.name = "triangles",
                                              .doc = "near-uniform triangles",
                                              .params = triangles,
                                              .nparams = FRACAS_COUNT(triangles)};

const fracas_kind fracas_spacing_given = {.name = "given", .doc = "the elements of the mesh file"};

static fracas_err check_mesh(const void *section)
{
    const fracas_mesh *mesh = section;
    if (mesh->spacing != &fracas_spacing_triangles || (mesh->size > 0) != (mesh->divisions > 0))
        return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "triangles take either size or divisions, and %s given: %s",
                       mesh->size > 0 ? "both are" : "neither is",
                       mesh->size > 0
                           ? "leave one out, or set it to 0 where a sweep would inherit it"
                           : "add one, for instance `size: 0.1 mm`");
}

static const fracas_kind *const spacings[] = {&fracas_spacing_uniform, &fracas_spacing_graded,
                                              &fracas_spacing_perturbed, &fracas_spacing_triangles,
                                              &fracas_spacing_given};
const fracas_section fracas_mesh_section = {
    .name = "mesh",
    .doc = "The elements",
    .selector = "spacing",
    .kinds = spacings,
    .nkinds = FRACAS_COUNT(spacings),
    .kind_offset = offsetof(fracas_mesh, spacing),
    .offset = offsetof(fracas_spec, mesh),
    .hashed = true,
    .check = check_mesh,
};
