/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/loading/initial.h"

#include "base/elementary.h"
#include "engine/loading/load.h"
#include "engine/loading/region.h"

#include <math.h>

#define KEY(key, place, measure, models, what)                                            \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = measure, .doc = what,         \
                  .fallback = FRACAS_REQUIRED, .minimum = -INFINITY, .maximum = INFINITY, \
                  .offset = offsetof(fracas_initial, place), .only = models, .optional = true)
#define HALF_WAVES(axis, i, models)                                                             \
    FRACAS_BRACES(.name = "half_waves_" axis, .type = FRACAS_REAL, .unit = "1",                 \
                  .doc = "the velocity is a sine along " axis " with so many half waves, from " \
                         "from_" axis " to to_" axis,                                           \
                  .fallback = FRACAS_REQUIRED, .maximum = INFINITY, .minimum_open = true,       \
                  .offset = offsetof(fracas_initial, half_waves[i]), .only = models,            \
                  .optional = true)
#define ALL FRACAS_GROUP_SURFACES
#define SHELL FRACAS_GROUP_SHELL

static const fracas_param params[] = {
    KEY("velocity_x", velocity[0], "m/s", ALL,
        "velocity along x, but of components that edges hold"),
    KEY("velocity_y", velocity[1], "m/s", ALL, "velocity along y"),
    KEY("velocity_z", velocity[2], "m/s", SHELL, "velocity along z"),
    KEY("spin", spin, "rad/s", ALL,
        "angular velocity about the axis along z through at_x, at_y, beside those velocities"),
    KEY("at_x", at[0], "m", ALL, "x of the spin's axis and of the middle of `within`; none is 0"),
    KEY("at_y", at[1], "m", ALL, "y of both; none is 0"),
    KEY("at_z", at[2], "m", SHELL, "z of the middle; none is 0"),
    {.name = "within",
     .type = FRACAS_REAL,
     .unit = "m",
     .doc = "nodes farther from the middle start without this velocity; none: all have it",
     .fallback = FRACAS_REQUIRED,
     .maximum = INFINITY,
     .minimum_open = true,
     .offset = offsetof(fracas_initial, within),
     .only = ALL,
     .optional = true},
    KEY("from_x", from[0], "m", ALL, "nodes with a smaller x start without it"),
    KEY("to_x", to[0], "m", ALL, "nodes with a larger x start without it"),
    KEY("from_y", from[1], "m", ALL, "nodes with a smaller y start without it"),
    KEY("to_y", to[1], "m", ALL, "nodes with a larger y start without it"),
    KEY("from_z", from[2], "m", SHELL, "nodes with a smaller z start without it"),
    KEY("to_z", to[2], "m", SHELL, "nodes with a larger z start without it"),
    KEY("radial", radial, "m/s", ALL,
        "velocity away from at_x, at_y, at_z, or from an axis through it, beside those above"),
    {FRACAS_ONE_OF("axis", fracas_front_axes, offsetof(fracas_initial, axis),
                   "direction of the axis of radial and spin, through at_x, at_y, at_z; without "
                   "it radial is away from that place, and spin about z"),
     .only = SHELL, .optional = true},
    HALF_WAVES("x", 0, ALL),
    HALF_WAVES("y", 1, ALL),
    HALF_WAVES("z", 2, SHELL),
    KEY("strain_x", strain[0], "1", ALL, "uniform strain along x, from the stress-free state"),
    KEY("strain_y", strain[1], "1", ALL, "along y"),
    KEY("strain_z", strain[2], "1", SHELL, "along z"),
    KEY("strain_xy", strain_xy, "1", ALL, "shear strain, half the change of the angle of x and y"),
    KEY("stress_x", stress[0], "Pa", ALL,
        "uniform stress along x of a flat body; its strains add to those above"),
    KEY("stress_y", stress[1], "Pa", ALL, "along y"),
    KEY("stress_xy", stress_xy, "Pa", ALL, "shear stress"),
    KEY("temperature", temperature, "K", ALL,
        "change of the temperature from the stress-free state, all at once: cooling is below 0"),
    KEY("expansion_coefficient", expansion, "1/K", ALL,
        "thermal strain by temperature, of which the body has the opposite where it is held"),
};

/* NaN: not given. A model without the key has 0. */
static double given(double value)
{
    return isnan(value) ? 0 : value;
}

static bool is_set(double value)
{
    return fabs(value) > 0; /* NaN: no */
}

bool fracas_initial_moves(const fracas_initial *initial)
{
    bool moves = is_set(initial->spin) || is_set(initial->radial);
    for (int i = 0; i < 3; i++) moves = moves || is_set(initial->velocity[i]);
    return moves;
}

/* Both 0: the model has no such limits. */
static bool is_limited(const fracas_initial *initial, int i)
{
    return is_set(initial->from[i]) || is_set(initial->to[i]) ||
           isnan(initial->from[i]) != isnan(initial->to[i]);
}

bool fracas_initial_parts(const fracas_initial *initial)
{
    bool parts = initial->within > 0 || is_set(initial->radial);
    for (int i = 0; i < 3; i++) parts = parts || is_limited(initial, i);
    return parts && fracas_initial_moves(initial);
}

bool fracas_initial_has_stress(const fracas_initial *initial)
{
    return is_set(initial->stress[0]) || is_set(initial->stress[1]) || is_set(initial->stress_xy);
}

static fracas_region region_of(const fracas_initial *initial)
{
    fracas_region region = {.within = initial->within};
    for (int i = 0; i < 3; i++) {
        region.at[i] = given(initial->at[i]);
        region.from[i] = is_limited(initial, i) ? initial->from[i] : NAN;
        region.to[i] = is_limited(initial, i) ? initial->to[i] : NAN;
    }
    return region;
}

/* s(x): 1 without half waves  (initial.2) */
static double wave_at(const fracas_initial *initial, const double x[3])
{
    double wave = 1;
    for (int i = 0; i < 3; i++)
        if (initial->half_waves[i] > 0) /* NaN: no */
            wave *= fracas_sinpi(initial->half_waves[i] * (x[i] - initial->from[i]) /
                                 (initial->to[i] - initial->from[i]));
    return wave;
}

/* Component of the axis; none: -1. */
static int axis_of(const fracas_initial *initial)
{
    for (int i = 0; i < 3; i++)
        if (initial->axis == fracas_front_axes[i]) return i;
    return -1;
}

/* (initial.1) */
void fracas_initial_velocity(const fracas_initial *initial, const double x[3], double velocity[3])
{
    const int axis = axis_of(initial), about = axis < 0 ? 2 : axis;
    const fracas_region region = region_of(initial);
    const double spin = given(initial->spin), wave = wave_at(initial, x);
    double from[3], square = 0;
    for (int i = 0; i < 3; i++) velocity[i] = 0;
    if (!fracas_region_has(&region, x)) return;
    for (int i = 0; i < 3; i++) {
        velocity[i] = given(initial->velocity[i]);
        from[i] = x[i] - given(initial->at[i]);
        if (i != axis) square += from[i] * from[i];
    }
    for (int i = 0; i < 3 && square > 0; i++)
        if (i != axis) velocity[i] += given(initial->radial) * (from[i] / sqrt(square));
    velocity[(about + 1) % 3] -= spin * from[(about + 2) % 3];
    velocity[(about + 2) % 3] += spin * from[(about + 1) % 3];
    for (int i = 0; i < 3; i++) velocity[i] *= wave;
}

/* (initial.3) */
fracas_initial_strain fracas_initial_strain_of(const fracas_spec *spec)
{
    const fracas_initial *initial = &spec->initial;
    const double young = spec->material.young, nu = spec->material.poisson,
                 thermal = -given(initial->expansion) * given(initial->temperature);
    fracas_initial_strain s = {given(initial->strain[0]) + thermal,
                               given(initial->strain[1]) + thermal,
                               given(initial->strain[2]) + thermal, given(initial->strain_xy)};
    if (!fracas_initial_has_stress(initial)) return s; /* a chain has no nu */
    const double x = given(initial->stress[0]), y = given(initial->stress[1]);
    s.x += (x - nu * y) / young;
    s.y += (y - nu * x) / young;
    s.xy += (1 + nu) * given(initial->stress_xy) / young;
    return s;
}

bool fracas_initial_is_strained(const fracas_spec *spec)
{
    const fracas_initial_strain s = fracas_initial_strain_of(spec);
    return is_set(s.x) || is_set(s.y) || is_set(s.z) || is_set(s.xy);
}

/* (initial.4) */
void fracas_initial_displacement(const fracas_initial_strain *s, const double x[3],
                                 double displacement[3])
{
    displacement[0] = s->x * x[0] + s->xy * x[1];
    displacement[1] = s->xy * x[0] + s->y * x[1];
    displacement[2] = s->z * x[2];
}

/* Principal strains: two in the plane x, y, and the one along z. */
static void principal_of(const fracas_spec *spec, double principal[3])
{
    const fracas_initial_strain s = fracas_initial_strain_of(spec);
    const double mean = 0.5 * (s.x + s.y),
                 radius = sqrt(0.25 * (s.x - s.y) * (s.x - s.y) + s.xy * s.xy);
    principal[0] = mean + radius;
    principal[1] = mean - radius;
    principal[2] = s.z;
}

/* Two of a body in the plane x, y, else three. */
static int principals_of(const fracas_spec *spec)
{
    return spec->formulation->groups & FRACAS_GROUP_MEMBRANE ||
                   fracas_initial_has_stress(&spec->initial)
               ? 2
               : 3;
}

/* E (a + nu b)/(1 - nu^2) and E (b + nu a)/(1 - nu^2) of two principal strains a, b [Pa]. */
static void stresses_of(const fracas_spec *spec, double one, double other, double stress[2])
{
    const double nu = spec->material.poisson, plane = spec->material.young / (1 - nu * nu);
    stress[0] = plane * (one + nu * other);
    stress[1] = plane * (other + nu * one);
}

double fracas_initial_stress(const fracas_spec *spec)
{
    double principal[3], s[2], largest = 0;
    principal_of(spec, principal);
    for (int i = 0; i < principals_of(spec); i++)
        for (int j = 0; j < i; j++) {
            stresses_of(spec, principal[i], principal[j], s);
            largest = fmax(largest, fmax(fabs(s[0]), fabs(s[1])));
        }
    return largest;
}

double fracas_initial_effective(const fracas_spec *spec)
{
    const double coupling = spec->cohesive.coupling;
    double principal[3], s[2], largest = 0;
    principal_of(spec, principal);
    for (int i = 0; i < principals_of(spec); i++)
        for (int j = 0; j < i; j++) {
            stresses_of(spec, principal[i], principal[j], s);
            largest = fmax(largest, fmax(s[0], s[1]));
            if (coupling > 0) largest = fmax(largest, 0.5 * fabs(s[0] - s[1]) / coupling);
        }
    return largest;
}

double fracas_initial_largest_strain(const fracas_spec *spec)
{
    double principal[3], largest = 0;
    principal_of(spec, principal);
    for (int i = 0; i < principals_of(spec); i++) largest = fmax(largest, fabs(principal[i]));
    return largest;
}

/* One is given, also 0 as in a sweep. */
static bool has_velocity(const fracas_initial *initial)
{
    bool has = !isnan(initial->spin) || !isnan(initial->radial);
    for (int i = 0; i < 3; i++)
        has = has || (i < 2 ? !isnan(initial->velocity[i]) : is_set(initial->velocity[i]));
    return has;
}

static fracas_err check_limits(const fracas_initial *initial)
{
    static const char axis[] = "xyz";
    const bool surface = isnan(initial->temperature) || isnan(initial->stress_xy) ||
                         isnan(initial->within); /* all 0: the model has no such section */
    for (int i = 0; i < 3; i++)
        if ((is_limited(initial, i) || (surface && i < 2)) && initial->to[i] <= initial->from[i])
            return fracas_fail(FRACAS_USAGE,
                               "to_%c is %g m, not beyond from_%c, %g m: no node is between them",
                               axis[i], initial->to[i], axis[i], initial->from[i]);
    return FRACAS_OK;
}

/* Only the velocity has a region. */
static fracas_err check_region(const fracas_initial *initial)
{
    bool limited = initial->within > 0, middle = false;
    for (int i = 0; i < 3; i++) {
        limited = limited || is_limited(initial, i);
        middle = middle || is_set(initial->at[i]);
    }
    if (limited && !has_velocity(initial))
        return fracas_fail(
            FRACAS_USAGE,
            "limits of a region are given, but no velocity_x, _y, _z, radial or "
            "spin: the region is that of the velocity, strains and stresses are those of all "
            "of the body");
    if (middle && !(initial->within > 0) && isnan(initial->spin) && isnan(initial->radial))
        return fracas_fail(FRACAS_USAGE, "at_x, at_y or at_z is given, but no spin, radial or "
                                         "within, whose middle it would be");
    if (initial->axis && isnan(initial->spin) && isnan(initial->radial))
        return fracas_fail(FRACAS_USAGE,
                           "axis is %s, but there is no radial and no spin, whose "
                           "axis it would be",
                           initial->axis->name);
    return FRACAS_OK;
}

static fracas_err check_waves(const fracas_initial *initial)
{
    static const char axis[] = "xyz";
    for (int i = 0; i < 3; i++) {
        if (!(initial->half_waves[i] > 0)) continue;
        if (!has_velocity(initial))
            return fracas_fail(FRACAS_USAGE,
                               "half_waves_%c is %g, but no velocity_x, _y, _z, radial or spin is "
                               "given, which they would shape",
                               axis[i], initial->half_waves[i]);
        if (isnan(initial->from[i]) || isnan(initial->to[i]))
            return fracas_fail(FRACAS_USAGE,
                               "half_waves_%c is %g: give from_%c and to_%c too, where the sine "
                               "begins and ends",
                               axis[i], initial->half_waves[i], axis[i], axis[i]);
    }
    return FRACAS_OK;
}

/* A temperature alone strains nothing, nor does a coefficient. */
static fracas_err check_initial(const void *section)
{
    const fracas_initial *initial = section;
    if (is_set(initial->temperature) && !is_set(initial->expansion))
        return fracas_fail(FRACAS_USAGE,
                           "temperature is %g K, without an expansion_coefficient: give the "
                           "material's, for instance expansion_coefficient: 8e-6 1/K",
                           initial->temperature);
    TRY(check_limits(initial));
    TRY(check_waves(initial));
    return check_region(initial);
}

const fracas_section fracas_initial_section = {
    .name = "initial",
    .doc = "How a surface starts, beside its load: at rest and free of stress without it",
    FRACAS_PARAMS(params),
    .offset = offsetof(fracas_spec, initial),
    .hashed = true,
    .check = check_initial,
};
