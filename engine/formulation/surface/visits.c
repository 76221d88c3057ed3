/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/visits.h"

#include "base/own.h"

void fracas_surface_visits_clear(fracas_surface_visits *v)
{
    free(v->join_from);
    free(v->join);
    free(v->finish_from);
    free(v->finish);
    *v = (fracas_surface_visits){0};
}

/* Interfaces by their second element: a counting sort. */
static void fill_join(fracas_surface_visits *v, const fracas_surface *surface)
{
    const size_t n = surface->nelements, m = surface->ninterfaces;
    for (size_t i = 0; i < m; i++) v->join_from[surface->interface[i].element[1] + 2]++;
    for (size_t e = 0; e < n; e++) v->join_from[e + 1] += v->join_from[e];
    for (size_t i = 0; i < m; i++)
        v->join[v->join_from[surface->interface[i].element[1] + 1]++] = (uint32_t)i;
}

/* Elements by the last of their neighbours, likewise; `last` and `next` are room for one number an
 * element. */
static void fill_finish(fracas_surface_visits *v, const fracas_surface *surface, uint32_t *last,
                        uint32_t *next)
{
    const size_t n = surface->nelements;
    for (size_t e = 0; e < n; e++) last[e] = (uint32_t)e;
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        const uint32_t *pair = surface->interface[i].element;
        if (pair[1] > last[pair[0]]) last[pair[0]] = pair[1];
    }
    for (size_t e = 0; e < n; e++) {
        v->finish_from[last[e] + 1]++;
        while (last[e] - e > v->window) v->window = 2 * v->window + 1;
    }
    for (size_t e = 0; e < n; e++) v->finish_from[e + 1] += v->finish_from[e];
    for (size_t e = 0; e < n; e++) next[e] = v->finish_from[e];
    for (size_t e = 0; e < n; e++) v->finish[next[last[e]]++] = (uint32_t)e;
}

fracas_err fracas_surface_visits_init(fracas_surface_visits *v, const fracas_surface *surface)
{
    const size_t n = surface->nelements, m = surface->ninterfaces;
    *v = (fracas_surface_visits){.join_from = calloc(n + 2, sizeof *v->join_from),
                                 .join = malloc((m ? m : 1) * sizeof *v->join),
                                 .finish_from = calloc(n + 2, sizeof *v->finish_from),
                                 .finish = malloc(n * sizeof *v->finish)};
    OWNED uint32_t *last = malloc(n * sizeof *last);
    OWNED uint32_t *next = malloc(n * sizeof *next);
    if (!v->join_from || !v->join || !v->finish_from || !v->finish || !last || !next)
        return fracas_no_memory("the order of a mesh");
    fill_join(v, surface);
    fill_finish(v, surface, last, next);
    return FRACAS_OK;
}
