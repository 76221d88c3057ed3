/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion of points of the body at the times of the history (docs/theory/probes.md). */
#ifndef FRACAS_ENGINE_SOLVER_PROBES_H
#define FRACAS_ENGINE_SOLVER_PROBES_H

#include "engine/formulation/formulation.h"

/* Values of a probe: displacement, velocity. */
enum {
    FRACAS_SPOT_VALUES = 6,
    FRACAS_SPOTS_VALUES = FRACAS_MOST_PROBES * FRACAS_SPOT_VALUES + 3 * FRACAS_HOLDERS
};

typedef struct {
    size_t count;
    fracas_spot spot[FRACAS_MOST_PROBES];
    size_t edges; /* held ones, whose forces are kept behind the probes' values */
    int64_t edge[FRACAS_HOLDERS];
} fracas_spots;

/* The points of the probes (NULL: none) and, with `reactions`, the held edges; errors of
 * fracas_model_check_probes. */
FRACAS_MUST_USE fracas_err fracas_spots_find(const fracas_model *model, const fracas_probes *probes,
                                             bool reactions, fracas_spots *spots);

static inline size_t fracas_spots_values(const fracas_spots *spots)
{
    return spots->count * FRACAS_SPOT_VALUES + 3 * spots->edges;
}

/* Their values after a step. */
void fracas_spots_look(const fracas_spots *spots, const fracas_model *model,
                       const fracas_step *step, int lane, double value[FRACAS_SPOTS_VALUES]);

/* Rows of probes and reactions of a record with its history, from the values of each of its rows.
 */
FRACAS_MUST_USE fracas_err fracas_spots_take(const fracas_spots *spots, const double *value,
                                             fracas_record *record);

#endif
