/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/warnings.h"

#include "engine/loading/loading.h"
#include "engine/mesh/make.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/* Largest resolved element size over E G_c/sigma_c^2, the softening length of a crack. */
#define COARSE 0.5
/* Wave speeds sqrt(E/rho) of solids, from rubber to diamond [m/s]. */
#define SLOWEST 10.0
#define FASTEST 2.5e4
/* Largest turn of a ring with initial opening directions [rad]: 1 - cos is 5e-5. */
#define TURNED 0.01

/* Writes the text, and returns whether the warning applies. */
static FRACAS_PRINTF(3, 4) bool applies(const fracas_warning *w, bool condition, const char *format,
                                        ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(w->text, w->size, format, arguments);
    va_end(arguments);
    return condition;
}

/* Remedy for a load too weak to crack the body. */
static const char *harder(const fracas_warning *w)
{
    const fracas_spec *spec = &w->point->spec;
    if (!fracas_loading_traits_of(spec)->released) return "load it harder, or longer";
    return spec->time.end < w->forecast->turn ? "raise its velocity or time.end"
                                              : "a free ring swings back: raise its velocity";
}

/* Remedy for a mesh too coarse for a crack's softening. */
static void finer(const fracas_spec *spec, const fracas_forecast *forecast, char *text, size_t size)
{
    const double times = forecast->coarseness / COARSE;
    if (!fracas_spec_is_surface(spec))
        snprintf(text, size, "raise mesh.elements to %.0f",
                 ceil((double)forecast->elements * times));
    else if (fracas_spacing_of(spec)->from_file)
        snprintf(text, size, "give a mesh with edges %.2g times shorter", times);
    else if (spec->mesh.size > 0)
        snprintf(text, size, "lower mesh.size to %.2g m", spec->mesh.size / times);
    else
        snprintf(text, size, "raise mesh.divisions to %.0f",
                 ceil((double)spec->mesh.divisions * times));
}

static bool warn_coarse(const fracas_warning *w)
{
    char remedy[80];
    finer(&w->point->spec, w->forecast, remedy, sizeof remedy);
    return applies(w, w->forecast->coarseness > COARSE,
                   "elements are %.3g E G_c/sigma_c^2 long, above %.1g a crack's softening is not "
                   "resolved: %s",
                   w->forecast->coarseness, COARSE, remedy);
}

static bool warn_uniform(const fracas_warning *w)
{
    const bool all = w->forecast->equal;
    return applies(
        w, w->forecast->uniform,
        "%s interfaces %sare equally strong and qualify at once; where the body breaks is "
        "then up to mesh and rounding: give the strength a scatter%s",
        all ? "all" : "half of the", all ? "" : "or more ",
        fracas_strength_scatter_remedy(&w->point->strength));
}

static bool warn_lines(const fracas_warning *w)
{
    return applies(
        w, w->forecast->lines,
        "interfaces are equally strong and the mesh is regular, so that cracks follow its "
        "lines: give mesh.amplitude, for instance 0.2");
}

/* Finds wrong units of young and density, which no other check compares. */
static bool warn_wave(const fracas_warning *w)
{
    const double speed = sqrt(w->point->spec.material.young / w->point->spec.material.density);
    return applies(
        w, speed < SLOWEST || speed > FASTEST,
        "waves go at sqrt(young/density) = %.3g m/s, in solids at %.3g to %.3g: are material.young "
        "[Pa] and material.density [kg/m3] in the units meant? A bare number is SI",
        speed, SLOWEST, FASTEST);
}

static bool warn_weak_load(const fracas_warning *w)
{
    return applies(
        w, w->forecast->bound < w->forecast->mean,
        "until time.end the stress stays below %.3g MPa, the mean strength is %.3g MPa: the "
        "weakest interfaces will crack, or none: %s",
        1e-6 * w->forecast->bound, 1e-6 * w->forecast->mean, harder(w));
}

static bool warn_repeated(const fracas_warning *w)
{
    return applies(w, w->forecast->repeated,
                   "its strengths are those of a file, so all its %" PRId64
                   " replicas are equal: give it replicas: 1",
                   w->point->replicas);
}

static bool warn_folds(const fracas_warning *w)
{
    return applies(
        w, w->forecast->folds,
        "the whole ring comes under compression, where it folds, as it has no bending "
        "stiffness: what breaks then means nothing: load it outward, and end a free ring that "
        "stays whole by %.3g s",
        2 * w->forecast->turn);
}

static bool warn_lonely(const fracas_warning *w)
{
    return applies(
        w, w->forecast->lonely,
        "cohesive.zone is longer than half of the ring: once an interface opens, none else "
        "can: shorten it to less than a quarter of a fragment");
}

/* Laws without flux soften from the stress at the end of the step:
 * docs/decisions/onset-of-surfaces.md. */
static bool warn_passed(const fracas_warning *w)
{
    return applies(
        w, w->forecast->spread > 0 && w->forecast->step_stress > 0.25 * w->forecast->spread,
        "one time step adds %.3g Pa of stress, and nearly all strengths lie within %.3g Pa: "
        "interfaces that a step passes together are equally strong; lower time.safety %.2g times",
        w->forecast->step_stress, w->forecast->spread,
        4 * w->forecast->step_stress / w->forecast->spread);
}

static bool warn_step(const fracas_warning *w)
{
    return applies(
        w, w->forecast->step_stress > w->forecast->mean,
        "one time step adds %.3g Pa of stress, more than the mean strength of %.3g Pa: are "
        "strength, material and loading in the units meant? A bare number is SI",
        w->forecast->step_stress, w->forecast->mean);
}

static bool warn_turned(const fracas_warning *w)
{
    return applies(
        w, w->forecast->turned > TURNED,
        "the ring turns by %.2g rad until time.end, and geometry.direction is initial: "
        "interfaces that open along directions it no longer has are off from %.2g rad on: "
        "leave direction out, for current",
        w->forecast->turned, TURNED);
}

static bool warn_short(const fracas_warning *w)
{
    const double length = w->point->strength.correlation_length;
    return applies(
        w, w->point->strength.covariance && length < w->forecast->element / 3,
        "strength.correlation_length is %.3g m, less than a third of an element of %.3g m: "
        "strengths are as good as independent: is that in m? A bare number is SI",
        length, w->forecast->element);
}

static bool warn_long(const fracas_warning *w)
{
    const double length = w->point->strength.correlation_length;
    return applies(
        w, w->point->strength.covariance && length > w->forecast->extent,
        "strength.correlation_length is %.3g m, more than the %.3g m of the body: strengths "
        "of a replica are much alike, and differ from replica to replica: is that in m? A "
        "bare number is SI",
        length, w->forecast->extent);
}

static bool warn_flat(const fracas_warning *w)
{
    return applies(
        w, w->forecast->flat,
        "strength.factor is the same at all interfaces: the body does not reach where %s "
        "changes along %s: are its coordinates in m?",
        w->forecast->flat ? w->point->strength.factor->path : "",
        w->forecast->flat ? w->point->strength.factor_along->name : "");
}

/* Correlated neighbours leave the body fewer independent flaws than its volume suggests. */
static bool warn_weakest(const fracas_warning *w)
{
    return applies(
        w, w->point->strength.covariance && fracas_strength_has_size_effect(&w->point->strength),
        "strengths are correlated, and their size effect is that of independent flaws: the body "
        "gets stronger as its mesh is refined: leave one of the two out, or compare on one mesh");
}

fracas_plan_warning *const fracas_plan_warnings[FRACAS_PLAN_WARNINGS] = {
    warn_coarse, warn_uniform, warn_lines, warn_weak_load, warn_repeated,
    warn_folds,  warn_lonely,  warn_step,  warn_turned,    warn_passed,
    warn_short,  warn_long,    warn_flat,  warn_weakest,   warn_wave};
