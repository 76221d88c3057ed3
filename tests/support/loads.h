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

/* The choice of this name for a key of a load; of the last table with the key. */
static inline const fracas_kind *load_choice(const fracas_kind *load, const char *key,
                                             const char *name)
{
    const fracas_kind *found = NULL;
    for (size_t p = 0; p < load->nparams; p++)
        for (size_t c = 0; strcmp(load->params[p].name, key) == 0 && c < load->params[p].nchoices;
             c++)
            if (strcmp(load->params[p].choices[c]->name, name) == 0)
                found = load->params[p].choices[c];
    assert_non_null(found);
    return found;
}
static inline const fracas_kind *motion_choice(const char *key, const char *name)
{
    return load_choice(&fracas_loading_edge_motion, key, name);
}

/* Place of a load's number of this key. */
static inline size_t load_place(const fracas_loading *loading, const char *key)
{
    for (size_t p = 0; p < loading->type->nparams; p++)
        if (strcmp(loading->type->params[p].name, key) == 0)
            return loading->type->params[p].offset / sizeof(double);
    fail_msg("%s has no %s", loading->type->name, key);
    return 0;
}

static inline double *load_number(fracas_loading *loading, const char *key)
{
    return (double *)(void *)loading + load_place(loading, key);
}

static inline double load_value(const fracas_loading *loading, const char *key)
{
    return *((const double *)(const void *)loading + load_place(loading, key));
}

#endif
