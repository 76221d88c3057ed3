/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/family.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_gamma.h>
#include <math.h>
#include <string.h>

const fracas_family *const fracas_families[FRACAS_NFAMILIES] = {
    &fracas_family_exponential, &fracas_family_rayleigh,          &fracas_family_shifted_rayleigh,
    &fracas_family_weibull,     &fracas_family_weibull3,          &fracas_family_lognormal,
    &fracas_family_gamma,       &fracas_family_generalised_gamma, &fracas_family_power_law,
    &fracas_family_mott,
};

const fracas_family *fracas_family_find(const char *name)
{
    for (size_t f = 0; f < FRACAS_NFAMILIES; f++)
        if (!strcmp(fracas_families[f]->name, name)) return fracas_families[f];
    return NULL;
}

bool fracas_family_within(const fracas_family *special, const fracas_family *general)
{
    const size_t length = strlen(general->name);
    for (const char *at = special->general; *at; at += strspn(at, " ")) {
        const size_t word = strcspn(at, " ");
        if (word == length && !strncmp(at, general->name, word)) return true;
        at += word;
    }
    return false;
}

static const double wider[FRACAS_FAMILY_STARTS] = {1, 0.7, 1.5};

typedef struct {
    double shift, scale, shape;
} weibull;

/* (fits.1) */
static void law_tails(weibull law, double x, double *below, double *above)
{
    const double z = x > law.shift ? pow((x - law.shift) / law.scale, law.shape) : 0;
    *below = -expm1(-z);
    *above = exp(-z);
}

/* The shape of a coefficient of variation, to some percent, and the scale of a mean. */
static weibull weibull_of(double mean, double cv)
{
    weibull law = {.shape = fmin(fmax(pow(cv, -1.086), 0.2), 20)};
    law.scale = mean / gsl_sf_gamma(1 + 1 / law.shape);
    return law;
}

/* Shifts to begin with: half of the smallest size, most of it, nearly none. */
static double start_shift(const fracas_family_moments *moments, int which)
{
    static const double share[FRACAS_FAMILY_STARTS] = {0.5, 0.9, 0.02};
    return share[which] * fmin(moments->smallest, 0.9);
}

/* The tails of a family by shift, scale, shape. */
#define TAILS(member, ...)                                                            \
    static void member##_tails(const double *p, double from, double x, double *below, \
                               double *above)                                         \
    {                                                                                 \
        (void)from;                                                                   \
        law_tails((weibull){__VA_ARGS__}, x, below, above);                           \
    }
TAILS(exponential, 0, p[0], 1)
TAILS(mott, 0, p[0], 0.5)
TAILS(rayleigh, 0, M_SQRT2 *p[0], 2)
TAILS(shifted_rayleigh, p[0], M_SQRT2 *p[1], 2)
TAILS(weibull, 0, p[0], p[1])
TAILS(weibull3, p[0], p[1], p[2])

static void exponential_start(const fracas_family_moments *moments, int which, double *p)
{
    static const double scale[FRACAS_FAMILY_STARTS] = {1, 0.5, 2};
    (void)moments;
    p[0] = scale[which];
}

static void mott_start(const fracas_family_moments *moments, int which, double *p)
{
    exponential_start(moments, which, p);
    p[0] /= 2;
}

static void rayleigh_start(const fracas_family_moments *moments, int which, double *p)
{
    exponential_start(moments, which, p);
    p[0] *= sqrt(2 / M_PI);
}

static void shifted_rayleigh_start(const fracas_family_moments *moments, int which, double *p)
{
    p[0] = start_shift(moments, which);
    p[1] = (1 - p[0]) * sqrt(2 / M_PI);
}

static void weibull_start(const fracas_family_moments *moments, int which, double *p)
{
    const weibull law = weibull_of(1, moments->cv * wider[which]);
    p[0] = law.scale;
    p[1] = law.shape;
}

static void weibull3_start(const fracas_family_moments *moments, int which, double *p)
{
    p[0] = start_shift(moments, which);
    const weibull law = weibull_of(1 - p[0], moments->cv / (1 - p[0]));
    p[1] = law.scale;
    p[2] = law.shape;
}

/* ---- gamma ---- */

/* (fits.2) */
static void gamma_tails(const double *p, double from, double x, double *below, double *above)
{
    (void)from;
    *below = gsl_cdf_gamma_P(x, p[1], p[0]);
    *above = gsl_cdf_gamma_Q(x, p[1], p[0]);
}

static void gamma_start(const fracas_family_moments *moments, int which, double *p)
{
    const double cv = moments->cv * wider[which];
    p[0] = cv * cv;
    p[1] = 1 / (cv * cv);
}

/* ---- lognormal ---- */

/* (fits.3) */
static void lognormal_tails(const double *p, double from, double x, double *below, double *above)
{
    (void)from;
    const double z = log(x / p[0]) / p[1];
    *below = gsl_cdf_ugaussian_P(z);
    *above = gsl_cdf_ugaussian_Q(z);
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

/* (fits.4) */
static void generalised_gamma_tails(const double *p, double from, double x, double *below,
                                    double *above)
{
    (void)from;
    const double g = to_gamma(p, x), shape = 1 / (p[2] * p[2]);
    *below = gsl_cdf_gamma_P(g, shape, 1);
    *above = gsl_cdf_gamma_Q(g, shape, 1);
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

/* (fits.5) */
static void power_law_tails(const double *p, double from, double x, double *below, double *above)
{
    const double all = beyond(p, from), rest = x > from ? beyond(p, x) : all;
    *above = rest / all;
    *below = (all - rest) / all;
}

static void power_law_start(const fracas_family_moments *moments, int which, double *p)
{
    static const double alpha[FRACAS_FAMILY_STARTS] = {0.5, 1.5, 0.1},
                        cut[FRACAS_FAMILY_STARTS] = {1.5, 5, 0.7};
    (void)moments;
    p[0] = alpha[which];
    p[1] = cut[which];
}

/* ---- the families ---- */

#define LENGTH(symbol, what)                                                     \
    {                                                                            \
        .name = symbol, .length = true, .lower = 1e-4, .upper = 1e3, .doc = what \
    }
#define SHIFT                                                                    \
    {                                                                            \
        .name = "x0", .length = true, .shift = true, .linear = true, .lower = 0, \
        .doc = "smallest size"                                                   \
    }
#define SHAPE(symbol, low, high, what)                           \
    {                                                            \
        .name = symbol, .lower = low, .upper = high, .doc = what \
    }

/* Name, families of which it is a special case, parameters. */
#define FAMILY(member, title, within, ...)                                \
    const fracas_family fracas_family_##member = {                        \
        .name = title,                                                    \
        .general = within,                                                \
        .nparameters = sizeof((fracas_family_parameter[]){__VA_ARGS__}) / \
                       sizeof(fracas_family_parameter),                   \
        .parameter = {__VA_ARGS__},                                       \
        .tails = member##_tails,                                          \
        .start = member##_start}

FAMILY(exponential, "exponential", "weibull weibull-3 gamma generalised-gamma power-law",
       LENGTH("mu", "mean"));
FAMILY(mott, "mott", "weibull weibull-3 generalised-gamma", LENGTH("mu", "half of the mean"));
FAMILY(rayleigh, "rayleigh", "shifted-rayleigh weibull weibull-3 generalised-gamma",
       LENGTH("sigma", "most frequent size"));
FAMILY(shifted_rayleigh, "shifted-rayleigh", "weibull-3", SHIFT,
       LENGTH("sigma", "most frequent size - x0"));
FAMILY(weibull, "weibull", "weibull-3 generalised-gamma", LENGTH("lambda", "scale"),
       SHAPE("k", 0.1, 50, "shape"));
FAMILY(weibull3, "weibull-3", "", SHIFT, LENGTH("lambda", "scale"), SHAPE("k", 0.1, 50, "shape"));
FAMILY(gamma, "gamma", "generalised-gamma", LENGTH("theta", "scale"),
       SHAPE("k", 0.02, 2000, "shape"));
FAMILY(lognormal, "lognormal", "generalised-gamma", LENGTH("m", "median"),
       SHAPE("sigma", 0.01, 10, "deviation of log x"));
FAMILY(generalised_gamma, "generalised-gamma", "", LENGTH("m", "scale"),
       SHAPE("sigma", 0.01, 10, "width of log x"),
       SHAPE("q", 0.03, 20, "1 Weibull, sigma gamma, towards 0 lognormal"));
FAMILY(
    power_law, "power-law", "",
    {.name = "alpha", .linear = true, .lower = 0, .upper = 6, .doc = "exponent"},
    {.name = "lambda", .length = true, .lower = 1e-3, .upper = 100, .doc = "where it is cut off"});
