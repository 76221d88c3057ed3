/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Breaks announced by the energies of fragments (docs/theory/settled.md). */
#ifndef FRACAS_ENGINE_FRAGMENTS_REST_H
#define FRACAS_ENGINE_FRAGMENTS_REST_H

#include <stddef.h>

/* Breaks still to come, of all fragments; NaN where it is unknown. */
typedef struct {
    double mean;     /* R */
    double variance; /* fragments are independent */
    double bound;    /* B: no more without energy from outside */
} fracas_rest;

#define FRACAS_REST_UNKNOWN ((fracas_rest){NAN, NAN, NAN})

/* Adds a fragment of internal energy E [J] whose unbroken interfaces still need `cost[count]` [J]
 * each, in any order; they are sorted. `parting`: largest energy with which an interface's two
 * sides fly apart, by its cost  (settled.3) to (settled.6). */
void fracas_rest_add(fracas_rest *rest, double energy, double *cost, size_t count, double parting);

#endif
