/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The realizations of a run: --replicas and --part. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_PART_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_PART_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/options.h"
#include "campaigns/store/store.h"

/* Reads options->file (fracas_campaign_read), with options->replicas in place of its own.
 * FRACAS_USAGE also for options->replicas or options->parts together with a rule for replicas. */
FRACAS_MUST_USE fracas_err fracas_run_campaign(const fracas_run_options *options,
                                               fracas_campaign **campaign);

/* Moves the rows of a part to the front and returns their number: rows part - 1, part - 1 + parts,
 * ... among `count` rows in plan order, or all with fewer than 2 parts. */
size_t fracas_run_part(int part, int parts, fracas_index_row *row, size_t count);

#endif
