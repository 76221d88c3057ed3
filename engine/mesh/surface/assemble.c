/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From arrays to a surface: neighbours found, elements and nodes put in a new order. */
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

/* Elements and nodes as given until `order` is applied. */
typedef struct {
    const fracas_surface_arrays *arrays;
    fracas_surface_side *side;
    uint32_t (*neighbour)[3];
    int32_t (*tag)[3]; /* tag of each edge of each element */
    uint32_t *order;   /* which element comes k-th */
    uint32_t *place;   /* where an element goes */
    uint32_t *node;    /* where a node goes */
} assembly;

static void assembly_clear(assembly *work)
{
    free(work->side);
    free(work->neighbour);
    free(work->tag);
    free(work->order);
    free(work->place);
    free(work->node);
}

void fracas_surface_destroy(const fracas_surface *surface)
{
    if (!surface) return;
    free((void *)surface->node);
    free((void *)surface->element);
    free((void *)surface->interface);
    free((void *)surface->border);
    free((void *)surface->given);
    free((void *)surface->group);
    free((void *)surface->area);
    free((void *)surface);
}

size_t fracas_surface_bytes(const fracas_surface *s)
{
    return s->nnodes * sizeof *s->node +
           s->nelements * (s->corners * sizeof *s->element + sizeof *s->given + sizeof *s->area) +
           s->ninterfaces * sizeof *s->interface + s->nborders * sizeof *s->border;
}

static fracas_err allocate_work(assembly *work)
{
    const size_t n = work->arrays->nelements;
    work->neighbour = malloc(n * sizeof *work->neighbour);
    work->tag = calloc(n, sizeof *work->tag);
    work->order = malloc(n * sizeof *work->order);
    work->place = malloc(n * sizeof *work->place);
    work->node = malloc(work->arrays->nnodes * sizeof *work->node);
    if (work->neighbour && work->tag && work->order && work->place && work->node) return FRACAS_OK;
    return fracas_no_memory("the order of a mesh's elements");
}

static fracas_err set_tags(assembly *work)
{
    const fracas_surface_arrays *arrays = work->arrays;
    const size_t nsides = 3 * arrays->nelements;
    for (size_t t = 0; t < arrays->ntags; t++) {
        const fracas_surface_tag *given = &arrays->tag[t];
        for (int k = 0; k < 2; k++)
            if (given->node[k] >= arrays->nnodes)
                return fracas_fail(FRACAS_USAGE,
                                   "tag %" PRId32 " is for node %" PRIu32 ", but there are %zu",
                                   given->tag, given->node[k], arrays->nnodes);
        const int64_t a = fracas_surface_node_name(arrays, given->node[0]),
                      b = fracas_surface_node_name(arrays, given->node[1]);
        const size_t first = fracas_surface_find_edge(work->side, nsides, given->node[0],
                                                      given->node[1]);
        if (first == nsides)
            return fracas_fail(FRACAS_USAGE,
                               "tag %" PRId32 " is for nodes %" PRId64 " and %" PRId64
                               ", between which no triangle has an edge",
                               given->tag, a, b);
        const int32_t before = work->tag[work->side[first].element][work->side[first].edge];
        if (before != 0 && before != given->tag)
            return fracas_fail(FRACAS_USAGE,
                               "the edge between nodes %" PRId64 " and %" PRId64
                               " has the tags %" PRId32 " and %" PRId32 ": one is the most",
                               a, b, before, given->tag);
        for (size_t i = first; i < fracas_surface_next_edge(work->side, first, nsides); i++)
            work->tag[work->side[i].element][work->side[i].edge] = given->tag;
    }
    return FRACAS_OK;
}

static void set_neighbours(assembly *work)
{
    const size_t nsides = 3 * work->arrays->nelements;
    for (size_t i = 0; i < nsides; i++)
        work->neighbour[work->side[i].element][work->side[i].edge] = NONE;
    for (size_t i = 0; i + 1 < nsides; i++) {
        const fracas_surface_side *a = &work->side[i], *b = a + 1;
        if (!fracas_surface_same_edge(a, b)) continue;
        work->neighbour[a->element][a->edge] = b->element;
        work->neighbour[b->element][b->edge] = a->element;
    }
}

static void count(const assembly *work, fracas_surface *made)
{
    const fracas_surface_arrays *arrays = work->arrays;
    made->order = arrays->order;
    made->corners = (size_t)(3 * arrays->order);
    made->nnodes = arrays->nnodes;
    made->nelements = arrays->nelements;
    made->turned = arrays->turned;
    for (size_t e = 0; e < arrays->nelements; e++)
        for (int k = 0; k < 3; k++) made->nborders += work->neighbour[e][k] == NONE;
    made->ninterfaces = (3 * made->nelements - made->nborders) / 2;
    /* Every edge has one mid-side node, and nodes that are none belong to no element. */
    made->nvertices = made->nnodes - (made->order == 2 ? made->ninterfaces + made->nborders : 0);
}

static void fill_elements(const assembly *work, size_t corners, double (*node)[3],
                          uint32_t *element, int64_t *given)
{
    const fracas_surface_arrays *arrays = work->arrays;
    uint32_t nodes = 0;
    for (size_t n = 0; n < arrays->nnodes; n++) work->node[n] = NONE;
    for (size_t e = 0; e < arrays->nelements; e++) {
        const uint32_t *from = arrays->element + corners * work->order[e];
        for (size_t k = 0; k < corners; k++) {
            uint32_t *place = &work->node[from[k]];
            if (*place == NONE) {
                memcpy(node[nodes], arrays->node[from[k]], sizeof *node);
                *place = nodes++;
            }
            element[corners * e + k] = *place;
        }
        given[e] = fracas_surface_element_name(arrays, work->order[e]);
    }
}

/* The number in element `of` of the edge to `neighbour`. */
static uint32_t edge_to(const assembly *work, uint32_t of, uint32_t neighbour)
{
    uint32_t k = 0;
    while (work->neighbour[of][k] != neighbour) k++;
    return k;
}

static void fill_edges(const assembly *work, fracas_surface_interface *interface,
                       fracas_surface_border *border)
{
    size_t interfaces = 0, borders = 0;
    for (uint32_t e = 0; e < work->arrays->nelements; e++) {
        const uint32_t from = work->order[e];
        const size_t start = interfaces;
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t neighbour = work->neighbour[from][k];
            const int32_t tag = work->tag[from][k];
            if (neighbour == NONE)
                border[borders++] = (fracas_surface_border){.element = e, .edge = k, .tag = tag};
            if (neighbour == NONE || work->place[neighbour] < e) continue;
            const uint32_t other = work->place[neighbour];
            size_t at = interfaces++;
            for (; at > start && interface[at - 1].element[1] > other; at--)
                interface[at] = interface[at - 1];
            interface[at] = (fracas_surface_interface){
                .element = {e, other}, .edge = {k, edge_to(work, neighbour, from)}, .tag = tag};
        }
    }
}

static fracas_err fill(const assembly *work, fracas_surface *made)
{
    count(work, made);
    double(*node)[3] = malloc(made->nnodes * sizeof *node);
    uint32_t *element = malloc(made->nelements * made->corners * sizeof *element);
    int64_t *given = malloc(made->nelements * sizeof *given);
    double *area = malloc(made->nelements * sizeof *area);
    /* there may be none of these */
    fracas_surface_interface *interface = malloc((made->ninterfaces + 1) * sizeof *interface);
    fracas_surface_border *border = malloc((made->nborders + 1) * sizeof *border);
    made->node = (const double(*)[3])node;
    made->element = element;
    made->given = given;
    made->area = area;
    made->interface = interface;
    made->border = border;
    fracas_surface_group *group = malloc((work->arrays->ngroups + 1) * sizeof *group);
    made->group = group;
    made->ngroups = work->arrays->ngroups;
    made->passed = work->arrays->passed;
    if (!group || !node || !element || !given || !area || !interface || !border)
        return fracas_no_memory("a mesh");
    if (made->ngroups > 0) memcpy(group, work->arrays->group, made->ngroups * sizeof *group);
    fill_elements(work, made->corners, node, element, given);
    fill_edges(work, interface, border);
    for (size_t e = 0; e < made->nelements; e++) area[e] = fracas_surface_find_area(made, e);
    return FRACAS_OK;
}

static fracas_err assemble(assembly *work, fracas_surface *made)
{
    const fracas_surface_arrays *arrays = work->arrays;
    TRY(fracas_surface_check_elements(arrays));
    work->side = fracas_surface_sides(arrays->element, arrays->nelements,
                                      (size_t)(3 * arrays->order));
    if (!work->side) return fracas_no_memory("the edges of a mesh");
    TRY(fracas_surface_check_edges(arrays, work->side));
    if (arrays->order == 2) TRY(fracas_surface_check_jacobians(arrays));
    TRY(allocate_work(work));
    TRY(set_tags(work));
    set_neighbours(work);
    TRY(fracas_surface_order(arrays->nelements, (const uint32_t(*)[3])work->neighbour,
                             work->order));
    for (uint32_t e = 0; e < arrays->nelements; e++) work->place[work->order[e]] = e;
    return fill(work, made);
}

fracas_err fracas_surface_assemble(const fracas_surface_arrays *arrays,
                                   const fracas_surface **surface)
{
    fracas_surface *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a mesh");
    FRACAS_CLEARED(assembly) work = {.arrays = arrays};
    fracas_err err = assemble(&work, made);
    if (err) fracas_surface_destroy(made);
    else *surface = made;
    return err;
}
