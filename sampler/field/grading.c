/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/field/grading.h"

#include "base/profile.h"

#include <math.h>

static const fracas_profile_form form = {"coordinate", "m", "factor", .positive = true};

fracas_err fracas_grading_check(const fracas_strength *strength)
{
    FRACAS_CLEARED(fracas_profile) of = {0};
    if (!strength->factor && !strength->factor_along) return FRACAS_OK;
    if (!strength->factor)
        return fracas_fail(FRACAS_USAGE, "strength.factor_along is given without a file `factor`: "
                                         "name its file, or leave out both");
    if (!strength->factor_along)
        return fracas_fail(FRACAS_USAGE,
                           "strength.factor needs `factor_along`: x, y, z or radius, what the "
                           "coordinates of %s are",
                           strength->factor->path);
    return fracas_profile_read(strength->factor, &form, &of);
}

/* (grading.1) */
static double coordinate_of(const fracas_kind *along, const double position[3])
{
    if (along == &fracas_along_radius)
        return sqrt(position[0] * position[0] + position[1] * position[1]);
    return position[along == &fracas_along_x ? 0 : along == &fracas_along_y ? 1 : 2];
}

fracas_err fracas_grading_create(const fracas_strength *strength, size_t n,
                                 const double (*position)[3], double **factor)
{
    FRACAS_CLEARED(fracas_profile) of = {0};
    *factor = NULL;
    TRY(fracas_grading_check(strength));
    if (!strength->factor || n == 0) return FRACAS_OK;
    TRY(fracas_profile_read(strength->factor, &form, &of));
    if (!(*factor = malloc(n * sizeof **factor)))
        return fracas_no_memory("the factors of a strength field");
    for (size_t k = 0; k < n; k++)
        (*factor)[k] = fracas_profile_at(&of, coordinate_of(strength->factor_along, position[k]));
    return FRACAS_OK;
}
