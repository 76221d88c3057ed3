/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A distribution by its own parameters, or by mean and standard deviation. */
#ifndef FRACAS_SAMPLER_PAIRS_H
#define FRACAS_SAMPLER_PAIRS_H

#include "base/err.h"

#include "sampler/strength.h"

#include <stdbool.h>

/* Parameters `mean` and `deviation`, given instead of `others`. */
#define FRACAS_STRENGTH_MOMENTS(others)                                                  \
    {.name = "mean",                                                                     \
     .type = FRACAS_REAL,                                                                \
     .unit = "Pa",                                                                       \
     .doc = "mean strength, given with deviation instead of " others,                    \
     .fallback = FRACAS_REQUIRED,                                                        \
     .maximum = INFINITY,                                                                \
     .minimum_open = true,                                                               \
     .offset = offsetof(fracas_strength, mean),                                          \
     .optional = true},                                                                  \
    {                                                                                    \
        .name = "deviation", .type = FRACAS_REAL, .unit = "Pa",                          \
        .doc = "standard deviation of the strength, given with mean instead of " others, \
        .fallback = FRACAS_REQUIRED, .maximum = INFINITY, .minimum_open = true,          \
        .offset = offsetof(fracas_strength, deviation), .optional = true                 \
    }

/* The distribution's own two parameters, and its two moments, which are positive where they are
 * given. *by_moments = whether the second pair is given and not the first. FRACAS_USAGE unless
 * exactly one pair is given whole. */
FRACAS_MUST_USE fracas_err fracas_pairs_choose(const fracas_strength *strength,
                                               const fracas_param pairs[4], bool *by_moments);

/* FRACAS_USAGE unless least <= ratio <= most; the message calls the ratio `name`, as
 * "deviation/mean". */
FRACAS_MUST_USE fracas_err fracas_pairs_check(const fracas_strength *strength, const char *name,
                                              double ratio, double least, double most);

#endif
