/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `traction`: on the face of an edge, by its area at the start. */
#include "engine/loading/load.h"

#define STRESS(key, member, what, models) \
    FRACAS_LOAD_NUMBER(key, member, "Pa", what ", times its amplitude", models)

static const fracas_param params[] = {
    {FRACAS_LOAD_EDGE("edge", edge, "edge on which it acts"), .fallback = FRACAS_REQUIRED},
    STRESS("normal", own[0], "stress outward in the surface, that pulls", 0),
    STRESS("shear", own[1], "stress along the edge, the body on its left", 0),
    STRESS("across", own[2], "stress along the normal of the mid-surface", FRACAS_GROUP_SHELL),
    FRACAS_LOAD_SPOT,
    FRACAS_LOAD_AMPLITUDE,
};

static void density(const fracas_spec *spec, const fracas_loading *loading, const fracas_place *at,
                    double density[3])
{
    const double *stress = loading->own;
    for (int i = 0; i < 3; i++)
        density[i] = spec->geometry.thickness *
                     (stress[0] * at->outward[i] + stress[1] * at->along[i] +
                      stress[2] * at->normal[i]);
}

static const char *edge_of(const fracas_loading *loading, int i)
{
    return i == 0 && loading->edge ? loading->edge->name : NULL;
}

static const fracas_load load = {.on = FRACAS_LOAD_ON_EDGE, .density = density, .edge = edge_of};

/* Waves reflect, and held bodies bend: no bound is known. */
const fracas_kind fracas_loading_traction = {
    "traction", "a stress on one edge of a body at rest", FRACAS_PARAMS(params),
    .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){
        .surface = fracas_load_unbounded, .load = &load, .check = fracas_load_check}};
