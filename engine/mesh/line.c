/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/line.h"

#include "base/own.h"

#include <math.h>
#include <stdlib.h>

#define NONE UINT32_MAX

fracas_line fracas_line_of(const char *what, const char *section, const double from[3],
                           const double to[3], double within, double size)
{
    fracas_line l = {.within = within > 0 ? within : size, .what = what, .section = section};
    double square = 0;
    for (int i = 0; i < 3; i++) {
        l.from[i] = isnan(from[i]) ? 0 : from[i];
        l.along[i] = isnan(to[i]) ? 0 : to[i] - l.from[i];
        square += l.along[i] * l.along[i];
    }
    l.length = sqrt(square);
    return l;
}

double fracas_line_distance(const fracas_line *l, const double x[3], double *share)
{
    double dot = 0, square = 0;
    for (int i = 0; i < 3; i++) dot += (x[i] - l->from[i]) * l->along[i];
    *share = fmax(0, fmin(1, dot / (l->length * l->length)));
    for (int i = 0; i < 3; i++) {
        const double apart = x[i] - l->from[i] - *share * l->along[i];
        square += apart * apart;
    }
    return sqrt(square);
}

static double apart(const fracas_line *l, const double x[3], bool from_end)
{
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const double d = x[i] - l->from[i] - (from_end ? l->along[i] : 0);
        square += d * d;
    }
    return sqrt(square);
}

fracas_err fracas_line_too_far(const fracas_line *l, const char *part, const char *from,
                               double nearest)
{
    return fracas_fail(FRACAS_USAGE,
                       "the %s's %s is %.4g m away from the nearest %s, and within is %.4g m: move "
                       "it, or raise %s.within",
                       l->what, part, nearest, from, l->within, l->section);
}

/* Shortest paths along interfaces from one vertex. */
typedef struct {
    double *cost;  /* [node] m, INFINITY: not reached */
    uint32_t *via; /* [node]: the interface that leads to it */
} paths;

static void paths_clear(paths *p)
{
    free(p->cost);
    free(p->via);
}

static void ends_of(const fracas_surface *surface, size_t i, uint32_t node[2])
{
    const fracas_surface_interface *of = &surface->interface[i];
    const uint32_t *corner = surface->element + of->element[0] * surface->corners;
    node[0] = corner[of->edge[0]];
    node[1] = corner[(of->edge[0] + 1) % 3];
}

/* L + (d_a^2 + d_b^2)/L of an interface [m]; INFINITY: it leads too far away  (meshes.9) */
static double cost_of(const fracas_line *l, const fracas_surface *surface, const uint32_t node[2])
{
    double share, square = 0, off = 0;
    for (int i = 0; i < 3; i++) {
        const double d = surface->node[node[1]][i] - surface->node[node[0]][i];
        square += d * d;
    }
    for (int end = 0; end < 2; end++) {
        const double d = fracas_line_distance(l, surface->node[node[end]], &share);
        if (d > l->within) return INFINITY;
        off += d * d;
    }
    return sqrt(square) + off / sqrt(square);
}

/* Vertices alone: a mid-side node is no end of an edge. */
static fracas_err nearest_vertex(const fracas_line *l, const fracas_surface *surface, bool from_end,
                                 uint32_t *vertex)
{
    double least = INFINITY;
    *vertex = 0;
    for (size_t e = 0; e < surface->nelements; e++)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t node = surface->element[e * surface->corners + k];
            const double d = apart(l, surface->node[node], from_end);
            if (d > least || (d == least && node >= *vertex)) continue;
            least = d;
            *vertex = node;
        }
    return least <= l->within ? FRACAS_OK
                              : fracas_line_too_far(l, from_end ? "end" : "start", "vertex", least);
}

/* Passes over the interfaces near the line until no path gets shorter. */
static void shorten(const uint32_t (*ends)[2], const double *cost, const uint32_t *number,
                    size_t count, paths *p)
{
    for (bool changes = true; changes;) {
        changes = false;
        for (size_t i = 0; i < count; i++)
            for (int way = 0; way < 2; way++) {
                const uint32_t a = ends[i][way], b = ends[i][1 - way];
                if (!(p->cost[a] + cost[i] < p->cost[b])) continue;
                p->cost[b] = p->cost[a] + cost[i];
                p->via[b] = number[i];
                changes = true;
            }
    }
}

static fracas_err find_paths(const fracas_line *l, const fracas_surface *surface, uint32_t start,
                             paths *p)
{
    const size_t room = surface->ninterfaces + 1;
    OWNED uint32_t(*ends)[2] = malloc(room * sizeof *ends);
    OWNED double *cost = malloc(room * sizeof *cost);
    OWNED uint32_t *number = malloc(room * sizeof *number);
    size_t count = 0;
    p->cost = malloc(surface->nnodes * sizeof *p->cost);
    p->via = malloc(surface->nnodes * sizeof *p->via);
    if (!ends || !cost || !number || !p->cost || !p->via)
        return fracas_no_memory("a line on a body");
    for (uint32_t i = 0; i < surface->ninterfaces; i++) {
        ends_of(surface, i, ends[count]);
        cost[count] = cost_of(l, surface, ends[count]);
        number[count] = i;
        count += isfinite(cost[count]);
    }
    for (size_t n = 0; n < surface->nnodes; n++) {
        p->cost[n] = INFINITY;
        p->via[n] = NONE;
    }
    p->cost[start] = 0;
    shorten((const uint32_t(*)[2])ends, cost, number, count, p);
    return FRACAS_OK;
}

fracas_err fracas_line_find(const fracas_line *l, const fracas_surface *surface, bool *on)
{
    FRACAS_CLEARED(paths) p = {0};
    uint32_t start, at, node[2];
    TRY(nearest_vertex(l, surface, false, &start));
    TRY(nearest_vertex(l, surface, true, &at));
    if (start == at)
        return fracas_fail(FRACAS_USAGE,
                           "the %s is %.4g m long, and both its ends are nearest to one vertex: "
                           "lengthen it, or refine the mesh",
                           l->what, l->length);
    TRY(find_paths(l, surface, start, &p));
    if (isinf(p.cost[at]))
        return fracas_fail(FRACAS_USAGE,
                           "no interfaces lead from one end of the %s to the other and stay "
                           "within %.4g m of its line: raise %s.within; edges on the boundary and "
                           "in planes of symmetry are no interfaces",
                           l->what, l->within, l->section);
    while (at != start) {
        on[p.via[at]] = true;
        ends_of(surface, p.via[at], node);
        at = node[0] == at ? node[1] : node[0];
    }
    return FRACAS_OK;
}
