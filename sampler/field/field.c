#include "sampler/field/field.h"

#include "sampler/distribution/distribution.h"
#include "sampler/field/correlation.h"
#include "sampler/special/normal.h"

#include <stdlib.h>
#include <string.h>

struct fracas_field {
    const fracas_strength *strength;
    size_t n, points;
    fracas_extent *extent; /* [n] */
    double *given;         /* [n*points], where strengths are given; else NULL */
    fracas_correlation *correlation; /* NULL where strengths are independent */
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
    return fracas_distribution_of(field->strength)->fill(field->strength, field->n * field->points, sites->position, 1, field->given);
}

fracas_err fracas_field_create(const fracas_strength *strength, const fracas_sites *sites, fracas_field **field)
{
    fracas_field *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a strength field");
    *made = (fracas_field){.strength = strength, .n = sites->n, .points = sites->points};
    made->extent = copy_of(sites->extent, sites->n, sizeof *made->extent);
    fracas_err err = made->extent ? FRACAS_OK : fracas_no_memory("a strength field");
    if (!err && fracas_strength_is_given(strength)) err = read_given(made, sites);
    if (!err && strength->covariance)
        err = fracas_correlation_create(strength, made->n * made->points, sites->position, sites->period, &made->correlation);
    if (err) fracas_field_destroy(made);
    else *field = made;
    return err;
}

void fracas_field_destroy(fracas_field *field)
{
    if (!field) return;
    free(field->extent);
    free(field->given);
    fracas_correlation_destroy(field->correlation);
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

/* (fields.17) z[k] of the normal field */
static fracas_err draw_normal_field(const fracas_field *field, const fracas_stream *stream, double *z)
{
    const size_t count = fracas_correlation_normals(field->correlation);
    double *w = malloc((count + 1) * sizeof *w);
    if (!w) return fracas_no_memory("a correlated field");
    for (size_t k = 0; k < count; k++) {
        const double u = fracas_stream_uniform(stream, fracas_stream_site(k / field->points, k % field->points));
        w[k] = fracas_normal_quantile(fracas_probability_of(u));
    }
    fracas_err err = fracas_correlation_apply(field->correlation, w, z);
    free(w);
    return err;
}

/* (fields.18) */
static fracas_err sample_correlated(const fracas_field *field, const fracas_stream *stream, size_t stride, double *sigma_c)
{
    const size_t count = fracas_field_size(field);
    double *z = malloc((count + 1) * sizeof *z);
    if (!z) return fracas_no_memory("a correlated field");
    fracas_err err = draw_normal_field(field, stream, z);
    for (size_t k = 0; k < count && !err; k++) {
        const fracas_probability p = {.below = fracas_normal_upper(-z[k]), .above = fracas_normal_upper(z[k])};
        sigma_c[k * stride] = fracas_strength_quantile(field->strength, field->extent[k / field->points], p);
    }
    free(z);
    return err;
}

/* (sampling.3) */
fracas_err fracas_field_sample(const fracas_field *field, const fracas_stream *stream, size_t stride, double *sigma_c)
{
    if (field->correlation) return sample_correlated(field, stream, stride, sigma_c);
    for (size_t i = 0, k = 0; i < field->n; i++)
        for (size_t g = 0; g < field->points; g++, k++) {
            if (field->given) {
                sigma_c[k * stride] = field->given[k];
                continue;
            }
            const double u = fracas_stream_uniform(stream, fracas_stream_site(i, g));
            sigma_c[k * stride] = fracas_strength_quantile(field->strength, field->extent[i], fracas_probability_of(u));
        }
    return FRACAS_OK;
}
