/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The status channel: rank 0 reports to its launcher by lines on stdout, or, without a launcher,
 * shows progress to the user itself.
 *
 *   @fracas progress TOTAL DONE MEMORY FAILED WORK
 *   @fracas say TEXT
 *   @fracas end STATUS RAN AGAIN TEXT
 *
 * A line break in TEXT travels as a vertical tab. Lines without the mark come from others (MPI). */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STATUS_CHANNEL_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STATUS_CHANNEL_H

#include "campaigns/scheduler/status/progress.h"
#include "campaigns/scheduler/types/environment.h"

typedef struct {
    bool launcher; /* one reads stdout */
    bool again;    /* no worker is left, and the launcher is to start the ranks again */
    fracas_progress progress;
} fracas_channel;

void fracas_channel_init(fracas_channel *channel);
void fracas_channel_progress(fracas_channel *channel, const fracas_counts *counts);
void fracas_channel_message(fracas_channel *channel, const char *format, ...) FRACAS_PRINTF(2, 3);
/* Last line of a run: its result, with this thread's error message, and whether it had anything to
 * do. */
void fracas_channel_end(fracas_channel *channel, fracas_err err, bool ran);

/* The last line, as the launcher has read it. */
typedef struct {
    bool ended, ran, again;
    fracas_err err;
    char text[1024];
} fracas_ending;

/* Reads one line (without its end): shows progress and messages, keeps the ending. False if it has
 * no mark. */
bool fracas_channel_receive(char *line, fracas_progress *progress, fracas_ending *ending);

#endif
