/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rounds of a study with a rule for replicas (docs/theory/sequential.md), and their decisions
 * in the index. A decision depends only on the values of the round's replicas, not on their order
 * in time. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_ROUNDS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_ROUNDS_H

#include "campaigns/campaign.h"
#include "campaigns/store/index.h"

#include <stdbool.h>

typedef struct {
    const fracas_campaign *campaign;
    fracas_point_table table; /* the campaign's, with the present replicas of every point */
    fracas_point_row *point;  /* table.point */
    int64_t *round;           /* present round of each point */
    size_t open;              /* points with a rule, not yet stopped */
    bool *stopped;            /* one a point; true without a rule */
} fracas_rounds;

/* Decides all rounds whose realizations are complete in the index, and plans the following ones. An
 * incomplete round goes by its recorded decision of the same rule. FRACAS_DAMAGED, naming point and
 * round, if a recorded decision contradicts its realizations. The campaign must outlive *rounds,
 * which the caller clears, also after an error. */
FRACAS_MUST_USE fracas_err fracas_rounds_init(fracas_rounds *rounds,
                                              const fracas_campaign *campaign, fracas_index *index);
void fracas_rounds_clear(fracas_rounds *rounds);

/* Decides the complete rounds of one point and plans the next: rounds->point[p].replicas grows. */
FRACAS_MUST_USE fracas_err fracas_rounds_advance(fracas_rounds *rounds, fracas_index *index,
                                                 size_t p);
/* The same for all points of a committed segment in one transaction: a design may have thousands.
 */
FRACAS_MUST_USE fracas_err fracas_rounds_commit(fracas_rounds *rounds, fracas_index *index,
                                                const fracas_segment_row *row, size_t count);

/* When every point has stopped: FRACAS_DAMAGED, naming point and round, unless the recorded
 * decisions are exactly those of the realizations. */
FRACAS_MUST_USE fracas_err fracas_rounds_check(const fracas_campaign *campaign,
                                               fracas_index *index);

#endif
