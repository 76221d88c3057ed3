/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/strengths.h"

#include "analysis/data/columns.h"

#include <math.h>
#include <string.h>

static const char *text_of(const fracas_point_table *table, size_t point, const char *path)
{
    const size_t column = fracas_point_table_find(table, path);
    return column == SIZE_MAX ? "" : table->point[point].value[column].text;
}

bool fracas_strengths_uniform(const fracas_point_table *table, size_t point)
{
    return !strcmp(text_of(table, point, "strength.distribution"), "uniform");
}

double fracas_strengths_least(const fracas_point_table *table, size_t point)
{
    const double given = fracas_columns_real(table, point, "strength.minimum");
    if (isfinite(given) || !fracas_strengths_uniform(table, point)) return given;
    return fracas_columns_real(table, point, "strength.mean") -
           sqrt(3) * fracas_columns_real(table, point, "strength.deviation");
}

/* By the parameters, for studies of format version 5 and less, which have no deviation. */
static double scatter_by_parameters(const fracas_point_table *table, size_t p, double mean)
{
    const double deviation = fracas_columns_real(table, p, "strength.deviation"),
                 sigma = fracas_columns_real(table, p, "strength.sigma"),
                 modulus = fracas_columns_real(table, p, "derived.strength_modulus");
    if (isfinite(deviation)) return deviation / mean;
    if (isfinite(sigma)) return sigma;           /* lognormal */
    if (isfinite(modulus)) return 1.2 / modulus; /* weibull, to 10 % from shape 3 on */
    return (fracas_columns_real(table, p, "strength.maximum") -
            fracas_columns_real(table, p, "strength.minimum")) /
           sqrt(12) / mean;
}

double fracas_strengths_scatter(const fracas_point_table *table, size_t point)
{
    const double mean = fracas_columns_real(table, point, "derived.strength_mean"),
                 deviation = fracas_columns_real(table, point, "derived.strength_deviation");
    if (*text_of(table, point, "strength.file")) return NAN;
    if (isnan(deviation)) return scatter_by_parameters(table, point, mean);
    return deviation > 0 ? deviation / mean : NAN;
}
