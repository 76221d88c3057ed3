/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields that a campaign file asks for, written when its run has ended. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WRITTEN_FIELDS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WRITTEN_FIELDS_H

#include "campaigns/campaign.h"
#include "campaigns/plan/plan.h"

#include <stdio.h>

/* Computes each realization chosen by campaign->fields again, and writes STUDY/fields/POINT-REPLICA
 * (field_files.h), whole or not at all, under the lock of the study. One of the same point and
 * instants stays, one of others is removed. Says which it writes on `out`. Nothing where the
 * campaign chooses none, and while study.h5 is not there. Errors as fracas_replay_run. */
FRACAS_MUST_USE fracas_err fracas_written_fields(const char *study, const fracas_campaign *campaign,
                                                 FILE *out);

/* How many realizations that are, and the bytes of their fields until time.end. Builds the models.
 */
FRACAS_MUST_USE fracas_err fracas_written_fields_size(const fracas_campaign *campaign,
                                                      fracas_planned_fields *size);

#endif
