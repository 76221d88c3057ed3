/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Order of elements: neighbours close to each other, in the cache together. */
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

enum { MOST_SWEEPS = 8 };

typedef struct {
    const uint32_t (*neighbour)[3];
    uint32_t *queue;   /* elements in the order in which sweeps reach them */
    uint32_t *reached; /* number of the last sweep that reached an element */
    uint32_t sweeps;
} search;

static int degree_of(const search *state, uint32_t e)
{
    int degree = 0;
    for (int k = 0; k < 3; k++) degree += state->neighbour[e][k] != UINT32_MAX;
    return degree;
}

/* Queues neighbours of `e` new to this sweep at `end`: fewer neighbours first, then lower numbers.
 */
static size_t reach_neighbours(search *state, uint32_t e, size_t end)
{
    const size_t start = end;
    for (int k = 0; k < 3; k++) {
        const uint32_t next = state->neighbour[e][k];
        if (next == UINT32_MAX || state->reached[next] == state->sweeps) continue;
        state->reached[next] = state->sweeps;
        const int degree = degree_of(state, next);
        size_t at = end++;
        for (; at > start; at--) {
            const uint32_t other = state->queue[at - 1];
            if (degree_of(state, other) < degree ||
                (degree_of(state, other) == degree && other < next))
                break;
            state->queue[at] = other;
        }
        state->queue[at] = next;
    }
    return end;
}

/* Queues the component of `start` from place `begin` on, level by level; returns its end. */
static size_t sweep(search *state, uint32_t start, size_t begin, size_t *depth, size_t *last_level)
{
    size_t end = begin, level_end = begin + 1;
    state->sweeps++;
    state->reached[start] = state->sweeps;
    state->queue[end++] = start;
    *depth = 0;
    *last_level = begin;
    for (size_t at = begin; at < end; at++) {
        if (at == level_end) {
            ++*depth;
            *last_level = at;
            level_end = end;
        }
        end = reach_neighbours(state, state->queue[at], end);
    }
    return end;
}

/* Cuthill and McKee from an element far out, found as by George and Liu. */
static size_t order_component(search *state, uint32_t start, size_t begin)
{
    size_t depth, last_level, end = sweep(state, start, begin, &depth, &last_level);
    for (int i = 0; i < MOST_SWEEPS; i++) {
        uint32_t far = state->queue[last_level];
        for (size_t at = last_level; at < end; at++)
            if (degree_of(state, state->queue[at]) < degree_of(state, far)) far = state->queue[at];
        const size_t before = depth;
        end = sweep(state, far, begin, &depth, &last_level);
        if (depth <= before) break;
    }
    return end;
}

fracas_err fracas_surface_order(size_t nelements, const uint32_t (*neighbour)[3], uint32_t *order)
{
    OWNED uint32_t *reached = calloc(nelements, sizeof *reached);
    search state = {.neighbour = neighbour, .queue = order, .reached = reached};
    if (!reached) return fracas_no_memory("the order of a mesh's elements");
    size_t end = 0;
    for (size_t e = 0; e < nelements; e++)
        if (reached[e] == 0) end = order_component(&state, (uint32_t)e, end);
    for (size_t i = 0; i < nelements / 2; i++) {
        const uint32_t swapped = order[i];
        order[i] = order[nelements - 1 - i];
        order[nelements - 1 - i] = swapped;
    }
    return FRACAS_OK;
}
