/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a distribution of strengths is: one file each, and a line in sampler/strength.c. */
#ifndef FRACAS_SAMPLER_DISTRIBUTION_H
#define FRACAS_SAMPLER_DISTRIBUTION_H

#include "base/err.h"
#include "base/isa.h"
#include "sampler/distribution/blocks.h"
#include "sampler/distribution/lines.h"
#include "sampler/strength.h"

typedef struct {
    double mean,
        deviation; /* Pa; the deviation is the standard one, of the law and not of a sample */
} fracas_moments;

/* All but `init` are for strengths that are ready (fracas_strength_init), and of the law as it is
 * before any size effect of reference_volume or reference_area. */
typedef struct {
    fracas_kind kind; /* first: a strength names its distribution by this */
    double (*quantile)(const fracas_strength *strength, fracas_extent extent,
                       fracas_probability p); /* F^-1 [Pa] */
    fracas_moments (*moments)(const fracas_strength *strength, fracas_extent extent);
    fracas_err (*init)(fracas_strength *strength); /* finds its own parameters, checks what single
                                                      ranges cannot say; may be NULL */
    void (*clear)(fracas_strength *strength);      /* frees what `init` took; may be NULL */
    bool size_effect;                              /* both depend on the extent */
    /* True if it can have the weakest-link size effect of a reference; then also: */
    bool takes_reference;
    double (*far)(const fracas_strength *strength,
                  double t); /* [Pa] F^-1 where p.above is e^-t; NULL: the largest there is */
    double far_from; /* the t that it holds from, 700 at most: beyond 745 e^-t is no double */
    fracas_moments (*weakest)(const fracas_strength *strength,
                              double size); /* of the weakest of `size`; NULL: by quadrature */
    /* Both NULL where strengths are drawn: the next strength of the file, and sigma_c[i*stride] =
     * that of interface i. */
    fracas_lines_reader *read;
    fracas_err (*fill)(const fracas_strength *strength, size_t n, const double (*position)[3],
                       size_t stride, double *sigma_c);
    fracas_block_quantile *block[FRACAS_NISAS]; /* the quantile of whole blocks, by instruction set;
                                                   all NULL: of one number at a time */
    bool placed;                                /* they are found by position, not by number */
} fracas_distribution;

const fracas_distribution *fracas_distribution_of(const fracas_strength *strength);

extern const fracas_distribution fracas_constant;
extern const fracas_distribution fracas_uniform;
extern const fracas_distribution fracas_weibull;
extern const fracas_distribution fracas_lognormal;
extern const fracas_distribution fracas_normal;
extern const fracas_distribution fracas_gamma_law; /* fracas_gamma is the function */
extern const fracas_distribution fracas_flaws;
extern const fracas_distribution fracas_empirical;
extern const fracas_distribution fracas_file_distribution; /* fracas_file is a campaign file */
extern const fracas_distribution fracas_positions;

#endif
