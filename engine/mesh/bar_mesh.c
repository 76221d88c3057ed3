#include "engine/mesh/bar_mesh.h"

#include "engine/spec.h"

const fracas_kind fracas_ends_periodic = {
    .name = "periodic", .doc = "the bar closes on itself, as the hoop direction of a ring does"};
const fracas_kind fracas_ends_held = {
    .name = "held", .doc = "both ends move with the imposed rate"};

static const fracas_kind *const ends[] = {&fracas_ends_periodic, &fracas_ends_held};

static const fracas_param geometry[] = {
    {"length", FRACAS_REAL, "m", "length of the bar (circumference of the ring)", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_geometry, length)},
    {"area", FRACAS_REAL, "m2", "area of the cross-section", 1e-6, 0, INFINITY, true,
     offsetof(fracas_geometry, area)},
};
const fracas_section fracas_geometry_section = {
    .name = "geometry", .doc = "The body", .selector = "ends", .kinds = ends, .nkinds = FRACAS_COUNT(ends),
    .kind_offset = offsetof(fracas_geometry, ends), .params = geometry, .nparams = FRACAS_COUNT(geometry),
    .offset = offsetof(fracas_spec, geometry), .hashed = true,
};

static const fracas_param mesh[] = {
    {"elements", FRACAS_INTEGER, "1", "number of elements, all of one length", FRACAS_REQUIRED, 2, 1e8, false,
     offsetof(fracas_mesh, elements)},
};
const fracas_section fracas_mesh_section = {
    .name = "mesh", .doc = "The elements", .params = mesh, .nparams = FRACAS_COUNT(mesh),
    .offset = offsetof(fracas_spec, mesh), .hashed = true,
};
