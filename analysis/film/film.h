/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A film of a body that moves: a page of its own, which draws it at any of its instants, from any
 * side. */
#ifndef FRACAS_ANALYSIS_FILM_FILM_H
#define FRACAS_ANALYSIS_FILM_FILM_H

#include "base/err.h"
#include "base/own.h"

#include <stddef.h>
#include <stdint.h>

/* Values that say how elements are loaded. */
typedef struct {
    const char *name; /* NULL: none */
    const char *unit;
    const double *value; /* [element][components] */
    size_t components;   /* 1, or 6: xx, yy, zz, xy, yz, xz */
} fracas_film_stress;
enum { FRACAS_FILM_STRESSES = 2 };

/* The body at an instant, as fracas_fields has it: the arrays belong to the caller. */
typedef struct {
    size_t elements, corners;        /* nodes of an element: 2, 3 or 6, in VTK's order */
    size_t interfaces, ends;         /* nodes of an interface: 1, 2 or 3 */
    double time;                     /* s */
    const double (*place)[3];        /* [element][corner] m, now */
    const double (*displacement)[3]; /* the same, m */
    const double (*velocity)[3];     /* the same, m/s */
    fracas_film_stress stress[FRACAS_FILM_STRESSES];
    const int64_t *fragment;     /* [element], from 0 */
    const int64_t (*between)[2]; /* [interface] its two elements */
    const double *damage;        /* [interface] 0 to 1 */
} fracas_film_instant;

#define FRACAS_FILM_BYTES 200e6 /* a page has at most: browsers hold it all */

typedef struct fracas_film fracas_film;

/* Bytes of a page with so many instants of a body like this one. */
double fracas_film_bytes(const fracas_film_instant *like, size_t instants);

/* Room for so many instants of the body. */
FRACAS_MUST_USE fracas_err fracas_film_create(const fracas_film_instant *first, size_t most,
                                              fracas_film **film);
void fracas_film_destroy(fracas_film *film); /* NULL is allowed */
FRACAS_OWNER(fracas_film, fracas_film_destroy)

/* Keeps the body as it is now; no more than `most` times. */
FRACAS_MUST_USE fracas_err fracas_film_add(fracas_film *film, const fracas_film_instant *now);

/* Writes the page FOLDER/NAME, where `how` says how the body moves, whole or not at all.
 * Displacements are kept to 1/131070 of the range of their component over all instants, speeds and
 * the principal stresses of the largest amount to 1/510 of theirs. */
FRACAS_MUST_USE fracas_err fracas_film_write(const fracas_film *film, const char *folder,
                                             const char *name, const char *title, const char *how);

#endif
