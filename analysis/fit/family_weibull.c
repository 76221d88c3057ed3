/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Families with P(size > x) = exp(-((x - x0)/scale)^shape): exponential, Mott, Rayleigh, Weibull,
 * with and without a shift. */
#include "analysis/fit/family.h"

#include <gsl/gsl_sf_gamma.h>
#include <math.h>

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

static double law_log_density(weibull law, double x)
{
    if (x < law.shift) return -INFINITY;
    const double y = (x - law.shift) / law.scale;
    return log(law.shape / law.scale) + (law.shape == 1 ? 0 : (law.shape - 1) * log(y)) -
           pow(y, law.shape);
}

static double law_quantile(weibull law, double above)
{
    return law.shift + law.scale * pow(-log(above), 1 / law.shape);
}

/* The shape of a coefficient of variation, to some percent, and the scale of a mean. */
static weibull weibull_of(double mean, double cv)
{
    weibull law = {.shape = fmin(fmax(pow(cv, -1.086), 0.2), 20)};
    law.scale = mean / gsl_sf_gamma(1 + 1 / law.shape);
    return law;
}

/* Shifts to begin with: none, half of the smallest size, most of it. */
static double start_shift(const fracas_family_moments *moments, int which)
{
    static const double share[FRACAS_FAMILY_STARTS] = {0.5, 0.9, 0.02};
    return share[which] * fmin(moments->smallest, 0.9);
}

static weibull as_exponential(const double *p)
{
    return (weibull){0, p[0], 1};
}
static weibull as_mott(const double *p)
{
    return (weibull){0, p[0], 0.5};
}
static weibull as_rayleigh(const double *p)
{
    return (weibull){0, M_SQRT2 * p[0], 2};
}
static weibull as_shifted_rayleigh(const double *p)
{
    return (weibull){p[0], M_SQRT2 * p[1], 2};
}
static weibull as_weibull(const double *p)
{
    return (weibull){0, p[0], p[1]};
}
static weibull as_weibull3(const double *p)
{
    return (weibull){p[0], p[1], p[2]};
}

#define MEMBER(member)                                                                \
    static void member##_tails(const double *p, double from, double x, double *below, \
                               double *above)                                         \
    {                                                                                 \
        (void)from;                                                                   \
        law_tails(as_##member(p), x, below, above);                                   \
    }                                                                                 \
    static double member##_log_density(const double *p, double from, double x)        \
    {                                                                                 \
        (void)from;                                                                   \
        return law_log_density(as_##member(p), x);                                    \
    }                                                                                 \
    static double member##_quantile(const double *p, double from, double above)       \
    {                                                                                 \
        (void)from;                                                                   \
        return law_quantile(as_##member(p), above);                                   \
    }

MEMBER(exponential)
MEMBER(mott)
MEMBER(rayleigh)
MEMBER(shifted_rayleigh)
MEMBER(weibull)
MEMBER(weibull3)

#define FUNCTIONS(member)                                                                        \
    .tails = member##_tails, .log_density = member##_log_density, .quantile = member##_quantile, \
    .start = member##_start
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
    static const double wider[FRACAS_FAMILY_STARTS] = {1, 0.7, 1.5};
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

const fracas_family fracas_family_exponential = {
    .name = "exponential",
    .survival = "exp(-x/mu)",
    .nparameters = 1,
    .parameter = {LENGTH("mu", "mean")},
    .general = "weibull weibull-3 gamma generalised-gamma power-law",
    FUNCTIONS(exponential),
};
const fracas_family fracas_family_mott = {
    .name = "mott",
    .survival = "exp(-sqrt(x/mu))",
    .nparameters = 1,
    .parameter = {LENGTH("mu", "half of the mean")},
    .general = "weibull weibull-3 generalised-gamma",
    FUNCTIONS(mott),
};
const fracas_family fracas_family_rayleigh = {
    .name = "rayleigh",
    .survival = "exp(-x^2/(2 sigma^2))",
    .nparameters = 1,
    .parameter = {LENGTH("sigma", "most frequent size")},
    .general = "shifted-rayleigh weibull weibull-3 generalised-gamma",
    FUNCTIONS(rayleigh),
};
const fracas_family fracas_family_shifted_rayleigh = {
    .name = "shifted-rayleigh",
    .survival = "exp(-(x - x0)^2/(2 sigma^2))",
    .nparameters = 2,
    .parameter = {SHIFT, LENGTH("sigma", "most frequent size - x0")},
    .general = "weibull-3",
    FUNCTIONS(shifted_rayleigh),
};
const fracas_family fracas_family_weibull = {
    .name = "weibull",
    .survival = "exp(-(x/lambda)^k)",
    .nparameters = 2,
    .parameter = {LENGTH("lambda", "scale"), SHAPE("k", 0.1, 50, "shape")},
    .general = "weibull-3 generalised-gamma",
    FUNCTIONS(weibull),
};
const fracas_family fracas_family_weibull3 = {
    .name = "weibull-3",
    .survival = "exp(-((x - x0)/lambda)^k)",
    .nparameters = 3,
    .parameter = {SHIFT, LENGTH("lambda", "scale"), SHAPE("k", 0.1, 50, "shape")},
    .general = "",
    FUNCTIONS(weibull3),
};
