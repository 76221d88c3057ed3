/* The registry of distributions, and what is done with any of them. */
#include "sampler/distribution.h"

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

static const fracas_distribution *distribution_of(const fracas_strength *strength)
{
    return (const fracas_distribution *)(const void *)strength->distribution;
}

fracas_err fracas_strength_check(const fracas_strength *strength)
{
    const fracas_distribution *distribution = distribution_of(strength);
    return distribution->check ? distribution->check(strength) : FRACAS_OK;
}

double fracas_strength_quantile(const fracas_strength *strength, double volume, double u)
{
    return distribution_of(strength)->quantile(strength, volume, u);
}

double fracas_strength_mean(const fracas_strength *strength, double volume)
{
    return distribution_of(strength)->mean(strength, volume);
}

bool fracas_strength_has_size_effect(const fracas_strength *strength)
{
    return distribution_of(strength)->size_effect;
}

size_t fracas_strength_count(const fracas_strength *strength)
{
    const fracas_distribution *distribution = distribution_of(strength);
    return distribution->count ? distribution->count(strength) : 0;
}

bool fracas_strength_is_given(const fracas_strength *strength)
{
    return distribution_of(strength)->fill != NULL;
}

bool fracas_strength_is_placed(const fracas_strength *strength)
{
    return distribution_of(strength)->placed;
}

/* (sampling.3) */
fracas_err fracas_strength_sample(const fracas_strength *strength, const fracas_stream *stream, size_t n, const double *volume,
                                  const double (*position)[3], size_t stride, double *sigma_c)
{
    const fracas_distribution *distribution = distribution_of(strength);
    if (distribution->fill) return distribution->fill(strength, n, position, stride, sigma_c);
    for (size_t i = 0; i < n; i++)
        sigma_c[i * stride] = distribution->quantile(strength, volume[i], fracas_stream_uniform(stream, i));
    return FRACAS_OK;
}
