/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of every kernel beside what this machine can do: `fracas bench kernels`. */
#ifndef FRACAS_BENCH_KERNELS_KERNELS_H
#define FRACAS_BENCH_KERNELS_KERNELS_H

#include "base/err.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    bool full;        /* all cases; else bodies of 2500 elements, on one lane and the widest unit */
    const char *only; /* cases whose name has this in it, of all; NULL: no choice */
    int repeats;      /* of each, of 10 ms and more */
    bool json;
} fracas_bench_options;

/* Times the cases and prints a table, or JSON. Each repeat of a case, and a multiply-add loop just
 * before it, by processor time; `progress`, unless NULL, gets a line that is rewritten.
 * FRACAS_USAGE where no case has `only` in its name. */
FRACAS_MUST_USE fracas_err fracas_bench_kernels(const fracas_bench_options *options, FILE *out,
                                                FILE *progress);

#endif
