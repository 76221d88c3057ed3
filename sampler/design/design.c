/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/design/design.h"

#include "base/own.h"
#include "sampler/design/correlation.h"
#include "sampler/stream.h"

#include <gsl/gsl_qrng.h>
#include <stdbool.h>

typedef struct {
    fracas_kind kind; /* first: a design names its type by this */
    fracas_err (*fill)(const fracas_design *design, fracas_probability *p); /* independent */
    bool stratified; /* they only give the order of the points in each parameter */
} design_type;

/* Purposes of a parameter's random numbers. */
enum { PLACE, JITTER, SHIFT };

/* (designs.1) */
static fracas_stream stream_of(const fracas_design *design, size_t parameter, uint64_t use)
{
    return (fracas_stream){.seed = design->seed,
                           .purpose = FRACAS_PURPOSE_DESIGN,
                           .point = {use},
                           .replica = design->name[parameter]};
}

/* ---- random ---- */

FRACAS_MUST_USE static fracas_err random_fill(const fracas_design *design, fracas_probability *p)
{
    for (size_t j = 0; j < design->parameters; j++) {
        const fracas_stream stream = stream_of(design, j, PLACE);
        for (size_t i = 0; i < design->points; i++)
            p[i * design->parameters + j] = fracas_probability_of(
                fracas_stream_uniform(&stream, i));
    }
    return FRACAS_OK;
}

static const design_type random_type = {
    .kind = {.name = "random",
             .doc = "points at random, each on its own; can be extended by more of them"},
    .fill = random_fill,
};

/* ---- Latin hypercube: a random design whose points are moved, in each parameter, to the stratum
 * of their rank ---- */

typedef struct {
    double u;
    size_t point;
} ranked;

static int by_u(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    int order = (x->u > y->u) - (x->u < y->u);
    return order ? order : (x->point > y->point) - (x->point < y->point);
}

/* (designs.2) Both tails by themselves: u may round to 1 in the last stratum, 1 - u is then still
 * right. */
FRACAS_MUST_USE static fracas_err stratify(const fracas_design *design, fracas_probability *p)
{
    const size_t n = design->points;
    OWNED ranked *order = malloc(n * sizeof *order);
    if (!order) return fracas_no_memory("the points of a design");
    for (size_t j = 0; j < design->parameters; j++) {
        const fracas_stream stream = stream_of(design, j, JITTER);
        for (size_t i = 0; i < n; i++) order[i] = (ranked){p[i * design->parameters + j].below, i};
        qsort(order, n, sizeof *order, by_u);
        for (size_t rank = 0; rank < n; rank++) {
            const size_t i = order[rank].point;
            const double v = fracas_stream_uniform(&stream, i);
            p[i * design->parameters + j] = (fracas_probability){
                ((double)rank + v) / (double)n, ((double)(n - 1 - rank) + (1.0 - v)) / (double)n};
        }
    }
    return FRACAS_OK;
}

static const design_type latin_hypercube = {
    .kind = {.name = "latin-hypercube",
             .doc = "one point in each of n equally likely strata of every parameter"},
    .fill = random_fill,
    .stratified = true,
};

/* ---- Sobol sequence ---- */

/* (designs.3) The sequence begins with the origin, which GSL leaves out. x is a multiple of 2^-30
 * and s an odd one of 2^-53: u is exact, and neither 0 nor 1. */
static void shift(const double *x, const double *s, size_t parameters, fracas_probability *p)
{
    for (size_t j = 0; j < parameters; j++)
        p[j] = fracas_probability_of(s[j] < 1.0 - x[j] ? x[j] + s[j] : s[j] - (1.0 - x[j]));
}

/* The generator in memory of our own: gsl_qrng_alloc ends the program where there is none. */
FRACAS_MUST_USE static fracas_err sobol_fill(const fracas_design *design, fracas_probability *p)
{
    const unsigned d = (unsigned)design->parameters;
    double x[40] = {0.0}, s[40]; /* gsl_qrng_sobol has no more */
    OWNED void *state = malloc(gsl_qrng_sobol->state_size(d));
    if (!state) return fracas_no_memory("a Sobol sequence");
    gsl_qrng_sobol->init_state(state, d);
    for (size_t j = 0; j < d; j++) {
        const fracas_stream stream = stream_of(design, j, SHIFT);
        s[j] = fracas_stream_uniform(&stream, 0);
    }
    for (size_t i = 0; i < design->points; i++) {
        if (i > 0) gsl_qrng_sobol->get(state, d, x);
        shift(x, s, d, p + i * d);
    }
    return FRACAS_OK;
}

static const design_type sobol = {
    .kind = {.name = "sobol",
             .doc = "points of a Sobol sequence, shifted at random; even, and can be extended by "
                    "more of them"},
    .fill = sobol_fill,
};

/* ---- any ---- */

const fracas_kind *const fracas_design_types[3] = {&latin_hypercube.kind, &sobol.kind,
                                                   &random_type.kind};

size_t fracas_design_most_parameters(const fracas_kind *type)
{
    return type == &sobol.kind ? gsl_qrng_sobol->max_dimension : SIZE_MAX;
}

FRACAS_MUST_USE static fracas_err correlate(const fracas_design *design, fracas_probability *p)
{
    const size_t d = design->parameters;
    OWNED double *room = malloc((d + 1) * d * sizeof *room);
    double *factor = room + d, rest;
    size_t at;
    if (!room) return fracas_no_memory("the correlation of a design");
    if (!fracas_correlation_factor(d, design->correlation, factor, &at, &rest))
        return fracas_fail(
            FRACAS_BUG, "a design whose correlation is not positive definite at parameter %zu", at);
    for (size_t i = 0; i < design->points; i++) fracas_correlate(d, factor, room, p + i * d);
    return FRACAS_OK;
}

fracas_err fracas_design_fill(const fracas_design *design, fracas_probability *p)
{
    const design_type *type = (const design_type *)(const void *)design->type;
    TRY(type->fill(design, p));
    if (design->correlation) TRY(correlate(design, p));
    return type->stratified ? stratify(design, p) : FRACAS_OK;
}
