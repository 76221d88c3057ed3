/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sets of nodes of loads on them: within limits, in a ball, or on the edges of a group. Their
 * numbers are the first of own[]. */
#ifndef FRACAS_ENGINE_LOADING_NODES_H
#define FRACAS_ENGINE_LOADING_NODES_H

#include "engine/loading/load.h"

enum {
    FRACAS_NODES_FROM, /* own: FROM, TO, AT: x, y, z */
    FRACAS_NODES_TO = 3,
    FRACAS_NODES_AT = 6,
    FRACAS_NODES_WITHIN = 9,
    FRACAS_NODES_OWN /* a load's own from here on */
};

#define FRACAS_NODES_PLACE(key, place, models, what)                                      \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = "m", .doc = what,             \
                  .fallback = FRACAS_REQUIRED, .minimum = -INFINITY, .maximum = INFINITY, \
                  .offset = offsetof(fracas_loading, own[place]), .only = models,         \
                  .optional = true)
/* The keys. Nodes beside the set `beyond`: "are free". The place at_x, at_y, at_z is `middle`. */
#define FRACAS_NODES_KEYS(beyond, middle)                                                          \
    FRACAS_NODES_PLACE("from_x", FRACAS_NODES_FROM, 0, "nodes with a smaller x " beyond),          \
        FRACAS_NODES_PLACE("to_x", FRACAS_NODES_TO, 0, "nodes with a larger x " beyond),           \
        FRACAS_NODES_PLACE("from_y", FRACAS_NODES_FROM + 1, 0, "nodes with a smaller y " beyond),  \
        FRACAS_NODES_PLACE("to_y", FRACAS_NODES_TO + 1, 0, "nodes with a larger y " beyond),       \
        FRACAS_NODES_PLACE("from_z", FRACAS_NODES_FROM + 2, FRACAS_GROUP_SHELL,                    \
                           "nodes with a smaller z " beyond),                                      \
        FRACAS_NODES_PLACE("to_z", FRACAS_NODES_TO + 2, FRACAS_GROUP_SHELL,                        \
                           "nodes with a larger z " beyond),                                       \
        FRACAS_LOAD_LENGTH("within", own[FRACAS_NODES_WITHIN],                                     \
                           "nodes farther from at_x, at_y, at_z " beyond),                         \
        FRACAS_NODES_PLACE("at_x", FRACAS_NODES_AT, 0, "x of " middle "; none is 0"),              \
        FRACAS_NODES_PLACE("at_y", FRACAS_NODES_AT + 1, 0, "y of it; none is 0"),                  \
        FRACAS_NODES_PLACE("at_z", FRACAS_NODES_AT + 2, FRACAS_GROUP_SHELL, "z of it; none is 0"), \
    {                                                                                              \
        FRACAS_LOAD_EDGE("edge", edge,                                                             \
                         "nodes on these edges, inside the body too, in place of limits"),         \
            .optional = true                                                                       \
    }

/* Traits of the load: `edge` and `beside`. */
const char *fracas_nodes_edge(const fracas_loading *loading, int i);
double fracas_nodes_beside(const fracas_loading *loading, int dimension, const double x[3]);

/* Limits along an axis are given. */
bool fracas_nodes_limited(const fracas_loading *loading, int dimension);
/* at_x, at_y or at_z is not 0. */
bool fracas_nodes_middle(const fracas_loading *loading);

/* FRACAS_USAGE where no node is between limits, and for both limits and edges. */
FRACAS_MUST_USE fracas_err fracas_nodes_check(const fracas_loading *loading);

#endif
