/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faults between elements: the edges shared by them. */
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <inttypes.h>
#include <math.h>

#define FOLDED -0.5 /* cosine of the angle between two normals: 120 degrees */

static int compare_sides(const void *left, const void *right)
{
    const fracas_surface_side *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    if (a->element != b->element) return a->element < b->element ? -1 : 1;
    return a->edge < b->edge ? -1 : a->edge > b->edge;
}

fracas_surface_side *fracas_surface_sides(const uint32_t *element, size_t nelements, size_t corners)
{
    fracas_surface_side *side = malloc(3 * nelements * sizeof *side);
    if (!side) return NULL;
    for (size_t e = 0; e < nelements; e++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t from = element[corners * e + k], to = element[corners * e + (k + 1) % 3];
            side[3 * e + k] = (fracas_surface_side){.low = from < to ? from : to,
                                                    .high = from < to ? to : from,
                                                    .element = (uint32_t)e,
                                                    .edge = k};
        }
    qsort(side, 3 * nelements, sizeof *side, compare_sides);
    return side;
}

size_t fracas_surface_find_edge(const fracas_surface_side *side, size_t nsides, uint32_t a,
                                uint32_t b)
{
    const fracas_surface_side edge = {.low = a < b ? a : b, .high = a < b ? b : a}; /* the first */
    size_t first = 0, last = nsides;
    while (first < last) {
        const size_t middle = first + (last - first) / 2;
        if (!fracas_surface_same_edge(&side[middle], &edge) &&
            compare_sides(&side[middle], &edge) < 0)
            first = middle + 1;
        else last = middle;
    }
    return first < nsides && fracas_surface_same_edge(&side[first], &edge) ? first : nsides;
}

static uint32_t node_of(const fracas_surface_arrays *arrays, const fracas_surface_side *side,
                        uint32_t corner)
{
    return arrays->element[(size_t)(3 * arrays->order) * side->element + corner];
}

static int64_t name_of(const fracas_surface_arrays *arrays, const fracas_surface_side *side)
{
    return fracas_surface_element_name(arrays, side->element);
}

/* All sides of one edge. */
static fracas_err check_edge(const fracas_surface_arrays *arrays, const fracas_surface_side *side,
                             size_t count)
{
    for (size_t i = 0; i + 1 < count; i++)
        for (size_t j = i + 1; j < count && j < 3; j++) /* among more than three some are enough */
            if (node_of(arrays, &side[i], (side[i].edge + 2) % 3) ==
                node_of(arrays, &side[j], (side[j].edge + 2) % 3))
                return fracas_fail(FRACAS_USAGE,
                                   "elements %" PRId64 " and %" PRId64
                                   " have the same vertices: leave one out",
                                   name_of(arrays, &side[i]), name_of(arrays, &side[j]));
    const int64_t low = fracas_surface_node_name(arrays, side->low),
                  high = fracas_surface_node_name(arrays, side->high);
    if (count > 2)
        return fracas_fail(FRACAS_USAGE,
                           "the edge between nodes %" PRId64 " and %" PRId64
                           " is shared by elements %" PRId64 ", %" PRId64 " and %" PRId64
                           ": a surface has two at most",
                           low, high, name_of(arrays, &side[0]), name_of(arrays, &side[1]),
                           name_of(arrays, &side[2]));
    if (arrays->order == 1 || count == 1) return FRACAS_OK;
    const uint32_t a = node_of(arrays, &side[0], 3 + side[0].edge),
                   b = node_of(arrays, &side[1], 3 + side[1].edge);
    if (a == b) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "elements %" PRId64 " and %" PRId64 " have different nodes, %" PRId64 " and %" PRId64
        ", in the middle of the edge between nodes %" PRId64 " and %" PRId64,
        name_of(arrays, &side[0]), name_of(arrays, &side[1]), fracas_surface_node_name(arrays, a),
        fracas_surface_node_name(arrays, b), low, high);
}

/* A mid-side node belongs to one edge and is no vertex. owner[node]: an element with it. */
static fracas_err check_middles(const fracas_surface_arrays *arrays,
                                const fracas_surface_side *side, uint32_t *owner)
{
    const size_t nsides = 3 * arrays->nelements;
    for (size_t n = 0; n < arrays->nnodes; n++) owner[n] = UINT32_MAX;
    for (size_t i = 0; i < nsides; i++)
        owner[node_of(arrays, &side[i], side[i].edge)] = side[i].element;
    for (size_t first = 0; first < nsides; first = fracas_surface_next_edge(side, first, nsides)) {
        const uint32_t middle = node_of(arrays, &side[first], 3 + side[first].edge);
        if (owner[middle] != UINT32_MAX)
            return fracas_fail(FRACAS_USAGE,
                               "node %" PRId64 " in the middle of an edge of element %" PRId64
                               " has another place in element %" PRId64,
                               fracas_surface_node_name(arrays, middle),
                               name_of(arrays, &side[first]),
                               fracas_surface_element_name(arrays, owner[middle]));
        owner[middle] = side[first].element;
    }
    return FRACAS_OK;
}

static bool goes_round_against(const fracas_surface_arrays *arrays, const fracas_surface_side *a,
                               const fracas_surface_side *b)
{
    return node_of(arrays, a, a->edge) == node_of(arrays, b, b->edge);
}

static void unit_normal(const fracas_surface_arrays *arrays, const fracas_surface_side *side,
                        double normal[3])
{
    fracas_surface_normal(arrays->node[node_of(arrays, side, 0)],
                          arrays->node[node_of(arrays, side, 1)],
                          arrays->node[node_of(arrays, side, 2)], normal);
    const double length = sqrt(fracas_surface_dot(normal, normal));
    for (int i = 0; i < 3; i++) normal[i] /= length;
}

static bool is_folded_back(const fracas_surface_arrays *arrays, const fracas_surface_side *a,
                           const fracas_surface_side *b)
{
    double left[3], right[3];
    unit_normal(arrays, a, left);
    unit_normal(arrays, b, right);
    return fracas_surface_dot(left, right) < FOLDED;
}

/* The element at odds with most of its neighbours, the first of several; count[]: with how many. */
static size_t most_at_odds(const fracas_surface_arrays *arrays, const fracas_surface_side *side,
                           bool (*at_odds)(const fracas_surface_arrays *arrays,
                                           const fracas_surface_side *a,
                                           const fracas_surface_side *b),
                           uint8_t *count)
{
    const size_t nsides = 3 * arrays->nelements;
    size_t worst = 0;
    for (size_t e = 0; e < arrays->nelements; e++) count[e] = 0;
    for (size_t i = 0; i + 1 < nsides; i++) {
        if (!fracas_surface_same_edge(&side[i], &side[i + 1]) ||
            !at_odds(arrays, &side[i], &side[i + 1]))
            continue;
        count[side[i].element]++;
        count[side[i + 1].element]++;
    }
    for (size_t e = 1; e < arrays->nelements; e++)
        if (count[e] > count[worst]) worst = e;
    return worst;
}

static fracas_err check_sides(const fracas_surface_arrays *arrays, const fracas_surface_side *side,
                              uint8_t *count)
{
    size_t worst = most_at_odds(arrays, side, goes_round_against, count);
    if (count[worst])
        return fracas_fail(
            FRACAS_USAGE,
            "element %" PRId64
            " is inverted: it goes round against %d of its neighbours; turn the order of its nodes",
            fracas_surface_element_name(arrays, worst), count[worst]);
    worst = most_at_odds(arrays, side, is_folded_back, count);
    if (count[worst])
        return fracas_fail(
            FRACAS_USAGE,
            "element %" PRId64
            " is inverted: it is folded back on %d of its neighbours by more than 120 degrees",
            fracas_surface_element_name(arrays, worst), count[worst]);
    return FRACAS_OK;
}

fracas_err fracas_surface_check_edges(const fracas_surface_arrays *arrays,
                                      const fracas_surface_side *side)
{
    const size_t nsides = 3 * arrays->nelements;
    for (size_t first = 0, next; first < nsides; first = next) {
        next = fracas_surface_next_edge(side, first, nsides);
        TRY(check_edge(arrays, side + first, next - first));
    }
    if (arrays->order == 2) {
        OWNED uint32_t *owner = malloc(arrays->nnodes * sizeof *owner);
        if (!owner) return fracas_no_memory("the nodes of a mesh");
        TRY(check_middles(arrays, side, owner));
    }
    OWNED uint8_t *count = malloc(arrays->nelements);
    return count ? check_sides(arrays, side, count) : fracas_no_memory("the elements of a mesh");
}
