/* The registry of distributions, and what is done with any of them. */
#include "sampler/distribution/distribution.h"
#include "sampler/field/grading.h"

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

static const fracas_kind per_interface = {.name = "interface", .doc = "one strength for all of an interface"};
static const fracas_kind per_point = {.name = "gauss-point",
                                      .doc = "one for each Gauss point of an interface of a surface; bars and rings have one point an interface"};
static const fracas_kind *const places[] = {&per_interface, &per_point};

const fracas_kind fracas_along_x = {.name = "x", .doc = "along x"}, fracas_along_y = {.name = "y", .doc = "along y"},
                  fracas_along_z = {.name = "z", .doc = "along z"},
                  fracas_along_radius = {.name = "radius", .doc = "the distance from the z axis, sqrt(x^2 + y^2)"};
static const fracas_kind *const directions[] = {&fracas_along_x, &fracas_along_y, &fracas_along_z, &fracas_along_radius};

static const fracas_param params[] = {
    {.name = "per", .type = FRACAS_CHOICE, .unit = "1", .doc = "what has a strength of its own; none is interface", .choices = places,
     .nchoices = FRACAS_COUNT(places), .offset = offsetof(fracas_strength, per), .optional = true},
    {.name = "factor", .type = FRACAS_ATTACHMENT, .unit = "1",
     .doc = "text whose lines begin with a coordinate [m] and a factor by which strengths there are multiplied, linear between two lines; "
            "coordinates increase, one that is given twice is a jump",
     .offset = offsetof(fracas_strength, factor), .optional = true},
    {.name = "factor_along", .type = FRACAS_CHOICE, .unit = "1", .doc = "which coordinate those of the file `factor` are",
     .choices = directions, .nchoices = FRACAS_COUNT(directions), .offset = offsetof(fracas_strength, factor_along), .optional = true},
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
    if (fracas_strength_is_given(strength) && fracas_strength_is_per_point(strength))
        return fracas_fail(FRACAS_USAGE, "strength.per is gauss-point, but the distribution `%s` gives one strength to each interface: "
                           "leave out `per`, or let strengths be drawn", distribution->kind.name);
    TRY(fracas_grading_check(strength));
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

bool fracas_strength_is_per_point(const fracas_strength *strength)
{
    return strength->per == &per_point;
}

bool fracas_strength_is_placed(const fracas_strength *strength)
{
    return fracas_distribution_of(strength)->placed;
}
