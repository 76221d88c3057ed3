/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person sees of a run: on a terminal one line with a bar, updated in place; else a plain
 * line now and then. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_PROGRESS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_PROGRESS_H

#include "campaigns/scheduler/lease/scheduler.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    FILE *out;
    bool terminal;
    bool bar;     /* one stands in the last line of the terminal */
    bool any;     /* counts were seen */
    double began; /* fracas_now at the first counts: the rate is since then */
    double shown; /* fracas_now of the last line */
    fracas_scheduler_counts first, last;
} fracas_progress;

void fracas_progress_init(fracas_progress *progress, FILE *out);

/* New counts: shown when enough time has passed since the last ones. */
void fracas_progress_update(fracas_progress *progress, const fracas_scheduler_counts *counts);

/* A line of text of its own, above the bar. */
void fracas_progress_say(fracas_progress *progress, const char *text);

/* Shows the last counts and leaves the line. */
void fracas_progress_end(fracas_progress *progress);

#endif
