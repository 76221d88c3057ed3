/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What tests ask for: faults, to see what isolation makes of them, and a log of what is computed.
 */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_FAULT_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_FAULT_H

#include "base/err.h"

#include <stddef.h>
#include <stdint.h>

/* With FRACAS_TEST_FAULT=WHAT:POINT:REPLICA[:FILE] in the environment this happens to the process
 * that is about to compute that realization (point counted from 0 in plan order); it is called with
 * those of a batch, `count` replicas of `point`. WHAT is crash   SIGSEGV abort   abort(), after a
 * sentence on standard error exit    the process ends with status 0, as a library might do it hang
 * it never returns memory  it allocates 1 GiB, and fails as all of us do where it cannot:
 * FRACAS_ENVIRONMENT model   nothing yet: fracas_fault_of_model With FILE, at most 1023 bytes, it
 * happens once: to the process that creates this file. FRACAS_BUG if it cannot be understood.
 * FRACAS_OK, and nothing happens, to any other realization. */
FRACAS_MUST_USE fracas_err fracas_fault_if_asked(uint64_t point, const int64_t *replica,
                                                 size_t count);

/* With FRACAS_TEST_FAULT=model:POINT:0 the process that is about to build the model of this point
 * dies of SIGSEGV. */
void fracas_fault_of_model(uint64_t point);

/* With FRACAS_TEST_LOG=FILE, where FILE is there, appends a line for a batch that is begun: pid,
 * pid of the parent, point, replicas. */
void fracas_log_if_asked(uint64_t point, const int64_t *replica, size_t count);

#endif
