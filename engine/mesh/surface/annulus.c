/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Circles of nodes, as many as their lengths ask for, and strips of triangles between them. */
#include "base/elementary.h"
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <math.h>

#define ROW 0.86602540378443865 /* altitude of an equilateral triangle by its edge */
#define LEAST_NODES 8.0 /* on a circle: bent edges of fewer come too close to opposite vertices */

typedef struct {
    double inner, outer;
    double layers;
} annulus;

static double radius_of(const annulus *body, double circle)
{
    return body->inner + (body->outer - body->inner) * (circle / body->layers);
}

/* (meshes.4) */
static double nodes_of(const annulus *body, double circle)
{
    const double edge = (body->outer - body->inner) / (body->layers * ROW);
    return fmax(LEAST_NODES, floor(2.0 * FRACAS_PI * radius_of(body, circle) / edge + 0.5));
}

/* Every other circle is turned by half an edge. */
static void fill_circle(const annulus *body, size_t circle, size_t count, double (*node)[3])
{
    const double radius = radius_of(body, (double)circle);
    for (size_t i = 0; i < count; i++) {
        const double angle = (double)(2 * i + circle % 2) / (double)count; /* in pi */
        node[i][0] = radius * fracas_cospi(angle);
        node[i][1] = radius * fracas_sinpi(angle);
        node[i][2] = 0.0;
    }
}

/* Advances on the circle whose next edge has its middle first; `circle`: the inner one. */
static uint32_t *fill_strip(size_t circle, size_t inner, size_t outer, uint32_t first,
                            uint32_t *put)
{
    const size_t turn_in = circle % 2, turn_out = 1 - turn_in;
    size_t a = 0, b = 0;
    while (a < inner || b < outer) {
        const uint32_t from_in = first + (uint32_t)(a % inner),
                       from_out = first + (uint32_t)(inner + b % outer);
        *put++ = from_in;
        *put++ = from_out;
        if (b == outer ||
            (a < inner && (2 * a + 1 + turn_in) * outer < (2 * b + 1 + turn_out) * inner))
            *put++ = first + (uint32_t)(++a % inner);
        else *put++ = first + (uint32_t)(inner + ++b % outer);
    }
    return put;
}

static fracas_surface_tag *fill_tags(size_t count, uint32_t first, int32_t tag,
                                     fracas_surface_tag *put)
{
    for (uint32_t i = 0; i < count; i++)
        *put++ = (fracas_surface_tag){.node = {first + i, first + (uint32_t)((i + 1) % count)},
                                      .tag = tag};
    return put;
}

static void fill(const annulus *body, fracas_surface_draft *draft)
{
    const size_t layers = (size_t)body->layers;
    size_t first = 0, count = (size_t)nodes_of(body, 0.0);
    fracas_surface_tag *tag = fill_tags(count, 0, 1, draft->tag);
    uint32_t *element = draft->element;
    for (size_t circle = 0; circle < layers; circle++) {
        const size_t next = (size_t)nodes_of(body, (double)circle + 1.0);
        fill_circle(body, circle, count, draft->node + first);
        element = fill_strip(circle, count, next, (uint32_t)first, element);
        first += count;
        count = next;
    }
    fill_circle(body, layers, count, draft->node + first);
    fill_tags(count, (uint32_t)first, 2, tag);
    draft->radius[1] = body->inner;
    draft->radius[2] = body->outer;
}

fracas_err fracas_surface_annulus(double inner, double outer,
                                  const fracas_surface_fineness *fineness,
                                  const fracas_surface **surface)
{
    TRY(fracas_surface_check_length("the inner radius", inner));
    TRY(fracas_surface_check_length("the outer radius", outer));
    if (!(outer - inner >= 1e-6 * outer))
        return fracas_fail(FRACAS_USAGE,
                           "the outer radius of an annulus is %g m, the inner one %g m: it should "
                           "be larger, by a millionth at least",
                           outer, inner);
    annulus body = {.inner = inner, .outer = outer};
    TRY(fracas_surface_divide(fineness, outer - inner, ROW, &body.layers));
    const double ends = nodes_of(&body, 0.0) + nodes_of(&body, body.layers);
    double vertices = nodes_of(&body, 0.0);
    /* Stops where fracas_surface_draft_init will refuse. */
    for (double circle = 1.0; circle <= body.layers && vertices <= (double)FRACAS_SURFACE_LARGEST;
         circle++)
        vertices += nodes_of(&body, circle);
    FRACAS_CLEARED(fracas_surface_draft) draft = {0};
    TRY(fracas_surface_draft_init(&draft, vertices, 2.0 * vertices - ends, ends));
    fill(&body, &draft);
    return fracas_surface_draft_finish(&draft, fineness, surface);
}
