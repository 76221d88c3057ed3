/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loads on surfaces as a campaign file gives them. */
#ifndef FRACAS_TESTS_SUPPORT_LOADS_H
#define FRACAS_TESTS_SUPPORT_LOADS_H

#include "engine/loading/load.h"
#include "tests/support/test.h"

#include <math.h>
#include <string.h>

/* A load none of whose optional keys is given. */
static inline fracas_loading bare_load(const fracas_kind *type)
{
    return (fracas_loading){.type = type,
                            .rise = NAN,
                            .decay = NAN,
                            .duration = NAN,
                            .front = NAN,
                            .front_at = NAN,
                            .front_from = NAN,
                            .decay_by_travel = NAN,
                            .spot = NAN,
                            .spot_decay = NAN,
                            .spot_at = {NAN, NAN, NAN}};
}

/* The choice of this name for a key of edge-motion; of the last table with the key. */
static inline const fracas_kind *motion_choice(const char *key, const char *name)
{
    const fracas_kind *load = &fracas_loading_edge_motion, *found = NULL;
    for (size_t p = 0; p < load->nparams; p++)
        for (size_t c = 0; strcmp(load->params[p].name, key) == 0 && c < load->params[p].nchoices;
             c++)
            if (strcmp(load->params[p].choices[c]->name, name) == 0)
                found = load->params[p].choices[c];
    assert_non_null(found);
    return found;
}

#endif
