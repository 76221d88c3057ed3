/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/design/uncertain.h"

#include "base/elementary.h"
#include "sampler/distribution/distribution.h"
#include "sampler/special/normal.h"

typedef struct {
    fracas_kind kind; /* first: an uncertain parameter names its distribution by this */
    const fracas_distribution *strength; /* a distribution of strengths, used here too; or */
    double (*quantile)(const fracas_uncertain *uncertain, fracas_probability p);
    fracas_err (*check)(const fracas_uncertain *uncertain); /* may be NULL */
} uncertain_kind;

/* ---- distributions of strengths, used here too ---- */

static void set_defaults(const fracas_param *params, size_t nparams, fracas_strength *strength)
{
    for (size_t i = 0; i < nparams; i++)
        if (params[i].optional) fracas_param_clear(&params[i], strength);
        else if (!isnan(params[i].fallback) && params[i].type != FRACAS_ATTACHMENT)
            fracas_param_set(&params[i], strength, params[i].fallback);
}

/* The quantile of a distribution of strengths; its other numbers have their defaults. */
static double strength_quantile(const fracas_distribution *distribution,
                                const fracas_uncertain *uncertain, fracas_probability p)
{
    fracas_strength strength = {.distribution = &distribution->kind};
    set_defaults(fracas_strength_section.params, fracas_strength_section.nparams, &strength);
    set_defaults(distribution->kind.params, distribution->kind.nparams, &strength);
    strength.minimum = uncertain->minimum;
    strength.median = uncertain->median;
    strength.sigma = uncertain->sigma;
    strength.scale = uncertain->scale;
    strength.shape = uncertain->shape;
    return fracas_strength_quantile(&strength, (fracas_extent){1.0, 1.0}, p);
}

/* ---- between two bounds ---- */

FRACAS_MUST_USE static fracas_err check_bounds(const fracas_uncertain *uncertain)
{
    if (!(uncertain->minimum >= uncertain->maximum)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "its minimum is %.15g and its maximum %.15g; the maximum must be the "
                       "larger: swap them, or give the one value in the section",
                       uncertain->minimum, uncertain->maximum);
}

/* (designs.6) */
static double uniform_quantile(const fracas_uncertain *uncertain, fracas_probability p)
{
    return uncertain->minimum * p.above + uncertain->maximum * p.below;
}

/* (designs.7) */
static double log_uniform_quantile(const fracas_uncertain *uncertain, fracas_probability p)
{
    return fracas_pow(uncertain->minimum, p.above) * fracas_pow(uncertain->maximum, p.below);
}

/* ---- normal, cut where there are bounds ---- */

typedef struct {
    double below, above, kept; /* uncut probabilities: under both bounds, over both, between */
} cut;

static cut cut_of(const fracas_uncertain *uncertain)
{
    const double a = (uncertain->minimum - uncertain->mean) / uncertain->deviation;
    const double b = (uncertain->maximum - uncertain->mean) / uncertain->deviation;
    const cut out = {isnan(a) ? 0.0 : fracas_normal_upper(-a),
                     isnan(b) ? 0.0 : fracas_normal_upper(b), 0.0};
    /* the one of the differences without cancellation */
    const double kept = a > 0.0   ? fracas_normal_upper(a) - out.above
                        : b < 0.0 ? fracas_normal_upper(-b) - out.below
                                  : 1.0 - out.below - out.above;
    return (cut){out.below, out.above, kept};
}

FRACAS_MUST_USE static fracas_err normal_check(const fracas_uncertain *uncertain)
{
    TRY(check_bounds(uncertain));
    const double kept = cut_of(uncertain).kept;
    if (kept >= 1e-9) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "its bounds leave %.3g of the normal distribution; set them nearer to the "
                       "mean, or use the distribution uniform",
                       kept);
}

/* (designs.8) */
static double normal_quantile(const fracas_uncertain *uncertain, fracas_probability p)
{
    const cut out = cut_of(uncertain);
    const fracas_probability whole = {out.below + p.below * out.kept,
                                      out.above + p.above * out.kept};
    const double value = uncertain->mean + uncertain->deviation * fracas_normal_quantile(whole);
    return fmin(fmax(value, uncertain->minimum), uncertain->maximum); /* a bound of NaN is none */
}

/* ---- the tables ---- */

#define NUMBER(key, unit, doc, fallback, minimum, maximum, open)        \
    {                                                                   \
#key, FRACAS_REAL, unit, doc, fallback, minimum, maximum, open, \
            offsetof(fracas_uncertain, key)                             \
    }
#define BOUND(key, doc)                                                           \
    {                                                                             \
#key, FRACAS_REAL, FRACAS_OWN_UNIT, doc, NAN, -INFINITY, INFINITY, false, \
            offsetof(fracas_uncertain, key), .optional = true                     \
    }

static const fracas_param between[] = {
    NUMBER(minimum, FRACAS_OWN_UNIT, "smallest value", FRACAS_REQUIRED, -INFINITY, INFINITY, false),
    NUMBER(maximum, FRACAS_OWN_UNIT, "largest value", FRACAS_REQUIRED, -INFINITY, INFINITY, false),
};
static const fracas_param log_between[] = {
    NUMBER(minimum, FRACAS_OWN_UNIT, "smallest value", FRACAS_REQUIRED, 0, INFINITY, true),
    NUMBER(maximum, FRACAS_OWN_UNIT, "largest value", FRACAS_REQUIRED, 0, INFINITY, true),
};
static const fracas_param normal_params[] = {
    NUMBER(mean, FRACAS_OWN_UNIT, "mean, before it is cut", FRACAS_REQUIRED, -INFINITY, INFINITY,
           false),
    NUMBER(deviation, FRACAS_OWN_UNIT, "standard deviation, before it is cut", FRACAS_REQUIRED, 0,
           INFINITY, true),
    BOUND(minimum, "values below are cut off"),
    BOUND(maximum, "values above are cut off"),
};
static const fracas_param lognormal_params[] = {
    NUMBER(median, FRACAS_OWN_UNIT, "median", FRACAS_REQUIRED, 0, INFINITY, true),
    NUMBER(sigma, "1", "standard deviation of the logarithm", FRACAS_REQUIRED, 0, 10, true),
};
static const fracas_param weibull_params[] = {
    NUMBER(minimum, FRACAS_OWN_UNIT, "smallest value", 0, -INFINITY, INFINITY, false),
    NUMBER(scale, FRACAS_OWN_UNIT, "scale above the minimum", FRACAS_REQUIRED, 0, INFINITY, true),
    NUMBER(shape, "1", "Weibull modulus", FRACAS_REQUIRED, 0.1, 1000, false),
};
static const fracas_param gamma_params[] = {
    NUMBER(scale, FRACAS_OWN_UNIT, "scale: the mean is shape scale", FRACAS_REQUIRED, 0, INFINITY,
           true),
    NUMBER(shape, "1", "shape: the coefficient of variation is 1/sqrt(shape)", FRACAS_REQUIRED, 0.1,
           1e6, false),
};

#define KIND(name, text, doc, params, ...) \
    static const uncertain_kind name = {{text, doc, FRACAS_PARAMS(params)}, __VA_ARGS__}
KIND(uniform, "uniform", "all values between two bounds equally likely", between, NULL,
     uniform_quantile, check_bounds);
KIND(log_uniform, "log-uniform", "logarithm uniform between two bounds", log_between, NULL,
     log_uniform_quantile, check_bounds);
KIND(normal, "normal", "normal; of both signs, unless it is cut", normal_params, NULL,
     normal_quantile, normal_check);
KIND(lognormal, "lognormal", "logarithm normal: median exp(sigma z)", lognormal_params,
     &fracas_lognormal);
KIND(weibull, "weibull", "Weibull, with two or three parameters", weibull_params, &fracas_weibull);
KIND(gamma_kind, "gamma", "gamma: mean shape scale, variance shape scale^2", gamma_params,
     &fracas_gamma_distribution);

static const fracas_kind *const distributions[] = {&uniform.kind, &log_uniform.kind,
                                                   &normal.kind,  &lognormal.kind,
                                                   &weibull.kind, &gamma_kind.kind};

const fracas_section fracas_uncertain_section = {
    .name = "parameters",
    .doc = "What is not known exactly",
    .selector = "distribution",
    FRACAS_KINDS(distributions),
    .kind_offset = offsetof(fracas_uncertain, kind),
};

static const uncertain_kind *kind_of(const fracas_uncertain *uncertain)
{
    return (const uncertain_kind *)(const void *)uncertain->kind;
}

fracas_err fracas_uncertain_check(const fracas_uncertain *uncertain)
{
    return kind_of(uncertain)->check ? kind_of(uncertain)->check(uncertain) : FRACAS_OK;
}

double fracas_uncertain_quantile(const fracas_uncertain *uncertain, fracas_probability p)
{
    const uncertain_kind *kind = kind_of(uncertain);
    return kind->strength ? strength_quantile(kind->strength, uncertain, p)
                          : kind->quantile(uncertain, p);
}
