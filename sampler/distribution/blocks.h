/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Quantiles of blocks of random numbers, over lanes: one source, compiled once for each instruction
 * set. */
#ifndef FRACAS_SAMPLER_BLOCKS_H
#define FRACAS_SAMPLER_BLOCKS_H

#include "sampler/strength.h"

#include <stddef.h>

enum { FRACAS_BLOCK_LANES = 8 }; /* the widest lanes: a block is a whole number of them */

/* sigma_c[j] = F^-1(u[j]) [Pa], with the bits of the distribution's `quantile`. u are numbers of a
 * stream, n is a multiple of FRACAS_BLOCK_LANES, both arrays are aligned to 64 bytes. */
typedef void fracas_block_quantile(const fracas_strength *strength, size_t n, const double *u,
                                   double *sigma_c);

fracas_block_quantile fracas_uniform_baseline, fracas_weibull_baseline, fracas_lognormal_baseline;
fracas_block_quantile fracas_uniform_avx2, fracas_weibull_avx2, fracas_lognormal_avx2;
fracas_block_quantile fracas_uniform_avx512, fracas_weibull_avx512, fracas_lognormal_avx512;

/* A distribution's functions, by fracas_isa. */
#define FRACAS_BLOCKS(name)                         \
    {                                               \
        name##_baseline, name##_avx2, name##_avx512 \
    }

#endif
