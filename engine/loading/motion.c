/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/loading/motion.h"

#include <math.h>

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
const fracas_kind *const fracas_motion_rises[FRACAS_MOTION_RISES] = {&smooth, &linear};

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
double fracas_motion_path(const fracas_loading *loading, const fracas_profile *history, double t)
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
        return fracas_fail(FRACAS_USAGE, "displacement is given, but neither rise nor history: it "
                                         "would jump: say in which time it gets there, for "
                                         "instance `rise: 20 us`");
    if (history->count == 0) return FRACAS_OK;
    const double first = fracas_profile_at(history, 0);
    if (first != 0)
        return fracas_fail(FRACAS_USAGE,
                           "%s says %g at 0 s, and it would jump there: let its displacement "
                           "begin with 0,0, or give velocity",
                           loading->history->path, first);
    for (size_t p = 1; p < history->count; p++)
        if (history->place[p].at == history->place[p - 1].at)
            return fracas_fail(FRACAS_USAGE,
                               "%s has two factors at %g s, and it would jump there: let its "
                               "displacement take some time, or give velocity",
                               loading->history->path, history->place[p].at);
    return FRACAS_OK;
}

fracas_err fracas_motion_check(const fracas_loading *loading)
{
    if (loading->history && !isnan(loading->rise))
        return fracas_fail(FRACAS_USAGE,
                           "history and rise are both given: %s says how it moves: leave rise out",
                           loading->history->path);
    FRACAS_CLEARED(fracas_profile) history = {0};
    TRY(fracas_load_history(loading, &history));
    return fabs(loading->displacement) > 0 ? check_displacement(loading, &history) : FRACAS_OK;
}
