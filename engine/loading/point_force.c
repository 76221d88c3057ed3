/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `point-force`: at a point, on the nodes of a part of a body, or on edges. */
#include "engine/loading/nodes.h"

#include <math.h>

enum { FORCE = FRACAS_NODES_OWN, ACROSS = FORCE + 3 }; /* own: FORCE: x, y, z */

#define TOTAL(key, place, what, models)                                                         \
    FRACAS_LOAD_NUMBER(key, place, "N", what " of all its nodes together, times its amplitude", \
                       models)
#define SHELL FRACAS_GROUP_SHELL

static const fracas_param params[] = {
    FRACAS_NODES_KEYS("have none of it", "the point, or of the middle of `within`"),
    TOTAL("total_x", own[FORCE], "force along x", 0),
    TOTAL("total_y", own[FORCE + 1], "force along y", 0),
    TOTAL("total_z", own[FORCE + 2], "force along z", SHELL),
    TOTAL("total_across", own[ACROSS], "force along the normal of the mid-surface", SHELL),
    FRACAS_LOAD_AMPLITUDE,
};

/* The whole force, as a node has its direction. */
static void density(const fracas_spec *spec, const fracas_loading *loading, const fracas_place *at,
                    double density[3])
{
    (void)spec;
    fracas_load_vector(loading, FORCE, at, density);
}

/* Without limits along an axis; a ball may be smaller than an element. */
static bool middle_of(const fracas_loading *loading, int dimension, double at[3])
{
    const double *own = loading->own + FRACAS_NODES_AT;
    for (int i = 0; at && i < 3; i++) at[i] = isnan(own[i]) ? 0 : own[i];
    return !loading->edge && !fracas_nodes_limited(loading, dimension);
}

static double beside(const fracas_loading *loading, int dimension, const double x[3])
{
    const bool point = middle_of(loading, dimension, NULL) &&
                       !(loading->own[FRACAS_NODES_WITHIN] > 0);
    return point ? INFINITY : fracas_nodes_beside(loading, dimension, x);
}

static fracas_err check(const fracas_loading *loading)
{
    TRY(fracas_nodes_check(loading));
    if (loading->edge && fracas_nodes_middle(loading))
        return fracas_fail(FRACAS_USAGE, "%s has both a point and the edges %s: leave one out",
                           loading->type->name, loading->edge->name);
    if (fracas_nodes_middle(loading) && fracas_nodes_limited(loading, 2) &&
        !(loading->own[FRACAS_NODES_WITHIN] > 0))
        return fracas_fail(FRACAS_USAGE, "point-force has both limits and a point, without within: "
                                         "leave one out");
    return fracas_load_check(loading);
}

static const fracas_load load = {.on = FRACAS_LOAD_ON_NODES,
                                 .density = density,
                                 .edge = fracas_nodes_edge,
                                 .beside = beside,
                                 .middle = middle_of};

/* Waves reflect, and a point concentrates stress: no bound is known. */
const fracas_kind fracas_loading_point_force = {
    "point-force", "a force at a point of a body at rest, or on the nodes of a part of it",
    FRACAS_PARAMS(params), .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){
        .surface = fracas_load_unbounded, .load = &load, .check = check}};
