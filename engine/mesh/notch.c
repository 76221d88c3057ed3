/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/notch.h"

#include "base/own.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

#define END(key, place, models, what)                                                     \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = "m", .doc = what,             \
                  .fallback = FRACAS_REQUIRED, .minimum = -INFINITY, .maximum = INFINITY, \
                  .offset = offsetof(fracas_notch, place), .only = models, .optional = true)
#define FLAT (FRACAS_GROUP_RING | FRACAS_GROUP_SURFACES)

static const fracas_kind contact_law = {"law", "pressed faces touch as those that break do"},
                         contact_none = {"none", "faces pass through each other"};
static const fracas_kind *const contacts[] = {&contact_law, &contact_none};

bool fracas_notch_touches(const fracas_notch *notch)
{
    return notch->contact != &contact_none;
}

static const fracas_param params[] = {
    END("from_x", from[0], 0, "x of one end of the line; none is 0"),
    END("from_y", from[1], FLAT, "y of this end; none is 0"),
    END("from_z", from[2], FRACAS_GROUP_SHELL, "z of this end; none is 0"),
    END("to_x", to[0], 0, "x of the other end; none is that of the first"),
    END("to_y", to[1], FLAT, "y of the other end; none is that of the first"),
    END("to_z", to[2], FRACAS_GROUP_SHELL, "z of the other end; none is that of the first"),
    {.name = "within",
     .type = FRACAS_REAL,
     .unit = "m",
     .doc = "no broken interface is farther from the line; none is the mean length of an "
            "interface, of a bar's or ring's element",
     .fallback = FRACAS_REQUIRED,
     .minimum = 0,
     .maximum = INFINITY,
     .minimum_open = true,
     .offset = offsetof(fracas_notch, within),
     .optional = true},
    {FRACAS_ONE_OF("contact", contacts, offsetof(fracas_notch, contact),
                   "what faces do that are pressed together; none given is `law`"),
     .only = FRACAS_GROUP_SURFACES, .optional = true},
};

/* Keys that the model does not have are 0 at both ends. */
static fracas_err check_notch(const void *section)
{
    const fracas_notch *notch = section;
    bool begins = notch->within > 0, ends = false;
    for (int i = 0; i < 3; i++) {
        if (notch->from[i] == 0 && notch->to[i] == 0) continue;
        begins = begins || !isnan(notch->from[i]);
        ends = ends || !isnan(notch->to[i]);
    }
    if (!begins || ends) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "a notch has no second end: give to_x, to_y or to_z");
}

const fracas_section fracas_notch_section = {
    .name = "notch",
    .doc = "Interfaces along a line that are broken from the start; none without it",
    FRACAS_PARAMS(params),
    .offset = offsetof(fracas_spec, notch),
    .hashed = true,
    .check = check_notch,
};

/* ---- the line ---- */

typedef struct {
    double from[3], along[3], length; /* m */
    double within;                    /* m */
} line;

static line line_of(const fracas_notch *notch, double size)
{
    line l = {.within = notch->within > 0 ? notch->within : size};
    double square = 0;
    for (int i = 0; i < 3; i++) {
        l.from[i] = isnan(notch->from[i]) ? 0 : notch->from[i];
        l.along[i] = isnan(notch->to[i]) ? 0 : notch->to[i] - l.from[i];
        square += l.along[i] * l.along[i];
    }
    l.length = sqrt(square);
    return l;
}

/* Distance of x from the line [m]; *share: of the nearest place on it, 0 to 1 from end to end. */
static double distance(const line *l, const double x[3], double *share)
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

static double apart(const line *l, const double x[3], bool from_end)
{
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const double d = x[i] - l->from[i] - (from_end ? l->along[i] : 0);
        square += d * d;
    }
    return sqrt(square);
}

static fracas_err too_far(const char *what, double nearest, const line *l)
{
    return fracas_fail(FRACAS_USAGE,
                       "the notch's %s is %.4g m away from the nearest %s, and within is %.4g m: "
                       "move it, or raise notch.within",
                       what, nearest, strcmp(what, "line") == 0 ? "interface" : "vertex",
                       l->within);
}

/* ---- chains ---- */

static fracas_err find_in_chain(const line *l, const fracas_notch_places *places, bool *broken)
{
    size_t best = 0;
    double least = INFINITY, middle = INFINITY;
    for (size_t i = 0; i < places->interfaces; i++) {
        double share;
        const double d = distance(l, places->position[i], &share);
        if (d > least || (d == least && fabs(share - 0.5) >= middle)) continue;
        least = d;
        middle = fabs(share - 0.5);
        best = i;
    }
    if (!(least <= l->within)) return too_far("line", least, l);
    broken[best] = true;
    return FRACAS_OK;
}

/* ---- surfaces ---- */

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
static double cost_of(const line *l, const fracas_surface *surface, const uint32_t node[2])
{
    double share, square = 0, off = 0;
    for (int i = 0; i < 3; i++) {
        const double d = surface->node[node[1]][i] - surface->node[node[0]][i];
        square += d * d;
    }
    for (int end = 0; end < 2; end++) {
        const double d = distance(l, surface->node[node[end]], &share);
        if (d > l->within) return INFINITY;
        off += d * d;
    }
    return sqrt(square) + off / sqrt(square);
}

/* Vertices alone: a mid-side node is no end of an edge. */
static fracas_err nearest_vertex(const line *l, const fracas_surface *surface, bool from_end,
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
    return least <= l->within ? FRACAS_OK : too_far(from_end ? "end" : "start", least, l);
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

static fracas_err find_paths(const line *l, const fracas_surface *surface, uint32_t start, paths *p)
{
    const size_t room = surface->ninterfaces + 1;
    OWNED uint32_t(*ends)[2] = malloc(room * sizeof *ends);
    OWNED double *cost = malloc(room * sizeof *cost);
    OWNED uint32_t *number = malloc(room * sizeof *number);
    size_t count = 0;
    p->cost = malloc(surface->nnodes * sizeof *p->cost);
    p->via = malloc(surface->nnodes * sizeof *p->via);
    if (!ends || !cost || !number || !p->cost || !p->via)
        return fracas_no_memory("the notch of a body");
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

static fracas_err find_on_surface(const line *l, const fracas_surface *surface, bool *broken)
{
    FRACAS_CLEARED(paths) p = {0};
    uint32_t start, at, node[2];
    TRY(nearest_vertex(l, surface, false, &start));
    TRY(nearest_vertex(l, surface, true, &at));
    if (start == at)
        return fracas_fail(FRACAS_USAGE,
                           "the notch is %.4g m long, and both its ends are nearest to one vertex: "
                           "lengthen it, or refine the mesh",
                           l->length);
    TRY(find_paths(l, surface, start, &p));
    if (isinf(p.cost[at]))
        return fracas_fail(FRACAS_USAGE,
                           "no interfaces lead from one end of the notch to the other and stay "
                           "within %.4g m of its line: raise notch.within",
                           l->within);
    while (at != start) {
        broken[p.via[at]] = true;
        ends_of(surface, p.via[at], node);
        at = node[0] == at ? node[1] : node[0];
    }
    return FRACAS_OK;
}

/* NULL: there is none. */
static const fracas_surface_group *group_of(const fracas_surface *surface)
{
    for (size_t g = 0; surface && g < surface->ngroups; g++)
        if (strcmp(surface->group[g].name, FRACAS_NOTCH_GROUP) == 0) return &surface->group[g];
    return NULL;
}

bool fracas_notch_has_line(const fracas_notch *notch)
{
    return line_of(notch, 0).length > 0;
}

fracas_err fracas_notch_find(const fracas_notch *notch, const fracas_notch_places *places,
                             uint32_t **interface, size_t *count)
{
    const line l = line_of(notch, places->size);
    const fracas_surface_group *group = group_of(places->surface);
    *count = 0;
    if (l.length == 0 && !group) return FRACAS_OK;
    OWNED bool *broken = calloc(places->interfaces + 1, sizeof *broken);
    if (!broken) return fracas_no_memory("the notch of a body");
    if (l.length > 0) {
        if (places->surface) TRY(find_on_surface(&l, places->surface, broken));
        else TRY(find_in_chain(&l, places, broken));
    }
    for (size_t i = 0; i < places->interfaces; i++) {
        if (group && places->surface->interface[i].tag == group->number) broken[i] = true;
        *count += broken[i];
    }
    if (*count == 0) return FRACAS_OK;
    *interface = malloc(*count * sizeof **interface);
    if (!*interface) return fracas_no_memory("the notch of a body");
    for (size_t i = 0, n = 0; i < places->interfaces; i++)
        if (broken[i]) (*interface)[n++] = (uint32_t)i;
    return FRACAS_OK;
}
