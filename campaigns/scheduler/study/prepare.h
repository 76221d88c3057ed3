/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study before and at the start of a run. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STUDY_PREPARE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STUDY_PREPARE_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/run.h"
#include "campaigns/store/store.h"

#include <stdbool.h>

/* The study folder of a run: options->study or studies/<name>; FRACAS_USAGE if the path is too
 * long. */
FRACAS_MUST_USE fracas_err fracas_study_folder(const fracas_run_options *options,
                                               const fracas_campaign *campaign, char *study,
                                               size_t size);

/* Writes FOLDER/NAME, the campaign as resolved, and copies of the files it names beside it; each
 * whole or not at all. The folders are made if they are not there. */
FRACAS_MUST_USE fracas_err fracas_campaign_keep(const fracas_campaign *campaign, const char *folder,
                                                const char *name);

/* FRACAS_OK when there is no study yet or the campaign extends (or is) the one in it; else
 * FRACAS_DAMAGED naming the first difference. Writes nothing. */
FRACAS_MUST_USE fracas_err fracas_study_fits(const char *study, const fracas_campaign *campaign);

/* *settled when study.h5 is of this campaign, it and the segments have the sizes that the index
 * says, and every realization is done or failed for good (*failed of them). */
FRACAS_MUST_USE fracas_err fracas_study_settled(const char *study, fracas_index *index,
                                                const fracas_campaign *campaign, bool *settled,
                                                int64_t *failed);

/* Looks at a study, under its lock (`force` as in fracas_study_lock), without changing it:
 * FRACAS_IN_USE when another run has it, FRACAS_DAMAGED when it does not fit, else *settled and
 * *failed as above (false and 0 for a new study). Settled is then a study whose every byte is what
 * the index says, too: anything else is for a run to put right. */
FRACAS_MUST_USE fracas_err fracas_study_examine(const char *study, const fracas_campaign *campaign,
                                                bool force, bool *settled, int64_t *failed);

/* Creates the folders, takes the lock (`force` as in fracas_study_lock; fracas_study_unlock it),
 * checks that the campaign fits, copies the files it names, writes campaign.yaml, opens the index,
 * recovers from an interruption (*report as fracas_study_recover, freed by the caller) and plans.
 * On failure nothing is held: *lock is -1, *index and *report are NULL. */
FRACAS_MUST_USE fracas_err fracas_study_prepare(const char *study, const fracas_campaign *campaign,
                                                bool force, int *lock, fracas_index **index,
                                                char **report);

/* The part of this that needs the lock, for one who has it; the folders are there. */
FRACAS_MUST_USE fracas_err fracas_study_plan(const char *study, const fracas_campaign *campaign,
                                             fracas_index **index, char **report);

#endif
