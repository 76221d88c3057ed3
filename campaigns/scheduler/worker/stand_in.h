/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What leases do instead of computing when the scheduler itself is measured (fracas bench
 * scheduler): they sleep, and give records without fragments. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_STAND_IN_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_STAND_IN_H

#include "base/err.h"
#include "engine/record.h"

#include <stdint.h>

typedef struct {
    double seconds; /* that a realization takes */
    double share;   /* of realizations that take `longer`, 0 to 1 */
    double longer;  /* s */
} fracas_stand_in;

enum { FRACAS_STAND_IN_TEXT = 80 };

/* As fracas_run_options.stand_in has it, `SECONDS` or `SECONDS+SHARE:LONGER`, such as
 * 0.001+0.01:10: one in a hundred takes 10 s. */
void fracas_stand_in_write(const fracas_stand_in *stand_in, char text[FRACAS_STAND_IN_TEXT]);
/* FRACAS_USAGE if the text is none. */
FRACAS_MUST_USE fracas_err fracas_stand_in_read(const char *text, fracas_stand_in *stand_in);

/* s that a realization takes: depends on its name only, so that every run of a study has the same
 * work. */
double fracas_stand_in_seconds(const fracas_stand_in *stand_in, uint64_t point, int64_t replica);

/* Sleeps as long as all these realizations of a point take, one after another, and makes each
 * record one of outcome INTACT with every number 0 (records initialised by the caller). It sleeps,
 * so that many more workers than cores show what the scheduler can do, not what the machine can.
 * FRACAS_USAGE as above. */
FRACAS_MUST_USE fracas_err fracas_stand_in_compute(const char *text, uint64_t point,
                                                   const int64_t *replica, size_t count,
                                                   fracas_record *record);

#endif
