/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/facets.h"

#include "analysis/data/room.h"

#include <stdlib.h>

enum { NONE = 255 };

typedef struct {
    size_t *first, *side; /* by fragment; 2 interface + side */
    uint32_t *order;      /* fragments, the largest first */
} neighbours;

static uint32_t fragment_at(const fracas_stored_mesh *mesh, const fracas_surface_state *state,
                            size_t i, size_t side)
{
    return state->fragment[mesh->interface[i].element[side]];
}

static int larger_first(const void *a, const void *b, void *state)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    const size_t *elements = ((const fracas_surface_state *)state)->elements;
    if (elements[x] != elements[y]) return elements[x] > elements[y] ? -1 : 1;
    return (x > y) - (x < y);
}

static fracas_err list_neighbours(const fracas_stored_mesh *mesh, const fracas_surface_state *state,
                                  fracas_room *room, neighbours *of)
{
    size_t *parted; /* fragments on both sides of each interface */
    FRACAS_TAKE(room, parted, 2 * mesh->ninterfaces);
    FRACAS_TAKE(room, of->order, state->nfragments);
    TRY(fracas_room_check(room, "the tints of a picture"));
    for (size_t k = 0; k < 2 * mesh->ninterfaces; k++)
        parted[k] = fragment_at(mesh, state, k / 2, k % 2);
    TRY(fracas_room_groups(room, parted, 2 * mesh->ninterfaces, state->nfragments, &of->first,
                           &of->side));
    for (size_t f = 0; f < state->nfragments; f++) of->order[f] = (uint32_t)f;
    qsort_r(of->order, state->nfragments, sizeof *of->order, larger_first,
            (void *)(uintptr_t)state);
    return FRACAS_OK;
}

static uint8_t best_tint(const fracas_stored_mesh *mesh, const fracas_surface_state *state,
                         const neighbours *of, uint32_t f, const uint8_t *tint, const size_t *drawn)
{
    size_t edges[FRACAS_TINTS] = {0};
    for (size_t k = of->first[f]; k < of->first[f + 1]; k++) {
        const uint32_t other = fragment_at(mesh, state, of->side[k] / 2, of->side[k] % 2 == 0);
        if (other != f && tint[other] < FRACAS_TINTS) edges[tint[other]]++;
    }
    uint8_t best = 0;
    for (uint8_t t = 1; t < FRACAS_TINTS; t++)
        if (edges[t] < edges[best] || (edges[t] == edges[best] && drawn[t] < drawn[best])) best = t;
    return best;
}

fracas_err fracas_tint_fragments(const fracas_stored_mesh *mesh, const fracas_surface_state *state,
                                 uint8_t **tint)
{
    FRACAS_CLEARED(fracas_room) room = {0};
    neighbours of;
    size_t drawn[FRACAS_TINTS] = {0}; /* elements in each tint */
    *tint = NULL;
    TRY(list_neighbours(mesh, state, &room, &of));
    *tint = malloc(state->nfragments + 1);
    if (!*tint) return fracas_no_memory("the tints of a picture");
    for (size_t f = 0; f < state->nfragments; f++)
        (*tint)[f] = state->elements[f] <= FRACAS_SURFACE_DUST ? FRACAS_TINT_DUST : NONE;
    for (size_t k = 0; k < state->nfragments; k++) {
        const uint32_t f = of.order[k];
        if ((*tint)[f] == FRACAS_TINT_DUST) continue;
        (*tint)[f] = best_tint(mesh, state, &of, f, *tint, drawn);
        drawn[(*tint)[f]] += state->elements[f];
    }
    return FRACAS_OK;
}
