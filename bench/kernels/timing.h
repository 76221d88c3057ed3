/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clocks and medians. */
#ifndef FRACAS_BENCH_KERNELS_TIMING_H
#define FRACAS_BENCH_KERNELS_TIMING_H

#include <time.h>

/* s, from any moment on. */
static inline double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif
