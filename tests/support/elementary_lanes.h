/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of base/elementary_lanes.h on arrays. n is a multiple of 8; arrays are aligned to
 * 64 bytes. */
#ifndef FRACAS_TESTS_SUPPORT_ELEMENTARY_LANES_H
#define FRACAS_TESTS_SUPPORT_ELEMENTARY_LANES_H

#include "base/isa.h"

#include <stddef.h>

typedef void over_lanes(size_t n, const double *x, double *y);

/* A unit (base/isa.h) of tests/support/elementary_lanes_kernel.c. */
typedef struct {
    over_lanes *log, *exp;
} elementary_unit;

#endif
