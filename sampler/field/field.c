/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/field/field.h"

#include "sampler/distribution/distribution.h"
#include "sampler/field/correlation.h"
#include "sampler/field/grading.h"
#include "sampler/special/normal.h"

#include <stdlib.h>
#include <string.h>

struct fracas_field {
    const fracas_strength *strength; /* ready: `drawn`, or as passed where strengths are given */
    fracas_strength drawn;
    size_t n, points;
    fracas_extent *extent;           /* [n] */
    double *given;                   /* [n*points], where strengths are given; else NULL */
    fracas_correlation *correlation; /* NULL where strengths are independent */
    double *factor;                  /* [n*points], where the material is graded; else NULL */
    fracas_isa isa;
};

/* A copy of `count` elements; NULL without memory. */
static void *copy_of(const void *from, size_t count, size_t size)
{
    void *copy = malloc(count > 0 ? count * size : 1);
    if (copy && count > 0) memcpy(copy, from, count * size);
    return copy;
}

static fracas_err read_given(fracas_field *field, const fracas_sites *sites)
{
    field->given = malloc((field->n * field->points + 1) * sizeof *field->given);
    if (!field->given) return fracas_no_memory("the strengths of a file");
    return fracas_distribution_of(field->strength)
        ->fill(field->strength, field->n * field->points, sites->position, 1, field->given);
}

fracas_err fracas_field_create(const fracas_strength *strength, const fracas_sites *sites,
                               fracas_field **field)
{
    const size_t n = sites->n * sites->points;
    OWN(fracas_field) made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a strength field");
    *made = (fracas_field){.strength = strength, .n = sites->n, .points = sites->points};
    made->extent = copy_of(sites->extent, sites->n, sizeof *made->extent);
    if (!made->extent) return fracas_no_memory("a strength field");
    TRY(fracas_isa_choose(FRACAS_ISA_BEST, &made->isa));
    if (fracas_strength_is_given(strength)) {
        TRY(read_given(made, sites));
    } else {
        TRY(fracas_strength_init(strength, &made->drawn));
        made->strength = &made->drawn;
    }
    if (strength->covariance)
        TRY(fracas_correlation_create(strength, n, sites->position, sites->period,
                                      &made->correlation));
    TRY(fracas_grading_create(strength, n, sites->position, &made->factor));
    *field = made;
    made = NULL;
    return FRACAS_OK;
}

void fracas_field_destroy(fracas_field *field)
{
    if (!field) return;
    if (field->strength == &field->drawn) fracas_strength_clear(&field->drawn);
    free(field->extent);
    free(field->given);
    fracas_correlation_destroy(field->correlation);
    free(field->factor);
    free(field);
}

size_t fracas_field_size(const fracas_field *field)
{
    return field->n * field->points;
}

double fracas_field_error(const fracas_field *field)
{
    return field->correlation ? fracas_correlation_error(field->correlation) : 0.0;
}

fracas_err fracas_field_use(fracas_field *field, fracas_isa isa)
{
    return fracas_isa_choose(isa, &field->isa);
}

/* ---- a realization ---- */

/* (sampling.3) over lanes: the sites of a Gauss point are successive. Lanes beyond the last
 * interface draw numbers of no use. */
static void sample_blocks(const fracas_field *field, fracas_block_quantile *quantile,
                          const fracas_stream *stream, size_t stride, double *sigma_c)
{
    enum { BLOCK = 32 * FRACAS_LANES_MAX };
    double u[BLOCK] __attribute__((aligned(64))), x[BLOCK] __attribute__((aligned(64)));
    const size_t next = field->points * stride;
    for (size_t g = 0; g < field->points; g++)
        for (size_t i = 0; i < field->n; i += BLOCK) {
            const size_t left = field->n - i, count = left < BLOCK ? left : BLOCK;
            const size_t whole = (count + FRACAS_LANES_MAX - 1) / FRACAS_LANES_MAX *
                                 FRACAS_LANES_MAX;
            fracas_stream_fill(stream, fracas_stream_site(i, g), whole, u);
            quantile(field->strength, whole, u, x);
            for (size_t j = 0; j < count; j++) sigma_c[g * stride + (i + j) * next] = x[j];
        }
}

/* (sampling.3) */
static void sample_each(const fracas_field *field, const fracas_stream *stream, size_t stride,
                        double *sigma_c)
{
    for (size_t i = 0, k = 0; i < field->n; i++)
        for (size_t g = 0; g < field->points; g++, k++) {
            const double u = fracas_stream_uniform(stream, fracas_stream_site(i, g));
            sigma_c[k * stride] = fracas_strength_quantile(field->strength, field->extent[i],
                                                           fracas_probability_of(u));
        }
}

/* (fields.17) z[k] of the normal field */
static fracas_err draw_normal_field(const fracas_field *field, const fracas_stream *stream,
                                    double *z)
{
    const size_t count = fracas_correlation_normals(field->correlation);
    OWNED double *w = malloc((count + 1) * sizeof *w);
    if (!w) return fracas_no_memory("a correlated field");
    for (size_t k = 0; k < count; k++) {
        const double u = fracas_stream_uniform(
            stream, fracas_stream_site(k / field->points, k % field->points));
        w[k] = fracas_normal_quantile(fracas_probability_of(u));
    }
    return fracas_correlation_apply(field->correlation, w, z);
}

/* (fields.18) */
static fracas_err sample_correlated(const fracas_field *field, const fracas_stream *stream,
                                    size_t stride, double *sigma_c)
{
    const size_t count = fracas_field_size(field);
    OWNED double *z = malloc((count + 1) * sizeof *z);
    if (!z) return fracas_no_memory("a correlated field");
    TRY(draw_normal_field(field, stream, z));
    for (size_t k = 0; k < count; k++) {
        const fracas_probability p = {.below = fracas_normal_upper(-z[k]),
                                      .above = fracas_normal_upper(z[k])};
        sigma_c[k * stride] = fracas_strength_quantile(field->strength,
                                                       field->extent[k / field->points], p);
    }
    return FRACAS_OK;
}

fracas_err fracas_field_sample(const fracas_field *field, const fracas_stream *stream,
                               size_t stride, double *sigma_c)
{
    fracas_block_quantile *block = fracas_block_quantile_of(
        fracas_distribution_of(field->strength)->block, field->isa, FRACAS_LANES_MAX);
    if (fracas_strength_has_size_effect(field->strength)) block = NULL; /* blocks know no extents */
    if (field->correlation) TRY(sample_correlated(field, stream, stride, sigma_c));
    else if (block) sample_blocks(field, block, stream, stride, sigma_c);
    else if (!field->given) sample_each(field, stream, stride, sigma_c);
    for (size_t k = 0; field->given && k < fracas_field_size(field); k++)
        sigma_c[k * stride] = field->given[k];
    for (size_t k = 0; field->factor && k < fracas_field_size(field); k++)
        sigma_c[k * stride] *= field->factor[k]; /* (grading.3) */
    return FRACAS_OK;
}
