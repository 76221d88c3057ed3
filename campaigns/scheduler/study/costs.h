/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be known of a campaign's computations before the first one. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STUDY_COSTS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STUDY_COSTS_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/run.h"

/* Predicted cost and bytes (NULL: not wanted) of one realization of each point (fracas_plan_cost),
 * freed by the caller. FRACAS_USAGE for parameters that do not go together, or lanes or an
 * instruction set that no batch can have here: nothing needs to be started to find that out. */
FRACAS_MUST_USE fracas_err fracas_costs_create(const fracas_campaign *campaign,
                                               const fracas_run_options *options, double **cost,
                                               double **bytes);

#endif
