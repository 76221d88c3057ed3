/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A distribution of strengths: one file each, and a line in distributions.list.h. */
#ifndef FRACAS_SAMPLER_DISTRIBUTION_H
#define FRACAS_SAMPLER_DISTRIBUTION_H

#include "base/err.h"
#include "base/isa.h"
#include "sampler/distribution/blocks.h"
#include "sampler/distribution/lines.h"
#include "sampler/strength.h"

typedef struct {
    double mean, deviation; /* Pa; the standard deviation of the distribution, not of a sample */
} fracas_moments;

/* All functions but `init` take ready strengths (fracas_strength_init), and compute the
 * distribution before any size effect of reference_volume or reference_area. Quantile F^-1 [Pa]. */
typedef struct {
    fracas_kind kind; /* first: a strength names its distribution by this */
    double (*quantile)(const fracas_strength *strength, fracas_extent extent, fracas_probability p);
    fracas_moments (*moments)(const fracas_strength *strength, fracas_extent extent);
    fracas_err (*init)(fracas_strength *strength); /* finds, checks its parameters; may be NULL */
    void (*clear)(fracas_strength *strength);      /* frees the memory of `init`; may be NULL */
    bool size_effect;                              /* both depend on the extent */
    /* Modulus m of strengths that are Weibull's, F = 1 - exp(-((s - minimum)/scale)^m), or tend to
     * it, for Mott's law; NaN, or no function: others, whatever their tail. */
    double (*tail)(const fracas_strength *strength, fracas_extent extent);
    /* True if it can have the weakest-link size effect of a reference; then also: */
    bool takes_reference;
    double (*far)(const fracas_strength *strength, double t); /* F^-1 [Pa] at e^-t; NULL: largest */
    double far_from; /* the t from which it holds, 700 at most: p.above = e^-t is 0 beyond 745 */
    fracas_moments (*weakest)(const fracas_strength *strength, double size); /* NULL: quadrature */
    /* Both NULL for drawn strengths: the next strength of the file, and sigma_c[i*stride] =
     * strength of interface i. */
    fracas_lines_reader *read;
    fracas_err (*fill)(const fracas_strength *strength, size_t n, const double (*position)[3],
                       size_t stride, double *sigma_c);
    fracas_block block;         /* the quantile of whole blocks; NONE: of one number at a time */
    bool placed;                /* they are found by position, not by number */
    const char *scatter_remedy; /* fracas_strength_scatter_remedy; NULL: none */
} fracas_distribution;

/* The parameter `file`. */
#define FRACAS_STRENGTH_FILE(text)                                                     \
    FRACAS_BRACES(.name = "file", .type = FRACAS_ATTACHMENT, .unit = "1", .doc = text, \
                  .fallback = FRACAS_REQUIRED, .offset = offsetof(fracas_strength, file))

const fracas_distribution *fracas_distribution_of(const fracas_strength *strength);

#define FRACAS_DISTRIBUTION(name) extern const fracas_distribution name;
#include "sampler/distribution/distributions.list.h"
#undef FRACAS_DISTRIBUTION

#endif
