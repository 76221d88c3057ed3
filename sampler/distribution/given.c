/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/distribution/given.h"

fracas_err fracas_given_init(fracas_strength *strength)
{
    fracas_lines_summary of;
    return fracas_lines_summarize(strength->file, fracas_distribution_of(strength)->read, &of);
}

/* The file was checked when the campaign was read. */
static fracas_lines_summary summary_of(const fracas_strength *strength)
{
    fracas_lines_summary of;
    const fracas_err err = fracas_lines_summarize(strength->file,
                                                  fracas_distribution_of(strength)->read, &of);
    return err ? (fracas_lines_summary){.sum = NAN} : of;
}

double fracas_given_quantile(const fracas_strength *strength, fracas_extent extent,
                             fracas_probability p)
{
    (void)extent;
    const fracas_lines_summary of = summary_of(strength);
    return p.below < 0.5 ? of.smallest : of.largest;
}

fracas_moments fracas_given_moments(const fracas_strength *strength, fracas_extent extent)
{
    (void)extent;
    const fracas_lines_summary of = summary_of(strength);
    return (fracas_moments){of.sum / (double)of.count, sqrt(of.squares / (double)of.count)};
}

size_t fracas_given_count(const fracas_strength *strength)
{
    return summary_of(strength).count;
}
