/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `node-motion`: the nodes of a part of a body rest, or move as prescribed. */
#include "engine/loading/motion.h"
#include "engine/loading/region.h"

#include <math.h>

enum { FROM, TO = 3, AT = 6, WITHIN = 9 }; /* own: FROM, TO, AT: x, y, z */

static const fracas_kind only_along = {"along", "that component alone"},
                         every = {"all", "all components: the others rest"};
static const fracas_kind *const extents[] = {&only_along, &every},
                                *const plane_axes[] = {&fracas_front_x, &fracas_front_y},
                                *const axes[] = {&fracas_front_x, &fracas_front_y, &fracas_front_z};

#define DIRECTION(kinds, models)                                                         \
    FRACAS_BRACES(FRACAS_ONE_OF("direction", kinds, offsetof(fracas_loading, direction), \
                                "component that is prescribed"),                         \
                  .only = models)
#define PLACE(key, place, models, what)                                                   \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = "m", .doc = what,             \
                  .fallback = FRACAS_REQUIRED, .minimum = -INFINITY, .maximum = INFINITY, \
                  .offset = offsetof(fracas_loading, place), .only = models, .optional = true)
#define SHELL FRACAS_GROUP_SHELL

static const fracas_param params[] = {
    PLACE("from_x", own[FROM], 0, "nodes with a smaller x are free"),
    PLACE("to_x", own[TO], 0, "nodes with a larger x are free"),
    PLACE("from_y", own[FROM + 1], 0, "nodes with a smaller y are free"),
    PLACE("to_y", own[TO + 1], 0, "nodes with a larger y are free"),
    PLACE("from_z", own[FROM + 2], SHELL, "nodes with a smaller z are free"),
    PLACE("to_z", own[TO + 2], SHELL, "nodes with a larger z are free"),
    FRACAS_LOAD_LENGTH("within", own[WITHIN], "nodes farther from at_x, at_y, at_z are free"),
    PLACE("at_x", own[AT], 0, "x of the middle of `within`; none is 0"),
    PLACE("at_y", own[AT + 1], 0, "y of this middle; none is 0"),
    PLACE("at_z", own[AT + 2], SHELL, "z of this middle; none is 0"),
    {FRACAS_LOAD_EDGE("edge", edge,
                      "nodes on these edges, inside the body too, in place of limits"),
     .optional = true},
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

static const char *edge_of(const fracas_loading *loading, int i)
{
    return i == 0 && loading->edge ? loading->edge->name : NULL;
}

/* A model without z has 0 for its keys. */
static fracas_region region_of(const fracas_loading *loading, int dimension)
{
    const double *own = loading->own;
    fracas_region region = {.within = own[WITHIN]};
    for (int i = 0; i < 3; i++) {
        region.from[i] = i < dimension ? own[FROM + i] : NAN;
        region.to[i] = i < dimension ? own[TO + i] : NAN;
        region.at[i] = isnan(own[AT + i]) ? 0 : own[AT + i];
    }
    return region;
}

static bool rests(const fracas_loading *loading)
{
    return !(fabs(loading->displacement) > 0) && !(fabs(loading->velocity) > 0);
}

static double beside(const fracas_loading *loading, int dimension, const double x[3])
{
    const fracas_region region = region_of(loading, dimension);
    return loading->edge || fracas_region_has(&region, x) ? 0 : fracas_region_beside(&region, x);
}

static unsigned components(const fracas_loading *loading, int dimension)
{
    unsigned along = 0;
    for (int i = 0; i < dimension; i++) along |= (loading->direction == axes[i]) * (1u << i);
    return loading->own_choice == &every ? (1u << dimension) - 1 : along;
}

/* Without z in the model, its keys are 0. */
static fracas_err check_region(const fracas_loading *loading)
{
    static const char axis[] = "xyz";
    const double *own = loading->own;
    bool limited = own[WITHIN] > 0, middle = false;
    for (int i = 0; i < 3; i++) {
        limited = limited || fabs(own[FROM + i]) >= (i == 2 ? 0x1p-1000 : 0) ||
                  fabs(own[TO + i]) >= (i == 2 ? 0x1p-1000 : 0);
        middle = middle || fabs(own[AT + i]) > 0;
        if (own[TO + i] < own[FROM + i])
            return fracas_fail(FRACAS_USAGE,
                               "to_%c is %g m, below from_%c, %g m: no node is between them",
                               axis[i], own[TO + i], axis[i], own[FROM + i]);
    }
    if (middle && !(own[WITHIN] > 0))
        return fracas_fail(FRACAS_USAGE, "at_x, at_y or at_z is given, but no within, whose middle "
                                         "it would be");
    if (loading->edge && limited)
        return fracas_fail(FRACAS_USAGE,
                           "node-motion has both limits and the edges %s: leave one out",
                           loading->edge->name);
    return FRACAS_OK;
}

static fracas_err check(const fracas_loading *loading)
{
    TRY(check_region(loading));
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
                                 .edge = edge_of,
                                 .path = fracas_motion_path,
                                 .components = components,
                                 .beside = beside,
                                 .rests = rests};

/* Waves reflect, and a punch concentrates stress: no bound is known. */
const fracas_kind fracas_loading_node_motion = {
    "node-motion", "nodes of a part of a body at rest move as prescribed, or rest: a support",
    FRACAS_PARAMS(params), .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){
        .surface = fracas_load_unbounded, .load = &load, .check = check}};
