/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far fragments lie over each other: without contact they pass through each other. */
#ifndef FRACAS_ENGINE_FRAGMENTS_OVERLAP_H
#define FRACAS_ENGINE_FRAGMENTS_OVERLAP_H

#include "engine/fields.h"

/* *overlap = sum |e n e'| over pairs of elements of different fragments by sum |e|  (fragments.9),
 * 1: lengths of elements on the x axis, areas of those in a plane z = const, by their corners as
 * they are now. NaN for other bodies, for which it is not defined. FRACAS_ENVIRONMENT without
 * memory. Time: proportional to elements^(3/2). */
FRACAS_MUST_USE fracas_err fracas_fragments_overlap(const fracas_fields *fields, double *overlap);

#endif
