/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the bodies: fineness, perturbation of vertices, mid-side nodes. */
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <inttypes.h>
#include <math.h>

fracas_err fracas_surface_check_length(const char *what, double length)
{
    /* volumes and their inverses are numbers */
    if (length >= 1e-30 && length <= 1e30) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s of a surface is %g m: it should be between 1e-30 and 1e30 m", what,
                       length);
}

fracas_err fracas_surface_divide(const fracas_surface_fineness *fineness, double length,
                                 double height, double *divisions)
{
    if ((fineness->size != 0.0) == (fineness->divisions != 0))
        return fracas_fail(
            FRACAS_USAGE,
            "a surface takes either a size of elements or a number of divisions, not %s",
            fineness->divisions ? "both" : "neither");
    if (fineness->divisions == 0)
        TRY(fracas_surface_check_length("the size of the elements", fineness->size));
    *divisions = fineness->divisions ? (double)fineness->divisions
                                     : fmax(1.0, floor(length / (height * fineness->size) + 0.5));
    if (*divisions <= (double)FRACAS_SURFACE_LARGEST) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "a surface of %g m would have %g divisions: take fewer, or a larger size of elements",
        length, *divisions);
}

fracas_err fracas_surface_draft_init(fracas_surface_draft *draft, double nvertices,
                                     double nelements, double ntags)
{
    /* Twice as many edges as vertices make four times as many nodes of the second order. */
    if (!(4.0 * nvertices <= (double)FRACAS_SURFACE_LARGEST))
        return fracas_fail(FRACAS_USAGE,
                           "a surface would have %.15g elements, more than %zu: take a larger size",
                           nelements, FRACAS_SURFACE_LARGEST / 2);
    *draft = (fracas_surface_draft){
        .nvertices = (size_t)nvertices, .nelements = (size_t)nelements, .ntags = (size_t)ntags};
    draft->node = malloc(draft->nvertices * sizeof *draft->node);
    draft->element = malloc(3 * draft->nelements * sizeof *draft->element);
    draft->tag = malloc((draft->ntags + 1) * sizeof *draft->tag); /* there may be none */
    return draft->node && draft->element && draft->tag ? FRACAS_OK : fracas_no_memory("a mesh");
}

void fracas_surface_draft_clear(fracas_surface_draft *draft)
{
    free(draft->node);
    free(draft->element);
    free(draft->tag);
    *draft = (fracas_surface_draft){0};
}

void fracas_surface_project(double point[3], double radius)
{
    const double share = radius / sqrt(fracas_surface_dot(point, point));
    for (int i = 0; i < 3; i++) point[i] *= share;
}

/* y of the nearest place of the axis. */
static double beside(const fracas_surface_draft *draft, const double point[3])
{
    return fmax(-draft->axis, fmin(point[1], draft->axis));
}

/* The same around the axis. */
static void project(const fracas_surface_draft *draft, double point[3], double radius)
{
    const double y = beside(draft, point);
    if (draft->axis > 0.0) point[1] -= y;
    fracas_surface_project(point, radius);
    if (draft->axis > 0.0) point[1] += y;
}

/* ---- perturbation ---- */

static fracas_err check_shifts(const fracas_surface_draft *draft,
                               const fracas_surface_fineness *fineness)
{
    if (!(fineness->amplitude >= 0.0 && fineness->amplitude <= FRACAS_SURFACE_AMPLITUDE))
        return fracas_fail(
            FRACAS_USAGE,
            "the amplitude of a mesh's perturbation is %g: it should be between 0 and %g",
            fineness->amplitude, FRACAS_SURFACE_AMPLITUDE);
    if (!fineness->shift && fineness->amplitude == 0.0) return FRACAS_OK;
    const size_t given = fineness->shift ? fineness->nshifts : 0;
    if (given != draft->nvertices)
        return fracas_fail(
            FRACAS_USAGE,
            "a mesh's perturbation needs a pair of numbers for each of its %zu vertices, not %zu",
            draft->nvertices, given);
    for (size_t v = 0; v < draft->nvertices; v++)
        for (int i = 0; i < 2; i++)
            if (!(fabs(fineness->shift[v][i]) <= 1.0))
                return fracas_fail(FRACAS_USAGE,
                                   "number %d of vertex %zu in a mesh's perturbation is %g: it "
                                   "should be between -1 and 1",
                                   i, v, fineness->shift[v][i]);
    return FRACAS_OK;
}

/* (meshes.7) The local edge length of each vertex, 0 on the boundary: that of an equilateral
 * triangle as high as the least altitude of the elements around it. */
static void set_room(const fracas_surface_draft *draft, double *room)
{
    const double edge_by_altitude = 1.1547005383792515; /* 2/sqrt(3) */
    for (size_t v = 0; v < draft->nvertices; v++) room[v] = INFINITY;
    for (size_t e = 0; e < draft->nelements; e++) {
        const uint32_t *node = draft->element + 3 * e;
        double normal[3], longest = 0.0;
        fracas_surface_normal(draft->node[node[0]], draft->node[node[1]], draft->node[node[2]],
                              normal);
        for (int k = 0; k < 3; k++) {
            const double *a = draft->node[node[k]], *b = draft->node[node[(k + 1) % 3]];
            const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
            longest = fmax(longest, sqrt(fracas_surface_dot(d, d)));
        }
        const double altitude = sqrt(fracas_surface_dot(normal, normal)) / longest;
        for (int k = 0; k < 3; k++)
            room[node[k]] = fmin(room[node[k]], edge_by_altitude * altitude);
    }
    for (size_t t = 0; t < draft->ntags; t++)
        for (int k = 0; k < 2; k++) room[draft->tag[t].node[k]] = 0.0;
}

/* Two unit vectors along the surface at `point`: x and y in the plane, around and along a tube. */
static void tangents(const fracas_surface_draft *draft, const double point[3], double first[3],
                     double second[3])
{
    static const double origin[3], axis[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    memcpy(first, axis[0], sizeof axis[0]);
    memcpy(second, axis[1], sizeof axis[1]);
    if (draft->round == 0.0) return;
    const bool tube = fabs(point[1]) < draft->axis;
    const double out[3] = {point[0], draft->axis > 0.0 ? point[1] - beside(draft, point) : point[1],
                           point[2]};
    int least = tube ? 1 : 0;
    for (int i = 0; i < 3 && !tube; i++)
        if (fabs(out[i]) < fabs(out[least])) least = i;
    fracas_surface_normal(origin, axis[least], out, first);
    fracas_surface_project(first, 1.0);
    fracas_surface_normal(origin, out, first, second);
    fracas_surface_project(second, 1.0);
}

/* (meshes.8) */
static fracas_err perturb(const fracas_surface_draft *draft,
                          const fracas_surface_fineness *fineness, double (*node)[3])
{
    OWNED double *room = malloc(draft->nvertices * sizeof *room);
    if (!room) return fracas_no_memory("the perturbation of a mesh");
    set_room(draft, room);
    for (size_t v = 0; v < draft->nvertices; v++) {
        if (room[v] == 0.0) continue;
        double first[3], second[3];
        tangents(draft, node[v], first, second);
        for (int i = 0; i < 3; i++)
            node[v][i] += fineness->amplitude * room[v] *
                          (fineness->shift[v][0] * first[i] + fineness->shift[v][1] * second[i]);
        if (draft->round > 0.0) project(draft, node[v], draft->round);
    }
    return FRACAS_OK;
}

/* ---- mid-side nodes ---- */

typedef struct {
    double (*node)[3];
    uint32_t *element;
    size_t nnodes;
} refined;

static void refined_clear(refined *all)
{
    free(all->node);
    free(all->element);
}

/* Straight middles behind the vertices; each edge's in all its elements. */
static void add_middles(const fracas_surface_draft *draft, const fracas_surface_side *side,
                        refined *all)
{
    const size_t nsides = 3 * draft->nelements;
    for (size_t e = 0; e < draft->nelements; e++)
        memcpy(all->element + 6 * e, draft->element + 3 * e, 3 * sizeof *all->element);
    for (size_t first = 0, next; first < nsides; first = next) {
        next = fracas_surface_next_edge(side, first, nsides);
        const double *a = all->node[side[first].low], *b = all->node[side[first].high];
        double *middle = all->node[all->nnodes];
        for (int i = 0; i < 3; i++) middle[i] = 0.5 * (a[i] + b[i]);
        if (next - first == 2 && draft->radius[0] > 0.0) project(draft, middle, draft->radius[0]);
        for (size_t i = first; i < next; i++)
            all->element[6 * (size_t)side[i].element + 3 + side[i].edge] = (uint32_t)all->nnodes;
        all->nnodes++;
    }
}

/* Middles of tagged edges onto their circles. */
static void bend_tagged(const fracas_surface_draft *draft, const fracas_surface_side *side,
                        refined *all)
{
    for (size_t t = 0; t < draft->ntags; t++) {
        const fracas_surface_tag *tag = &draft->tag[t];
        const size_t first = fracas_surface_find_edge(side, 3 * draft->nelements, tag->node[0],
                                                      tag->node[1]);
        const uint32_t middle =
            all->element[6 * (size_t)side[first].element + 3 + side[first].edge];
        if (draft->radius[tag->tag] > 0.0)
            project(draft, all->node[middle], draft->radius[tag->tag]);
    }
}

static fracas_err refine(const fracas_surface_draft *draft, const fracas_surface_fineness *fineness,
                         refined *all)
{
    const bool bent = fineness->order == 2;
    /* every edge of the boundary has a tag */
    const size_t nedges = bent ? (3 * draft->nelements + draft->ntags) / 2 : 0;
    OWNED fracas_surface_side *side =
        bent ? fracas_surface_sides(draft->element, draft->nelements, 3) : NULL;
    if (bent && !side) return fracas_no_memory("the edges of a mesh");
    all->node = malloc((draft->nvertices + nedges) * sizeof *all->node);
    all->element = malloc(3 * (size_t)fineness->order * draft->nelements * sizeof *all->element);
    if (!all->node || !all->element) return fracas_no_memory("a mesh");
    memcpy(all->node, draft->node, draft->nvertices * sizeof *all->node);
    all->nnodes = draft->nvertices;
    if (fineness->amplitude > 0.0) TRY(perturb(draft, fineness, all->node));
    if (bent) {
        add_middles(draft, side, all);
        bend_tagged(draft, side, all);
    } else {
        memcpy(all->element, draft->element, 3 * draft->nelements * sizeof *all->element);
    }
    return FRACAS_OK;
}

fracas_err fracas_surface_draft_finish(const fracas_surface_draft *draft,
                                       const fracas_surface_fineness *fineness,
                                       const fracas_surface **surface)
{
    if (fineness->order != 1 && fineness->order != 2)
        return fracas_fail(FRACAS_USAGE, "a surface has elements of order 1 or 2, not %d",
                           fineness->order);
    TRY(check_shifts(draft, fineness));
    FRACAS_CLEARED(refined) all = {0};
    TRY(refine(draft, fineness, &all));
    const fracas_surface_arrays arrays = {.order = fineness->order,
                                          .nnodes = all.nnodes,
                                          .nelements = draft->nelements,
                                          .ntags = draft->ntags,
                                          .node = (const double(*)[3])all.node,
                                          .element = all.element,
                                          .tag = draft->tag};
    return fracas_surface_assemble(&arrays, surface);
}
