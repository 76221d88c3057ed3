/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/warnings.h"

#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The softening zone of a crack, some E G_c/sigma_c^2 long, should hold elements. */
#define COARSE 0.5
/* Speeds sqrt(E/rho) of waves that solids have, from rubber to diamond [m/s]. */
#define SLOWEST 10.0
#define FASTEST 2.5e4
/* A ring turned further than this no longer opens along the directions of its start [rad]: 1 - cos
 * of it is 5e-5. */
#define TURNED 0.01

/* What would crack more of a body whose stress stays below its strength. */
static const char *harder(const fracas_spec *spec, const fracas_forecast *forecast)
{
    if (spec->loading.type != &fracas_loading_initial_velocity) return "load it harder, or longer";
    return spec->time.end < forecast->turn ? "raise its velocity or time.end"
                                           : "a free ring swings back: raise its velocity";
}

/* What would resolve a crack's softening. */
static void finer(const fracas_spec *spec, const fracas_forecast *forecast, char *text, size_t size)
{
    const double times = forecast->coarseness / COARSE;
    if (!fracas_spec_is_surface(spec))
        snprintf(text, size, "raise mesh.elements to %.0f",
                 ceil((double)forecast->elements * times));
    else if (spec->mesh.spacing == &fracas_spacing_given)
        snprintf(text, size, "give a mesh with edges %.2g times shorter", times);
    else if (spec->mesh.size > 0)
        snprintf(text, size, "lower mesh.size to %.2g m", spec->mesh.size / times);
    else
        snprintf(text, size, "raise mesh.divisions to %.0f",
                 ceil((double)spec->mesh.divisions * times));
}

static bool warn_coarse(const fracas_point *point, const fracas_forecast *forecast, char *text,
                        size_t size)
{
    char remedy[80];
    finer(&point->spec, forecast, remedy, sizeof remedy);
    snprintf(text, size,
             "elements are %.3g E G_c/sigma_c^2 long, above %.1g a crack's softening is not "
             "resolved: %s",
             forecast->coarseness, COARSE, remedy);
    return forecast->coarseness > COARSE;
}

static bool warn_uniform(const fracas_point *point, const fracas_forecast *forecast, char *text,
                         size_t size)
{
    const char *distribution = point->strength.distribution->name;
    const bool all = strcmp(distribution, "constant") == 0;
    snprintf(text, size,
             "%s interfaces %sare equally strong and qualify at once; where the body breaks is "
             "then up to mesh and rounding: give the strength a scatter%s",
             all ? "all" : "half of the", all ? "" : "or more ",
             strcmp(distribution, "flaws") ? "" : ", here by a higher flaw_density");
    return forecast->uniform;
}

static bool warn_lines(const fracas_point *point, const fracas_forecast *forecast, char *text,
                       size_t size)
{
    (void)point;
    snprintf(text, size,
             "interfaces are equally strong and the mesh is regular, so that cracks follow its "
             "lines: give mesh.amplitude, for instance 0.2");
    return forecast->lines;
}

/* A unit slipped: no other check compares these two. */
static bool warn_wave(const fracas_point *point, const fracas_forecast *forecast, char *text,
                      size_t size)
{
    (void)forecast;
    const double speed = sqrt(point->spec.material.young / point->spec.material.density);
    snprintf(
        text, size,
        "waves go at sqrt(young/density) = %.3g m/s, in solids at %.3g to %.3g: are material.young "
        "[Pa] and material.density [kg/m3] in the units meant? A bare number is SI",
        speed, SLOWEST, FASTEST);
    return speed < SLOWEST || speed > FASTEST;
}

static bool warn_weak_load(const fracas_point *point, const fracas_forecast *forecast, char *text,
                           size_t size)
{
    snprintf(text, size,
             "until time.end the stress stays below %.3g MPa, the mean strength is %.3g MPa: the "
             "weakest interfaces will crack, or none: %s",
             1e-6 * forecast->bound, 1e-6 * forecast->mean, harder(&point->spec, forecast));
    return forecast->bound < forecast->mean;
}

static bool warn_repeated(const fracas_point *point, const fracas_forecast *forecast, char *text,
                          size_t size)
{
    snprintf(text, size,
             "its strengths are those of a file, so all its %" PRId64
             " replicas are equal: give it replicas: 1",
             point->replicas);
    return forecast->repeated;
}

static bool warn_folds(const fracas_point *point, const fracas_forecast *forecast, char *text,
                       size_t size)
{
    (void)point;
    snprintf(text, size,
             "the whole ring comes under compression, where it folds, as it has no bending "
             "stiffness: what breaks then means nothing: load it outward, and end a free ring that "
             "stays whole by %.3g s",
             2 * forecast->turn);
    return forecast->folds;
}

static bool warn_lonely(const fracas_point *point, const fracas_forecast *forecast, char *text,
                        size_t size)
{
    (void)point;
    snprintf(text, size,
             "cohesive.zone is longer than half of the ring: once an interface opens, none else "
             "can: shorten it to less than a quarter of a fragment");
    return forecast->lonely;
}

/* Laws that leave the flux soften from what the step has reached:
 * docs/decisions/onset-of-surfaces.md. */
static bool warn_passed(const fracas_point *point, const fracas_forecast *forecast, char *text,
                        size_t size)
{
    (void)point;
    snprintf(
        text, size,
        "one time step adds %.3g Pa of stress, and nearly all strengths lie within %.3g Pa: "
        "interfaces that a step passes together are equally strong; lower time.safety %.2g times",
        forecast->step_stress, forecast->spread, 4 * forecast->step_stress / forecast->spread);
    return forecast->spread > 0 && forecast->step_stress > 0.25 * forecast->spread;
}

static bool warn_step(const fracas_point *point, const fracas_forecast *forecast, char *text,
                      size_t size)
{
    (void)point;
    snprintf(text, size,
             "one time step adds %.3g Pa of stress, more than the mean strength of %.3g Pa: are "
             "strength, material and loading in the units meant? A bare number is SI",
             forecast->step_stress, forecast->mean);
    return forecast->step_stress > forecast->mean;
}

static bool warn_turned(const fracas_point *point, const fracas_forecast *forecast, char *text,
                        size_t size)
{
    (void)point;
    snprintf(text, size,
             "the ring turns by %.2g rad until time.end, and geometry.direction is initial: "
             "interfaces that open along directions it no longer has are off from %.2g rad on: "
             "leave direction out, for current",
             forecast->turned, TURNED);
    return forecast->turned > TURNED;
}

static bool warn_short(const fracas_point *point, const fracas_forecast *forecast, char *text,
                       size_t size)
{
    const double length = point->strength.correlation_length;
    snprintf(text, size,
             "strength.correlation_length is %.3g m, less than a third of an element of %.3g m: "
             "strengths are as good as independent: is that in m? A bare number is SI",
             length, forecast->element);
    return point->strength.covariance && length < forecast->element / 3;
}

static bool warn_long(const fracas_point *point, const fracas_forecast *forecast, char *text,
                      size_t size)
{
    const double length = point->strength.correlation_length;
    snprintf(text, size,
             "strength.correlation_length is %.3g m, more than the %.3g m of the body: strengths "
             "of a replica are much alike, and differ from replica to replica: is that in m? A "
             "bare number is SI",
             length, forecast->extent);
    return point->strength.covariance && length > forecast->extent;
}

static bool warn_flat(const fracas_point *point, const fracas_forecast *forecast, char *text,
                      size_t size)
{
    snprintf(text, size,
             "strength.factor is the same at all interfaces: the body does not reach where %s "
             "changes along %s: are its coordinates in m?",
             forecast->flat ? point->strength.factor->path : "",
             forecast->flat ? point->strength.factor_along->name : "");
    return forecast->flat;
}

/* A correlation of neighbours leaves the body fewer independent flaws than its volume has. */
static bool warn_weakest(const fracas_point *point, const fracas_forecast *forecast, char *text,
                         size_t size)
{
    (void)forecast;
    snprintf(
        text, size,
        "strengths are correlated, and their size effect is that of independent flaws: the body "
        "gets stronger as its mesh is refined: leave one of the two out, or compare on one mesh");
    return point->strength.covariance && fracas_strength_has_size_effect(&point->strength);
}

fracas_plan_warning *const fracas_plan_warnings[FRACAS_PLAN_WARNINGS] = {
    warn_coarse, warn_uniform, warn_lines, warn_weak_load, warn_repeated,
    warn_folds,  warn_lonely,  warn_step,  warn_turned,    warn_passed,
    warn_short,  warn_long,    warn_flat,  warn_weakest,   warn_wave};
