/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The path s(t) of loads that move nodes, with its keys (docs/theory/loads.md).
 */
#ifndef FRACAS_ENGINE_LOADING_MOTION_H
#define FRACAS_ENGINE_LOADING_MOTION_H

#include "engine/loading/load.h"

enum { FRACAS_MOTION_RISES = 2 };
extern const fracas_kind *const fracas_motion_rises[FRACAS_MOTION_RISES]; /* smooth, linear */

/* s(t) [m] of the keys below, s(0) = 0  (loads.6) */
double fracas_motion_path(const fracas_loading *loading, const fracas_profile *history, double t);

/* FRACAS_USAGE where history and rise are both given, or a displacement would jump. */
FRACAS_MUST_USE fracas_err fracas_motion_check(const fracas_loading *loading);

#define FRACAS_MOTION_LARGEST(key, member, measure, what)                         \
    FRACAS_BRACES(key, FRACAS_REAL, measure, what, 0, -INFINITY, INFINITY, false, \
                  offsetof(fracas_loading, member))
#define FRACAS_MOTION_PATH                                                                \
    FRACAS_MOTION_LARGEST("displacement", displacement, "m",                              \
                          "displacement once it has risen; or give velocity"),            \
        FRACAS_MOTION_LARGEST("velocity", velocity, "m/s",                                \
                              "velocity once it has risen; or give displacement"),        \
        FRACAS_LOAD_TIME("rise", rise, "time in which it rises from 0, as rise_by says"), \
        {FRACAS_ONE_OF("rise_by", fracas_motion_rises, offsetof(fracas_loading, rise_by), \
                       "how it rises")},                                                  \
        FRACAS_LOAD_HISTORY("rise")

#endif
