/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress in words: counts, rate, time left, a bar. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STATUS_DESCRIBE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STATUS_DESCRIBE_H

#include "campaigns/scheduler/types/lease.h"

#include <stdbool.h>
#include <stddef.h>

/* "128 of 512 realizations done, 16 computed, 0 failed, 12.3/s, 0:31 left"; `brief`: "128/512
 * done, ...". `rate` 0 and `left` NaN: not known. */
void fracas_counts_describe(const fracas_counts *counts, bool brief, double rate, double left,
                            char *text, size_t size);

/* "1:02:03", "2:03" [h:min:s]; "-" if it is not known. */
typedef struct {
    char text[32];
} fracas_duration;
fracas_duration fracas_duration_text(double seconds);

enum { FRACAS_BAR = 20 };
/* "####...": `done` of `total`. */
void fracas_bar_draw(int64_t done, int64_t total, char bar[FRACAS_BAR + 1]);

#endif
