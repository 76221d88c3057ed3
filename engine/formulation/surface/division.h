/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A surface divided into parts, which are computed at once, and the order in which each part visits
 * its elements and interfaces in one pass: an element has its turn, then come the interfaces with
 * elements before it, then the elements that have all their interfaces by then are finished.
 *
 * A part is a range of consecutive elements, whole blocks of sums. Elements of other parts that
 * share an interface with it are its ghosts: it has copies of their displacements and velocities,
 * takes their turns in the same order, and drops their forces. Both parts compute the interfaces
 * between them, from the same numbers in the same order; the one with the second element counts
 * events and energies. So nothing but the copies goes between parts, once a step, and no bit
 * depends on their number. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_DIVISION_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_DIVISION_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct fracas_surface_constants;

/* Places in a group's memory are counted in fields from its start (layout.h). */
typedef struct {
    uint32_t element;               /* its number */
    uint32_t at, slot;              /* places of its fields, and of its stresses and forces */
    uint32_t facet_end, finish_end; /* its interfaces and finished elements begin with the ends of
                                      the turn before */
    bool ghost;
} fracas_surface_turn;

typedef struct {
    uint32_t interface; /* its number */
    uint32_t at;        /* place of its fields */
    uint32_t element[2], slot[2];
    uint8_t edge[2]; /* which of its elements' edges */
} fracas_surface_facet;

typedef struct {
    uint32_t element, at, slot;
} fracas_surface_finish;

/* Fields to be copied before a step. */
typedef struct {
    uint32_t from, to, count;
} fracas_surface_copy;

typedef struct {
    size_t turns, copies;
    fracas_surface_turn *turn;
    fracas_surface_facet *facet;
    fracas_surface_finish *finish;
    fracas_surface_copy *copy;
} fracas_surface_part;

/* Components of an element that an edge holds, or a set of nodes. */
typedef struct {
    uint32_t element;
    uint32_t edge; /* number among the body's held edges, then its sets of nodes */
    uint32_t held; /* bit dimension node + component */
} fracas_surface_hold;

typedef struct {
    size_t parts;
    fracas_surface_part *part;
    size_t sums;   /* place of the sums of all blocks */
    size_t fields; /* a lane's, in a group's memory */
    /* Forces and accelerations of elements with held nodes, for reactions: place of the first row,
     * and of each element the number of its row + 1, 0: it has none. NULL: nobody asks for any. */
    size_t kept;
    uint32_t *kept_row; /* [element] */
    size_t holds;
    fracas_surface_hold *hold; /* sorted by their edges */
} fracas_surface_division;

/* Divides a body into `parts`, or as many as it has blocks; with `reactions` it keeps forces of
 * held elements. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err
fracas_surface_division_create(const struct fracas_surface_constants *constants, size_t parts,
                               bool reactions, fracas_surface_division **division);
void fracas_surface_division_destroy(void *division); /* NULL is allowed */

#endif
