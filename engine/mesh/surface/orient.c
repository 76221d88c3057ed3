/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elements of a file turned until neighbours go round alike. */
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <inttypes.h>
#include <stdbool.h>

#define NONE UINT32_MAX

typedef struct {
    fracas_surface_side *side;
    uint32_t (*neighbour)[3]; /* across edge k; NONE: none, or more than one */
    bool (*against)[3];       /* goes round against it */
    uint32_t *queue;          /* elements of a part in the order in which a walk reaches them */
    uint8_t *state;           /* an element's */
} walk;

enum { UNSEEN, KEPT, TURNED };

static void walk_clear(walk *w)
{
    free(w->side);
    free(w->neighbour);
    free(w->against);
    free(w->queue);
    free(w->state);
}

static fracas_err walk_init(const fracas_surface_arrays *arrays, walk *w)
{
    const size_t n = arrays->nelements;
    w->side = fracas_surface_sides(arrays->element, n, (size_t)(3 * arrays->order));
    w->neighbour = malloc(n * sizeof *w->neighbour);
    w->against = malloc(n * sizeof *w->against);
    w->queue = malloc(n * sizeof *w->queue);
    w->state = calloc(n, sizeof *w->state);
    if (w->side && w->neighbour && w->against && w->queue && w->state) return FRACAS_OK;
    return fracas_no_memory("the edges of a mesh");
}

/* Neighbours over edges of two elements. */
static void join(const fracas_surface_arrays *arrays, walk *w)
{
    const size_t nsides = 3 * arrays->nelements, corners = (size_t)(3 * arrays->order);
    for (size_t first = 0, next; first < nsides; first = next) {
        const fracas_surface_side *a = &w->side[first], *b = a + 1;
        next = fracas_surface_next_edge(w->side, first, nsides);
        for (size_t i = first; i < next; i++)
            w->neighbour[w->side[i].element][w->side[i].edge] = NONE;
        if (next - first != 2) continue;
        const bool against = arrays->element[corners * a->element + a->edge] ==
                             arrays->element[corners * b->element + b->edge];
        w->neighbour[a->element][a->edge] = b->element;
        w->neighbour[b->element][b->edge] = a->element;
        w->against[a->element][a->edge] = w->against[b->element][b->edge] = against;
    }
}

/* Walks through the part of `start`, which is kept. *count: its elements. */
static fracas_err walk_part(const fracas_surface_arrays *arrays, walk *w, uint32_t start,
                            size_t *count)
{
    size_t end = 0;
    w->state[start] = KEPT;
    w->queue[end++] = start;
    for (size_t at = 0; at < end; at++) {
        const uint32_t e = w->queue[at];
        for (int k = 0; k < 3; k++) {
            const uint32_t next = w->neighbour[e][k];
            if (next == NONE) continue;
            const bool turned = (w->state[e] == TURNED) != w->against[e][k];
            const uint8_t state = turned ? TURNED : KEPT;
            if (w->state[next] == UNSEEN) w->queue[end++] = next;
            else if (w->state[next] != state)
                return fracas_fail(FRACAS_USAGE,
                                   "elements %" PRId64 " and %" PRId64
                                   " go round against each other however one turns them: the "
                                   "surface has one side only, as a Moebius band: cut it open",
                                   fracas_surface_element_name(arrays, e),
                                   fracas_surface_element_name(arrays, next));
            w->state[next] = state;
        }
    }
    *count = end;
    return FRACAS_OK;
}

/* True if the part goes round the wrong way with the elements turned so far: clockwise in a plane,
 * in space against most of its elements as they came. */
static bool is_backward(const fracas_surface_arrays *arrays, const walk *w, size_t count, bool flat)
{
    const size_t corners = (size_t)(3 * arrays->order);
    double area = 0;
    size_t turned = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t *node = arrays->element + corners * w->queue[i];
        const bool is_turned = w->state[w->queue[i]] == TURNED;
        double normal[3];
        fracas_surface_normal(arrays->node[node[0]], arrays->node[node[1]], arrays->node[node[2]],
                              normal);
        area += is_turned ? -normal[2] : normal[2];
        turned += is_turned;
    }
    return flat ? area < 0 : 2 * turned > count;
}

static void swap(uint32_t *a, uint32_t *b)
{
    const uint32_t was = *a;
    *a = *b;
    *b = was;
}

fracas_err fracas_surface_orient(const fracas_surface_arrays *arrays, bool flat, uint32_t *element,
                                 size_t *turned)
{
    const size_t corners = (size_t)(3 * arrays->order);
    FRACAS_CLEARED(walk) w = {0};
    *turned = 0;
    TRY(walk_init(arrays, &w));
    join(arrays, &w);
    for (uint32_t start = 0; start < arrays->nelements; start++) {
        size_t count = 0;
        if (w.state[start] != UNSEEN) continue;
        TRY(walk_part(arrays, &w, start, &count));
        if (!is_backward(arrays, &w, count, flat)) continue;
        for (size_t i = 0; i < count; i++)
            w.state[w.queue[i]] = w.state[w.queue[i]] == TURNED ? KEPT : TURNED;
    }
    for (size_t e = 0; e < arrays->nelements; e++) {
        uint32_t *node = element + corners * e;
        if (w.state[e] != TURNED) continue;
        swap(&node[1], &node[2]);
        if (corners == 6) swap(&node[3], &node[5]);
        ++*turned;
    }
    return FRACAS_OK;
}
