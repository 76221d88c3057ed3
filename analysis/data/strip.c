/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/strip.h"

#include "analysis/data/chain.h"
#include "base/own.h"

#include <math.h>
#include <stdlib.h>

static const double band = 0.1;         /* width of a circle's strip / radius */
static const double slender = 1.0 / 12; /* width of a bar's / length */

enum { NEAR, FAR, NEAR_MIDDLE, FAR_MIDDLE, SIDES }; /* nodes of an element's front and sides */

typedef struct {
    fracas_stored_mesh *mesh;
    size_t n;      /* elements of the chain */
    bool closed;   /* a circle */
    double length; /* m */
} strip;

/* Node of the section in front of element e, or half way along its side. */
static int64_t node_of(const strip *s, size_t e, int which)
{
    const size_t section = s->closed ? e % s->n : e;
    return (int64_t)(which < NEAR_MIDDLE ? 2 * section + (size_t)which
                                         : 2 * s->n + 2 * section + (size_t)(which - NEAR_MIDDLE));
}

static int64_t middle_of(const strip *s, size_t e, int which)
{
    return s->closed ? node_of(s, e, which) : -1;
}

/* The inner side of a circle is near, its outer one far: triangles go counter-clockwise. */
static void put_node(const strip *s, int64_t node, double along, int side)
{
    double *at = s->mesh->node[node].position;
    if (!s->closed) {
        at[0] = along;
        at[1] = side == NEAR ? slender * s->length : 0;
        return;
    }
    const double radius = s->length / (2 * M_PI), angle = along / radius;
    const double distance = radius * (1 + (side % 2 == NEAR ? -band / 2 : band / 2));
    at[0] = distance * cos(angle);
    at[1] = distance * sin(angle);
}

static void place(const strip *s, const double *along)
{
    for (size_t e = 0; e <= s->n; e++)
        for (int side = 0; side < (s->closed ? SIDES : NEAR_MIDDLE) && e < s->n + !s->closed;
             side++) {
            const double half = side >= NEAR_MIDDLE ? (along[e + 1] - along[e]) / 2 : 0;
            put_node(s, node_of(s, e, side), along[e] + half, side);
        }
}

/* Both triangles of each element, and the interface between them. */
static void put_elements(const strip *s, size_t first)
{
    for (size_t e = 0; e < s->n; e++) {
        const int64_t a = node_of(s, e, NEAR), b = node_of(s, e, FAR), c = node_of(s, e + 1, FAR),
                      d = node_of(s, e + 1, NEAR);
        const int64_t one = (int64_t)(2 * e), other = one + 1;
        const int64_t far = middle_of(s, e, FAR_MIDDLE), near = middle_of(s, e, NEAR_MIDDLE);
        s->mesh->element[one] = (fracas_stored_element){{a, b, c, -1, far, -1}};
        s->mesh->element[other] = (fracas_stored_element){{a, c, d, -1, -1, near}};
        s->mesh->interface[first + e] = (fracas_stored_interface){{one, other}, {c, a, -1}};
        s->mesh->border[2 * e] = (fracas_stored_border){one, {b, c, far}, 0};
        s->mesh->border[2 * e + 1] = (fracas_stored_border){other, {d, a, near}, 0};
    }
    if (s->closed) return;
    const int64_t last = (int64_t)(2 * s->n - 1);
    s->mesh->border[2 * s->n] = (fracas_stored_border){
        0, {node_of(s, 0, NEAR), node_of(s, 0, FAR), -1}, 0};
    s->mesh->border[2 * s->n + 1] = (fracas_stored_border){
        last, {node_of(s, s->n, FAR), node_of(s, s->n, NEAR), -1}, 0};
}

/* Interface i is between elements i and i + 1. */
static void put_interfaces(const strip *s, size_t count)
{
    for (size_t i = 0; i < count; i++)
        s->mesh->interface[i] = (fracas_stored_interface){
            {(int64_t)(2 * i + 1), (int64_t)(2 * (i + 1) % (2 * s->n))},
            {node_of(s, i + 1, FAR), node_of(s, i + 1, NEAR), -1}};
}

fracas_err fracas_strip_create(fracas_record *record, fracas_stored_mesh *mesh)
{
    const size_t between = record->ninterface;
    fracas_chain chain;
    TRY(fracas_chain_of(record, &chain));
    const strip s = {mesh, chain.elements, chain.closed, chain.length};
    OWNED double *along = malloc((s.n + 1) * sizeof *along);
    if (!along) return fracas_no_memory("the elements of a picture");
    fracas_chain_along(&chain, record, along);
    *mesh = (fracas_stored_mesh){.nnodes = s.closed ? SIDES * s.n : 2 * (s.n + 1),
                                 .nelements = 2 * s.n,
                                 .ninterfaces = between + s.n,
                                 .nborders = 2 * s.n + (s.closed ? 0 : 2)};
    TRY(fracas_stored_mesh_allocate(mesh));
    place(&s, along);
    put_interfaces(&s, between);
    put_elements(&s, between);
    fracas_interface_row *row = realloc(record->interface, mesh->ninterfaces * sizeof *row);
    if (!row) return fracas_no_memory("the interfaces of a picture");
    for (size_t i = between; i < mesh->ninterfaces; i++)
        row[i] = (fracas_interface_row){NAN, 0, NAN, NAN};
    record->interface = row;
    record->ninterface = mesh->ninterfaces;
    return FRACAS_OK;
}
