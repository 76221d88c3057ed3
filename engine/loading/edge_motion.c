/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `edge-motion`: one or two edges have a prescribed displacement or velocity. */
#include "engine/loading/motion.h"

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

#define DIRECTION(kinds, models)                                                         \
    FRACAS_BRACES(FRACAS_ONE_OF("direction", kinds, offsetof(fracas_loading, direction), \
                                "in which it moves"),                                    \
                  .only = models)

static const fracas_param params[] = {
    {FRACAS_LOAD_EDGE("edge", edge,
                      "edge that moves as far as `geometry` holds it, a free one whole"),
     .fallback = FRACAS_REQUIRED},
    {FRACAS_LOAD_EDGE("second_edge", second_edge,
                      "another one, which moves as much in its own direction"),
     .optional = true},
    DIRECTION(plane_directions, FRACAS_GROUP_MEMBRANE),
    DIRECTION(directions, FRACAS_GROUP_SHELL),
    FRACAS_MOTION_PATH,
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
    return fracas_motion_check(loading);
}

static const fracas_load load = {.on = FRACAS_LOAD_ON_EDGE,
                                 .density = direction_at,
                                 .edge = edge_of,
                                 .path = fracas_motion_path};

/* Waves reflect, and corners of held edges concentrate stress: no bound is known. */
const fracas_kind fracas_loading_edge_motion = {
    "edge-motion", "one or two edges of a body at rest move as prescribed", FRACAS_PARAMS(params),
    .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){
        .surface = fracas_load_unbounded, .load = &load, .check = check}};
