/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Families with incomplete gamma functions: gamma, generalised gamma, power law with exponential
 * cut-off; and the lognormal, a limit. */
#include "analysis/fit/family.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>

/* ---- gamma ---- */

static void gamma_tails(const double *p, double from, double x, double *below, double *above)
{
    (void)from;
    *below = gsl_cdf_gamma_P(x, p[1], p[0]);
    *above = gsl_cdf_gamma_Q(x, p[1], p[0]);
}

/* (fits.2) */
static double gamma_log_density(const double *p, double from, double x)
{
    (void)from;
    const double y = x / p[0];
    return x < 0 ? -INFINITY
                 : (p[1] == 1 ? 0 : (p[1] - 1) * log(y)) - y - gsl_sf_lngamma(p[1]) - log(p[0]);
}

static double gamma_quantile(const double *p, double from, double above)
{
    (void)from;
    return gsl_cdf_gamma_Qinv(above, p[1], p[0]);
}

static const double wider[FRACAS_FAMILY_STARTS] = {1, 0.7, 1.5};

static void gamma_start(const fracas_family_moments *moments, int which, double *p)
{
    const double cv = moments->cv * wider[which];
    p[0] = cv * cv;
    p[1] = 1 / (cv * cv);
}

/* ---- lognormal ---- */

static void lognormal_tails(const double *p, double from, double x, double *below, double *above)
{
    (void)from;
    const double z = log(x / p[0]) / p[1];
    *below = gsl_cdf_ugaussian_P(z);
    *above = gsl_cdf_ugaussian_Q(z);
}

/* (fits.3) */
static double lognormal_log_density(const double *p, double from, double x)
{
    (void)from;
    const double z = log(x / p[0]) / p[1];
    return x > 0 ? -0.5 * z * z - log(x * p[1]) - 0.5 * log(2 * M_PI) : -INFINITY;
}

static double lognormal_quantile(const double *p, double from, double above)
{
    (void)from;
    return p[0] * exp(p[1] * gsl_cdf_ugaussian_Qinv(above));
}

static void lognormal_start(const fracas_family_moments *moments, int which, double *p)
{
    const double cv = moments->cv * wider[which];
    p[1] = sqrt(log1p(cv * cv));
    p[0] = exp(-0.5 * p[1] * p[1]);
}

/* ---- generalised gamma ---- */

/* x = m (q^2 G)^(sigma/q) with G of gamma shape 1/q^2. */
static double to_gamma(const double *p, double x)
{
    return pow(x / p[0], p[2] / p[1]) / (p[2] * p[2]);
}

static void generalised_gamma_tails(const double *p, double from, double x, double *below,
                                    double *above)
{
    (void)from;
    const double g = to_gamma(p, x), shape = 1 / (p[2] * p[2]);
    *below = gsl_cdf_gamma_P(g, shape, 1);
    *above = gsl_cdf_gamma_Q(g, shape, 1);
}

/* (fits.4) */
static double generalised_gamma_log_density(const double *p, double from, double x)
{
    (void)from;
    if (x <= 0) return -INFINITY;
    const double shape = 1 / (p[2] * p[2]), g = to_gamma(p, x);
    return shape * log(g) - g - gsl_sf_lngamma(shape) + log(p[2] / (p[1] * x));
}

static double generalised_gamma_quantile(const double *p, double from, double above)
{
    (void)from;
    const double g = gsl_cdf_gamma_Qinv(above, 1 / (p[2] * p[2]), 1);
    return p[0] * pow(p[2] * p[2] * g, p[1] / p[2]);
}

/* A gamma, a Weibull, nearly a lognormal. */
static void generalised_gamma_start(const fracas_family_moments *moments, int which, double *p)
{
    const double cv = moments->cv, shape = fmin(fmax(pow(cv, -1.086), 0.2), 20),
                 sigma = sqrt(log1p(cv * cv));
    p[0] = which == 0   ? 1
           : which == 1 ? 1 / gsl_sf_gamma(1 + 1 / shape)
                        : exp(-0.5 * sigma * sigma);
    p[1] = which == 0 ? cv : which == 1 ? 1 / shape : sigma;
    p[2] = which == 0 ? cv : which == 1 ? 1 : 0.1;
}

/* ---- power law with cut-off ---- */

/* integral from x on of t^-alpha exp(-t/lambda) dt = lambda^(1 - alpha) Gamma(1 - alpha, x/lambda),
 * without the power of lambda. For -1/2 < a < 0 and small arguments GSL 2.7 is good to 2e-6 only:
 * there by Gamma(a, z) = (Gamma(a + 1, z) - z^a exp(-z))/a. */
static double beyond(const double *p, double x)
{
    const double a = 1 - p[0], z = x / p[1];
    gsl_sf_result found;
    if (a <= 0 && z <= 0) return NAN;
    const bool poor = a > -0.6 && a < -1e-7 && z < 0.3;
    gsl_sf_gamma_inc_e(poor             ? a + 1
                       : fabs(a) < 1e-7 ? 0
                                        : a,
                       z, &found); /* 0 where it underflows */
    return poor ? (found.val - pow(z, a) * exp(-z)) / a : found.val;
}

static void power_law_tails(const double *p, double from, double x, double *below, double *above)
{
    const double all = beyond(p, from), rest = x > from ? beyond(p, x) : all;
    *above = rest / all;
    *below = (all - rest) / all;
}

/* (fits.5) */
static double power_law_log_density(const double *p, double from, double x)
{
    return x < from || x <= 0 ? -INFINITY
                              : -p[0] * log(x / p[1]) - x / p[1] - log(beyond(p, from)) - log(p[1]);
}

/* P(size > x) falls with x: halves an interval of log x. */
static double power_law_quantile(const double *p, double from, double above)
{
    double low = log(from > 0 ? from : p[1] * 1e-30), high = log(fmax(from, 0) + 700 * p[1]);
    for (int i = 0; i < 60; i++) {
        double below, rest;
        const double middle = 0.5 * (low + high);
        power_law_tails(p, from, exp(middle), &below, &rest);
        *(rest > above ? &low : &high) = middle;
    }
    return exp(0.5 * (low + high));
}

static void power_law_start(const fracas_family_moments *moments, int which, double *p)
{
    static const double alpha[FRACAS_FAMILY_STARTS] = {0.5, 1.5, 0.1},
                        cut[FRACAS_FAMILY_STARTS] = {1.5, 5, 0.7};
    (void)moments;
    p[0] = alpha[which];
    p[1] = cut[which];
}

#define FUNCTIONS(member)                                                                        \
    .tails = member##_tails, .log_density = member##_log_density, .quantile = member##_quantile, \
    .start = member##_start
#define LENGTH(symbol, what)                                                     \
    {                                                                            \
        .name = symbol, .length = true, .lower = 1e-4, .upper = 1e3, .doc = what \
    }
#define SHAPE(symbol, low, high, what)                           \
    {                                                            \
        .name = symbol, .lower = low, .upper = high, .doc = what \
    }

const fracas_family fracas_family_gamma = {
    .name = "gamma",
    .survival = "Q(k, x/theta)",
    .nparameters = 2,
    .parameter = {LENGTH("theta", "scale"), SHAPE("k", 0.02, 2000, "shape")},
    .general = "generalised-gamma",
    FUNCTIONS(gamma),
};
const fracas_family fracas_family_lognormal = {
    .name = "lognormal",
    .survival = "Phi(-log(x/m)/sigma)",
    .nparameters = 2,
    .parameter = {LENGTH("m", "median"), SHAPE("sigma", 0.01, 10, "deviation of log x")},
    .general = "generalised-gamma",
    FUNCTIONS(lognormal),
};
const fracas_family fracas_family_generalised_gamma = {
    .name = "generalised-gamma",
    .survival = "Q(1/q^2, (x/m)^(q/sigma)/q^2)",
    .nparameters = 3,
    .parameter = {LENGTH("m", "scale"), SHAPE("sigma", 0.01, 10, "width of log x"),
                  SHAPE("q", 0.03, 20, "1 Weibull, sigma gamma, towards 0 lognormal")},
    .general = "",
    FUNCTIONS(generalised_gamma),
};
const fracas_family fracas_family_power_law = {
    .name = "power-law",
    .survival = "Gamma(1 - alpha, x/lambda)/Gamma(1 - alpha, cut/lambda)",
    .nparameters = 2,
    .parameter = {{.name = "alpha", .linear = true, .lower = 0, .upper = 6, .doc = "exponent"},
                  {.name = "lambda",
                   .length = true,
                   .lower = 1e-3,
                   .upper = 100,
                   .doc = "where it is cut off"}},
    .general = "",
    FUNCTIONS(power_law),
};
