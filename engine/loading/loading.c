/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/loading/loading.h"

const fracas_kind fracas_axis_radial = {.name = "radial", .doc = "outward"};
const fracas_kind fracas_axis_circumferential = {.name = "circumferential",
                                                 .doc = "along the ring, counter-clockwise"};
static const fracas_kind *const axes[] = {&fracas_axis_radial, &fracas_axis_circumferential};
#define DIRECTION(what)                                                                        \
    {                                                                                          \
        .name = "direction", .type = FRACAS_CHOICE, .unit = "1", .doc = what, .choices = axes, \
        .nchoices = FRACAS_COUNT(axes), .offset = offsetof(fracas_loading, direction)          \
    }

static const fracas_param imposed_rate[] = {
    {"rate", FRACAS_REAL, "1/s",
     "strain rate; a bar's velocities start as rate x, a ring's nodes move outward at rate radius",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_loading, rate)},
};
const fracas_kind fracas_loading_imposed_rate = {
    .name = "imposed-rate",
    .doc = "uniform stretching at a constant strain rate",
    .params = imposed_rate,
    .nparams = FRACAS_COUNT(imposed_rate)};

static const fracas_param initial_velocity[] = {
    {"radial", FRACAS_REAL, "m/s", "velocity outward: the strain rate is radial/radius", 0,
     -INFINITY, INFINITY, false, offsetof(fracas_loading, radial)},
    {"circumferential", FRACAS_REAL, "m/s",
     "velocity along the ring: it spins at circumferential/radius", 0, -INFINITY, INFINITY, false,
     offsetof(fracas_loading, circumferential)},
};
const fracas_kind fracas_loading_initial_velocity = {
    .name = "initial-velocity",
    .doc = "all nodes start with a velocity, then the ring is free",
    .params = initial_velocity,
    .nparams = FRACAS_COUNT(initial_velocity)};

static const fracas_param held_velocity[] = {
    DIRECTION("component of the velocity that is held; the other one starts at 0 and is free"),
    {"velocity", FRACAS_REAL, "m/s", "velocity at the start", FRACAS_REQUIRED, -INFINITY, INFINITY,
     false, offsetof(fracas_loading, velocity)},
    {"acceleration", FRACAS_REAL, "m/s2", "its constant change with time", 0, -INFINITY, INFINITY,
     false, offsetof(fracas_loading, acceleration)},
};
const fracas_kind fracas_loading_held_velocity = {
    .name = "held-velocity",
    .doc = "one component of every node's velocity is velocity + acceleration t",
    .params = held_velocity,
    .nparams = FRACAS_COUNT(held_velocity)};

static const fracas_param force[] = {
    DIRECTION("direction of the force"),
    {"force", FRACAS_REAL, "N/m", "force per length of the ring at the start", FRACAS_REQUIRED,
     -INFINITY, INFINITY, false, offsetof(fracas_loading, force)},
    {"force_rate", FRACAS_REAL, "N/(m s)", "its constant change with time", 0, -INFINITY, INFINITY,
     false, offsetof(fracas_loading, force_rate)},
};
const fracas_kind fracas_loading_force = {
    .name = "force",
    .doc = "a force per length, force + force_rate t, on a ring at rest",
    .params = force,
    .nparams = FRACAS_COUNT(force)};

const fracas_kind fracas_start_moving = {.name = "moving", .doc = "with the same velocities"};
const fracas_kind fracas_start_rest = {.name = "rest",
                                       .doc = "at rest, so that held edges send a shock into it"};
static const fracas_kind *const starts[] = {&fracas_start_moving, &fracas_start_rest};

static const fracas_param expansion[] = {
    {"rate", FRACAS_REAL, "1/s",
     "strain rate along x: velocities are rate x, ratio rate y and, of shells, rate z",
     FRACAS_REQUIRED, -INFINITY, INFINITY, false, offsetof(fracas_loading, rate)},
    {"ratio", FRACAS_REAL, "1", "strain rate along y by that along x", 1, -INFINITY, INFINITY,
     false, offsetof(fracas_loading, ratio)},
    {.name = "start",
     .type = FRACAS_CHOICE,
     .unit = "1",
     .doc = "how the inside starts",
     .choices = starts,
     .nchoices = FRACAS_COUNT(starts),
     .offset = offsetof(fracas_loading, start)},
};
const fracas_kind fracas_loading_expansion = {
    .name = "expansion",
    .doc = "velocities (rate x, ratio rate y; of shells also rate z): all nodes start with them, "
           "those of held edges keep them",
    .params = expansion,
    .nparams = FRACAS_COUNT(expansion)};

static const fracas_param centrifugal[] = {
    {"speed", FRACAS_REAL, "rad/s", "angular velocity w in the end", FRACAS_REQUIRED, 0, INFINITY,
     false, offsetof(fracas_loading, speed)},
    {"ramp", FRACAS_REAL, "s", "time in which w rises from 0, in proportion to time", 0, 0,
     INFINITY, false, offsetof(fracas_loading, ramp)},
};
const fracas_kind fracas_loading_centrifugal = {
    .name = "centrifugal",
    .doc = "a force w^2 r on every unit of mass of a body at rest, r from the origin to where it "
           "started",
    .params = centrifugal,
    .nparams = FRACAS_COUNT(centrifugal)};

static const fracas_kind *const loadings[] = {
    &fracas_loading_imposed_rate, &fracas_loading_initial_velocity, &fracas_loading_held_velocity,
    &fracas_loading_force,        &fracas_loading_expansion,        &fracas_loading_centrifugal};

const fracas_section fracas_loading_section = {
    .name = "loading",
    .doc = "What drives the body",
    .selector = "type",
    .kinds = loadings,
    .nkinds = FRACAS_COUNT(loadings),
    .kind_offset = offsetof(fracas_loading, type),
    .offset = offsetof(fracas_spec, loading),
    .hashed = true,
};
