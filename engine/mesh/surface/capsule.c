/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A quarter of a tube with the octant of a sphere on it, and their mirror images. */
#include "engine/mesh/surface/capsule.h"

#include "base/elementary.h"
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <math.h>
#include <string.h>

/* Right angles at the poles and on the seams bend both ways: from 0.29 on some fold. */
#define LARGEST_AMPLITUDE 0.25

enum { X_PLANE = 1, Z_PLANE, Y_PLANE, SEAM }; /* tags */

/* A quarter of the tube: (n + 1)(m + 1) nodes, row by row from y = 0 up. */
static void place_tube(double radius, double half, size_t n, size_t m, double (*node)[3])
{
    for (size_t j = 0; j <= m; j++)
        for (size_t i = 0; i <= n; i++, node++) {
            const double angle = (double)i / (2.0 * (double)n);
            (*node)[0] = radius * fracas_sinpi(angle);
            (*node)[1] = half * ((double)j / (double)m);
            (*node)[2] = radius * fracas_cospi(angle) + 0.0; /* 0 is none of -0 */
        }
}

/* The node of the tube's last row nearest to a node of the octant's rim. */
static uint32_t nearest(const fracas_surface_draft *tube, size_t n, size_t m, const double x[3])
{
    uint32_t best = 0;
    double least = INFINITY;
    for (size_t k = (n + 1) * m; k < (n + 1) * (m + 1); k++) {
        const double dx = tube->node[k][0] - x[0], dz = tube->node[k][2] - x[2];
        if (dx * dx + dz * dz < least) {
            least = dx * dx + dz * dz;
            best = (uint32_t)k;
        }
    }
    return best;
}

/* Adds the octant behind the tube: nodes at y = 0 are the tube's last row, others move up
 * by `half`. */
static fracas_err add_cap(const fracas_surface_draft *cap, double half, size_t n, size_t m,
                          fracas_surface_draft *all)
{
    OWNED uint32_t *number = malloc(cap->nvertices * sizeof *number);
    size_t next = (n + 1) * (m + 1), tags = 0;
    if (!number) return fracas_no_memory("a mesh");
    for (size_t v = 0; v < cap->nvertices; v++) {
        const double *x = cap->node[v];
        if (x[1] == 0.0) number[v] = nearest(all, n, m, x);
        else {
            memcpy(all->node[next], (double[3]){x[0], x[1] + half, x[2]}, sizeof *all->node);
            number[v] = (uint32_t)next++;
        }
    }
    for (size_t k = 0; k < 3 * cap->nelements; k++)
        all->element[6 * n * m + k] = number[cap->element[k]];
    for (size_t t = 0; t < 2 * (n + m); t++)
        if (all->tag[t].tag != SEAM) all->tag[tags++] = all->tag[t];
    for (size_t t = 0; t < cap->ntags; t++) {
        const fracas_surface_tag *of = &cap->tag[t];
        if (of->tag == 2) continue; /* y = 0 */
        all->tag[tags++] = (fracas_surface_tag){.node = {number[of->node[0]], number[of->node[1]]},
                                                .tag = of->tag == 1 ? X_PLANE : Z_PLANE};
    }
    all->ntags = tags;
    return FRACAS_OK;
}

static fracas_err make_octant(double radius, double half, double n, double m,
                              fracas_surface_draft *all)
{
    FRACAS_CLEARED(fracas_surface_draft) cap = {0};
    TRY(fracas_surface_draft_octant(radius, n, &cap));
    TRY(fracas_surface_draft_init(all, (n + 1.0) * m + (double)cap.nvertices, 2.0 * n * m + n * n,
                                  5.0 * n + 2.0 * m));
    place_tube(radius, half, (size_t)n, (size_t)m, all->node);
    fracas_surface_fill_grid(all, (size_t)n, (size_t)m, false); /* tags 1, 2, 3 as here */
    return add_cap(&cap, half, (size_t)n, (size_t)m, all);
}

/* Joins a draft and its mirror image across the plane in which the coordinate k is 0, and whose
 * edges have this tag. */
static fracas_err mirror(int k, int32_t tag, fracas_surface_draft *draft)
{
    FRACAS_CLEARED(fracas_surface_draft) both = {0};
    OWNED uint32_t *image = malloc(draft->nvertices * sizeof *image);
    size_t shared = 0, next = draft->nvertices, tags = 0;
    if (!image) return fracas_no_memory("a mesh");
    for (size_t v = 0; v < draft->nvertices; v++) shared += draft->node[v][k] == 0.0;
    TRY(fracas_surface_draft_init(&both, 2.0 * (double)draft->nvertices - (double)shared,
                                  2.0 * (double)draft->nelements, 2.0 * (double)draft->ntags));
    for (size_t v = 0; v < draft->nvertices; v++) {
        memcpy(both.node[v], draft->node[v], sizeof *both.node);
        image[v] = (uint32_t)(draft->node[v][k] == 0.0 ? v : next);
        if (image[v] == v) continue;
        memcpy(both.node[next], draft->node[v], sizeof *both.node);
        both.node[next++][k] *= -1.0;
    }
    for (size_t e = 0; e < draft->nelements; e++)
        for (size_t c = 0; c < 3; c++) {
            both.element[3 * e + c] = draft->element[3 * e + c];
            both.element[3 * (draft->nelements + e) + c] = image[draft->element[3 * e + 2 - c]];
        }
    for (size_t t = 0; t < draft->ntags; t++) {
        const fracas_surface_tag *of = &draft->tag[t];
        if (of->tag == tag) continue;
        both.tag[tags++] = *of;
        both.tag[tags++] = (fracas_surface_tag){.node = {image[of->node[0]], image[of->node[1]]},
                                                .tag = of->tag};
    }
    both.ntags = tags;
    fracas_surface_draft_clear(draft);
    *draft = both;
    both = (fracas_surface_draft){0};
    return FRACAS_OK;
}

fracas_err fracas_surface_capsule(double radius, double length, int planes,
                                  const fracas_surface_fineness *fineness,
                                  const fracas_surface **surface)
{
    const double quarter = 0.5 * FRACAS_PI * radius, half = 0.5 * length;
    double n;
    TRY(fracas_surface_check_length("the radius", radius));
    TRY(fracas_surface_check_length("the length", length));
    TRY(fracas_surface_divide(fineness, quarter, FRACAS_SURFACE_LEG, &n));
    if (fineness->amplitude > LARGEST_AMPLITUDE)
        return fracas_fail(FRACAS_USAGE,
                           "the amplitude of a capsule's mesh is %g: it should be at most %g, for "
                           "beyond elements can fold at its poles and seams",
                           fineness->amplitude, LARGEST_AMPLITUDE);
    const double m = fmax(1.0, floor(half * (n / quarter) + 0.5));
    FRACAS_CLEARED(fracas_surface_draft) draft = {0};
    TRY(make_octant(radius, half, n, m, &draft));
    if (planes < 3) TRY(mirror(1, Y_PLANE, &draft));
    if (planes < 2) TRY(mirror(0, X_PLANE, &draft));
    if (planes < 1) TRY(mirror(2, Z_PLANE, &draft));
    draft.round = radius;
    draft.axis = half;
    for (int t = 0; t < FRACAS_SURFACE_TAGS; t++) draft.radius[t] = radius;
    return fracas_surface_draft_finish(&draft, fineness, surface);
}
