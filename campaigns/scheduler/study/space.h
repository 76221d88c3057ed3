/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Is there room for a study? */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STUDY_SPACE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STUDY_SPACE_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/run.h"

/* FRACAS_ENVIRONMENT, with both numbers and what can be done, unless the disk of the study has room
 * for what is still to be computed, once in segments and once in study.h5, which is written whole
 * beside an older one: need = r sum_p n_p b_p + sum_p n_p b_p + empty files,  r = 1 - done/planned,
 * b_p = `bytes`[p] or what a realization took so far with n_p replicas that are sure to be computed
 * (the least, where a rule decides). FRACAS_OK with options->ignore_space. */
FRACAS_MUST_USE fracas_err fracas_space_check(const char *study, const fracas_campaign *campaign,
                                              const fracas_run_options *options,
                                              const double *bytes);

/* For a run that starts mpirun: raises this process's limit on open files as far as it may;
 * FRACAS_ENVIRONMENT, naming the limit, where MPI would not come up, or hang without a word, under
 * the limits on open files or on the size of files. */
FRACAS_MUST_USE fracas_err fracas_limits_check(const fracas_run_options *options);

#endif
