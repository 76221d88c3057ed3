/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands on a study without computation: reindex, merge, gc, retry, merge-studies. Each takes
 * the lock of the study (FRACAS_IN_USE names the holder) and reports its actions line by line.
 * *end: the realizations when it ends. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_UPKEEP_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_UPKEEP_H

#include "campaigns/campaign.h"
#include "campaigns/store/upkeep.h"

/* fracas_study_reindex with the campaign of the study; then rules plan their replicas. */
FRACAS_MUST_USE fracas_err fracas_upkeep_reindex(const char *study, const fracas_campaign *campaign,
                                                 const fracas_said *said, fracas_index_counts *end);

/* Recovers as a run does, and writes study.h5; *written is false if it was complete before.
 * FRACAS_INTERRUPTED counts missing realizations, FRACAS_SOME_FAILED failed ones. */
FRACAS_MUST_USE fracas_err fracas_upkeep_merge(const char *study, const fracas_campaign *campaign,
                                               const fracas_said *said, fracas_index_counts *end,
                                               bool *written);

/* Makes a study of `file`, a study.h5 with this campaign: in the new or empty folder `study` the
 * campaign file with its attachments, the file as the only segment, and then as
 * fracas_upkeep_merge. Without `results` the campaign alone. FRACAS_USAGE if the folder has
 * anything in it. */
FRACAS_MUST_USE fracas_err fracas_upkeep_unpack(const char *file, const fracas_campaign *campaign,
                                                bool results, const char *study,
                                                const fracas_said *said, fracas_index_counts *end);

/* fracas_study_collect with the files named in the campaign; `merged`: after fracas_study_fold. */
FRACAS_MUST_USE fracas_err fracas_upkeep_collect(
    const char *study, const fracas_campaign *campaign, bool dry, bool merged,
    void (*found)(void *context, const fracas_collected *item), void *context, uint64_t *freed);

/* fracas_index_retry of one point, or of all (`point` negative). FRACAS_USAGE for an unknown point.
 */
FRACAS_MUST_USE fracas_err fracas_upkeep_retry(const char *study, const fracas_campaign *campaign,
                                               int64_t point, int64_t *rows);

/* Merges `from` into `into`. One campaign must extend the other (or be equal), and `into` becomes a
 * study of the longer one. All is compared before anything is copied: FRACAS_DAMAGED names the
 * first difference and leaves `into` unchanged. `from` stays. */
FRACAS_MUST_USE fracas_err fracas_upkeep_join(const char *into, const char *from,
                                              const fracas_said *said, fracas_joined *joined,
                                              int64_t *both, fracas_index_counts *end);

#endif
