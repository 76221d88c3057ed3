/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Seconds of the monotonic clock, for ages, rates and waits. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_CLOCK_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_CLOCK_H

#include <time.h>

static inline double fracas_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
