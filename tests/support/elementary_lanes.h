/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of base/elementary_lanes.h on arrays, one source for each instruction set. n is a
 * multiple of 8; arrays are aligned to 64 bytes. */
#ifndef FRACAS_TESTS_SUPPORT_ELEMENTARY_LANES_H
#define FRACAS_TESTS_SUPPORT_ELEMENTARY_LANES_H

#include <stddef.h>

typedef void over_lanes(size_t n, const double *x, double *y);

over_lanes log_baseline, log_avx2, log_avx512, exp_baseline, exp_avx2, exp_avx512;

#endif
