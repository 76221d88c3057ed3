/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands on a study that compute nothing: its index anew, its study.h5 written, what nobody needs
 * removed, failures planned again, two studies made one. Each takes the lock of the study
 * (FRACAS_IN_USE names who has it); what it does is said line by line. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STUDY_UPKEEP_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STUDY_UPKEEP_H

#include "campaigns/campaign.h"
#include "campaigns/store/upkeep.h"

/* Realizations of a study when a command ends. */
typedef struct {
    int64_t realizations, done, failed, missing;
    int64_t segments;
} fracas_upkeep;

/* fracas_study_reindex with the campaign of the study, and what rules for replicas then plan. */
FRACAS_MUST_USE fracas_err fracas_upkeep_reindex(const char *study, const fracas_campaign *campaign,
                                                 const fracas_said *said, fracas_upkeep *end);

/* Writes study.h5, after the sweep that a run begins with; *written is false where it is there and
 * of this campaign. FRACAS_INTERRUPTED counts what is missing, FRACAS_SOME_FAILED what failed. */
FRACAS_MUST_USE fracas_err fracas_upkeep_merge(const char *study, const fracas_campaign *campaign,
                                               const fracas_said *said, fracas_upkeep *end,
                                               bool *written);

/* fracas_study_collect with the files that the campaign names. */
FRACAS_MUST_USE fracas_err fracas_upkeep_collect(
    const char *study, const fracas_campaign *campaign, bool dry,
    void (*found)(void *context, const fracas_collected *item), void *context, uint64_t *freed);

/* fracas_index_retry of one point, or of all (`point` negative); FRACAS_USAGE if there is no such
 * point. */
FRACAS_MUST_USE fracas_err fracas_upkeep_retry(const char *study, const fracas_campaign *campaign,
                                               int64_t point, int64_t *rows);

/* Makes `into` the study of both. One campaign must extend the other (or be it): `into` becomes a
 * study of the longer one. Everything is compared before anything is copied: FRACAS_DAMAGED names
 * the first difference, and then nothing of `into` has changed. `from` stays. */
FRACAS_MUST_USE fracas_err fracas_upkeep_join(const char *into, const char *from,
                                              const fracas_said *said, fracas_joined *joined,
                                              int64_t *both, fracas_upkeep *end);

#endif
