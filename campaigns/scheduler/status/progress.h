/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress of a run for its user: on a terminal one line with a bar, updated in place; else a plain
 * line every few seconds. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STATUS_PROGRESS_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STATUS_PROGRESS_H

#include "base/err.h"
#include "campaigns/scheduler/status/describe.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    FILE *out;
    bool terminal; /* one that moves its cursor */
    bool quiet;    /* only messages are shown */
    bool bar;      /* the last line of the terminal is a bar */
    bool any;      /* counts have come */
    double began;  /* fracas_now of the first counts, from which the rate counts */
    double shown;  /* fracas_now of the last line */
    fracas_counts first, last;
} fracas_progress;

void fracas_progress_init(fracas_progress *progress, FILE *out);

/* Takes new counts, and shows them if the last line is old enough. */
void fracas_progress_update(fracas_progress *progress, const fracas_counts *counts);

/* Prints a line of text above the bar. */
void fracas_progress_message(fracas_progress *progress, const char *text);

/* Shows the last counts and leaves the line. */
void fracas_progress_end(fracas_progress *progress);

#endif
