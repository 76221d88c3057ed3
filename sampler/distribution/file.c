/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Given strengths: one line of a file for each interface. */
#include "sampler/distribution/distribution.h"

#include "base/units.h"
#include "sampler/distribution/given.h"

#include <stdio.h>
#include <string.h>

/* The next strength; *found is false at the end of the file. */
FRACAS_MUST_USE static fracas_err next_strength(fracas_lines *lines, double *value, bool *found)
{
    char field[FRACAS_FIELD] = "";
    *found = fracas_lines_next(lines);
    if (*found) fracas_lines_last_field(lines, field);
    if (*found && lines->first && fracas_lines_is_heading(field)) {
        fracas_lines_name(lines);
        return next_strength(lines, value, found);
    }
    if (*found) TRY(fracas_lines_check_commas(lines, 1, "number,strength"));
    if (!*found || (!fracas_number_read(field, value) && *value > 0.0)) return FRACAS_OK;
    return fracas_lines_refuse(lines, field,
                               "a strength in Pa, a number greater than 0 at the end of the line, "
                               "after a comma or a blank if it is not alone, without a unit");
}

FRACAS_MUST_USE static fracas_err file_fill(const fracas_strength *strength, size_t n,
                                            const double (*position)[3], size_t stride,
                                            double *sigma_c)
{
    (void)position;
    fracas_lines lines = fracas_lines_begin(strength->file);
    bool found = true;
    for (size_t i = 0; i < n; i++)
        if (!found || next_strength(&lines, &sigma_c[i * stride], &found) || !found)
            sigma_c[i * stride] = NAN;
    return FRACAS_OK;
}

static const fracas_param params[] = {
    FRACAS_STRENGTH_FILE(
        "text with a strength in Pa at the end of each line, for one interface after the other; "
        "headings in the first line, empty lines and lines that start with # are skipped"),
};
const fracas_distribution fracas_file_distribution = {
    .kind = {.name = "file",
             .doc = "strengths of all interfaces from a file, the same for every replica",
             FRACAS_PARAMS(params)},
    .quantile = fracas_given_quantile,
    .moments = fracas_given_moments,
    .init = fracas_given_init,
    .read = next_strength,
    .fill = file_fill,
};
