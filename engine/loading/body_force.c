/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `body-force`: on every unit of mass. */
#include "engine/loading/load.h"

#define COMPONENT(key, i, models)           \
    FRACAS_LOAD_NUMBER(key, own[i], "m/s2", \
                       "force along " key " on a unit of mass, times its amplitude", models)

static const fracas_param params[] = {
    COMPONENT("x", 0, 0), COMPONENT("y", 1, 0),  COMPONENT("z", 2, FRACAS_GROUP_SHELL),
    FRACAS_LOAD_SPOT,     FRACAS_LOAD_AMPLITUDE,
};

static void density(const fracas_spec *spec, const fracas_loading *loading, const fracas_place *at,
                    double density[3])
{
    (void)spec, (void)at;
    for (int i = 0; i < 3; i++) density[i] = loading->own[i];
}

static const fracas_load load = {.on = FRACAS_LOAD_ON_MASS, .density = density};

/* Waves reflect, and held bodies bend: no bound is known. */
const fracas_kind fracas_loading_body_force = {
    "body-force", "a force on every unit of mass of a body at rest", FRACAS_PARAMS(params),
    .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){
        .surface = fracas_load_unbounded, .load = &load, .check = fracas_load_check}};
