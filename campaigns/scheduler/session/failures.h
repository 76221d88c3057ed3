/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Failure report of a study. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_FAILURES_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_FAILURES_H

#include "campaigns/store/index.h"

/* FRACAS_OK when no realization has failed for good. Else FRACAS_SOME_FAILED with a message such as
 * "12 realizations of STUDY FAILED: 2 of point 3, 10 of point 7 (...)", which names the first
 * points. `index` of the study; NULL: the function opens it. */
FRACAS_MUST_USE fracas_err fracas_failure_report(const char *study, fracas_index *index,
                                                 const fracas_point_table *table);

#endif
