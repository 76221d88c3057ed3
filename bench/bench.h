/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common to all benchmarks: clocks, medians, and giving up. */
#ifndef FRACAS_BENCH_BENCH_H
#define FRACAS_BENCH_BENCH_H

#include "base/err.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
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

/* Ends the program with the message of an error. */
static inline void demand(fracas_err err)
{
    if (!err) return;
    fprintf(stderr, "%s: %s\n", program_invocation_short_name, fracas_message());
    exit(err);
}

#endif
