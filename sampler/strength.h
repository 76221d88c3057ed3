/* Distributions of strengths. */
#ifndef FRACAS_SAMPLER_STRENGTH_H
#define FRACAS_SAMPLER_STRENGTH_H

#include "base/err.h"
#include "base/param.h"
#include "sampler/probability.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* `strength` of the campaign file, resolved, in SI. A distribution uses the members its table names; optional ones are NaN, or
 * NULL, where none is given. */
typedef struct {
    const fracas_kind *distribution;
    double value;   /* Pa, constant */
    double minimum; /* Pa */
    double maximum; /* Pa */
    double scale;   /* Pa */
    double shape;   /* 1 */
    double median;  /* Pa, lognormal: exp(mu) */
    double sigma;   /* 1, lognormal: standard deviation of the logarithm */
    double mean;      /* Pa, normal, before it is cut off at 0 */
    double deviation; /* Pa, normal */
    double density;   /* 1/m3, flaws: their mean number per volume */
    double exponent;  /* 1, flaws: of the power law of their strengths */
    const fracas_attachment *file; /* file, positions: a strength for each interface */
    const fracas_kind *covariance; /* of a correlated field; NULL: strengths are independent */
    double correlation_length;     /* m */
    double smoothness;             /* 1, matern: nu */
} fracas_strength;

/* The section `strength`; its offset is 0: the owner says where the struct is. */
extern const fracas_section fracas_strength_section;

/* FRACAS_USAGE when values that are each in range do not go together (uniform: minimum < maximum). */
FRACAS_MUST_USE fracas_err fracas_strength_check(const fracas_strength *strength);

/* What an interface stands for. */
typedef struct {
    double volume; /* m3, of the body around it */
    double area;   /* m2, of its own */
} fracas_extent;

/* F^-1 [Pa] of an interface of this extent; of a file, the smallest of its lines where p.below < 1/2, else the largest. Only
 * strengths with a size effect depend on the extent. */
double fracas_strength_quantile(const fracas_strength *strength, fracas_extent extent, fracas_probability p);

/* Mean of the distribution [Pa], same bits on every CPU. */
double fracas_strength_mean(const fracas_strength *strength, fracas_extent extent);

/* True if the strength of an interface depends on its extent. */
bool fracas_strength_has_size_effect(const fracas_strength *strength);

/* Number of strengths that there are, where they are given (distributions `file`, `positions`) and not drawn; 0: as many as one
 * likes. */
size_t fracas_strength_count(const fracas_strength *strength);

/* True if there is such a number: they are the same for every replica. */
bool fracas_strength_is_given(const fracas_strength *strength);

/* True if they are found by position (distribution `positions`): there may be more than interfaces. */
bool fracas_strength_is_placed(const fracas_strength *strength);

#endif
