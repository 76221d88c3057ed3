/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The campaign and the study before and at the start of a run. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_PREPARE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_PREPARE_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/options.h"
#include "campaigns/store/index.h"

#include <stdbool.h>

/* Reads options->file (fracas_campaign_read), with options->replicas in place of its own.
 * FRACAS_USAGE also for options->replicas or options->parts together with a rule for replicas. */
FRACAS_MUST_USE fracas_err fracas_run_campaign(const fracas_run_options *options,
                                               fracas_campaign **campaign);

/* Moves the rows of a part to the front and returns their number: rows part - 1, part - 1 + parts,
 * ... among `count` rows in plan order, or all with fewer than 2 parts. */
size_t fracas_run_part(int part, int parts, fracas_index_row *row, size_t count);

/* The study folder of a run: options->study or studies/<name>; FRACAS_USAGE if the path is too
 * long. */
FRACAS_MUST_USE fracas_err fracas_study_folder(const fracas_run_options *options,
                                               const fracas_campaign *campaign, char *study,
                                               size_t size);

/* FRACAS_OK when there is no study yet, or the campaign extends (or equals) the one in it. Else
 * FRACAS_DAMAGED naming the first difference. Writes nothing. */
FRACAS_MUST_USE fracas_err fracas_study_fits(const char *study, const fracas_campaign *campaign);

/* *complete: study.h5 is of this campaign, it and the segments have the sizes noted in the index,
 * and every realization is done or failed for good (*failed of them). */
FRACAS_MUST_USE fracas_err fracas_study_is_complete(const char *study, fracas_index *index,
                                                    const fracas_campaign *campaign, bool *complete,
                                                    int64_t *failed);

/* Examines a study under its lock (`force` as in fracas_study_lock), without changing it; only from
 * a complete one it removes the checkpoints that are left, and gives it the campaign's keys of the
 * report, which are in no hash.
 * FRACAS_USAGE for a folder with files that no run wrote (campaigns/scheduler/session/keep.h),
 * FRACAS_IN_USE when another run has it, FRACAS_DAMAGED when it does not fit, else *complete and
 * *failed as above (false and 0 for a new study). Here a complete study also has all bytes as
 * sealed in the index; a run repairs any other. */
FRACAS_MUST_USE fracas_err fracas_study_examine(const char *study, const fracas_campaign *campaign,
                                                bool force, bool *complete, int64_t *failed);

/* Creates the folders, takes the lock (`force` as in fracas_study_lock; the caller unlocks it),
 * checks the campaign (fracas_study_fits), copies its attachments, writes campaign.yaml, opens the
 * index, recovers from an interruption (*report as fracas_study_recover, freed by the caller) and
 * plans. On failure nothing is held: *lock is -1, *index and *report are NULL. */
FRACAS_MUST_USE fracas_err fracas_study_prepare(const char *study, const fracas_campaign *campaign,
                                                bool force, int *lock, fracas_index **index,
                                                char **report);

/* The steps after the lock, for a caller who holds it and has the folders. */
FRACAS_MUST_USE fracas_err fracas_study_plan(const char *study, const fracas_campaign *campaign,
                                             fracas_index **index, char **report);

#endif
