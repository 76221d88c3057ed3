/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small meshes, and what is true of every surface. */
#ifndef FRACAS_TESTS_SUPPORT_SURFACE_H
#define FRACAS_TESTS_SUPPORT_SURFACE_H

#include "base/hash.h"
#include "base/param.h"
#include "engine/mesh/surface/cylinder.h"
#include "tests/support/test.h"

/* The numbers 2^-32 k, 0 <= k < 2^32, spread at random. */
static inline double next_share(uint64_t *x)
{
    *x = *x * 6364136223846793005u + 1442695040888963407u;
    return (double)(*x >> 32) * 0x1p-32;
}

/* A surface ending with its scope: OWN(a_surface). */
typedef const fracas_surface a_surface;
FRACAS_OWNER(a_surface, fracas_surface_destroy)

/* Bodies of two lengths [m], or of one. */
typedef enum {
    SHAPE_RECTANGLE,
    SHAPE_ANNULUS,
    SHAPE_SPHERE,
    SHAPE_OCTANT,
    SHAPE_TUBE, /* and cut by one to three planes of symmetry */
    SHAPE_TUBE_HALF,
    SHAPE_TUBE_QUARTER,
    SHAPE_TUBE_OCTANT
} body_shape;

static inline a_surface *surface_of(body_shape shape, const double length[2],
                                    const fracas_surface_fineness *fineness)
{
    a_surface *surface = NULL;
    switch (shape) {
    case SHAPE_RECTANGLE:
        OK(fracas_surface_rectangle(length[0], length[1], fineness, &surface));
        break;
    case SHAPE_ANNULUS: OK(fracas_surface_annulus(length[0], length[1], fineness, &surface)); break;
    case SHAPE_SPHERE: OK(fracas_surface_sphere(length[0], fineness, &surface)); break;
    case SHAPE_OCTANT: OK(fracas_surface_octant(length[0], fineness, &surface)); break;
    case SHAPE_TUBE:
    case SHAPE_TUBE_HALF:
    case SHAPE_TUBE_QUARTER:
    case SHAPE_TUBE_OCTANT:
        OK(fracas_surface_cylinder(length[0], length[1], (int)(shape - SHAPE_TUBE), fineness,
                                   &surface));
        break;
    }
    return surface;
}

/* The same, its nodes moved by 0.3 of the room that they have: by random numbers, or (`ends`) by
 * the ends of their range. */
static inline a_surface *surface_moved(body_shape shape, const double length[2], size_t divisions,
                                       int order, uint64_t seed, bool ends)
{
    fracas_surface_fineness fineness = {.divisions = divisions, .order = 1};
    OWN(a_surface) plain = surface_of(shape, length, &fineness);
    double(*shift)[2] = taken(plain->nvertices * sizeof *shift);
    for (size_t v = 0; v < plain->nvertices; v++)
        for (int i = 0; i < 2; i++) {
            shift[v][i] = 2.0 * next_share(&seed) - 1.0;
            if (ends) shift[v][i] = shift[v][i] < 0.0 ? -1.0 : 1.0;
        }
    fineness = (fracas_surface_fineness){.divisions = divisions,
                                         .order = order,
                                         .amplitude = 0.3,
                                         .shift = (const double(*)[2])shift,
                                         .nshifts = plain->nvertices};
    a_surface *surface = surface_of(shape, length, &fineness);
    free(shift);
    return surface;
}

static inline long euler(const fracas_surface *s)
{
    return (long)s->nvertices - (long)(s->ninterfaces + s->nborders) + (long)s->nelements;
}

static inline uint32_t corner_of(const fracas_surface *s, size_t element, size_t corner)
{
    return s->element[element * s->corners + corner];
}

/* Interfaces and borders hold each edge of each element once, in order, and join sides that have
 * the same nodes. */
static inline void check_edges(const fracas_surface *s)
{
    OWNED uint8_t *seen = zeroed(3 * s->nelements, 1);
    for (size_t i = 0; i < s->ninterfaces; i++) {
        const fracas_surface_interface *f = &s->interface[i];
        assert_true(f->element[0] < f->element[1] && f->element[1] < s->nelements &&
                    f->edge[0] < 3 && f->edge[1] < 3);
        if (i > 0) {
            const fracas_surface_interface *before = f - 1;
            assert_true(
                before->element[0] < f->element[0] ||
                (before->element[0] == f->element[0] && before->element[1] < f->element[1]));
        }
        for (int k = 0; k < 2; k++) assert_int_equal(seen[3 * f->element[k] + f->edge[k]]++, 0);
        const uint32_t a = f->edge[0], b = f->edge[1];
        assert_int_equal(corner_of(s, f->element[0], a), corner_of(s, f->element[1], (b + 1) % 3));
        assert_int_equal(corner_of(s, f->element[0], (a + 1) % 3), corner_of(s, f->element[1], b));
        if (s->order == 2)
            assert_int_equal(corner_of(s, f->element[0], 3 + a),
                             corner_of(s, f->element[1], 3 + b));
    }
    for (size_t i = 0; i < s->nborders; i++) {
        const fracas_surface_border *f = &s->border[i];
        assert_true(f->element < s->nelements && f->edge < 3);
        if (i > 0) assert_true(3 * f[-1].element + f[-1].edge < 3 * f->element + f->edge);
        assert_int_equal(seen[3 * f->element + f->edge]++, 0);
    }
    for (size_t i = 0; i < 3 * s->nelements; i++) assert_int_equal(seen[i], 1);
}

/* Everything in a surface, as one number: the same on every machine. */
static inline uint64_t checksum_of(const fracas_surface *s)
{
    OWN(fracas_checksum) sum;
    OK(fracas_checksum_create(&sum));
    fracas_checksum_add(sum, s->node, s->nnodes * sizeof *s->node);
    fracas_checksum_add(sum, s->element, s->nelements * s->corners * sizeof *s->element);
    fracas_checksum_add(sum, s->interface, s->ninterfaces * sizeof *s->interface);
    fracas_checksum_add(sum, s->border, s->nborders * sizeof *s->border);
    fracas_checksum_add(sum, s->given, s->nelements * sizeof *s->given);
    const uint64_t value = fracas_checksum_end(sum);
    return value;
}

#endif
