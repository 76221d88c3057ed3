/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A number by a coordinate, from the lines of a file. */
#ifndef FRACAS_BASE_PROFILE_H
#define FRACAS_BASE_PROFILE_H

#include "base/err.h"
#include "base/own.h"
#include "base/param.h"

typedef struct {
    double at, value, integral; /* from the first place to this one */
} fracas_profile_place;

typedef struct {
    fracas_profile_place *place; /* [count] by rising coordinates, at most two at each */
    size_t count;
} fracas_profile;

/* Words of its messages, and its range. */
typedef struct {
    const char *at, *unit, *value; /* "coordinate", "m", "factor" */
    bool positive;                 /* values are above 0; else any finite ones */
} fracas_profile_form;

/* FRACAS_USAGE for a line of no profile: rising coordinates, none more than
 * twice, and finite values; and for a file without lines. FRACAS_ENVIRONMENT without memory. The
 * caller clears, whatever is returned. */
FRACAS_MUST_USE fracas_err fracas_profile_read(const fracas_attachment *file,
                                               const fracas_profile_form *form, fracas_profile *of);

/* Through its places (s_j, f_j): f_1 for s < s_1, f_m for s >= s_m, else f_j + (f_{j+1} - f_j) (s -
 * s_j)/(s_{j+1} - s_j) with s_j <= s < s_{j+1}; at a coordinate given twice the second holds. */
double fracas_profile_at(const fracas_profile *of, double s);

/* Its integral from 0 to s. */
double fracas_profile_integral(const fracas_profile *of, double s);

void fracas_profile_clear(fracas_profile *of);

#endif
