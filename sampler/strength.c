/* The registry of distributions, and what is done with any of them. */
#include "sampler/distribution/distribution.h"
#include "sampler/field/covariance.h"

static const fracas_kind *const distributions[] = {
    &fracas_weibull.kind,
    &fracas_uniform.kind,
    &fracas_lognormal.kind,
    &fracas_constant.kind,
    &fracas_normal.kind,
    &fracas_gamma_law.kind,
    &fracas_flaws.kind,
    &fracas_file_distribution.kind,
    &fracas_positions.kind,
};
static const fracas_kind *const covariances[] = {&fracas_covariance_exponential, &fracas_covariance_matern, &fracas_covariance_gaussian};
static const fracas_param params[] = {
    {.name = "covariance", .type = FRACAS_CHOICE, .unit = "1",
     .doc = "how strengths at a distance d are alike, through a Gaussian field of this covariance; without it they are independent",
     .offset = offsetof(fracas_strength, covariance), .choices = covariances, .nchoices = FRACAS_COUNT(covariances), .optional = true},
    {.name = "correlation_length", .type = FRACAS_REAL, .unit = "m", .doc = "length l of the covariance", .maximum = INFINITY,
     .minimum_open = true, .offset = offsetof(fracas_strength, correlation_length), .optional = true},
    {.name = "smoothness", .type = FRACAS_REAL, .unit = "1",
     .doc = "nu of a matern covariance, 1.5 where it is not given: the field can be differentiated k times "
            "for every k < nu", .minimum = 0.1, .maximum = 10, .offset = offsetof(fracas_strength, smoothness), .optional = true},
};

static fracas_err check_section(const void *section)
{
    return fracas_strength_check(section);
}

const fracas_section fracas_strength_section = {
    .name = "strength", .doc = "How strong interfaces are", .selector = "distribution", .kinds = distributions,
    .nkinds = FRACAS_COUNT(distributions), .kind_offset = offsetof(fracas_strength, distribution), .hashed = true,
    .params = params, .nparams = FRACAS_COUNT(params), .check = check_section,
};

const fracas_distribution *fracas_distribution_of(const fracas_strength *strength)
{
    return (const fracas_distribution *)(const void *)strength->distribution;
}

fracas_err fracas_strength_check(const fracas_strength *strength)
{
    const fracas_distribution *distribution = fracas_distribution_of(strength);
    TRY(fracas_covariance_check(strength));
    return distribution->check ? distribution->check(strength) : FRACAS_OK;
}

double fracas_strength_quantile(const fracas_strength *strength, fracas_extent extent, fracas_probability p)
{
    return fracas_distribution_of(strength)->quantile(strength, extent, p);
}

double fracas_strength_mean(const fracas_strength *strength, fracas_extent extent)
{
    return fracas_distribution_of(strength)->mean(strength, extent);
}

bool fracas_strength_has_size_effect(const fracas_strength *strength)
{
    return fracas_distribution_of(strength)->size_effect;
}

size_t fracas_strength_count(const fracas_strength *strength)
{
    const fracas_distribution *distribution = fracas_distribution_of(strength);
    return distribution->count ? distribution->count(strength) : 0;
}

bool fracas_strength_is_given(const fracas_strength *strength)
{
    return fracas_distribution_of(strength)->fill != NULL;
}

bool fracas_strength_is_placed(const fracas_strength *strength)
{
    return fracas_distribution_of(strength)->placed;
}
