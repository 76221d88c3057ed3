/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strengths without a mesh or a campaign. */
#ifndef FRACAS_TESTS_SUPPORT_STRENGTHS_H
#define FRACAS_TESTS_SUPPORT_STRENGTHS_H

#include "sampler/api/sampler.h"
#include "tests/support/laws.h"

/* A realization of the field of `strength` over n interfaces that stand for these volumes (NULL: 1
 * m3 each), with areas of 1 m2, at these positions (NULL: at 0). */
static inline fracas_err sample_strengths(const fracas_strength *strength,
                                          const fracas_stream *stream, size_t n,
                                          const double *volume, const double (*position)[3],
                                          size_t stride, double *sigma_c)
{
    OWNED fracas_extent *extent = malloc((n + 1) * sizeof *extent);
    double(*origin)[3] = calloc(n + 1, sizeof *origin);
    if (!extent || !origin) abort();
    for (size_t i = 0; i < n; i++) extent[i] = (fracas_extent){volume ? volume[i] : 1.0, 1.0};
    const fracas_sites sites = {.n = n,
                                .points = 1,
                                .extent = extent,
                                .position = position ? position : (const double(*)[3])origin};
    fracas_field *field;
    fracas_err err = fracas_field_create(strength, &sites, &field);
    if (!err) {
        err = fracas_field_sample(field, stream, stride, sigma_c);
        fracas_field_destroy(field);
    }
    free(origin);
    return err;
}

/* As fracas_strength_quantile and fracas_strength_mean, for an interface that stands for this
 * volume, of 1 m2. */
static inline double quantile_of(const fracas_strength *strength, double volume, double u)
{
    return fracas_strength_quantile(strength, (fracas_extent){volume, 1.0},
                                    fracas_probability_of(u));
}

static inline double mean_of_strength(const fracas_strength *strength, double volume)
{
    return fracas_strength_mean(strength, (fracas_extent){volume, 1.0});
}

#endif
