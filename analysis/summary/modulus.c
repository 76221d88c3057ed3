/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/modulus.h"

#include "analysis/data/columns.h"

#include <gsl/gsl_roots.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <string.h>

/* ln(1 + variance/mean^2) of t^x, t exponential: ln Gamma(1 + 2x) - 2 ln Gamma(1 + x), less
 * `context`. */
static double excess(double x, void *context)
{
    return gsl_sf_lngamma(1 + 2 * x) - 2 * gsl_sf_lngamma(1 + x) - *(double *)context;
}

/* The shape of Weibull strengths whose deviation/(mean - minimum) is `ratio`; NaN if it is not
 * between 0.1 and 1000. */
static double shape_of(double ratio)
{
    double wanted = log1p(ratio * ratio), low = 1e-3 * (1 - 1e-9), high = 10 * (1 + 1e-9);
    if (!(excess(low, &wanted) <= 0 && excess(high, &wanted) >= 0)) return NAN;
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    if (!solver) return NAN;
    gsl_function function = {.function = excess, .params = &wanted};
    gsl_root_fsolver_set(solver, &function, low, high);
    for (int i = 0; i < 200 && gsl_root_test_interval(low, high, 0, 1e-14); i++) {
        if (gsl_root_fsolver_iterate(solver)) break;
        low = gsl_root_fsolver_x_lower(solver);
        high = gsl_root_fsolver_x_upper(solver);
    }
    const double x = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return 1 / x;
}

static double weibull_shape(const fracas_point_table *table, size_t point, double minimum)
{
    const double shape = fracas_columns_real(table, point, "strength.shape");
    if (isfinite(shape)) return shape;
    return shape_of(fracas_columns_real(table, point, "strength.deviation") /
                    (fracas_columns_real(table, point, "strength.mean") - minimum));
}

/* P(no flaw in an interface) = exp(-density V) < 1/2. */
static bool most_have_flaws(const fracas_point_table *table, size_t point, double length)
{
    const double volume = fracas_columns_real(table, point, "geometry.area") * length /
                          fracas_columns_real(table, point, "mesh.elements");
    return fracas_columns_real(table, point, "strength.flaw_density") * volume > M_LN2;
}

/* (scaling-laws.8), (scaling-laws.9) */
fracas_modulus fracas_modulus_of(const fracas_point_table *table, size_t point, double length)
{
    const size_t column = fracas_point_table_find(table, "strength.distribution");
    const char *name = column == SIZE_MAX ? "" : table->point[point].value[column].text;
    const double given = fracas_columns_real(table, point, "strength.minimum"),
                 minimum = isfinite(given) ? given : 0;
    const double mean = fracas_columns_real(table, point, "derived.strength_mean");
    const bool weibull = !strcmp(name, "weibull"), flaws = !strcmp(name, "flaws");
    if (!weibull && !flaws)
        return (fracas_modulus){
            NAN, "its strengths have no Weibull modulus: they are neither weibull nor flaws"};
    if (flaws && !most_have_flaws(table, point, length))
        return (fracas_modulus){NAN, "most interfaces are without a flaw"};
    const double exponent = weibull ? weibull_shape(table, point, minimum)
                                    : fracas_columns_real(table, point, "strength.exponent");
    const double modulus = exponent * mean / (mean - minimum);
    if (isfinite(modulus) && modulus > 0) return (fracas_modulus){modulus, NULL};
    return (fracas_modulus){NAN, "the parameters of its strengths are not in the study"};
}
