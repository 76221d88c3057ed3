/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Graded material: a factor of the strengths by position. */
#ifndef FRACAS_SAMPLER_FIELD_GRADING_H
#define FRACAS_SAMPLER_FIELD_GRADING_H

#include "sampler/strength.h"

/* FRACAS_USAGE if only one of `factor` and `factor_along` is given, or for a line of the file that
 * does not belong to a profile: increasing coordinates [m], none more than twice, and finite
 * positive factors. */
FRACAS_MUST_USE fracas_err fracas_grading_check(const fracas_strength *strength);

/* *factor = [n], new, to be freed: the factor at each position [m]; NULL where strengths are not
 * graded (or n is 0). Through the places (s_j, f_j) of the profile, s the coordinate of the
 * position, f(s) = f_1 for s < s_1, f_m for s >= s_m, else f_j + (f_{j+1} - f_j) (s - s_j)/(s_{j+1}
 * - s_j) with s_j <= s < s_{j+1}; at a coordinate given twice the second factor holds. Errors as
 * fracas_grading_check, and FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_grading_create(const fracas_strength *strength, size_t n,
                                                 const double (*position)[3], double **factor);

#endif
