/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/loading/load.h"

#include "base/elementary.h"

#include <math.h>

typedef struct {
    int component;
} front_axis;

const fracas_kind fracas_front_x = {"x", "along x", .traits = &(const front_axis){0}},
                  fracas_front_y = {"y", "along y", .traits = &(const front_axis){1}},
                  fracas_front_z = {"z", "along z", .traits = &(const front_axis){2}};
const fracas_kind *const fracas_front_axes[3] = {&fracas_front_x, &fracas_front_y, &fracas_front_z};

/* Keys of edges in the shapes' tables (engine/mesh/body.c). */
static const fracas_kind left = {"left", "of a plate"}, right = {"right", "of a plate"},
                         bottom = {"bottom", "of a plate"}, top = {"top", "of a plate"},
                         inner = {"inner_edge", "of an annulus"},
                         outer = {"outer_edge", "of an annulus"},
                         group[] = {{"edge_1", "of a mesh file"}, {"edge_2", "of a mesh file"},
                                    {"edge_3", "of a mesh file"}, {"edge_4", "of a mesh file"},
                                    {"edge_5", "of a mesh file"}, {"edge_6", "of a mesh file"},
                                    {"edge_7", "of a mesh file"}, {"edge_8", "of a mesh file"}};
const fracas_kind *const fracas_load_edges[FRACAS_LOAD_EDGES] = {
    &left,     &right,    &bottom,   &top,      &inner,    &outer,    &group[0],
    &group[1], &group[2], &group[3], &group[4], &group[5], &group[6], &group[7]};

bool fracas_load_has_front(const fracas_loading *loading)
{
    return fabs(loading->front) > 0; /* NaN: no */
}

/* (loads.9) */
double fracas_load_spot(const fracas_loading *loading, const double x[3])
{
    if (!(loading->spot > 0)) return 1; /* NaN, or 0 of a load without these keys */
    double squares = 0;
    for (int i = 0; i < 3; i++) {
        const double at = isnan(loading->spot_at[i]) ? 0 : loading->spot_at[i];
        squares += (x[i] - at) * (x[i] - at);
    }
    const double beyond = sqrt(squares) - loading->spot;
    if (beyond <= 0) return 1;
    return loading->spot_decay > 0 ? fracas_exp(-beyond / loading->spot_decay) : 0;
}

/* FRACAS_USAGE unless the keys of the spot go together. */
FRACAS_MUST_USE static fracas_err check_spot(const fracas_loading *loading)
{
    const struct {
        const char *key;
        double value;
    } of_spot[] = {{"spot_decay", loading->spot_decay},
                   {"spot_x", loading->spot_at[0]},
                   {"spot_y", loading->spot_at[1]},
                   {"spot_z", loading->spot_at[2]}};
    for (size_t k = 0; !(loading->spot > 0) && k < FRACAS_COUNT(of_spot); k++)
        if (fabs(of_spot[k].value) > 0)
            return fracas_fail(FRACAS_USAGE,
                               "%s is given, but no spot: give its radius, `spot: 5 mm`, or "
                               "leave %s out",
                               of_spot[k].key, of_spot[k].key);
    return FRACAS_OK;
}

/* (loads.2) */
fracas_load_clock fracas_load_clock_at(const fracas_loading *loading, const double x[3])
{
    fracas_load_clock clock = {0, loading->decay > 0 ? loading->decay : INFINITY};
    if (!fracas_load_has_front(loading)) return clock;
    const front_axis *axis =
        (loading->front_along ? loading->front_along : &fracas_front_x)->traits;
    const double place = x[axis->component], at = isnan(loading->front_at) ? 0 : loading->front_at,
                 travel = (place - loading->front_from) / loading->front; /* NaN: from far away */
    clock.arrival = travel < 0 ? INFINITY : (place - at) / loading->front;
    if (loading->decay_by_travel > 0) clock.decay = loading->decay_by_travel * travel;
    return clock;
}

fracas_err fracas_load_history(const fracas_loading *loading, fracas_profile *history)
{
    static const fracas_profile_form form = {"time", "s", "factor", .positive = false};
    *history = (fracas_profile){0};
    return loading->history ? fracas_profile_read(loading->history, &form, history) : FRACAS_OK;
}

/* (loads.2) */
double fracas_load_amplitude(const fracas_loading *loading, const fracas_profile *history,
                             const fracas_load_clock *clock, double t)
{
    const double since = t - clock->arrival;
    if (since < 0) return 0;
    double amplitude = loading->rise > 0 ? fmin(1, since / loading->rise) : 1;
    if (loading->duration > 0) amplitude *= 1 - since / loading->duration;
    if (history->count > 0) amplitude = fracas_profile_at(history, since);
    if (clock->decay < INFINITY)
        amplitude *= clock->decay > 0 ? fracas_exp(-since / clock->decay) : 0;
    return amplitude;
}

/* Beyond its duration the load is negative, and grows unless it decays. */
double fracas_load_largest(const fracas_loading *loading, double t)
{
    FRACAS_CLEARED(fracas_profile) history = {0};
    if (loading->history && !fracas_load_history(loading, &history)) {
        double largest = 0;
        for (size_t p = 0; p < history.count; p++)
            largest = fmax(largest, fabs(history.place[p].value));
        return largest;
    }
    if (!(loading->duration > 0)) return 1;
    return fracas_load_has_front(loading) ? INFINITY : fmax(1, t / loading->duration - 1);
}

fracas_stretch fracas_load_unbounded(const fracas_spec *spec, const fracas_loading *loading,
                                     double t)
{
    (void)spec, (void)loading, (void)t;
    return (fracas_stretch){.strain = INFINITY, .ratio = 1, .ratio_z = NAN};
}

fracas_err fracas_load_check(const fracas_loading *loading)
{
    const bool front = !isnan(loading->front);
    TRY(check_spot(loading));
    if (front && loading->front == 0)
        return fracas_fail(FRACAS_USAGE, "front is 0 m/s: it would never arrive: give its speed, "
                                         "or leave front out for a load that acts everywhere");
    const struct {
        const char *key;
        bool given;
    } of_front[] = {{"front_at", !isnan(loading->front_at)},
                    {"front_from", !isnan(loading->front_from)},
                    {"decay_by_travel", !isnan(loading->decay_by_travel)}};
    for (size_t k = 0; !front && k < FRACAS_COUNT(of_front); k++)
        if (of_front[k].given)
            return fracas_fail(FRACAS_USAGE,
                               "%s is given, but no front: give the speed of the front, `front: "
                               "2000 m/s`, or leave %s out",
                               of_front[k].key, of_front[k].key);
    if (!isnan(loading->decay_by_travel) && isnan(loading->front_from))
        return fracas_fail(FRACAS_USAGE, "decay_by_travel is given, but not front_from, from where "
                                         "the front has travelled: give its coordinate");
    if (loading->history && !(isnan(loading->rise) && isnan(loading->duration)))
        return fracas_fail(FRACAS_USAGE,
                           "history and %s are both given: %s says how the load changes: leave the "
                           "other out",
                           isnan(loading->rise) ? "duration" : "rise", loading->history->path);
    FRACAS_CLEARED(fracas_profile) history = {0};
    TRY(fracas_load_history(loading, &history));
    if (!isnan(loading->decay) && !isnan(loading->decay_by_travel))
        return fracas_fail(FRACAS_USAGE, "decay and decay_by_travel are both given: the load "
                                         "decays by one of them: leave the other out");
    return FRACAS_OK;
}
