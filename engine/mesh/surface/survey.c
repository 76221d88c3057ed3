/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a mesh from a file, doubled nodes, and directions of its edges. */
#include "engine/mesh/surface/survey.h"

#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <math.h>

#define NONE UINT32_MAX
#define ONE_PLACE 1e-9 /* apart at most, by the extent of the body */

static uint32_t root_of(uint32_t *above, uint32_t e)
{
    while (above[e] != e) e = above[e] = above[above[e]];
    return e;
}

/* above[e]: the element that stands for the part of e. */
static size_t find_parts(const fracas_surface *surface, uint32_t *above)
{
    size_t parts = surface->nelements;
    for (uint32_t e = 0; e < surface->nelements; e++) above[e] = e;
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        const uint32_t a = root_of(above, surface->interface[i].element[0]),
                       b = root_of(above, surface->interface[i].element[1]);
        parts -= a != b;
        above[a > b ? a : b] = a > b ? b : a;
    }
    for (uint32_t e = 0; e < surface->nelements; e++) above[e] = root_of(above, e);
    return parts;
}

/* A node, by its distance along a direction that no mesh has. */
typedef struct {
    double along;
    uint32_t node, part;
    bool seen; /* in one position with a node before it */
} place;

static int compare_places(const void *left, const void *right)
{
    const place *a = left, *b = right;
    if (a->along != b->along) return a->along < b->along ? -1 : 1;
    return a->node < b->node ? -1 : a->node > b->node;
}

static void fill_places(const fracas_surface *surface, const uint32_t *part, place *all)
{
    static const double direction[3] = {0.70710678, 0.57735027, 0.40824829};
    for (uint32_t n = 0; n < surface->nnodes; n++)
        all[n] = (place){
            .along = fracas_surface_dot(direction, surface->node[n]), .node = n, .part = NONE};
    for (size_t e = 0; e < surface->nelements; e++)
        for (size_t k = 0; k < surface->corners; k++)
            all[surface->element[surface->corners * e + k]].part = part[e];
    qsort(all, surface->nnodes, sizeof *all, compare_places);
}

/* Positions that nodes of different parts have. */
static size_t count_doubled(const fracas_surface *surface, double apart, place *all)
{
    size_t doubled = 0;
    for (size_t i = 0; i < surface->nnodes; i++) {
        bool first = false;
        const double *a = surface->node[all[i].node];
        for (size_t j = i + 1; j < surface->nnodes && all[j].along - all[i].along <= 2 * apart;
             j++) {
            const double *b = surface->node[all[j].node];
            if (all[j].part == all[i].part || !(fabs(a[0] - b[0]) <= apart) ||
                !(fabs(a[1] - b[1]) <= apart) || !(fabs(a[2] - b[2]) <= apart))
                continue;
            first = !all[i].seen;
            all[j].seen = true;
        }
        doubled += first;
    }
    return doubled;
}

/* A corner of the border, by its place along the body's longest side. */
typedef struct {
    double along;
    const double *position;
} corner;

static int compare_corners(const void *left, const void *right)
{
    const corner *a = left, *b = right;
    return (a->along > b->along) - (a->along < b->along);
}

/* The corner lies on the edge from a to b, away from its ends. */
static bool is_on(const double *position, const double *a, const double *b, double apart)
{
    double along[3], to[3], off = 0;
    for (int i = 0; i < 3; i++) along[i] = b[i] - a[i], to[i] = position[i] - a[i];
    const double square = fracas_surface_dot(along, along),
                 s = fracas_surface_dot(along, to) / square;
    for (int i = 0; i < 3; i++) off = fmax(off, fabs(to[i] - s * along[i]));
    return off <= apart && s * sqrt(square) > apart && (1 - s) * sqrt(square) > apart;
}

/* Corners of the border on its edges. Large meshes whose edges are mostly border are told of by
 * their parts. */
static fracas_err count_hanging(const fracas_surface *surface, const double box[3], double apart,
                                size_t *hanging)
{
    enum { FEW = 1000 };
    const size_t n = surface->nborders;
    if (n > FEW && n > surface->ninterfaces) return FRACAS_OK;
    OWNED corner *corners = malloc((n + 1) * sizeof *corners);
    if (!corners) return fracas_no_memory("the border of a mesh");
    const int side = box[1] > box[0] ? (box[2] > box[1] ? 2 : 1) : (box[2] > box[0] ? 2 : 0);
    for (size_t i = 0; i < n; i++) {
        const double *position = fracas_surface_node(surface, surface->border[i].element,
                                                     surface->border[i].edge);
        corners[i] = (corner){position[side], position};
    }
    qsort(corners, n, sizeof *corners, compare_corners);
    for (size_t i = 0; i < n; i++) {
        const fracas_surface_border *of = &surface->border[i];
        const double *a = fracas_surface_node(surface, of->element, of->edge),
                     *b = fracas_surface_node(surface, of->element, (of->edge + 1) % 3);
        size_t from = 0, to = n;
        while (from < to) {
            const size_t middle = (from + to) / 2;
            if (corners[middle].along < fmin(a[side], b[side]) - apart) from = middle + 1;
            else to = middle;
        }
        for (; from < n && corners[from].along <= fmax(a[side], b[side]) + apart; from++)
            *hanging += is_on(corners[from].position, a, b, apart);
    }
    return FRACAS_OK;
}

/* Edges between elements count by their length in the plane, in bins of 5 degrees. */
static double find_steered(const fracas_surface *surface)
{
    enum { BINS = 36, DIRECTIONS = 3 };
    double length[BINS] = {0}, all = 0, steered = 0;
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        const fracas_surface_interface *of = &surface->interface[i];
        const double *a = fracas_surface_node(surface, of->element[0], of->edge[0]),
                     *b = fracas_surface_node(surface, of->element[0], (of->edge[0] + 1) % 3);
        const double along = hypot(b[0] - a[0], b[1] - a[1]);
        const double turn = atan2(b[1] - a[1], b[0] - a[0]) / M_PI + 1; /* half turns */
        length[(int)(turn * BINS + 0.5) % BINS] += along;
        all += along;
    }
    for (int d = 0; d < DIRECTIONS; d++) {
        int best = 0;
        double most = -1;
        for (int i = 0; i < BINS; i++) {
            const double of = length[(i + BINS - 1) % BINS] + length[i] + length[(i + 1) % BINS];
            if (of > most) most = of, best = i;
        }
        steered += most;
        for (int i = -1; i <= 1; i++) length[(best + BINS + i) % BINS] = 0;
    }
    return all > 0 ? steered / all : 0;
}

/* Vertices are on a sphere about the origin, but for the round-off of a file. */
static bool find_round(const fracas_surface *surface)
{
    double least = INFINITY, most = 0;
    for (size_t e = 0; e < surface->nelements; e++)
        for (size_t k = 0; k < 3; k++) {
            const double *x = fracas_surface_node(surface, e, k), square = fracas_surface_dot(x, x);
            least = fmin(least, square);
            most = fmax(most, square);
        }
    return most - least <= 1e-3 * most;
}

fracas_err fracas_surface_survey_make(const fracas_surface *surface, fracas_surface_survey *survey)
{
    OWNED uint32_t *part = malloc(surface->nelements * sizeof *part);
    if (!part) return fracas_no_memory("the parts of a mesh");
    *survey = (fracas_surface_survey){.turned = surface->turned};
    fracas_surface_box(surface, survey->box);
    survey->parts = find_parts(surface, part);
    survey->round = find_round(surface);
    if (survey->box[2] == 0) survey->steered = find_steered(surface);
    const double extent = fmax(survey->box[0], fmax(survey->box[1], survey->box[2]));
    TRY(count_hanging(surface, survey->box, ONE_PLACE * extent, &survey->hanging));
    if (survey->parts == 1) return FRACAS_OK;
    OWNED place *all = malloc(surface->nnodes * sizeof *all);
    if (!all) return fracas_no_memory("the nodes of a mesh");
    fill_places(surface, part, all);
    survey->doubled = count_doubled(surface, ONE_PLACE * extent, all);
    return FRACAS_OK;
}

fracas_err fracas_surface_check_whole(const fracas_surface *surface)
{
    fracas_surface_survey survey;
    if (surface->ninterfaces > 0 || surface->nelements == 1) return FRACAS_OK;
    TRY(fracas_surface_survey_make(surface, &survey));
    return fracas_fail(
        FRACAS_USAGE,
        "none of the %zu elements has a neighbour: the mesh has no interface, and "
        "nothing could crack; %zu positions have nodes of several elements: " FRACAS_SURFACE_JOIN,
        surface->nelements, survey.doubled);
}
