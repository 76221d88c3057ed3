/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Needs of a run: predicted costs, the disk and the limits of the system. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_SPACE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_SPACE_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/options.h"

#include <stdio.h>

/* Predicted cost and bytes (NULL: not wanted) of one realization of each point (fracas_plan_cost),
 * freed by the caller. FRACAS_USAGE for conflicting parameters, or for lanes or an instruction set
 * missing on this machine. warn: where fracas_plan_words are said, before hours of a run that
 * breaks nothing; NULL, or options->quiet: nowhere. */
FRACAS_MUST_USE fracas_err fracas_costs_create(const fracas_campaign *campaign,
                                               const fracas_run_options *options, FILE *warn,
                                               double **cost, double **bytes);

/* FRACAS_ENVIRONMENT, naming both numbers, unless the disk of the study has room for the remaining
 * segments and for study.h5, which is written whole beside an older one:
 *   need = r sum_p n_p b_p + sum_p n_p b_p + empty files,   r = 1 - done/planned
 * with n_p replicas (with a rule, the minimum) and b_p = bytes[p], or the measured bytes of a
 * realization if greater. FRACAS_OK with options->ignore_space. */
FRACAS_MUST_USE fracas_err fracas_space_check(const char *study, const fracas_campaign *campaign,
                                              const fracas_run_options *options,
                                              const double *bytes);

#endif
