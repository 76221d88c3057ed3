/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Include with LANES and ISA, the last word of the functions' names, defined. */
#include "tests/support/elementary_lanes.h"

#include "base/lanes.h"

#include "base/elementary_lanes.h"

#define JOIN_(name, isa) name##_##isa
#define JOIN(name, isa) JOIN_(name, isa)

void JOIN(log, ISA)(size_t n, const double *x, double *y)
{
    for (size_t i = 0; i < n; i += LANES) lanes_store(y + i, lanes_log(lanes_load(x + i)));
}

void JOIN(exp, ISA)(size_t n, const double *x, double *y)
{
    for (size_t i = 0; i < n; i += LANES) lanes_store(y + i, lanes_exp(lanes_load(x + i)));
}
