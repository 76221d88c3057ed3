/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which fragments of a surface are drawn in which tint. */
#ifndef FRACAS_ANALYSIS_DRAW_TINT_H
#define FRACAS_ANALYSIS_DRAW_TINT_H

#include "analysis/data/surface.h"

enum { FRACAS_TINTS = 7, FRACAS_TINT_DUST = FRACAS_TINTS };

/* *tint: one for each fragment, freed by the caller; FRACAS_TINT_DUST for dust. The largest
 * fragment comes first; each gets the tint with the shortest common border, of several the one with
 * the fewest elements so far. */
FRACAS_MUST_USE fracas_err fracas_tint_fragments(const fracas_stored_mesh *mesh,
                                                 const fracas_surface_state *state, uint8_t **tint);

#endif
