/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fragments of a lane, their motions, and the rest of their velocities. */
#ifndef FRACAS_ENGINE_SOLVER_PIECES_H
#define FRACAS_ENGINE_SOLVER_PIECES_H

#include "engine/formulation/formulation.h"

typedef struct {
    size_t count;
    fracas_fragment_motion *motion; /* [count] */
    fracas_fragment_sums *beside;   /* [count]: with velocities less those of the motion */
} fracas_pieces;

/* Labels the partition of a lane and finds the motion of this kind of each fragment
 * (fragments.5): RIGID is that of the laboratory's velocities, others are of those of add_up.
 * Cleared by the caller, also after an error. */
FRACAS_MUST_USE fracas_err fracas_pieces_find(const fracas_model *model, fracas_step *step,
                                              int lane, fracas_motion kind, fracas_pieces *pieces);
void fracas_pieces_clear(fracas_pieces *pieces);

#endif
