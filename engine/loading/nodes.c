/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/loading/nodes.h"

#include "engine/loading/region.h"

#include <math.h>

enum {
    FROM = FRACAS_NODES_FROM,
    TO = FRACAS_NODES_TO,
    AT = FRACAS_NODES_AT,
    WITHIN = FRACAS_NODES_WITHIN
};

const char *fracas_nodes_edge(const fracas_loading *loading, int i)
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

double fracas_nodes_beside(const fracas_loading *loading, int dimension, const double x[3])
{
    const fracas_region region = region_of(loading, dimension);
    return loading->edge || fracas_region_has(&region, x) ? 0 : fracas_region_beside(&region, x);
}

bool fracas_nodes_limited(const fracas_loading *loading, int dimension)
{
    bool limited = false;
    for (int i = 0; i < dimension; i++)
        limited = limited || !isnan(loading->own[FROM + i]) || !isnan(loading->own[TO + i]);
    return limited;
}

bool fracas_nodes_middle(const fracas_loading *loading)
{
    bool middle = false;
    for (int i = 0; i < 3; i++) middle = middle || fabs(loading->own[AT + i]) > 0;
    return middle;
}

fracas_err fracas_nodes_check(const fracas_loading *loading)
{
    static const char axis[] = "xyz";
    const double *own = loading->own;
    for (int i = 0; i < 3; i++)
        if (own[TO + i] < own[FROM + i])
            return fracas_fail(FRACAS_USAGE,
                               "to_%c is %g m, below from_%c, %g m: no node is between them",
                               axis[i], own[TO + i], axis[i], own[FROM + i]);
    /* without z in the model, its keys are 0 */
    if (loading->edge && (fracas_nodes_limited(loading, 2) || own[WITHIN] > 0 ||
                          fabs(own[FROM + 2]) > 0 || fabs(own[TO + 2]) > 0))
        return fracas_fail(FRACAS_USAGE, "%s has both limits and the edges %s: leave one out",
                           loading->type->name, loading->edge->name);
    return FRACAS_OK;
}
