/* Random strength fields by inverse transform from counter-based streams. */
#ifndef FRACAS_SAMPLER_SAMPLER_H
#define FRACAS_SAMPLER_SAMPLER_H

#include "base/err.h"
#include "base/param.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* `strength` of the campaign file, resolved, in SI. A distribution uses the members its table names. */
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
} fracas_strength;

/* The section `strength`; its offset is 0: the owner says where the struct is. */
extern const fracas_section fracas_strength_section;

/* FRACAS_USAGE when values that are each in range do not go together (uniform: minimum < maximum). */
FRACAS_MUST_USE fracas_err fracas_strength_check(const fracas_strength *strength);

/* The name of a stream of random numbers: a value depends on this and its place, on nothing else. */
typedef struct {
    uint64_t seed;     /* of the campaign */
    uint64_t purpose;  /* FRACAS_PURPOSE_... */
    uint64_t point[2]; /* point hash */
    uint64_t replica;
} fracas_stream;

#define FRACAS_PURPOSE_STRENGTH 1u
#define FRACAS_PURPOSE_MESH 2u

/* u in (0, 1): word 0 of Philox4x64-10 with key (seed, purpose) and counter (site, replica, point),
 * as ((x >> 12) + 1/2) 2^-52. site = interface + Gauss point * 2^48.
 * u and 1 - u are both exact, from 2^-53 to 1 - 2^-53 (with 53 bits of x, u could round to 1). */
double fracas_stream_uniform(const fracas_stream *stream, uint64_t site);

/* sigma_c[i*stride] = F^-1(u_i) [Pa] for interfaces i = 0 .. n-1, whatever n and stride; `stride` lets a lane of a
 * batch be filled in place. `volume`: [n], as for fracas_strength_quantile. Of a file, its value i, whatever the stream (NaN
 * beyond its end). Of positions, the value of the line at position[i] [m]; FRACAS_USAGE where there is none or more than one,
 * FRACAS_ENVIRONMENT without memory. Else it does not fail, and `position` may be NULL. */
FRACAS_MUST_USE fracas_err fracas_strength_sample(const fracas_strength *strength, const fracas_stream *stream, size_t n,
                                                  const double *volume, const double (*position)[3], size_t stride,
                                                  double *sigma_c);

/* Number of strengths that there are, where they are given (distributions `file`, `positions`) and not drawn; 0: as many as one
 * likes. */
size_t fracas_strength_count(const fracas_strength *strength);

/* True if there is such a number: they are the same for every replica. */
bool fracas_strength_is_given(const fracas_strength *strength);

/* True if they are found by position (distribution `positions`): there may be more than interfaces. */
bool fracas_strength_is_placed(const fracas_strength *strength);

/* F^-1(u) [Pa], 0 < u < 1, of an interface that stands for `volume` [m3] of the body; of a file, the smallest of its lines for u < 1/2,
 * else the largest. Only strengths with a size effect depend on the volume. */
double fracas_strength_quantile(const fracas_strength *strength, double volume, double u);

/* True if the strength of an interface depends on its volume. */
bool fracas_strength_has_size_effect(const fracas_strength *strength);

/* Mean of the distribution [Pa], same bits on every CPU; `volume` as for fracas_strength_quantile. */
double fracas_strength_mean(const fracas_strength *strength, double volume);

#endif
