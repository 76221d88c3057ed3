/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distributions of strengths. */
#ifndef FRACAS_SAMPLER_STRENGTH_H
#define FRACAS_SAMPLER_STRENGTH_H

#include "base/err.h"
#include "base/param.h"
#include "sampler/probability.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* `strength` of the campaign file, resolved, in SI. A distribution uses the members its table
 * names; optional ones are NaN, or NULL, where none is given. */
typedef struct {
    const fracas_kind *distribution;
    double value;                     /* Pa, constant */
    double minimum;                   /* Pa */
    double maximum;                   /* Pa */
    double scale;                     /* Pa */
    double shape;                     /* 1 */
    double median;                    /* Pa, lognormal: exp(mu) */
    double sigma;                     /* 1, lognormal: standard deviation of the logarithm */
    double mean;                      /* Pa; normal: before it is cut off at 0 */
    double deviation;                 /* Pa, standard deviation, as mean */
    double own[4];                    /* numbers of one distribution alone: its file names them */
    const fracas_attachment *file;    /* strengths: each interface's; empirical: measured ones */
    const fracas_kind *interpolation; /* empirical: between its strengths */
    double reference_volume;          /* m3, or */
    double reference_area;            /* m2: extent of the interfaces with the given strengths */
    const fracas_kind *covariance;    /* a correlated field's; NULL: strengths are independent */
    double correlation_length;        /* m */
    double smoothness;                /* 1, matern: nu */
    const fracas_kind *per;           /* interface, gauss-point; NULL: interface */
    const fracas_attachment *factor;  /* profile of a factor of the strengths; NULL: 1 everywhere */
    const fracas_kind *factor_along;  /* x, y, z, radius: the profile's coordinate, given with it */
    bool ready;                       /* made by fracas_strength_init */
    struct fracas_table *table;       /* empirical, ready: owned */
} fracas_strength;

extern const fracas_kind fracas_along_x, fracas_along_y, fracas_along_z, fracas_along_radius;

/* The section `strength`; its offset is 0: the owner says where the struct is. */
extern const fracas_section fracas_strength_section;

/* FRACAS_USAGE when values in range contradict each other (uniform: minimum < maximum), if the
 * parameters are not exactly one of the distribution's sets, or if a file has a fault. */
FRACAS_MUST_USE fracas_err fracas_strength_check(const fracas_strength *strength);

/* *ready = the same strengths by the distribution's own parameters (from mean and deviation, say; a
 * table sorted). The functions below need them. Given strengths that are not ready they find them
 * at each call, which takes longer and gives the same bits, or NaN where this function fails. To be
 * cleared; `given` must outlive it. FRACAS_USAGE as fracas_strength_check, FRACAS_ENVIRONMENT
 * without memory; then there is nothing to clear. */
FRACAS_MUST_USE fracas_err fracas_strength_init(const fracas_strength *given,
                                                fracas_strength *ready);
void fracas_strength_clear(fracas_strength *ready);

/* Extent of an interface, for size effects. */
typedef struct {
    double volume; /* m3, body around it */
    double area;   /* m2, its own */
} fracas_extent;

/* F^-1 [Pa] of an interface of this extent; of a file, the smallest of its lines where p.below <
 * 1/2, else the largest. Only strengths with a size effect depend on the extent. */
double fracas_strength_quantile(const fracas_strength *strength, fracas_extent extent,
                                fracas_probability p);

/* Mean and standard deviation of the distribution of an interface of this extent [Pa], same bits on
 * every CPU. */
double fracas_strength_mean(const fracas_strength *strength, fracas_extent extent);
double fracas_strength_deviation(const fracas_strength *strength, fracas_extent extent);

/* Mott's modulus of the strengths of interfaces of this extent [1]
 *   M = m mean/(mean - minimum)                         (scaling-laws.8), (scaling-laws.9)
 * where m is the Weibull shape, or the exponent of the flaws if most interfaces have one. NaN for
 * other distributions, or without such an m. */
double fracas_strength_modulus(const fracas_strength *strength, fracas_extent extent);

/* True if the strength of an interface depends on its extent. */
bool fracas_strength_has_size_effect(const fracas_strength *strength);

/* Text for messages about equal strengths: ", here by ..." with the key that scatters them; "". */
const char *fracas_strength_scatter_remedy(const fracas_strength *strength);

/* Number of given strengths (distributions `file`, `positions`); 0 for drawn ones: there are as
 * many as you like. */
size_t fracas_strength_count(const fracas_strength *strength);

/* True if there is such a number: they are the same for every replica. */
bool fracas_strength_is_given(const fracas_strength *strength);

/* True if each Gauss point of an interface has a strength of its own. */
bool fracas_strength_is_per_point(const fracas_strength *strength);

/* True if found by position (distribution `positions`): there may be more than interfaces. */
bool fracas_strength_is_placed(const fracas_strength *strength);

#endif
