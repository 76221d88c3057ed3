/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is said of realizations that failed for good. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STUDY_VERDICT_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STUDY_VERDICT_H

#include "campaigns/store/store.h"

/* FRACAS_OK when none has failed, else FRACAS_SOME_FAILED with a message that counts them and names
 * the first points, with how many each, as "12 realizations of STUDY FAILED: 2 of point 3, 10 of
 * point 7 (...)". `index`: of the study, or NULL: it is opened. */
FRACAS_MUST_USE fracas_err fracas_failed_verdict(const char *study, fracas_index *index,
                                                 const fracas_point_table *table);

#endif
