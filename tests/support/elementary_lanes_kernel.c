/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/support/elementary_lanes.h"

#include "base/elementary_lanes.h"

static void log_of(size_t n, const double *x, double *y)
{
    for (size_t i = 0; i < n; i += LANES) lanes_store(y + i, lanes_log(lanes_load(x + i)));
}

static void exp_of(size_t n, const double *x, double *y)
{
    for (size_t i = 0; i < n; i += LANES) lanes_store(y + i, lanes_exp(lanes_load(x + i)));
}

const elementary_unit LANES_UNIT(elementary) = {.log = log_of, .exp = exp_of};
