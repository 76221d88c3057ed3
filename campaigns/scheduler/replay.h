/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One realization of a study computed again, in this process alone, as a run computes it. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_REPLAY_H
#define FRACAS_CAMPAIGNS_SCHEDULER_REPLAY_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/field_files.h"
#include "engine/engine.h"

typedef struct {
    const fracas_campaign *campaign;
    size_t point;
    int64_t replica;
    fracas_record stored; /* as the study has it */
    double overlap; /* share at the last instant of fields (engine/fragments/overlap.h); NaN: no
                       fields */
} fracas_replay;

/* Finds the realization in STUDY, whose campaign this is; study and campaign must outlive *replay.
 * FRACAS_USAGE if the campaign has no such realization or it FAILED, FRACAS_INTERRUPTED if it is
 * not done yet, FRACAS_DAMAGED if another program version computed it; and as fracas_results_open.
 */
FRACAS_MUST_USE fracas_err fracas_replay_find(const char *study, const fracas_campaign *campaign,
                                              size_t point, int64_t replica, fracas_replay *replay);
void fracas_replay_clear(fracas_replay *replay); /* all zero is allowed */

/* Computes it again, and sets `overlap`. FRACAS_DAMAGED, naming the first column that differs,
 * unless its record has the bytes of the study's. With a request (NULL: none) writes its fields on
 * the way, saying to `out` (NULL: nowhere) before how much; errors as fracas_field_files_open. */
FRACAS_MUST_USE fracas_err fracas_replay_run(fracas_replay *replay,
                                             const fracas_fields_request *request, FILE *out);

#endif
