/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `edge-motion`: one or two edges have a prescribed displacement or velocity. */
#include "engine/loading/load.h"

#include <math.h>

typedef struct {
    size_t of_place; /* offset of a direction in fracas_place */
} motion_direction;

static const fracas_kind
    outward = {"outward", "along its outward normal in the surface",
               .traits = &(const motion_direction){offsetof(fracas_place, outward)}},
    along = {"along", "along itself, the body on its left",
             .traits = &(const motion_direction){offsetof(fracas_place, along)}},
    across = {"across", "along the normal of the mid-surface",
              .traits = &(const motion_direction){offsetof(fracas_place, normal)}};
static const fracas_kind *const plane_directions[] = {&outward, &along}, *const directions[] = {
                                                                             &outward, &along,
                                                                             &across};

/* Rises over a share x in [0, 1] of their time, and their integrals from 0. */
typedef struct {
    double (*value)(double x), (*integral)(double x);
} motion_rise;

/* No jump of velocity or acceleration, largest slope 15/8  (loads.6) */
static double smooth_value(double x)
{
    return x * x * x * (10 - x * (15 - 6 * x));
}

static double smooth_integral(double x)
{
    return x * x * x * x * (2.5 - x * (3 - x));
}

static double linear_value(double x)
{
    return x;
}

static double linear_integral(double x)
{
    return 0.5 * x * x;
}

static const fracas_kind smooth = {"smooth",
                                   "10 x^3 - 15 x^4 + 6 x^5 of the share x of rise, without a jump "
                                   "of velocity or acceleration",
                                   .traits = &(const motion_rise){smooth_value, smooth_integral}},
                         linear = {"linear", "in proportion to time",
                                   .traits = &(const motion_rise){linear_value, linear_integral}};
static const fracas_kind *const rises[] = {&smooth, &linear};

#define DIRECTION(kinds, models)                                                         \
    FRACAS_BRACES(FRACAS_ONE_OF("direction", kinds, offsetof(fracas_loading, direction), \
                                "in which it moves"),                                    \
                  .only = models)
#define LARGEST(key, member, measure, what)                                       \
    FRACAS_BRACES(key, FRACAS_REAL, measure, what, 0, -INFINITY, INFINITY, false, \
                  offsetof(fracas_loading, member))

static const fracas_param params[] = {
    {FRACAS_LOAD_EDGE("edge", edge,
                      "edge that moves as far as `geometry` holds it, a free one whole"),
     .fallback = FRACAS_REQUIRED},
    {FRACAS_LOAD_EDGE("second_edge", second_edge,
                      "another one, which moves as much in its own direction"),
     .optional = true},
    DIRECTION(plane_directions, FRACAS_GROUP_MEMBRANE),
    DIRECTION(directions, FRACAS_GROUP_SHELL),
    LARGEST("displacement", displacement, "m", "displacement once it has risen; or give velocity"),
    LARGEST("velocity", velocity, "m/s", "velocity once it has risen; or give displacement"),
    FRACAS_LOAD_TIME("rise", rise, "time in which it rises from 0, as rise_by says"),
    {FRACAS_ONE_OF("rise_by", rises, offsetof(fracas_loading, rise_by), "how it rises")},
    FRACAS_LOAD_HISTORY("rise"),
};

/* d in (loads.5) */
static void direction_at(const fracas_spec *spec, const fracas_loading *loading,
                         const fracas_place *at, double direction[3])
{
    (void)spec;
    const motion_direction *of = loading->direction->traits;
    const double *vector = (const double *)((const char *)at + of->of_place);
    for (int i = 0; i < 3; i++) direction[i] = vector[i];
}

static const char *edge_of(const fracas_loading *loading, int i)
{
    const fracas_kind *edge = i == 0 ? loading->edge : i == 1 ? loading->second_edge : NULL;
    return edge ? edge->name : NULL;
}

/* Factor of the displacement, or the integral over time of that of the velocity  (loads.6) */
static double risen(const fracas_loading *loading, const fracas_profile *history, bool integral,
                    double t)
{
    const motion_rise *rise = loading->rise_by->traits;
    const double time = loading->rise;
    if (history->count > 0)
        return integral ? fracas_profile_integral(history, t) : fracas_profile_at(history, t);
    if (!(time > 0)) return integral ? t : 1;
    if (!integral) return t < time ? rise->value(t / time) : 1;
    return t < time ? time * rise->integral(t / time) : time * rise->integral(1) + (t - time);
}

/* (loads.6) */
static double path(const fracas_loading *loading, const fracas_profile *history, double t)
{
    const bool by_velocity = fabs(loading->velocity) > 0;
    if (t <= 0) return 0;
    return (by_velocity ? loading->velocity : loading->displacement) *
           risen(loading, history, by_velocity, t);
}

/* A displacement begins at 0 and does not jump. */
static fracas_err check_displacement(const fracas_loading *loading, const fracas_profile *history)
{
    if (history->count == 0 && isnan(loading->rise))
        return fracas_fail(FRACAS_USAGE, "displacement is given, but neither rise nor history: the "
                                         "edge would jump: say in which time it gets there, for "
                                         "instance `rise: 20 us`");
    if (history->count == 0) return FRACAS_OK;
    const double first = fracas_profile_at(history, 0);
    if (first != 0)
        return fracas_fail(FRACAS_USAGE,
                           "%s says %g at 0 s, and the edge would jump there: let its displacement "
                           "begin with 0,0, or give velocity",
                           loading->history->path, first);
    for (size_t p = 1; p < history->count; p++)
        if (history->place[p].at == history->place[p - 1].at)
            return fracas_fail(FRACAS_USAGE,
                               "%s has two factors at %g s, and the edge would jump there: let its "
                               "displacement take some time, or give velocity",
                               loading->history->path, history->place[p].at);
    return FRACAS_OK;
}

static fracas_err check(const fracas_loading *loading)
{
    const double given[2] = {loading->displacement, loading->velocity};
    TRY(fracas_param_check_either("edge-motion takes",
                                  (const char *const[]){"displacement", "velocity"}, given,
                                  "displacement: 2 um"));
    if (loading->second_edge && loading->second_edge == loading->edge)
        return fracas_fail(FRACAS_USAGE,
                           "edge and second_edge are both %s: name another edge, or leave "
                           "second_edge out",
                           loading->edge->name);
    if (loading->history && !isnan(loading->rise))
        return fracas_fail(FRACAS_USAGE,
                           "history and rise are both given: %s says how the edge moves: leave "
                           "rise out",
                           loading->history->path);
    FRACAS_CLEARED(fracas_profile) history = {0};
    TRY(fracas_load_history(loading, &history));
    return fabs(loading->displacement) > 0 ? check_displacement(loading, &history) : FRACAS_OK;
}

static const fracas_load load = {
    .on = FRACAS_LOAD_ON_EDGE, .density = direction_at, .edge = edge_of, .path = path};

/* Waves reflect, and corners of held edges concentrate stress: no bound is known. */
const fracas_kind fracas_loading_edge_motion = {
    "edge-motion", "one or two edges of a body at rest move as prescribed", FRACAS_PARAMS(params),
    .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){
        .surface = fracas_load_unbounded, .load = &load, .check = check}};
