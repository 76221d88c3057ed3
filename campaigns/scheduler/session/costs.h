/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Predicted costs of a campaign. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_COSTS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_COSTS_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/options.h"

/* Predicted cost and bytes (NULL: not wanted) of one realization of each point (fracas_plan_cost),
 * freed by the caller. FRACAS_USAGE for conflicting parameters, or for lanes or an instruction set
 * missing on this machine. */
FRACAS_MUST_USE fracas_err fracas_costs_create(const fracas_campaign *campaign,
                                               const fracas_run_options *options, double **cost,
                                               double **bytes);

#endif
