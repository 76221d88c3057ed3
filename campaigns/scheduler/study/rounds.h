/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rounds of a study whose replicas a rule decides (docs/theory/sequential.md): which points go
 * on, and the decisions in the index. What is decided depends on the values of a round's replicas
 * alone, not on when they came. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STUDY_ROUNDS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STUDY_ROUNDS_H

#include "campaigns/campaign.h"
#include "campaigns/store/store.h"

#include <stdbool.h>

typedef struct {
    const fracas_campaign *campaign;
    fracas_point_table table; /* of the campaign, with the replicas that every point has by now */
    fracas_point_row *point;  /* table.point */
    int64_t *round;           /* of each point, the one that is being computed */
    size_t open;              /* points with a rule that have not stopped */
    bool *stopped;            /* of each point; true without a rule */
} fracas_rounds;

/* Decides, round by round, all that the index has every realization for, and plans what follows. A
 * round that is not complete (any more) goes as it was decided by the same rule before.
 * FRACAS_DAMAGED, naming point and round, if a recorded decision is not what its realizations give.
 * The campaign must outlive *rounds, which the caller clears, after an error too. */
FRACAS_MUST_USE fracas_err fracas_rounds_init(fracas_rounds *rounds,
                                              const fracas_campaign *campaign, fracas_index *index);
void fracas_rounds_clear(fracas_rounds *rounds);

/* Decides the rounds of one point that are complete by now, and plans what follows:
 * rounds->point[p].replicas grows. */
FRACAS_MUST_USE fracas_err fracas_rounds_advance(fracas_rounds *rounds, fracas_index *index,
                                                 size_t p);
/* The same for the points of a segment that was committed, all at once: a design may have thousands
 * of them. */
FRACAS_MUST_USE fracas_err fracas_rounds_hear(fracas_rounds *rounds, fracas_index *index,
                                              const fracas_segment_row *row, size_t count);

/* When every point has stopped: FRACAS_DAMAGED, naming point and round, unless every recorded
 * decision is what its realizations give, and they are all. */
FRACAS_MUST_USE fracas_err fracas_rounds_check(const fracas_campaign *campaign,
                                               fracas_index *index);

#endif
