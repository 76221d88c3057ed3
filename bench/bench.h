/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common to all benchmarks: clocks, medians, and giving up. */
#ifndef FRACAS_BENCH_BENCH_H
#define FRACAS_BENCH_BENCH_H

#include "base/err.h"
#include "bench/kernels/timing.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program with the message of an error. */
static inline void demand(fracas_err err)
{
    if (!err) return;
    fprintf(stderr, "%s: %s\n", program_invocation_short_name, fracas_message());
    exit(err);
}

#endif
