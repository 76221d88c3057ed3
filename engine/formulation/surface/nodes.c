/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sets of nodes of a surface, which a load pushes, or holds at rest or along its path
 * (docs/theory/loads.md). */
#include "engine/formulation/surface/loads.h"

#include "base/own.h"

#include <math.h>
#include <stdlib.h>

/* A motion of nodes. */
static const fracas_load *nodes_of(const fracas_model *model, int n)
{
    const fracas_load *load = fracas_loading_load(&model->spec, n);
    return load && load->on == FRACAS_LOAD_ON_NODES && load->path ? load : NULL;
}

int fracas_surface_node_sets(const fracas_model *model, int number[FRACAS_LOADINGS])
{
    int sets = 0;
    for (int n = 0; n < FRACAS_LOADINGS; n++)
        if (nodes_of(model, n)) number[sets++] = n;
    return sets;
}

/* A load, its nodes, and how near the nearest one came. */
typedef struct {
    const fracas_model *model;
    const fracas_loading *loading;
    const fracas_load *load;
    const char *section;
    bool *on;       /* [node of the mesh] */
    double nearest; /* m */
    uint32_t node;  /* the nearest one */
} node_set;

static void mark_edge(node_set *set, uint32_t element, uint32_t edge)
{
    const fracas_surface *surface = set->model->surface;
    const uint32_t node[3] = {edge, (edge + 1) % 3, 3 + edge};
    for (int n = 0; n < surface->order + 1; n++)
        set->on[surface->element[element * surface->corners + node[n]]] = true;
}

static fracas_err mark_edges(node_set *set, int n)
{
    const fracas_surface *surface = set->model->surface;
    int32_t tag;
    TRY(fracas_surface_load_tag(set->model, n, 0, &tag));
    for (size_t b = 0; b < surface->nborders; b++)
        if (surface->border[b].tag == tag)
            mark_edge(set, surface->border[b].element, surface->border[b].edge);
    for (size_t i = 0; i < surface->ninterfaces; i++)
        if (surface->interface[i].tag == tag)
            mark_edge(set, surface->interface[i].element[0], surface->interface[i].edge[0]);
    return FRACAS_OK;
}

static fracas_err mark_limits(node_set *set, int dimension)
{
    const fracas_surface *surface = set->model->surface;
    set->nearest = INFINITY;
    for (uint32_t k = 0; k < surface->nnodes; k++) {
        const double beside = set->load->beside(set->loading, dimension, surface->node[k]);
        set->on[k] = beside == 0;
        if (beside >= set->nearest) continue;
        set->nearest = beside;
        set->node = k;
    }
    if (set->nearest == 0) return FRACAS_OK;
    if (set->load->middle && set->load->middle(set->loading, dimension, NULL)) return FRACAS_OK;
    const double *x = surface->node[set->node];
    return fracas_fail(FRACAS_USAGE,
                       "%s %s has no node: the nearest, at (%.6g, %.6g, %.6g) m, lies %.3g m "
                       "beside its limits: widen them, or move a row of nodes there",
                       set->section, set->loading->type->name, x[0], x[1], x[2], set->nearest);
}

fracas_err fracas_surface_nodes_mark(const fracas_model *model, int n, int dimension, bool *on)
{
    node_set set = {.model = model,
                    .loading = fracas_loading_at(&model->spec, n),
                    .load = fracas_loading_load(&model->spec, n),
                    .section = fracas_loading_sections[n].name,
                    .on = on};
    return set.load->edge(set.loading, 0) ? mark_edges(&set, n) : mark_limits(&set, dimension);
}

static fracas_err taken_twice(const node_set *set, const double x[3])
{
    return fracas_fail(FRACAS_USAGE,
                       "%s %s and another one prescribe the same component of the node at (%.6g, "
                       "%.6g, %.6g) m: take it out of one of them",
                       set->section, set->loading->type->name, x[0], x[1], x[2]);
}

/* Components of an element on nodes of a set. */
static uint32_t components_of(const node_set *set, const fracas_surface_tables *t, size_t e)
{
    const fracas_surface *surface = set->model->surface;
    const int dimension = t->body->dimension;
    const uint32_t components = set->load->components(set->loading, dimension);
    uint32_t bits = 0;
    for (size_t k = 0; k < surface->corners; k++)
        if (set->on[surface->element[e * surface->corners + k]])
            bits |= components << (size_t)dimension * k;
    return bits;
}

static const double *node_of_bit(const node_set *set, const fracas_surface_tables *t, size_t e,
                                 uint32_t bits)
{
    const size_t k = (size_t)__builtin_ctz(bits) / (size_t)t->body->dimension;
    return fracas_surface_node(set->model->surface, e, k);
}

/* Holds what no edge holds; `edges` [element]: what they do. */
static fracas_err hold(const node_set *set, fracas_surface_tables *t, const uint32_t *edges,
                       uint32_t *own)
{
    const bool rests = set->load->rests(set->loading);
    bool any = false;
    for (size_t e = 0; e < t->nelements; e++) {
        own[e] = components_of(set, t, e) & ~edges[e];
        const uint32_t again = own[e] & t->held[e];
        if (again) return taken_twice(set, node_of_bit(set, t, e, again));
        t->held[e] |= own[e];
        if (rests) t->fixed[e] |= own[e];
        else t->moved[e] |= own[e];
        any = any || own[e];
    }
    if (any) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s %s holds nothing: the edges of geometry hold all that it would: free "
                       "them, or leave it out",
                       set->section, set->loading->type->name);
}

static fracas_err fill_set(const fracas_model *model, fracas_surface_tables *t, int n,
                           const uint32_t *edges, uint32_t *own)
{
    OWNED bool *on = calloc(model->surface->nnodes, sizeof *on);
    if (!on) return fracas_no_memory("the nodes that a load holds");
    node_set set = {.model = model,
                    .loading = fracas_loading_at(&model->spec, n),
                    .load = nodes_of(model, n),
                    .section = fracas_loading_sections[n].name,
                    .on = on};
    TRY(fracas_surface_nodes_mark(model, n, t->body->dimension, on));
    return hold(&set, t, edges, own);
}

fracas_err fracas_surface_nodes_fill(const fracas_model *model, fracas_surface_tables *t)
{
    int number[FRACAS_LOADINGS];
    const int sets = fracas_surface_node_sets(model, number);
    if (sets == 0) return FRACAS_OK;
    OWNED uint32_t *edges = malloc(t->nelements * sizeof *edges);
    if (!edges) return fracas_no_memory("the nodes that a load holds");
    for (size_t e = 0; e < t->nelements; e++) edges[e] = t->held[e];
    for (int s = 0; s < sets; s++)
        TRY(fill_set(model, t, number[s], edges, t->set + (size_t)s * t->nelements));
    return FRACAS_OK;
}
