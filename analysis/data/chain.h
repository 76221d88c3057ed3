/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The elements of a bar or ring, which a study does not store, as they were before any motion. */
#ifndef FRACAS_ANALYSIS_DATA_CHAIN_H
#define FRACAS_ANALYSIS_DATA_CHAIN_H

#include "base/err.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/mesh.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    size_t elements; /* 2 or more */
    bool closed;     /* a ring, or a bar with periodic ends: as many interfaces as elements */
    double length;   /* m */
} fracas_chain;

/* The chain of a record with fragments and interfaces. FRACAS_DAMAGED if the interfaces are not
 * those between its elements. */
FRACAS_MUST_USE fracas_err fracas_chain_of(const fracas_record *record, fracas_chain *chain);

/* along[0..elements]: where elements begin, and the last one ends [m]. Elements of a fragment are
 * equally long; a closed chain's last ones may be those of its first. */
void fracas_chain_along(const fracas_chain *chain, const fracas_record *record, double *along);

/* The chain as a mesh of lines from x = 0 on, or, `round`, as chords of a circle around the origin.
 * A node of an interface is where its elements meet. *mesh is all zero before, and cleared by the
 * caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_chain_mesh(const fracas_record *record, bool round,
                                             fracas_stored_mesh *mesh);

#endif
