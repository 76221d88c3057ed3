/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/body.h"

#include "base/elementary.h"
#include "engine/mesh/surface/capsule.h"
#include "engine/mesh/surface/cylinder.h"
#include "engine/mesh/surface/gmsh.h"
#include "engine/mesh/surface/gmsh_file.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

const fracas_kind fracas_ends_periodic = {
    "periodic", "the bar closes on itself, as the hoop direction of a ring does"};
const fracas_kind fracas_ends_held = {"held", "both ends move with the imposed rate"};
const fracas_kind fracas_ends_free = {
    "free", "nothing holds them: the imposed rate is that of the velocities at the start, and the "
            "bar's middle rests"};
static const fracas_kind *const ends[] = {&fracas_ends_periodic, &fracas_ends_held,
                                          &fracas_ends_free};

const fracas_kind fracas_direction_initial = {
    "initial", "interfaces open along the circumference as it was at the start"};
const fracas_kind fracas_direction_current = {
    "current", "interfaces open along the mean of their two elements, wherever these have turned"};
static const fracas_kind *const directions[] = {&fracas_direction_current,
                                                &fracas_direction_initial};

const fracas_kind fracas_part_whole = {"whole", "all of it",
                                       .traits = &(const fracas_part_of_shape){0}};
const fracas_kind fracas_part_half = {"half", "z >= 0; the other one is the mirror image",
                                      .traits = &(const fracas_part_of_shape){1}};
const fracas_kind fracas_part_quarter = {"quarter", "x, z >= 0; the other three are mirror images",
                                         .traits = &(const fracas_part_of_shape){2}};
const fracas_kind fracas_part_octant = {"octant", "x, y, z >= 0; the other seven are mirror images",
                                        .traits = &(const fracas_part_of_shape){3}};
static const fracas_kind *const parts[] = {&fracas_part_whole, &fracas_part_octant};
static const fracas_kind *const tube_parts[] = {&fracas_part_whole, &fracas_part_half,
                                                &fracas_part_quarter, &fracas_part_octant};

static int planes_of(const fracas_geometry *geometry)
{
    return ((const fracas_part_of_shape *)geometry->part->traits)->planes;
}

static double wave_time(const fracas_spec *spec) /* radius by sqrt(E/rho) */
{
    return spec->geometry.radius * sqrt(spec->material.density / spec->material.young);
}

typedef struct {
    double metres;
} length_unit;
static const fracas_kind unit_m = {"m", "metres", .traits = &(const length_unit){1}},
                         unit_cm = {"cm", "centimetres", .traits = &(const length_unit){1e-2}},
                         unit_mm = {"mm", "millimetres", .traits = &(const length_unit){1e-3}},
                         unit_um = {"um", "micrometres", .traits = &(const length_unit){1e-6}},
                         unit_in = {"in", "inches", .traits = &(const length_unit){0.0254}};
static const fracas_kind *const units[] = {&unit_m, &unit_cm, &unit_mm, &unit_um, &unit_in};

#define EDGE(key, tag, what)                                                                  \
    FRACAS_BRACES(FRACAS_ONE_OF(key, fracas_edge_kinds, offsetof(fracas_geometry, edge[tag]), \
                                "what holds " what))
#define AS_EDGES "; none is as `edges` says"
#define EDGE_OF_GROUP(n, without, more)                                                            \
    FRACAS_BRACES(FRACAS_ONE_OF("edge_" #n, fracas_edge_kinds, offsetof(fracas_geometry, edge[n]), \
                                "what holds the edges of the physical group " #n                   \
                                ", or of that of this name" more),                                 \
                  .optional = without)
#define LENGTH(key, member, what)                                                  \
    FRACAS_BRACES(key, FRACAS_REAL, "m", what, FRACAS_REQUIRED, 0, INFINITY, true, \
                  offsetof(fracas_geometry, member))
#define THICKNESS LENGTH("thickness", thickness, "thickness of the plate or shell")
#define AREA                                                                                       \
    FRACAS_BRACES("area", FRACAS_REAL, "m2", "area of the cross-section", 1e-6, 0, INFINITY, true, \
                  offsetof(fracas_geometry, area))

static const fracas_param bar[] = {
    AREA,
    LENGTH("length", length,
           "length of the bar; with periodic ends that of the circumference it stands for"),
    {FRACAS_ONE_OF("ends", ends, offsetof(fracas_geometry, ends),
                   "what happens at the bar's two ends")},
    {.name = "gap",
     .type = FRACAS_REAL,
     .unit = "m",
     .doc = "with free ends: at the start, a rigid wall at rest is so far beyond each; none for no "
            "walls",
     .fallback = FRACAS_REQUIRED,
     .maximum = INFINITY,
     .offset = offsetof(fracas_geometry, gap),
     .optional = true},
};

static double bar_length(const fracas_geometry *geometry)
{
    return geometry->length;
}

static double bar_period(const fracas_geometry *geometry)
{
    return geometry->ends == &fracas_ends_periodic ? geometry->length : 0;
}

static bool bar_free(const fracas_geometry *geometry)
{
    return geometry->ends == &fracas_ends_free;
}

static double bar_gap(const fracas_geometry *geometry)
{
    return bar_free(geometry) ? geometry->gap : NAN;
}

const fracas_kind fracas_shape_bar = {
    "bar", "a straight bar", FRACAS_PARAMS(bar),
    .traits = &(const fracas_shape){
        .length = bar_length, .period = bar_period, .free = bar_free, .gap = bar_gap}};

static const fracas_param ring[] = {
    AREA,
    LENGTH("radius", radius, "radius of the ring: its circumference is 2 pi radius"),
    {FRACAS_ONE_OF("direction", directions, offsetof(fracas_geometry, direction),
                   "in which interfaces open")},
};

static double circumference(const fracas_geometry *geometry)
{
    return 2 * FRACAS_PI * geometry->radius;
}

const fracas_kind fracas_shape_ring = {
    "ring", "a closed thin ring", FRACAS_PARAMS(ring),
    .traits = &(const fracas_shape){.length = circumference, .round = true}};

static const fracas_param plate[] = {
    LENGTH("width", width, "along x, from -width/2 to width/2"),
    LENGTH("height", height, "along y, from -height/2 to height/2"),
    THICKNESS,
    EDGE("left", 1, "the edge at the smallest x"),
    EDGE("right", 2, "the edge at the largest x"),
    EDGE("bottom", 3, "the edge at the smallest y"),
    EDGE("top", 4, "the edge at the largest y"),
};

static fracas_err make_plate(const fracas_geometry *geometry,
                             const fracas_surface_fineness *fineness,
                             const fracas_surface **surface)
{
    return fracas_surface_rectangle(geometry->width, geometry->height, fineness, surface);
}

const fracas_kind fracas_shape_plate = {
    "plate", "a flat rectangle about the origin", FRACAS_PARAMS(plate),
    .traits = &(const fracas_shape){.make = make_plate, .even = true}};

static const fracas_param annulus[] = {
    LENGTH("inner", inner, "radius of the hole"),
    LENGTH("outer", outer, "radius of the rim"),
    THICKNESS,
    EDGE("inner_edge", 1, "the edge of the hole"),
    EDGE("outer_edge", 2, "the rim"),
};

static fracas_err make_annulus(const fracas_geometry *geometry,
                               const fracas_surface_fineness *fineness,
                               const fracas_surface **surface)
{
    return fracas_surface_annulus(geometry->inner, geometry->outer, fineness, surface);
}

const fracas_kind fracas_shape_annulus = {"annulus", "a flat plate ring about the origin",
                                          FRACAS_PARAMS(annulus),
                                          .traits = &(const fracas_shape){.make = make_annulus}};

static const fracas_param sphere[] = {
    LENGTH("radius", radius, "radius of the mid-surface"),
    THICKNESS,
    {FRACAS_ONE_OF("part", parts, offsetof(fracas_geometry, part), "how much of it is there")},
};

static fracas_err make_sphere(const fracas_geometry *geometry,
                              const fracas_surface_fineness *fineness,
                              const fracas_surface **surface)
{
    return geometry->part == &fracas_part_octant
               ? fracas_surface_octant(geometry->radius, fineness, surface)
               : fracas_surface_sphere(geometry->radius, fineness, surface);
}

static const fracas_kind *sphere_edge(const fracas_geometry *geometry, int32_t tag)
{
    (void)geometry, (void)tag;
    return &fracas_edge_symmetry;
}

static double sphere_concentration(double ratio)
{
    return ratio == 1 ? 1.2 : 3; /* facets; other modes */
}

/* It swings back at w^2 = 2 E/((1 - nu) rho R^2). */
static double sphere_swing(const fracas_spec *spec, double ratio)
{
    return ratio == 1 ? wave_time(spec) * sqrt((1 - spec->material.poisson) / 2) : INFINITY;
}

const fracas_kind fracas_shape_sphere = {
    "sphere", "a thin spherical shell about the origin", FRACAS_PARAMS(sphere),
    .traits = &(const fracas_shape){.make = make_sphere,
                                    .edge = sphere_edge,
                                    .concentration = sphere_concentration,
                                    .swing = sphere_swing}};

static const fracas_param cylinder[] = {
    LENGTH("radius", radius, "radius of the mid-surface"),
    LENGTH("length", length, "of the whole cylinder: along y, from -length/2 to length/2"),
    THICKNESS,
    {FRACAS_ONE_OF("part", tube_parts, offsetof(fracas_geometry, part), "how much of it is there")},
    EDGE("bottom", 3, "the end at the smallest y; of an octant it is a symmetry"),
    EDGE("top", 4, "the end at the largest y"),
};

static fracas_err make_cylinder(const fracas_geometry *geometry,
                                const fracas_surface_fineness *fineness,
                                const fracas_surface **surface)
{
    return fracas_surface_cylinder(geometry->radius, geometry->length, planes_of(geometry),
                                   fineness, surface);
}

static const fracas_kind *cylinder_edge(const fracas_geometry *geometry, int32_t tag)
{
    const bool is_plane = tag < 3 || (tag == 3 && planes_of(geometry) == 3);
    return is_plane ? &fracas_edge_symmetry : NULL;
}

static double cylinder_concentration(double ratio)
{
    return ratio == 0 ? 1.5 : 3; /* bending at its ends; waves along it */
}

/* A ring swings back at w^2 = E/(rho R^2), a longer tube earlier; along the axis as a plate. */
static double cylinder_swing(const fracas_spec *spec, double ratio)
{
    const double radius = spec->geometry.radius;
    return wave_time(spec) * (ratio == 0 ? 1 : 1 + 4 * spec->geometry.length / radius);
}

const fracas_kind fracas_shape_cylinder = {
    "cylinder",
    "a thin tube around the y axis, open at both ends; mesh.divisions are along the shorter of a "
    "quarter of its circumference and the length of the part",
    FRACAS_PARAMS(cylinder),
    .traits = &(const fracas_shape){.make = make_cylinder,
                                    .edge = cylinder_edge,
                                    .concentration = cylinder_concentration,
                                    .swing = cylinder_swing}};

static const fracas_param capsule[] = {
    LENGTH("radius", radius, "radius of the mid-surface, of tube and half spheres"),
    LENGTH("length", length, "of the whole tube between the half spheres: along y, from -length/2"),
    THICKNESS,
    {FRACAS_ONE_OF("part", tube_parts, offsetof(fracas_geometry, part), "how much of it is there")},
};

static fracas_err make_capsule(const fracas_geometry *geometry,
                               const fracas_surface_fineness *fineness,
                               const fracas_surface **surface)
{
    return fracas_surface_capsule(geometry->radius, geometry->length, planes_of(geometry), fineness,
                                  surface);
}

const fracas_kind fracas_shape_capsule = {
    "capsule",
    "a thin tube around the y axis, closed by half spheres; mesh.divisions are along a quarter of "
    "its circumference",
    FRACAS_PARAMS(capsule),
    .traits = &(const fracas_shape){.make = make_capsule, .edge = sphere_edge}};

static const fracas_param file[] = {
    {.name = "file",
     .type = FRACAS_ATTACHMENT,
     .unit = "1",
     .doc = "Gmsh file (MSH 2.2 or 4.1) of triangles with 3 or 6 nodes",
     .fallback = FRACAS_REQUIRED,
     .offset = offsetof(fracas_geometry, file)},
    {FRACAS_ONE_OF("unit", units, offsetof(fracas_geometry, unit),
                   "of the coordinates in the file; none is m"),
     .optional = true},
    THICKNESS,
    EDGE("edges", 0, "all edges but those of the physical groups below"),
    EDGE_OF_GROUP(1, false, ""),
    EDGE_OF_GROUP(2, false, ""),
    EDGE_OF_GROUP(3, false, ""),
    EDGE_OF_GROUP(4, false, ""),
    EDGE_OF_GROUP(5, true, AS_EDGES),
    EDGE_OF_GROUP(6, true, AS_EDGES),
    EDGE_OF_GROUP(7, true, AS_EDGES),
    EDGE_OF_GROUP(8, true, AS_EDGES),
};

static fracas_err make_from_file(const fracas_geometry *geometry,
                                 const fracas_surface_fineness *fineness,
                                 const fracas_surface **surface)
{
    const length_unit *unit = geometry->unit ? geometry->unit->traits : unit_m.traits;
    fracas_err err = fracas_surface_read_gmsh(geometry->file->text, geometry->file->size,
                                              unit->metres, fineness->flat, surface);
    return err ? fracas_fail_within(err, "mesh file %s", geometry->file->path) : FRACAS_OK;
}

const fracas_kind fracas_shape_file = {
    "file", "the surface of a mesh file", FRACAS_PARAMS(file),
    .traits = &(const fracas_shape){.make = make_from_file, .from_file = true}};

static const fracas_kind *const shapes[] = {
    &fracas_shape_bar,    &fracas_shape_ring,     &fracas_shape_plate, &fracas_shape_annulus,
    &fracas_shape_sphere, &fracas_shape_cylinder, &fracas_shape_file,  &fracas_shape_capsule};

static fracas_err check_cylinder(const fracas_geometry *geometry)
{
    const fracas_kind *decided = cylinder_edge(geometry, 3), *given = geometry->edge[3];
    if (!decided || given == decided || given == &fracas_edge_free) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "bottom is %s, but part: %s ends in the plane y = 0, its symmetry: leave "
                       "bottom out, or take part: %s",
                       given->name, geometry->part->name, fracas_part_quarter.name);
}

static fracas_err check_geometry(const void *section)
{
    const fracas_geometry *geometry = section;
    if (geometry->shape == &fracas_shape_cylinder) return check_cylinder(geometry);
    if (geometry->shape != &fracas_shape_bar || bar_free(geometry) || isnan(geometry->gap))
        return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "gap is given, but ends are %s: walls stand beyond ends that move by "
                       "themselves: give ends: free, or leave gap out",
                       geometry->ends->name);
}

/* Lists the names that an edge can have: keys of the shape, or names of the mesh file's groups. */
static fracas_err no_such_edge(const fracas_geometry *geometry, const char *asked, const char *key,
                               const char *known)
{
    char names[400] = "", name[FRACAS_RENAMED];
    const fracas_attachment *mesh = geometry->file;
    if (!((const fracas_shape *)geometry->shape->traits)->from_file || !mesh)
        return fracas_fail(FRACAS_USAGE, "%s is %s, and the shape %s has %s%s: %s", asked, key,
                           geometry->shape->name,
                           *known ? "the edges " : "no edges that can be named", known,
                           *known ? "name one of them" : "take another load, or a mesh file");
    for (size_t i = 0; fracas_gmsh_group_name(mesh->text, mesh->size, i, name); i++) {
        const size_t used = strlen(names), room = sizeof names - used;
        if (used + strlen(name) + 5 > sizeof names) break;
        snprintf(names + used, room, "%s\"%s\"", used ? ", " : "", name);
    }
    return fracas_fail(FRACAS_USAGE,
                       "%s is %s, and the mesh file %s has no physical group of curves of this "
                       "name: %s%s; name one of them, or %s",
                       asked, key, mesh->path, *names ? "it has " : "none has a name", names,
                       known);
}

/* Key of the edges of a tag, from 1; NULL: the shape has none. */
static const char *key_of_tag(const fracas_kind *shape, int32_t tag)
{
    const size_t place = offsetof(fracas_geometry, edge) + (size_t)tag * sizeof(fracas_kind *);
    for (size_t p = 0; tag > 0 && tag < FRACAS_EDGES && p < shape->nparams; p++)
        if (shape->params[p].offset == place) return shape->params[p].name;
    return NULL;
}

fracas_err fracas_shape_edge_tag(const fracas_geometry *geometry, const char *asked,
                                 const char *key, int32_t *tag)
{
    char known[160] = "";
    for (*tag = 1; *tag < FRACAS_EDGES; ++*tag) {
        const char *name = key_of_tag(geometry->shape, *tag);
        if (!name) continue;
        if (strcmp(name, key) == 0) return FRACAS_OK;
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", name);
    }
    return no_such_edge(geometry, asked, key, known);
}

/* The names of a mesh file's physical groups are names of edge_1 to edge_8. */
static fracas_err name_of_group(const fracas_attachment *mesh, const char **key)
{
    int32_t number;
    bool shared;
    TRY(fracas_gmsh_group(mesh->text, mesh->size, *key, &number, &shared));
    if (number != 0 && shared)
        return fracas_fail(FRACAS_USAGE,
                           "the mesh file has another physical group for edge_%" PRId32
                           ", by its number or name: give each a number from 1 to %d of its own",
                           number, FRACAS_EDGES - 1);
    const char *edge = key_of_tag(&fracas_shape_file, number);
    if (edge) *key = edge;
    else if (number != 0)
        return fracas_fail(FRACAS_USAGE,
                           "the mesh file's physical group of this name has the number %" PRId32
                           ", and those with keys have 1 to %d: in the .geo file, Physical "
                           "Curve(\"%s\", 1) gives the first",
                           number, FRACAS_EDGES - 1, *key);
    return FRACAS_OK;
}

static bool group_name(const fracas_attachment *mesh, size_t i, char name[FRACAS_RENAMED])
{
    return fracas_gmsh_group_name(mesh->text, mesh->size, i, name);
}

bool fracas_shape_edge_name(const fracas_geometry *geometry, const char *key,
                            char name[FRACAS_RENAMED])
{
    for (size_t i = 0; geometry->file && group_name(geometry->file, i, name); i++) {
        const char *named = name;
        if (!name_of_group(geometry->file, &named) && named != name && !strcmp(named, key))
            return true;
    }
    return false;
}

const fracas_section fracas_geometry_section = {
    .name = "geometry",
    .doc = "The body",
    .selector = "shape",
    FRACAS_KINDS(shapes),
    .kind_offset = offsetof(fracas_geometry, shape),
    .offset = offsetof(fracas_spec, geometry),
    .hashed = true,
    .check = check_geometry,
    .rename = name_of_group,
    .renames = group_name,
    .renamed = "edge_1",
};

#define ELEMENTS                                                                                  \
    FRACAS_BRACES("elements", FRACAS_INTEGER, "1", "number of elements", FRACAS_REQUIRED, 2, 1e8, \
                  false, offsetof(fracas_mesh, elements))

static const fracas_param uniform[] = {ELEMENTS};
const fracas_kind fracas_spacing_uniform = {"uniform", "elements of one length",
                                            FRACAS_PARAMS(uniform),
                                            .traits = &(const fracas_spacing){.uniform = true}};

static const fracas_param graded[] = {
    ELEMENTS,
    {"ratio", FRACAS_REAL, "1",
     "length of the last element by that of the first, those between in geometric progression",
     FRACAS_REQUIRED, 1e-3, 1e3, false, offsetof(fracas_mesh, ratio)},
};

/* (bar.19) */
static fracas_err fill_graded(const fracas_mesh *mesh, double length, double *size)
{
    const double step = fracas_log(mesh->ratio) / (double)(mesh->elements - 1);
    double sum = 0;
    for (int64_t e = 0; e < mesh->elements; e++) sum += size[e] = fracas_exp(step * (double)e);
    for (int64_t e = 0; e < mesh->elements; e++) size[e] *= length / sum;
    return FRACAS_OK;
}

const fracas_kind fracas_spacing_graded = {
    "graded", "lengths in geometric progression along the bar", FRACAS_PARAMS(graded),
    .traits = &(const fracas_spacing){.fill = fill_graded}};

static const fracas_param perturbed[] = {
    ELEMENTS,
    {"amplitude", FRACAS_REAL, "1",
     "largest move of a node between elements, in uniform element lengths", FRACAS_REQUIRED, 0,
     0.45, true, offsetof(fracas_mesh, amplitude)},
};

/* (bar.19) */
static fracas_err fill_perturbed(const fracas_mesh *mesh, double length, double *size)
{
    const double mean = length / (double)mesh->elements;
    double before = 0;
    if (!mesh->noise)
        return fracas_fail(FRACAS_BUG, "a perturbed mesh without the numbers that move its nodes");
    for (int64_t e = 0; e < mesh->elements; e++) {
        double move = e + 1 < mesh->elements ? mesh->amplitude * mean * mesh->noise[e + 1] : 0.0;
        size[e] = mean + move - before;
        before = move;
    }
    return FRACAS_OK;
}

const fracas_kind fracas_spacing_perturbed = {
    "perturbed", "nodes moved at random from a uniform mesh, once a point",
    FRACAS_PARAMS(perturbed),
    .traits = &(const fracas_spacing){.fill = fill_perturbed, .moves = true}};

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
     offsetof(fracas_mesh, order), .only = FRACAS_GROUP_MEMBRANE},
    {"order", FRACAS_INTEGER, "1", "2: quadratic triangles, which bend", 2, 2, 2, false,
     offsetof(fracas_mesh, order), .only = FRACAS_GROUP_SHELL},
    {"amplitude", FRACAS_REAL, "1",
     "largest random move of an inner node, in local edge lengths, once a point: regular meshes "
     "lead cracks along their lines",
     0, 0, FRACAS_SURFACE_AMPLITUDE, false, offsetof(fracas_mesh, amplitude)},
};
const fracas_kind fracas_spacing_triangles = {"triangles", "near-uniform triangles",
                                              FRACAS_PARAMS(triangles),
                                              .traits = &(const fracas_spacing){.rows = true}};

const fracas_kind fracas_spacing_given = {"given", "the elements of the mesh file",
                                          .traits = &(const fracas_spacing){.from_file = true}};

static fracas_err check_mesh(const void *section)
{
    const fracas_mesh *mesh = section;
    if (mesh->spacing != &fracas_spacing_triangles) return FRACAS_OK;
    return fracas_param_check_either("triangles take", (const char *const[]){"size", "divisions"},
                                     (const double[]){mesh->size, (double)mesh->divisions},
                                     "size: 0.1 mm");
}

static const fracas_kind *const spacings[] = {&fracas_spacing_uniform, &fracas_spacing_graded,
                                              &fracas_spacing_perturbed, &fracas_spacing_triangles,
                                              &fracas_spacing_given};
const fracas_section fracas_mesh_section = {
    .name = "mesh",
    .doc = "The elements",
    .selector = "spacing",
    FRACAS_KINDS(spacings),
    .kind_offset = offsetof(fracas_mesh, spacing),
    .offset = offsetof(fracas_spec, mesh),
    .hashed = true,
    .check = check_mesh,
};
