/* The registry of distributions, and what is done with any of them. */
#include "sampler/distribution/distribution.h"

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
static fracas_err check_section(const void *section)
{
    return fracas_strength_check(section);
}

const fracas_section fracas_strength_section = {
    .name = "strength", .doc = "How strong interfaces are", .selector = "distribution", .kinds = distributions,
    .nkinds = FRACAS_COUNT(distributions), .kind_offset = offsetof(fracas_strength, distribution), .hashed = true,
    .check = check_section,
};

const fracas_distribution *fracas_distribution_of(const fracas_strength *strength)
{
    return (const fracas_distribution *)(const void *)strength->distribution;
}

fracas_err fracas_strength_check(const fracas_strength *strength)
{
    const fracas_distribution *distribution = fracas_distribution_of(strength);
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
