/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `node-motion`: the nodes of a part of a body rest, or move as prescribed. */
#include "engine/loading/motion.h"
#include "engine/loading/nodes.h"

#include <math.h>

static const fracas_kind only_along = {"along", "that component alone"},
                         every = {"all", "all components: the others rest"};
static const fracas_kind *const extents[] = {&only_along, &every},
                                *const plane_axes[] = {&fracas_front_x, &fracas_front_y},
                                *const axes[] = {&fracas_front_x, &fracas_front_y, &fracas_front_z};

#define DIRECTION(kinds, models)                                                         \
    FRACAS_BRACES(FRACAS_ONE_OF("direction", kinds, offsetof(fracas_loading, direction), \
                                "component that is prescribed"),                         \
                  .only = models)
#define SHELL FRACAS_GROUP_SHELL

static const fracas_param params[] = {
    FRACAS_NODES_KEYS("are free", "the middle of `within`"),
    DIRECTION(plane_axes, FRACAS_GROUP_MEMBRANE),
    DIRECTION(axes, SHELL),
    {FRACAS_ONE_OF("holds", extents, offsetof(fracas_loading, own_choice),
                   "what is prescribed of these nodes")},
    FRACAS_MOTION_PATH,
};

/* Along an axis. */
static void direction_at(const fracas_spec *spec, const fracas_loading *loading,
                         const fracas_place *at, double direction[3])
{
    (void)spec, (void)at;
    for (int i = 0; i < 3; i++) direction[i] = loading->direction == axes[i];
}

static bool rests(const fracas_loading *loading)
{
    return !(fabs(loading->displacement) > 0) && !(fabs(loading->velocity) > 0);
}

static unsigned components(const fracas_loading *loading, int dimension)
{
    unsigned along = 0;
    for (int i = 0; i < dimension; i++) along |= (loading->direction == axes[i]) * (1u << i);
    return loading->own_choice == &every ? (1u << dimension) - 1 : along;
}

static fracas_err check(const fracas_loading *loading)
{
    TRY(fracas_nodes_check(loading));
    if (fracas_nodes_middle(loading) && !(loading->own[FRACAS_NODES_WITHIN] > 0))
        return fracas_fail(FRACAS_USAGE, "at_x, at_y or at_z is given, but no within, whose middle "
                                         "it would be");
    if (rests(loading) && (loading->rise > 0 || loading->history))
        return fracas_fail(FRACAS_USAGE,
                           "node-motion has %s, but neither displacement nor velocity, whose %s it "
                           "would be: its nodes rest: give one, or leave it out",
                           loading->history ? "history" : "rise",
                           loading->history ? "factor" : "rise");
    if (rests(loading)) return FRACAS_OK;
    const double given[2] = {loading->displacement, loading->velocity};
    TRY(fracas_param_check_either("node-motion takes",
                                  (const char *const[]){"displacement", "velocity"}, given,
                                  "displacement: 2 um"));
    return fracas_motion_check(loading);
}

static const fracas_load load = {.on = FRACAS_LOAD_ON_NODES,
                                 .density = direction_at,
                                 .edge = fracas_nodes_edge,
                                 .path = fracas_motion_path,
                                 .components = components,
                                 .beside = fracas_nodes_beside,
                                 .rests = rests};

/* Waves reflect, and a punch concentrates stress: no bound is known. */
const fracas_kind fracas_loading_node_motion = {
    "node-motion", "nodes of a part of a body at rest move as prescribed, or rest: a support",
    FRACAS_PARAMS(params), .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){
        .surface = fracas_load_unbounded, .load = &load, .check = check}};
