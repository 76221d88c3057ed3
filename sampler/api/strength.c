/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The registry of distributions, and their common functions. */
#include "sampler/distribution/distribution.h"

#include "base/own.h"
#include "sampler/distribution/given.h"
#include "sampler/distribution/size.h"
#include "sampler/field/covariance.h"
#include "sampler/field/grading.h"

#define FRACAS_DISTRIBUTION(name) &name.kind,
static const fracas_kind *const distributions[] = {
#include "sampler/distribution/distributions.list.h"
};
static const fracas_kind *const covariances[] = {
    &fracas_covariance_exponential, &fracas_covariance_matern, &fracas_covariance_gaussian};
static const fracas_kind per_interface = {.name = "interface",
                                          .doc = "one strength for all of an interface"};
static const fracas_kind per_point = {.name = "gauss-point",
                                      .doc = "one for each Gauss point of an interface of a "
                                             "surface; bars and rings have one point an interface"};
static const fracas_kind *const places[] = {&per_interface, &per_point};

const fracas_kind fracas_along_x = {.name = "x", .doc = "along x"},
                  fracas_along_y = {.name = "y", .doc = "along y"},
                  fracas_along_z = {.name = "z", .doc = "along z"},
                  fracas_along_radius = {.name = "radius",
                                         .doc = "the distance from the z axis, sqrt(x^2 + y^2)"};
static const fracas_kind *const directions[] = {&fracas_along_x, &fracas_along_y, &fracas_along_z,
                                                &fracas_along_radius};

static const fracas_param params[] = {
    {FRACAS_ONE_OF("per", places, offsetof(fracas_strength, per),
                   "what has a strength of its own; none is interface"),
     .optional = true},
    {.name = "factor",
     .type = FRACAS_ATTACHMENT,
     .unit = "1",
     .doc = "text whose lines begin with a coordinate [m] and a factor by which strengths there "
            "are multiplied, linear between two lines; coordinates increase, one that is given "
            "twice is a jump",
     .offset = offsetof(fracas_strength, factor),
     .optional = true},
    {FRACAS_ONE_OF("factor_along", directions, offsetof(fracas_strength, factor_along),
                   "which coordinate those of the file `factor` are"),
     .optional = true},
    {"reference_volume", FRACAS_REAL, "m3",
     "volume of a specimen that has the strengths that are given: an interface has those of the "
     "weakest of as many specimens as fill its volume",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_strength, reference_volume),
     .optional = true},
    {"reference_area", FRACAS_REAL, "m2",
     "area of a specimen, in place of its volume: an interface counts by its own area",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_strength, reference_area),
     .optional = true},
    {FRACAS_ONE_OF(
         "covariance", covariances, offsetof(fracas_strength, covariance),
         "how strengths at a distance d are alike, through a Gaussian field of this covariance; "
         "without it they are independent"),
     .optional = true},
    {.name = "correlation_length",
     .type = FRACAS_REAL,
     .unit = "m",
     .doc = "length l of the covariance",
     .maximum = INFINITY,
     .minimum_open = true,
     .offset = offsetof(fracas_strength, correlation_length),
     .optional = true},
    {.name = "smoothness",
     .type = FRACAS_REAL,
     .unit = "1",
     .doc = "nu of a matern covariance, 1.5 where it is not given: the field can be differentiated "
            "k times for every k < nu",
     .minimum = 0.1,
     .maximum = 10,
     .offset = offsetof(fracas_strength, smoothness),
     .optional = true},
};

static fracas_err check_section(const void *section)
{
    return fracas_strength_check(section);
}

const fracas_section fracas_strength_section = {
    .name = "strength",
    .doc = "How strong interfaces are",
    .selector = "distribution",
    FRACAS_KINDS(distributions),
    .kind_offset = offsetof(fracas_strength, distribution),
    .hashed = true,
    FRACAS_PARAMS(params),
    .check = check_section,
};

const fracas_distribution *fracas_distribution_of(const fracas_strength *strength)
{
    return (const fracas_distribution *)(const void *)strength->distribution;
}

static bool has_reference(const fracas_strength *strength)
{
    return strength->reference_volume > 0.0 || strength->reference_area > 0.0;
}

static fracas_err check_reference(const fracas_strength *strength)
{
    const char *key = strength->reference_volume > 0.0 ? "reference_volume" : "reference_area";
    if (!has_reference(strength)) return FRACAS_OK;
    if (strength->reference_volume > 0.0 && strength->reference_area > 0.0)
        return fracas_fail(
            FRACAS_USAGE,
            "`reference_volume` and `reference_area` are both given: take out one of them");
    if (fracas_distribution_of(strength)->takes_reference) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "`%s` does not go with the distribution %s, whose strengths %s: take it out",
                       key, strength->distribution->name,
                       fracas_distribution_of(strength)->size_effect
                           ? "depend on the volume by themselves"
                           : "are the same whatever the extent of an interface");
}

fracas_err fracas_strength_init(const fracas_strength *given, fracas_strength *ready)
{
    const fracas_distribution *distribution = fracas_distribution_of(given);
    *ready = *given;
    ready->ready = false;
    TRY(check_reference(given));
    if (distribution->init) TRY(distribution->init(ready));
    ready->ready = true;
    return FRACAS_OK;
}

void fracas_strength_clear(fracas_strength *ready)
{
    if (ready->ready && fracas_distribution_of(ready)->clear)
        fracas_distribution_of(ready)->clear(ready);
}

fracas_err fracas_strength_check(const fracas_strength *strength)
{
    FRACAS_CLEARED(fracas_strength) ready = {0};
    if (fracas_strength_is_given(strength) && fracas_strength_is_per_point(strength))
        return fracas_fail(FRACAS_USAGE,
                           "strength.per is gauss-point, but the distribution `%s` gives one "
                           "strength to each interface: leave out `per`, or let strengths be drawn",
                           strength->distribution->name);
    TRY(fracas_covariance_check(strength));
    TRY(fracas_grading_check(strength));
    return fracas_strength_init(strength, &ready);
}

/* Strengths from a file, which may be long, need nothing to be ready. */
static bool is_ready(const fracas_strength *strength)
{
    return strength->ready || fracas_strength_is_given(strength);
}

double fracas_strength_quantile(const fracas_strength *strength, fracas_extent extent,
                                fracas_probability p)
{
    if (!is_ready(strength)) {
        FRACAS_CLEARED(fracas_strength) ready = {0};
        if (fracas_strength_init(strength, &ready)) return NAN;
        return fracas_strength_quantile(&ready, extent, p);
    }
    if (has_reference(strength))
        return fracas_size_quantile(strength, fracas_size_of(strength, extent), p);
    return fracas_distribution_of(strength)->quantile(strength, extent, p);
}

static fracas_moments moments_of(const fracas_strength *strength, fracas_extent extent)
{
    if (!is_ready(strength)) {
        FRACAS_CLEARED(fracas_strength) ready = {0};
        if (fracas_strength_init(strength, &ready)) return (fracas_moments){NAN, NAN};
        return moments_of(&ready, extent);
    }
    if (has_reference(strength))
        return fracas_size_moments(strength, fracas_size_of(strength, extent));
    return fracas_distribution_of(strength)->moments(strength, extent);
}

double fracas_strength_mean(const fracas_strength *strength, fracas_extent extent)
{
    return moments_of(strength, extent).mean;
}

double fracas_strength_deviation(const fracas_strength *strength, fracas_extent extent)
{
    return moments_of(strength, extent).deviation;
}

/* (scaling-laws.8), (scaling-laws.9) */
double fracas_strength_modulus(const fracas_strength *strength, fracas_extent extent)
{
    FRACAS_CLEARED(fracas_strength) ready = {0};
    const fracas_distribution *distribution = fracas_distribution_of(strength);
    if (!distribution->tail || fracas_strength_init(strength, &ready)) return NAN;
    const double mean = fracas_strength_mean(&ready, extent), above = mean - ready.minimum;
    return above > 0 ? distribution->tail(&ready, extent) * mean / above : NAN;
}

bool fracas_strength_has_size_effect(const fracas_strength *strength)
{
    return fracas_distribution_of(strength)->size_effect || has_reference(strength);
}

const char *fracas_strength_scatter_remedy(const fracas_strength *strength)
{
    const char *remedy = fracas_distribution_of(strength)->scatter_remedy;
    return remedy ? remedy : "";
}

size_t fracas_strength_count(const fracas_strength *strength)
{
    return fracas_strength_is_given(strength) ? fracas_given_count(strength) : 0;
}

bool fracas_strength_is_given(const fracas_strength *strength)
{
    return fracas_distribution_of(strength)->fill != NULL;
}

bool fracas_strength_is_per_point(const fracas_strength *strength)
{
    return strength->per == &per_point;
}

bool fracas_strength_is_placed(const fracas_strength *strength)
{
    return fracas_distribution_of(strength)->placed;
}
