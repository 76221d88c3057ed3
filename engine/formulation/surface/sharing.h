/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A surface shared among peers, processes that compute it together: each has consecutive blocks of
 * elements, and memory for the whole body, of which it keeps up to date its own elements and the
 * interfaces at them. After each step peers tell each other the unknowns of elements that have an
 * interface with the other's, the sums of the greatest branches of their blocks' tree, and events.
 * So all have the same energies, and decide the same. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_SHARING_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_SHARING_H

#include "base/own.h"
#include "engine/formulation/formulation.h"

struct fracas_surface_constants;
typedef struct fracas_surface_sharing fracas_surface_sharing;

/* The first of peer `number`'s blocks; `number` may be `count`. */
static inline size_t fracas_surface_share(size_t blocks, size_t number, size_t count)
{
    return number * blocks / count;
}

/* Which elements are whose neighbours. `peers` must outlive it. FRACAS_ENVIRONMENT without memory.
 */
FRACAS_MUST_USE fracas_err fracas_surface_sharing_create(const struct fracas_surface_constants *c,
                                                         const fracas_peers *peers,
                                                         fracas_surface_sharing **sharing);
void fracas_surface_sharing_destroy(fracas_surface_sharing *sharing); /* NULL is allowed */

/* Notes the counts of events before a step. */
void fracas_surface_sharing_begin(fracas_surface_sharing *sharing, const fracas_step *step);

/* Adds the sums of blocks of several peers, after they have told them, in a group of lanes. */
void fracas_surface_sharing_add(const fracas_surface_sharing *sharing, double *sums, size_t size);

#endif
