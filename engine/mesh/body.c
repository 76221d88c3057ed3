#include "engine/mesh/body.h"

#include "engine/spec.h"

const fracas_kind fracas_ends_periodic = {
    .name = "periodic", .doc = "the bar closes on itself, as the hoop direction of a ring does"};
const fracas_kind fracas_ends_held = {
    .name = "held", .doc = "both ends move with the imposed rate"};
static const fracas_kind *const ends[] = {&fracas_ends_periodic, &fracas_ends_held};

const fracas_kind fracas_direction_initial = {
    .name = "initial", .doc = "interfaces open along the circumference as it was at the start"};
const fracas_kind fracas_direction_current = {
    .name = "current", .doc = "interfaces open along the mean of their two elements, wherever these have turned"};
static const fracas_kind *const directions[] = {&fracas_direction_current, &fracas_direction_initial};

static const fracas_param bar[] = {
    {"length", FRACAS_REAL, "m", "length of the bar; with periodic ends that of the circumference it stands for", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_geometry, length)},
    {.name = "ends", .type = FRACAS_CHOICE, .unit = "1", .doc = "what happens at the bar's two ends", .choices = ends,
     .nchoices = FRACAS_COUNT(ends), .offset = offsetof(fracas_geometry, ends)},
};
const fracas_kind fracas_shape_bar = {
    .name = "bar", .doc = "a straight bar", .params = bar, .nparams = FRACAS_COUNT(bar)};

static const fracas_param ring[] = {
    {"radius", FRACAS_REAL, "m", "radius of the ring: its circumference is 2 pi radius", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_geometry, radius)},
    {.name = "direction", .type = FRACAS_CHOICE, .unit = "1", .doc = "in which interfaces open", .choices = directions,
     .nchoices = FRACAS_COUNT(directions), .offset = offsetof(fracas_geometry, direction)},
};
const fracas_kind fracas_shape_ring = {
    .name = "ring", .doc = "a closed thin ring", .params = ring, .nparams = FRACAS_COUNT(ring)};

static const fracas_kind *const shapes[] = {&fracas_shape_bar, &fracas_shape_ring};
static const fracas_param geometry[] = {
    {"area", FRACAS_REAL, "m2", "area of the cross-section", 1e-6, 0, INFINITY, true, offsetof(fracas_geometry, area)},
};
const fracas_section fracas_geometry_section = {
    .name = "geometry", .doc = "The body", .selector = "shape", .kinds = shapes, .nkinds = FRACAS_COUNT(shapes),
    .kind_offset = offsetof(fracas_geometry, shape), .params = geometry, .nparams = FRACAS_COUNT(geometry),
    .offset = offsetof(fracas_spec, geometry), .hashed = true,
};

const fracas_kind fracas_spacing_uniform = {.name = "uniform", .doc = "elements of one length"};

static const fracas_param graded[] = {
    {"ratio", FRACAS_REAL, "1", "length of the last element by that of the first, those between in geometric progression",
     FRACAS_REQUIRED, 1e-3, 1e3, false, offsetof(fracas_mesh, ratio)},
};
const fracas_kind fracas_spacing_graded = {
    .name = "graded", .doc = "lengths in geometric progression along the bar", .params = graded, .nparams = FRACAS_COUNT(graded)};

static const fracas_param perturbed[] = {
    {"amplitude", FRACAS_REAL, "1", "largest move of a node between elements, in uniform element lengths", FRACAS_REQUIRED, 0,
     0.45, true, offsetof(fracas_mesh, amplitude)},
};
const fracas_kind fracas_spacing_perturbed = {
    .name = "perturbed", .doc = "nodes moved at random from a uniform mesh, once a point", .params = perturbed,
    .nparams = FRACAS_COUNT(perturbed)};

static const fracas_kind *const spacings[] = {&fracas_spacing_uniform, &fracas_spacing_graded, &fracas_spacing_perturbed};
static const fracas_param mesh[] = {
    {"elements", FRACAS_INTEGER, "1", "number of elements", FRACAS_REQUIRED, 2, 1e8, false, offsetof(fracas_mesh, elements)},
};
const fracas_section fracas_mesh_section = {
    .name = "mesh", .doc = "The elements", .selector = "spacing", .kinds = spacings, .nkinds = FRACAS_COUNT(spacings),
    .kind_offset = offsetof(fracas_mesh, spacing), .params = mesh, .nparams = FRACAS_COUNT(mesh),
    .offset = offsetof(fracas_spec, mesh), .hashed = true,
};
