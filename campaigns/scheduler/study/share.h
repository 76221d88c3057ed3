/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What of a campaign a run computes: --replicas and --part. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STUDY_SHARE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STUDY_SHARE_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/run.h"
#include "campaigns/store/store.h"

/* Reads options->file (fracas_campaign_read), with options->replicas in place of its own.
 * FRACAS_USAGE also where a rule decides the replicas of a point, which neither options->replicas
 * nor options->parts go with. */
FRACAS_MUST_USE fracas_err fracas_run_campaign(const fracas_run_options *options,
                                               fracas_campaign **campaign);

/* Of rows in plan order, moves those of part K (from 1) of N to the front: every N-th one, from the
 * K-th on; of fewer than 2 parts all. Returns how many. */
size_t fracas_run_part(int part, int parts, fracas_index_row *row, size_t count);

#endif
