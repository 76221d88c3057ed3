/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How rank 0 speaks: to its parent by lines on stdout, or to the person itself when there is no
 * parent.
 *
 *   @fracas progress TOTAL DONE MEMORY FAILED
 *   @fracas say TEXT
 *   @fracas end STATUS RAN TEXT
 *
 * A line break in TEXT travels as a vertical tab. Lines without the mark are somebody else's
 * (MPI's). */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_VOICE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_VOICE_H

#include "campaigns/scheduler/launch/progress.h"

/* Set in the environment of mpirun by the parent. */
#define FRACAS_PARENT_MARK "FRACAS_PARENT"
/* And there: when the run must have ended, s since 1970 (--walltime); why mpirun was started again.
 */
#define FRACAS_DEADLINE "FRACAS_DEADLINE"
#define FRACAS_RESTARTED "FRACAS_RESTARTED"

typedef struct {
    bool parent; /* listens */
    fracas_progress progress;
} fracas_voice;

void fracas_voice_init(fracas_voice *voice);
void fracas_voice_progress(fracas_voice *voice, const fracas_scheduler_counts *counts);
void fracas_voice_say(fracas_voice *voice, const char *format, ...) FRACAS_PRINTF(2, 3);
/* The last word: how the run ended (with this thread's message) and whether anything had to be
 * done. */
void fracas_voice_end(fracas_voice *voice, fracas_err err, bool ran);

/* What the parent heard. */
typedef struct {
    bool ended, ran;
    fracas_err err;
    char text[1024]; /* of the end */
} fracas_verdict;

/* Takes one line (without its end): shows progress and sayings, keeps the end. False if it has no
 * mark. */
bool fracas_voice_hear(char *line, fracas_progress *progress, fracas_verdict *verdict);

#endif
