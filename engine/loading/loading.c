/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/loading/load.h"

#include <math.h>

const fracas_kind fracas_axis_radial = {"radial", "outward"};
const fracas_kind fracas_axis_circumferential = {"circumferential",
                                                 "along the ring, counter-clockwise"};
static const fracas_kind *const axes[] = {&fracas_axis_radial, &fracas_axis_circumferential};
#define DIRECTION(what) \
    FRACAS_BRACES(FRACAS_ONE_OF("direction", axes, offsetof(fracas_loading, direction), what))

static bool is_radial(const fracas_spec *spec)
{
    return spec->loading.direction == &fracas_axis_radial;
}

/* Mass of a chain per length [kg/m]. */
static double mass_of(const fracas_spec *spec)
{
    return spec->material.density * spec->geometry.area;
}

/* ---- imposed-rate ---- */

static const fracas_param imposed_rate[] = {
    {"rate", FRACAS_REAL, "1/s",
     "strain rate; a bar's velocities start as rate x, a ring's nodes move outward at rate radius",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_loading, rate)},
};

static double imposed_rate_of(const fracas_spec *spec)
{
    return spec->loading.rate;
}

static fracas_ring_maxima rate_ring(const fracas_spec *spec, double t)
{
    return (fracas_ring_maxima){.stress = spec->material.young * spec->loading.rate * t};
}

static fracas_ring_motion rate_motion(const fracas_spec *spec, double radius)
{
    return (fracas_ring_motion){.drive = FRACAS_RING_HELD, .level = spec->loading.rate * radius};
}

const fracas_kind fracas_loading_imposed_rate = {
    "imposed-rate", "uniform stretching at a constant strain rate", FRACAS_PARAMS(imposed_rate),
    .traits = &(const fracas_loading_traits){
        .rate = imposed_rate_of, .ring = rate_ring, .motion = rate_motion}};

/* ---- initial-velocity ---- */

static const fracas_param initial_velocity[] = {
    {"radial", FRACAS_REAL, "m/s", "velocity outward: the strain rate is radial/radius", 0,
     -INFINITY, INFINITY, false, offsetof(fracas_loading, radial)},
    {"circumferential", FRACAS_REAL, "m/s",
     "velocity along the ring: it spins at circumferential/radius", 0, -INFINITY, INFINITY, false,
     offsetof(fracas_loading, circumferential)},
};

static double initial_rate(const fracas_spec *spec)
{
    return spec->loading.radial / spec->geometry.radius;
}

/* A free ring comes to E v/c and swings back (docs/theory/ring.md). */
static fracas_ring_maxima velocity_ring(const fracas_spec *spec, double t)
{
    const double young = spec->material.young, radius = spec->geometry.radius,
                 speed = sqrt(young / spec->material.density);
    return (fracas_ring_maxima){
        .stress = young * fabs(spec->loading.radial) / radius * fmin(t, radius / speed),
        .along = spec->loading.circumferential};
}

static fracas_ring_motion velocity_motion(const fracas_spec *spec, double radius)
{
    const double swell = radius / spec->geometry.radius;
    return (fracas_ring_motion){
        .start = {spec->loading.radial * swell, spec->loading.circumferential * swell}};
}

static double velocity_path(const fracas_spec *spec, double t)
{
    return spec->loading.circumferential * t;
}

static bool velocity_folds(const fracas_spec *spec, bool whole, double turn)
{
    const fracas_loading *loading = &spec->loading;
    if (loading->circumferential != 0) return false;
    return loading->radial < 0 || (whole && loading->radial > 0 && spec->time.end > 2 * turn);
}

const fracas_kind fracas_loading_initial_velocity = {
    "initial-velocity", "all nodes start with a velocity, then the ring is free",
    FRACAS_PARAMS(initial_velocity),
    .traits = &(const fracas_loading_traits){.rate = initial_rate,
                                             .ring = velocity_ring,
                                             .motion = velocity_motion,
                                             .path = velocity_path,
                                             .folds = velocity_folds,
                                             .released = true}};

/* ---- held-velocity ---- */

static const fracas_param held_velocity[] = {
    DIRECTION("component of the velocity that is held; the other one starts at 0 and is free"),
    {"velocity", FRACAS_REAL, "m/s", "velocity at the start", FRACAS_REQUIRED, -INFINITY, INFINITY,
     false, offsetof(fracas_loading, velocity)},
    {"acceleration", FRACAS_REAL, "m/s2", "its constant change with time", 0, -INFINITY, INFINITY,
     false, offsetof(fracas_loading, acceleration)},
};

static double held_rate(const fracas_spec *spec)
{
    return is_radial(spec) ? spec->loading.velocity / spec->geometry.radius : NAN;
}

static fracas_ring_maxima held_ring(const fracas_spec *spec, double t)
{
    const double v = spec->loading.velocity, a = spec->loading.acceleration;
    if (!is_radial(spec)) return (fracas_ring_maxima){.along = fmax(fabs(v), fabs(v + a * t))};
    return (fracas_ring_maxima){.stress = spec->material.young * t / spec->geometry.radius *
                                          (v + 0.5 * t * fmax(0, a))};
}

static fracas_ring_motion held_motion(const fracas_spec *spec, double radius)
{
    const double swell = radius / spec->geometry.radius;
    return (fracas_ring_motion){.drive = FRACAS_RING_HELD,
                                .circumferential = !is_radial(spec),
                                .level = spec->loading.velocity * swell,
                                .rate = spec->loading.acceleration * swell};
}

static double held_path(const fracas_spec *spec, double t)
{
    const fracas_loading *loading = &spec->loading;
    return is_radial(spec) ? 0 : (loading->velocity + 0.5 * loading->acceleration * t) * t;
}

const fracas_kind fracas_loading_held_velocity = {
    "held-velocity", "one component of every node's velocity is velocity + acceleration t",
    FRACAS_PARAMS(held_velocity),
    .traits = &(const fracas_loading_traits){
        .rate = held_rate, .ring = held_ring, .motion = held_motion, .path = held_path}};

/* ---- force ---- */

static const fracas_param force[] = {
    DIRECTION("direction of the force"),
    {"force", FRACAS_REAL, "N/m", "force per length of the ring at the start", FRACAS_REQUIRED,
     -INFINITY, INFINITY, false, offsetof(fracas_loading, force)},
    {"force_rate", FRACAS_REAL, "N/(m s)", "its constant change with time", 0, -INFINITY, INFINITY,
     false, offsetof(fracas_loading, force_rate)},
};

static fracas_ring_maxima force_ring(const fracas_spec *spec, double t)
{
    const double f = spec->loading.force, rate = spec->loading.force_rate, mass = mass_of(spec);
    if (is_radial(spec))
        return (fracas_ring_maxima){.outward = fmax(fabs(f), fabs(f + rate * t)) / mass};
    return (fracas_ring_maxima){.along = t * (fabs(f) + 0.5 * t * fabs(rate)) / mass};
}

static fracas_ring_motion force_motion(const fracas_spec *spec, double radius)
{
    (void)radius;
    return (fracas_ring_motion){.drive = FRACAS_RING_FORCED,
                                .circumferential = !is_radial(spec),
                                .level = spec->loading.force,
                                .rate = spec->loading.force_rate};
}

static double force_path(const fracas_spec *spec, double t)
{
    const fracas_loading *loading = &spec->loading;
    if (is_radial(spec)) return 0;
    return (0.5 * loading->force + loading->force_rate * t / 6) * t * t / mass_of(spec);
}

static bool force_folds(const fracas_spec *spec, bool whole, double turn)
{
    const fracas_loading *loading = &spec->loading;
    (void)whole, (void)turn;
    return is_radial(spec) &&
           fmin(loading->force, loading->force + loading->force_rate * spec->time.end) < 0;
}

const fracas_kind fracas_loading_force = {
    "force", "a force per length, force + force_rate t, on a ring at rest", FRACAS_PARAMS(force),
    .traits = &(const fracas_loading_traits){
        .ring = force_ring, .motion = force_motion, .path = force_path, .folds = force_folds}};

/* ---- expansion ---- */

const fracas_kind fracas_start_moving = {"moving", "with the same velocities"};
const fracas_kind fracas_start_rest = {"rest", "at rest, so that held edges send a shock into it"};
static const fracas_kind *const starts[] = {&fracas_start_moving, &fracas_start_rest};

static const fracas_param expansion[] = {
    {"rate", FRACAS_REAL, "1/s",
     "strain rate along x: velocities are rate x, ratio rate y and, of shells, ratio_z rate z",
     FRACAS_REQUIRED, -INFINITY, INFINITY, false, offsetof(fracas_loading, rate)},
    {"ratio", FRACAS_REAL, "1", "strain rate along y by that along x", 1, -INFINITY, INFINITY,
     false, offsetof(fracas_loading, ratio)},
    {.name = "ratio_z",
     .type = FRACAS_REAL,
     .unit = "1",
     .doc = "strain rate along z by that along x; none is 1",
     .fallback = FRACAS_REQUIRED,
     .minimum = -INFINITY,
     .maximum = INFINITY,
     .offset = offsetof(fracas_loading, ratio_z),
     .only = FRACAS_GROUP_SHELL,
     .optional = true},
    {FRACAS_ONE_OF("start", starts, offsetof(fracas_loading, start), "how the inside starts")},
};

static fracas_stretch expansion_surface(const fracas_spec *spec, const fracas_loading *loading,
                                        double t)
{
    const bool shell = spec->formulation->groups & FRACAS_GROUP_SHELL;
    return (fracas_stretch){.strain = fabs(loading->rate) * t,
                            .ratio = loading->ratio,
                            .ratio_z = shell ? loading->ratio_z : NAN,
                            .moving = true,
                            .shock = loading->start == &fracas_start_rest};
}

const fracas_kind fracas_loading_expansion = {
    "expansion",
    "velocities (rate x, ratio rate y; of shells also ratio_z rate z): all nodes start with them, "
    "those of held edges keep them",
    FRACAS_PARAMS(expansion),
    .traits = &(const fracas_loading_traits){.rate = imposed_rate_of,
                                             .surface = expansion_surface}};

/* ---- centrifugal ---- */

static const fracas_param centrifugal[] = {
    {"speed", FRACAS_REAL, "rad/s", "angular velocity w in the end", FRACAS_REQUIRED, 0, INFINITY,
     false, offsetof(fracas_loading, speed)},
    {"ramp", FRACAS_REAL, "s", "time in which w rises from 0, in proportion to time", 0, 0,
     INFINITY, false, offsetof(fracas_loading, ramp)},
};

static fracas_stretch centrifugal_surface(const fracas_spec *spec, const fracas_loading *loading,
                                          double t)
{
    const double speed = loading->speed;
    (void)spec;
    return (fracas_stretch){.strain = 0.5 * speed * speed * t * t, .ratio = 1, .ratio_z = NAN};
}

const fracas_kind fracas_loading_centrifugal = {
    "centrifugal",
    "a force w^2 r on every unit of mass of a body at rest, r from the origin to where it "
    "started",
    FRACAS_PARAMS(centrifugal),
    .traits = &(const fracas_loading_traits){.surface = centrifugal_surface, .body_force = true}};

/* ---- none ---- */

static fracas_stretch still(const fracas_spec *spec, const fracas_loading *loading, double t)
{
    (void)spec, (void)loading, (void)t;
    return (fracas_stretch){.ratio = 1, .ratio_z = 1};
}

const fracas_kind fracas_loading_none = {
    "none", "no load: a body moves by what it starts with, the section `initial`",
    .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){.surface = still, .idle = true}};

#define LOAD(name) &fracas_loading_##name,
static const fracas_kind *const loadings[] = {&fracas_loading_imposed_rate,
                                              &fracas_loading_initial_velocity,
                                              &fracas_loading_held_velocity,
                                              &fracas_loading_force,
                                              &fracas_loading_expansion,
                                              &fracas_loading_centrifugal,
#include "engine/loading/loads.list.h"
                                              &fracas_loading_none},
                                *const loads[] = {
#include "engine/loading/loads.list.h"
};
#undef LOAD

/* Members of other loadings are 0. */
static fracas_err check_loading(const void *section)
{
    const fracas_loading *loading = section;
    const fracas_loading_traits *traits = loading->type ? loading->type->traits : NULL;
    return traits && traits->check ? traits->check(loading) : FRACAS_OK;
}

/* The n-th load of several. */
#define FURTHER(n, key, ordinal)                                                  \
    [n] = {                                                                       \
        .name = key,                                                              \
        .doc = "The " ordinal " of several loads on a surface; none without it",  \
        .selector = "type",                                                       \
        FRACAS_KINDS(loads),                                                      \
        .kind_offset = offsetof(fracas_loading, type),                            \
        .offset = offsetof(fracas_spec, also) + ((n)-1) * sizeof(fracas_loading), \
        .hashed = true,                                                           \
        .follows = &fracas_loading_sections[(n)-1],                               \
        .check = check_loading,                                                   \
    }

const fracas_section fracas_loading_sections[FRACAS_LOADINGS] = {
    {
        .name = "loading",
        .doc = "What drives the body",
        .selector = "type",
        FRACAS_KINDS(loadings),
        .kind_offset = offsetof(fracas_loading, type),
        .offset = offsetof(fracas_spec, loading),
        .hashed = true,
        .check = check_loading,
    },
    FURTHER(1, "loading_2", "second"),
    FURTHER(2, "loading_3", "third"),
};

const fracas_loading *fracas_loading_at(const fracas_spec *spec, int n)
{
    const fracas_loading *loading = n == 0 ? &spec->loading : &spec->also[n - 1];
    return loading->type ? loading : NULL;
}

const fracas_load *fracas_loading_load(const fracas_spec *spec, int n)
{
    const fracas_loading *loading = fracas_loading_at(spec, n);
    return loading ? ((const fracas_loading_traits *)loading->type->traits)->load : NULL;
}

bool fracas_loading_is_alone(const fracas_spec *spec)
{
    for (int n = 1; n < FRACAS_LOADINGS; n++)
        if (fracas_loading_at(spec, n)) return false;
    return true;
}

bool fracas_loading_is_idle(const fracas_spec *spec)
{
    for (int n = 0; n < FRACAS_LOADINGS; n++) {
        const fracas_loading *loading = fracas_loading_at(spec, n);
        const fracas_loading_traits *traits = loading ? loading->type->traits : NULL;
        const bool rests = traits && traits->load && traits->load->rests &&
                           traits->load->rests(loading);
        if (traits && !traits->idle && !rests) return false;
    }
    return true;
}

fracas_stretch fracas_loading_stretch(const fracas_spec *spec, double t)
{
    fracas_stretch sum = fracas_loading_traits_of(spec)->surface(spec, &spec->loading, t);
    for (int n = 1; n < FRACAS_LOADINGS; n++) {
        const fracas_loading *loading = fracas_loading_at(spec, n);
        if (!loading) continue;
        const fracas_loading_traits *traits = loading->type->traits;
        const fracas_stretch other = traits->surface(spec, loading, t);
        if (other.strain == 0) continue;
        if (sum.strain == 0 && !sum.moving && !sum.shock) { /* the first does nothing */
            sum = other;
            continue;
        }
        const bool alike = sum.ratio == other.ratio && isnan(sum.ratio_z) == isnan(other.ratio_z);
        sum.strain = alike ? sum.strain + other.strain : INFINITY;
        sum.whole = sum.whole > 0 && other.whole > 0 ? sum.whole + other.whole : 0;
    }
    return sum;
}
